#include <mpm/shape/quadratic.hpp>

#include "scheme_catalogue.hpp"

namespace mpm {

template <int Dim>
std::unique_ptr<Transfer<Dim>> make_quadratic_transfer(SchemeKind scheme, int)
{
  return make_scheme<Dim>(scheme, Quadratic{});
}

template std::unique_ptr<Transfer<2>> make_quadratic_transfer(SchemeKind, int);
template std::unique_ptr<Transfer<3>> make_quadratic_transfer(SchemeKind, int);

}  // namespace mpm
