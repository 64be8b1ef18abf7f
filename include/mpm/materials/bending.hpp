#pragma once
/// What a law and a cell that bends tell each other. A cell of the plane has one moment for either
/// axis. A brick bends as the plate that it is across each axis: alike along both axes of the
/// plate, oppositely, and twisted; what is left of its corners warps it.

#include <mpm/core/lanes.hpp>
#include <mpm/core/types.hpp>
#include <mpm/materials/elastic_constants.hpp>

#include <algorithm>

namespace mpm {

/// Moduli against bending of the undeformed material, Pa; 0 for a law that cannot tell.
template <int Dim>
struct BendingModuli;

/// Of fibres along each axis: of a plate of unit width, 12 / thickness^3 times its stiffness.
template <>
struct BendingModuli<2> {
  Vec<2> fibres = Vec<2>::Zero();
};

/// Of plates without stress across them: of the sum of the strains of both axes' fibres, of their
/// difference and of the shear; of fibres by themselves.
template <>
struct BendingModuli<3> {
  double alike = 0, opposite = 0, fibres = 0;

  BendingModuli() = default;
  explicit BendingModuli(const IsotropicConstants& elastic)
      : alike(elastic.youngs_modulus / (1 - elastic.poisson_ratio)),
        opposite(2 * elastic.shear_modulus()),
        fibres(elastic.youngs_modulus)
  {
  }
};

/// Stresses of fibres in Law::update_bent: with which they bear the moments when all of them yield.
/// With the thickness h that of a moment m is m / (V0 h / 4). In the plane one for the fibres along
/// each axis. In space those of the plates across each axis, in parts whose squares add up to that
/// of the von Mises stress, (s_1 + s_2) / 2, sqrt(3/4) (s_1 - s_2) and sqrt(3) s_12 of the next two
/// axes; and then of what warping strains along each axis.
template <int Dim>
inline constexpr int bending_stresses = Dim == 2 ? 2 : 12;

/// Columns of lanes per block in Law::update_bent: the stresses of fibres, Pa, in: of the moments
/// that the cell would bend with elastically, out: what flow takes of them; and then the cell's
/// deformation F_ij at i + Dim j.
template <int Dim>
inline constexpr int bending_columns = bending_stresses<Dim> + Dim* Dim;

/// Of one block that does not flow.
template <int Dim>
void take_no_moments(double* columns)
{
  std::fill_n(columns, bending_stresses<Dim> * lane_count, 0.0);
}

}  // namespace mpm
