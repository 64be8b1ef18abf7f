#pragma once
/// What a law and a cell that bends tell each other. A cell of the plane has one moment for either
/// axis. A brick bends as the plate that it is across each axis: alike along both axes of the
/// plate, oppositely, and twisted; what is left of its corners warps it.

#include <mpm/core/types.hpp>
#include <mpm/materials/elastic_constants.hpp>

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

/// Columns of lanes per block in Law::update_bent. In: squares of stresses of fibres, Pa^2, and
/// then energies, J, of the moments that the cell would bend with elastically. Out: in place of the
/// squares, what share of these moments the yield stress leaves.
///
/// The stress of fibres is that with which they bear a moment m when all of them yield: with the
/// thickness h, m / (V0 h / 4). In the plane: the sum of its squares over the axes, and the energy.
/// In space two of either: of moments that bend alike, sum of ((s_1 + s_2) / 2)^2 over the axes
/// across plates; and of all others, sum of 3/4 (s_1 - s_2)^2 + 3 s_12^2, and of the squares of
/// what warping strains. Together they are the squares of the plates' von Mises stress.
template <int Dim>
inline constexpr int bending_shares = Dim - 1;
template <int Dim>
inline constexpr int bending_columns = 2 * bending_shares<Dim>;

}  // namespace mpm
