#pragma once
/// From a scene and its specimen to bodies and what acts on them: the run before its first step.

#include <mpm/conditions/rigid_wall.hpp>
#include <mpm/core/corner_offsets.hpp>
#include <mpm/lagrangian/rigid_cells.hpp>
#include <mpm/simulation/layout.hpp>
#include <mpm/stepping/formulation.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace mpm {

/// Piston, fixed edge and what their reactions are divided by.
template <int Dim>
struct Apparatus {
  RigidWall<Dim>* piston = nullptr;
  RigidWall<Dim>* edge = nullptr;
  std::vector<const RigidWall<Dim>*> at_rest;  ///< fixed edge and lateral walls
  int axis = 0;
  double length = 0;  ///< m, of the specimen along the axis (without the load cell)
  double area = 0;    ///< m^2, reference cross-section
  int load_cell_body = -1;

  double strain(double time) const
  {
    return std::abs(piston->motion().displacement(time)) / length;
  }
};

/// The rank's share of the bodies, and what acts on them. Bodies: one per deformable material that
/// has particles, then the load cell.
template <int Dim>
struct Model {
  std::vector<Body<Dim>> bodies;
  std::vector<RigidCells<Dim>> rigid{};  ///< of a total Lagrangian step; else conditions
  Slots<Dim> slots{};
  CornerOffsets<Dim> offsets{};  ///< of the corners of this rank's locations at rest
  std::optional<Apparatus<Dim>> apparatus;
};

/// Collective.
template <int Dim>
Model<Dim> make_model(const scene::Scene& scene, const micrograph::Specimen<Dim>& specimen,
                      const Layout<Dim>& layout, const Decomposition<Dim>& decomposition);

/// What steps the model, of which it takes all but the apparatus. Collective.
template <int Dim>
std::unique_ptr<Formulation<Dim>> make_formulation(const scene::Scene& scene,
                                                   const Layout<Dim>& layout,
                                                   const Decomposition<Dim>& decomposition,
                                                   Model<Dim>&& model);

template <int Dim>
Loads<Dim> loads_of(const scene::Scene& scene);

/// Columns of the particles of a law, with those that loads and the exact solution need.
template <int Dim>
ParticleStore empty_store(const scene::Scene& scene, int particles_per_cell, const Law<Dim>& law,
                          const Loads<Dim>& loads);

}  // namespace mpm
