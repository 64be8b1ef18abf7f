#include <mpm/shape/linear.hpp>

#include "scheme_catalogue.hpp"

namespace mpm {

template <int Dim>
std::unique_ptr<Transfer<Dim>> make_linear_transfer(SchemeKind scheme, int)
{
  return make_scheme<Dim>(scheme, Linear{});
}

template std::unique_ptr<Transfer<2>> make_linear_transfer(SchemeKind, int);
template std::unique_ptr<Transfer<3>> make_linear_transfer(SchemeKind, int);

}  // namespace mpm
