// What the plan says of a mesh against the mesh that a total Lagrangian step builds, on any ranks.
#include <mpm/lagrangian/total_lagrangian.hpp>
#include <mpm/simulation/method.hpp>
#include <mpm/simulation/model.hpp>
#include <mpm/stepping/formulation.hpp>

#include <array>

#include "whole_scene.hpp"
#include <gtest/gtest.h>

namespace mpm {
namespace {

constexpr int steps = 4;

/// A piece of honeycomb, without contact, whose messages are not known before.
std::string honeycomb(const std::string& rest)
{
  return R"(
material: {law: von_mises, youngs_modulus: 1 GPa, poisson_ratio: 0.3, density: 1000 kg/m^3,
           yield_stress: 10 MPa}
specimen:
  size: [0.6 mm, 0.4 mm]
  shapes: [{honeycomb: {lower: [0 mm, 0 mm], upper: [0.6 mm, 0.4 mm], cell_side: 80 um,
                        wall_thickness: 25 um}}]
grid: {cells: [60, 40]}
output: {history_lines: 10, snapshots: 0}
)" + rest;
}

struct Expected {
  explicit Expected(const std::string& text)
      : scene(scene_of(text)),
        preparation(MPI_COMM_WORLD, scene, std::nullopt),
        decomposition(MPI_COMM_WORLD, preparation.partition.ownership),
        formulation(make_formulation(
            scene, preparation.layout, decomposition,
            make_model(scene, preparation.specimen, preparation.layout, decomposition)))
  {
  }

  /// Collective.
  void compare()
  {
    const Plan& plan = preparation.plan;
    double nodes = formulation->active_nodes();
    sum_over_ranks(MPI_COMM_WORLD, std::span(&nodes, 1));
    EXPECT_EQ(plan.nodes.allocated, nodes);

    // But for the last block of lanes of each body, and of the nodes.
    auto bytes = double(formulation->bytes());
    sum_over_ranks(MPI_COMM_WORLD, std::span(&bytes, 1));
    EXPECT_GE(bytes, plan.bytes());
    const auto lanes = double(lane_count * ranks_of(MPI_COMM_WORLD));
    EXPECT_LE(bytes - plan.bytes(),
              lanes * (double(plan.bodies.size()) * plan.bytes_per_particle() + 2 * 64));

    const double dt = time_step_of(preparation.layout).first();
    formulation->step(dt);  // behind which cells are looked at
    const Counters before = formulation->counters();
    for (int k = 0; k < steps; ++k) formulation->step(dt);
    const Counters after = formulation->counters();
    std::array<double, 2> sent{double(after.messages - before.messages),
                               double(after.bytes - before.bytes)};
    largest_over_ranks(MPI_COMM_WORLD, sent);
    EXPECT_EQ(plan.messages_per_step, sent[0] / steps);
    EXPECT_EQ(plan.bytes_per_step, sent[1] / steps);
  }

  scene::Scene scene;
  Preparation<2> preparation;
  Decomposition<2> decomposition;
  std::unique_ptr<Formulation<2>> formulation;
};

void expect_as_planned(const std::string& loading, const std::string& loads = "")
{
  Expected(honeycomb("numerics: {formulation: total_lagrangian, contact_stiffness: 0}\n"
                     "loading: {piston: right, speed: 10 m/s, " +
                     loading + "}\n" + loads))
      .compare();
}

TEST(MeshCount, IsThatOfTheMesh)
{
  expect_as_planned("lateral: rigid");
}

TEST(MeshCount, TakesImagesAcrossPeriodicSides)
{
  expect_as_planned("lateral: periodic");
}

TEST(MeshCount, TakesTheLoadCell)
{
  expect_as_planned("lateral: free, load_cell: {cells: 3, stiffness_ratio: 2}");
}

TEST(MeshCount, TakesLoadsOnParticles)
{
  expect_as_planned("lateral: free",
                    "loads: [{kind: traction, side: left, stress: [1 MPa, 0 Pa]}]\n");
}

TEST(MeshCount, TakesRigidBodies)
{
  Expected(R"(
materials:
  - {name: block, law: isotropic, youngs_modulus: 1 MPa, poisson_ratio: 0.3, density: 1000 kg/m^3}
  - {name: die, law: rigid, velocity: [0 m/s, -1 m/s]}
specimen:
  size: [20 mm, 10 mm]
  shapes:
    - {box: {lower: [0 mm, 0 mm], upper: [20 mm, 6 mm]}, material: block}
    - {box: {lower: [4 mm, 2 mm], upper: [8 mm, 4 mm]}, material: die}
    - {box: {lower: [7 mm, 8 mm], upper: [14 mm, 10 mm]}, material: die}
grid: {cells: [20, 10]}
numerics: {formulation: total_lagrangian, contact_stiffness: 0}
free_motion: {end_time: 1 ms}
output: {snapshots: 0}
)")
      .compare();
}

TEST(MeshCount, TakesWhatFittedCellsThatMayFailWereAtRest)
{
  std::string text = honeycomb(
      "numerics: {formulation: total_lagrangian, surface: fitted, contact_stiffness: 0}\n"
      "loading: {piston: right, speed: 10 m/s, lateral: rigid}\n");
  const std::string yield = "yield_stress: 10 MPa";
  text.insert(text.find(yield) + yield.size(), ", failure: {stretch: 3}");
  Expected(text).compare();
}

TEST(MeshCount, CountsCellsNearASurface)
{
  const scene::Scene scene = scene_of(R"(
material: {law: isotropic, youngs_modulus: 1 MPa, poisson_ratio: 0.3, density: 1000 kg/m^3}
specimen:
  size: [20 mm, 10 mm]
  shapes: [{box: {lower: [0 mm, 0 mm], upper: [20 mm, 10 mm]}}]
grid: {cells: [10, 5]}
numerics: {formulation: total_lagrangian}
loading: {piston: right, speed: 1 m/s}
)");
  const Preparation<2> preparation(MPI_COMM_WORLD, scene, std::nullopt);
  // The two outermost layers of 20 x 10 cells.
  EXPECT_EQ(preparation.plan.contact_cells, 20 * 10 - 16 * 6);
  EXPECT_EQ(preparation.plan.nodes.in_grid, 21 * 11);
}

TEST(MeshCount, CountsHinges)
{
  // Two boxes that touch in a corner, and a third one on a side of the first.
  const scene::Scene scene = scene_of(R"(
material: {law: isotropic, youngs_modulus: 1 MPa, poisson_ratio: 0.3, density: 1000 kg/m^3}
specimen:
  size: [20 mm, 10 mm]
  shapes:
    - box: {lower: [0 mm, 0 mm], upper: [8 mm, 4 mm]}
    - box: {lower: [8 mm, 4 mm], upper: [12 mm, 8 mm]}
    - box: {lower: [0 mm, 4 mm], upper: [4 mm, 10 mm]}
grid: {cells: [10, 5]}
numerics: {formulation: total_lagrangian}
free_motion: {end_time: 1 ms}
)");
  const Preparation<2> preparation(MPI_COMM_WORLD, scene, std::nullopt);
  EXPECT_EQ(preparation.plan.hinges, 1);
}

}  // namespace
}  // namespace mpm
