#include <mpm/shape/gimp.hpp>

#include "scheme_catalogue.hpp"

namespace mpm {

template <int Dim>
std::unique_ptr<Transfer<Dim>> make_gimp_transfer(SchemeKind scheme, int particles_per_cell)
{
  return make_scheme<Dim>(scheme, Gimp{0.5 / particles_per_cell});
}

template std::unique_ptr<Transfer<2>> make_gimp_transfer(SchemeKind, int);
template std::unique_ptr<Transfer<3>> make_gimp_transfer(SchemeKind, int);

}  // namespace mpm
