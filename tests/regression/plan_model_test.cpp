// The plan of a run against the model that is made of the same scene, and nodes that no particle
// comes near.
#include <mpm/simulation/method.hpp>
#include <mpm/simulation/model.hpp>
#include <mpm/stepping/updated_lagrangian.hpp>

#include <cmath>
#include <limits>

#include "whole_scene.hpp"
#include <gmock/gmock.h>

namespace mpm {
namespace {

std::string block(const std::string& rest)
{
  return R"(
material: {law: isotropic, youngs_modulus: 1 MPa, poisson_ratio: 0.3, density: 1000 kg/m^3}
specimen:
  size: [1 m, 0.5 m]
  shapes: [{box: {lower: [0 m, 0 m], upper: [1 m, 0.5 m]}, velocity: [0 m/s, 0 m/s]}]
output: {history_lines: 10, snapshots: 0}
)" + rest;
}

/// All that a run has before its first step.
struct Started {
  scene::Scene scene;
  Preparation<2> preparation;
  Decomposition<2> decomposition;
  Model<2> model;

  explicit Started(const std::string& text)
      : scene(scene_of(text)),
        preparation(MPI_COMM_WORLD, scene, std::nullopt),
        decomposition(MPI_COMM_WORLD, preparation.partition.ownership),
        model(make_model(scene, preparation.specimen, preparation.layout, decomposition))
  {
  }
};

TEST(Plan, NamesAsManyConditionsAsTheModelHas)
{
  const std::string grid = "grid: {cells: [10, 5]}\n";
  const auto expect_conditions = [&](const std::string& motion, std::size_t count) {
    const Started started(block(grid + motion));
    EXPECT_EQ(started.model.slots.conditions.size(), count) << motion;
    EXPECT_EQ(started.preparation.plan.conditions.size(), count) << motion;
  };
  const std::string press = "loading: {piston: right, speed: 1 m/s, strain: 10 %, lateral: ";
  expect_conditions(press + "free}\n", 2);
  expect_conditions(press + "periodic}\n", 2);
  expect_conditions(press + "rigid}\n", 4);
  expect_conditions(press + "[free, symmetric]}\n", 3);
  expect_conditions("free_motion: {end_time: 1 ms}\n", 0);
  expect_conditions("free_motion: {end_time: 1 ms, sides: [rigid, free, symmetric, free]}\n", 2);
}

TEST(Plan, NamesTheMethodWithWhatTheSceneMadeOfIt)
{
  using testing::ElementsAre;
  const auto method = [](const std::string& numerics) {
    return method_words(
        scene_of(block("grid: {cells: [10, 5]}\nloading: {piston: right, speed: 1 m/s, "
                       "strain: 10 %}\nnumerics: " +
                       numerics + "\n"))
            .numerics,
        2);
  };
  EXPECT_THAT(method("{}"), ElementsAre("uniform GIMP", "FLIP", "MUSL", "plane strain"));
  EXPECT_THAT(
      method("{pic_share: 0.01, domain: 0.5}"),
      ElementsAre("uniform GIMP with domains of 0.5", "FLIP with 1 % PIC", "MUSL", "plane strain"));
  EXPECT_THAT(method("{shape_function: quadratic, scheme: xpic, refinement_order: 3}"),
              ElementsAre("quadratic B-spline", "XPIC(3)", "MUSL", "plane strain"));
}

TEST(MakeFormulation, LeavesTheApparatusToTheOneWhoMeasures)
{
  Started started(
      block("grid: {cells: [10, 5]}\nloading: {piston: right, speed: 1 m/s, strain: 10 %}\n"));
  const std::vector<const RigidWall<2>*> at_rest = started.model.apparatus->at_rest;
  ASSERT_EQ(at_rest.size(), 3u);  // fixed edge and both lateral sides
  const auto formulation = make_formulation(started.scene, started.preparation.layout,
                                            started.decomposition, std::move(started.model));
  EXPECT_EQ(started.model.apparatus->at_rest, at_rest);
}

TEST(EmptyRegions, HaveNodesThatAStepNeitherReadsNorWrites)
{
  Started started(
      block("grid: {cells: [10, 5], margin: 1 m}\n"
            "free_motion: {end_time: 1 s}\n"
            "loads: [{kind: gravity, acceleration: [1 m/s^2, 0 m/s^2]}]\n"));
  const auto formulation = make_formulation(started.scene, started.preparation.layout,
                                            started.decomposition, std::move(started.model));
  auto& stepper = dynamic_cast<UpdatedLagrangian<2>&>(*formulation);
  const GridTopology<2>& grid = stepper.grid();
  const Plan::Nodes& planned = started.preparation.plan.nodes;

  // Cells with particles, and what the plan says that is updated around them.
  const LocalIndex first = 2 + 10, last[2] = {first + 9, first + 4};
  std::vector<LocalIndex> far;
  for (LocalIndex node = 0; node < grid.size(); ++node) {
    const IndexVec<2> at = grid.index(node);
    bool near = true;
    for (int d = 0; d < 2; ++d)
      near =
          near && at[d] >= first - planned.reach->below && at[d] <= last[d] + planned.reach->above;
    if (!near) far.push_back(node);
  }
  ASSERT_EQ(far.size(), 35u * 30 - (10 + 5) * (5 + 5));

  // The stepper's own arrays: who reads or writes there shows it.
  auto& fields = const_cast<NodeFields<2>&>(stepper.fields().front());
  const double mark = std::numeric_limits<double>::quiet_NaN();
  const auto values_of = [&](LocalIndex node) {
    return std::array<double*, 5>{&fields.mass_of(node), fields.force_of(node),
                                  fields.updated_of(node), fields.gradient_velocity_of(node),
                                  &fields.load_force[std::size_t(node) * 2]};
  };
  for (const LocalIndex node : far)
    for (double* value : values_of(node)) *value = mark;
  const double dt = time_step_of(started.preparation.layout).first();
  for (int step = 0; step < 60; ++step) stepper.step(dt);  // sorted once on the way
  stepper.check();
  for (const LocalIndex node : far)
    for (const double* value : values_of(node)) EXPECT_TRUE(std::isnan(*value));
  for (const Body<2>& body : stepper.bodies())
    for (LocalIndex p = 0; p < body.particles.size(); ++p)
      EXPECT_NEAR(body.particles.motion()(LeadingColumns<2>::velocity, p), 60 * dt, 1e-9 * dt);
}

}  // namespace
}  // namespace mpm
