#pragma once
/// Scalars of the whole run at one moment: energies, counts, what passed a wall.

#include <mpm/conditions/rigid_wall.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/stepping/formulation.hpp>

#include <optional>
#include <span>
#include <vector>

namespace mpm {

template <int Dim>
struct Sums {
  GlobalIndex particles = 0;
  GlobalIndex id_sum = 0;
  double mass = 0;                       ///< kg
  double kinetic_energy = 0;             ///< J
  double elastic_energy = 0;             ///< J
  double plastic_work = 0;               ///< J, with that of cells that failed
  Vec<Dim> momentum = Vec<Dim>::Zero();  ///< kg m/s
  std::optional<ContactSums> contact{};
  std::optional<FailedCells> failed{};
  std::optional<double> added_mass{};  ///< kg, as in Carried

  /// Work of the stresses, stored or dissipated, and what contact stores, J.
  double stress_work() const
  {
    return elastic_energy + plastic_work + (contact ? contact->energy : 0.0) +
           (failed ? failed->energy : 0.0);
  }
};

/// Over all ranks. Collective.
template <int Dim>
Sums<Dim> sum_over_bodies(const Formulation<Dim>& formulation);

/// Particles behind the face of a rigid wall.
struct Penetration {
  GlobalIndex particles = 0;
  double deepest = 0;            ///< m
  std::vector<GlobalIndex> ids;  ///< of this rank, deeper than one cell; at most ten
};

/// The sum over the ranks; `ids` stay this rank's. Collective.
template <int Dim>
Penetration find_behind(MPI_Comm comm, const std::vector<Body<Dim>>& bodies,
                        std::span<const RigidWall<Dim>* const> walls, double time,
                        const Vec<Dim>& spacing);

/// Sum of mass times axial Cauchy stress, and of mass, of one body on this rank: the load cell's
/// reading is their quotient over all ranks.
struct AxialStress {
  double mass_stress = 0;
  double mass = 0;
};
template <int Dim>
AxialStress axial_stress(const Body<Dim>& body, int axis);

}  // namespace mpm
