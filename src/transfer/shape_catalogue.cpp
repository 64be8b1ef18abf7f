#include <mpm/core/error.hpp>
#include <mpm/transfer/transfer.hpp>

namespace mpm {

template <int Dim>
std::unique_ptr<Transfer<Dim>> make_linear_transfer(SchemeKind, int);
template <int Dim>
std::unique_ptr<Transfer<Dim>> make_gimp_transfer(SchemeKind, int);
template <int Dim>
std::unique_ptr<Transfer<Dim>> make_quadratic_transfer(SchemeKind, int);

template <int Dim>
std::unique_ptr<Transfer<Dim>> make_transfer(ShapeKind shape, SchemeKind scheme,
                                             int particles_per_cell)
{
  switch (shape) {
    case ShapeKind::linear:
      return make_linear_transfer<Dim>(scheme, particles_per_cell);
    case ShapeKind::gimp:
      return make_gimp_transfer<Dim>(scheme, particles_per_cell);
    case ShapeKind::quadratic:
      return make_quadratic_transfer<Dim>(scheme, particles_per_cell);
  }
  throw InputError("unknown shape function");
}

template std::unique_ptr<Transfer<2>> make_transfer(ShapeKind, SchemeKind, int);
template std::unique_ptr<Transfer<3>> make_transfer(ShapeKind, SchemeKind, int);

}  // namespace mpm
