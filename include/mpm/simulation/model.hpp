#pragma once
/// From a scene and its specimen to grid, bodies and conditions: the run before its first step.

#include <mpm/conditions/rigid_wall.hpp>
#include <mpm/micrograph/specimen.hpp>
#include <mpm/parallel/partition.hpp>
#include <mpm/scene/scene.hpp>
#include <mpm/simulation/stepper.hpp>
#include <mpm/transfer/transfer.hpp>

namespace mpm {

/// Piston, fixed edge and what their reactions are divided by.
struct Apparatus {
  RigidWall<2>* piston = nullptr;
  RigidWall<2>* edge = nullptr;
  std::array<RigidWall<2>*, 2> lateral{nullptr, nullptr};  ///< none where free
  int axis = 0;
  double length = 0;  ///< m, of the specimen along the axis (without the load cell)
  double area = 0;    ///< m^2, reference cross-section
  int load_cell_body = -1;
};

/// Time at which the piston reaches a strain, s.
double time_of_strain(const scene::Scene& scene, const micrograph::SpecimenModel& specimen,
                      const WallMotion& piston, double strain);

/// What does not depend on the rank.
struct Layout {
  GridGeometry<2> geometry;
  std::array<double, 2> specimen_lower;  ///< m, where the lattice starts
  std::array<double, 2> location_size;   ///< m
  std::array<LocalIndex, 2> padding;     ///< cells left of and below the specimen
  double particle_volume;                ///< m^3
  double largest_particle_mass;          ///< kg
  double wave_speed;                     ///< m/s, of the stiffest body
  double cfl;
  double largest_speed;  ///< m/s, piston or initial
  /// Of the piston, towards the specimen; and the time at which it reaches the last strain, s.
  WallMotion piston;
  double end_time;
  struct LoadCellBox {
    IndexBox<2> locations;
    double density_ratio;
  };
  std::optional<LoadCellBox> load_cell;  ///< in locations from the specimen's lower left corner
};

Layout make_layout(const scene::Scene& scene, const micrograph::SpecimenModel& specimen);

/// The rank's share of the bodies, and conditions. Bodies: one per deformable material that has
/// particles, then the load cell.
struct Model {
  std::vector<Body<2>> bodies;
  std::vector<std::unique_ptr<BoundaryCondition<2>>> conditions;
  std::optional<Apparatus> apparatus;
  std::unique_ptr<Transfer<2>> transfer;
};

Model make_model(const scene::Scene& scene, const micrograph::SpecimenModel& specimen,
                 const Layout& layout, const Decomposition<2>& decomposition);

double default_cfl(const scene::Numerics& numerics);

/// Cuts across the piston's travel come first.
PartitionRules<2> partition_rules(const scene::Scene& scene);
/// Balanced by the particles at the start. Collective.
Decomposition<2> make_decomposition(MPI_Comm comm, const scene::Scene& scene,
                                    const micrograph::SpecimenModel& specimen,
                                    const Layout& layout);

}  // namespace mpm
