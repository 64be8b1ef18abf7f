#pragma once
/// From the scene's words to the method: time step, shape function and scheme, update order,
/// partition.

#include <mpm/parallel/partition.hpp>
#include <mpm/scene/scene.hpp>
#include <mpm/simulation/layout.hpp>
#include <mpm/stepping/time_step.hpp>
#include <mpm/stepping/update_order.hpp>

namespace mpm {

bool is_total_lagrangian(const scene::Numerics& numerics);
/// What limits the step, in words: shape function, scheme and update order, or contact.
std::string limited_by(const scene::Numerics& numerics);
/// Of its shape function, scheme and update order together, or of cells in contact.
std::optional<double> stable_cfl_of(const scene::Numerics& numerics);
double default_cfl(const scene::Numerics& numerics);
/// Least stretch of cells that keep their mass. Crushing is slow, free motion need not be.
double mass_scaling_of(const scene::Scene& scene);
/// Whether a material says where its cells fail.
bool cells_may_fail(const scene::Scene& scene);
/// When a step leaves the stresses, counted from the moment of the velocities, in steps.
double stress_moment_of(const scene::Numerics& numerics);
StepExtras extras_of(const scene::Numerics& numerics);
/// What the reactions of walls are measured from.
ReactionBook reaction_book(const scene::Numerics& numerics);
/// As a reader of the field writes them: shape function, scheme, update order, and the space.
std::vector<std::string> method_words(const scene::Numerics& numerics, int dimensions);
template <int Dim>
TimeStep time_step_of(const Layout<Dim>& layout);
/// At least, or where the scene ends the run before: compression makes steps shorter on the way.
template <int Dim>
double expected_steps(const scene::Scene& scene, const Layout<Dim>& layout);

template <int Dim>
std::unique_ptr<Transfer<Dim>> make_transfer(const scene::Numerics& numerics,
                                             int particles_per_cell);

/// Columns of the motion of particles of a law, as the formulation needs them.
template <int Dim>
std::vector<Column> motion_columns(const scene::Numerics& numerics, int particles_per_cell,
                                   const Law<Dim>& law);

/// Cuts across the piston's travel come first.
template <int Dim>
PartitionRules<Dim> partition_rules(const scene::Scene& scene);

/// Balanced by the particles at the start, of which each rank counts its slab. Collective.
template <int Dim>
Partition<Dim> first_partition(MPI_Comm comm, const scene::Scene& scene,
                               const micrograph::Specimen<Dim>& specimen,
                               const Layout<Dim>& layout);

}  // namespace mpm
