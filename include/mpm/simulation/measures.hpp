#pragma once
/// Scalars of the whole run at one moment: energies, counts, what passed a wall.

#include <mpm/simulation/model.hpp>

namespace mpm {

struct ParticleSums {
  GlobalIndex particles = 0;
  GlobalIndex id_sum = 0;
  double mass = 0;                   ///< kg
  double kinetic_energy = 0;         ///< J
  double elastic_energy = 0;         ///< J
  double plastic_work = 0;           ///< J
  Vec<2> momentum = Vec<2>::Zero();  ///< kg m/s

  /// Work of the stresses, stored or dissipated, J.
  double stress_work() const { return elastic_energy + plastic_work; }
};

/// Over all ranks. Collective.
ParticleSums sum_particles(MPI_Comm comm, const std::vector<Body<2>>& bodies);

/// Particles behind the face of a rigid wall.
struct Penetration {
  GlobalIndex particles = 0;
  double deepest = 0;            ///< m
  std::vector<GlobalIndex> ids;  ///< of this rank, deeper than one cell; at most ten
};

/// The sum over the ranks; `ids` stay this rank's. Collective.
Penetration find_behind(MPI_Comm comm, const std::vector<Body<2>>& bodies,
                        const std::vector<const RigidWall<2>*>& walls, double time,
                        const Vec<2>& spacing);

/// Sum of mass times axial Cauchy stress, and of mass, of one body on this rank: the load cell's
/// reading is their quotient over all ranks.
struct AxialStress {
  double mass_stress = 0;
  double mass = 0;
};
AxialStress axial_stress(const Body<2>& body, int axis);

}  // namespace mpm
