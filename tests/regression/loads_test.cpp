// Whole scenes with loads, initial velocities and walls that follow tables, against exact
// solutions.
#include <mpm/core/error.hpp>
#include <mpm/simulation/method.hpp>
#include <mpm/simulation/model.hpp>

#include <array>
#include <cmath>
#include <numbers>

#include "whole_scene.hpp"
#include <gmock/gmock.h>

namespace mpm {
namespace {

/// Sums over some hundred particles and steps.
constexpr double rounding = 1e-11;

/// A block in cells of 5 cm, c = 37 m/s in confined compression.
std::string block(const std::string& rest, const std::string& more_of_specimen = "",
                  const std::string& corner = "[1 m, 0.2 m]")
{
  return R"(material: {law: isotropic, youngs_modulus: 1 MPa, poisson_ratio: 0.3, density: 1000 kg/m^3}
specimen:
  size: [1 m, 0.2 m]
  shapes: [{box: {lower: [0 m, 0 m], upper: )" +
         corner + "}}]\n" + more_of_specimen +
         "grid: {cells: [20, 4], margin: 0.3 m}\noutput: {history_lines: 10}\n" + rest;
}

constexpr double density = 1000, young = 1e6, poisson = 0.3;
const double confined_modulus = young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson));

TEST(Gravity, ABlockFallsWithGTimesTAndTheWayOfTheSteps)
{
  const Outcome fall =
      run_scene(block("free_motion: {end_time: 0.1 s}\n"
                      "loads: [{kind: gravity, acceleration: [2 m/s^2, -10 m/s^2]}]\n"));
  const Vec<2> g(2, -10);
  // Each step goes its length with the velocity at its end.
  double steps = 0, longest = 0;
  for (std::size_t k = 1; k < fall.times.size(); ++k) {
    const double dt = fall.times[k] - fall.times[k - 1];
    steps += dt * fall.times[k];
    longest = std::max(longest, dt);
  }
  ASSERT_EQ(fall.particles.size(), 40u * 8);
  for (const Particle& p : fall.particles) {
    EXPECT_NEAR((p.velocity - fall.end() * g).norm(), 0, rounding);
    EXPECT_NEAR((p.place - p.start - steps * g).norm(), 0, rounding);
  }
  EXPECT_NEAR(steps, 0.5 * fall.end() * fall.end(), 0.5 * longest * fall.end());
  EXPECT_GT(fall.last().external_work, 0);
  EXPECT_LT(std::abs(fall.last().energy_error), rounding);
  EXPECT_LT(fall.last().momentum_error, rounding);
}

/// Everywhere in a column 1 m high. The strain hardly differs within a cell, so that it carries its
/// mean weight throughout.
void expect_weight_above(const Outcome& column, double gravity)
{
  std::array<double, 20> stress{};
  for (const Particle& p : column.particles) stress[std::size_t(p.start[0] * 20)] += p.stress[0];
  for (std::size_t cell = 0; cell < 20; ++cell)
    EXPECT_NEAR(stress[cell] / 16, -density * gravity * (1 - (double(cell) + 0.5) / 20),
                0.002 * density * gravity);
}

TEST(Gravity, AColumnThatIsLoadedSlowlyCarriesItsWeight)
{
  // The first period is 4 H / c = 0.11 s; the rate of damping is about critical for it.
  const Outcome column = run_scene(
      block("free_motion: {end_time: 0.8 s, sides: [symmetric, free, symmetric, symmetric]}\n"
            "loads:\n"
            "  - {kind: gravity, acceleration: [-10 m/s^2, 0 m/s^2], ramp_time: 0.2 s}\n"
            "  - {kind: damping, rate: 60 1/s}\n"));
  const double at_foot = density * 10 * 1.0;
  expect_weight_above(column, 10);
  EXPECT_LT(column.last().kinetic_energy, 1e-9 * column.last().elastic_energy);
  EXPECT_LT(std::abs(column.last().energy_error), 0.01);
  // The nominal stress is the weight above: tau exp(-tau / M) = -P. Its variation within a cell
  // makes 0.06 % of the energy.
  double energy = 0;
  constexpr int slices = 1000;
  for (int k = 0; k < slices; ++k) {
    const double nominal = -at_foot * (k + 0.5) / slices;
    double tau = nominal;
    for (int iteration = 0; iteration < 20; ++iteration)
      tau = nominal * std::exp(tau / confined_modulus);
    energy += 0.2 / slices * tau * tau / (2 * confined_modulus);
  }
  EXPECT_NEAR(column.last().elastic_energy / energy, 1, 0.002);
}

TEST(Gravity, DoesNotWeighWhatMassScalingAdds)
{
  // Cells at the foot are heavier by a tenth then.
  const Outcome column = run_scene(
      block("numerics: {formulation: total_lagrangian, mass_scaling: 1}\n"
            "free_motion: {end_time: 0.8 s, sides: [symmetric, free, symmetric, symmetric]}\n"
            "loads:\n"
            "  - {kind: gravity, acceleration: [-60 m/s^2, 0 m/s^2], ramp_time: 0.2 s}\n"
            "  - {kind: damping, rate: 60 1/s}\n"));
  expect_weight_above(column, 60);
}

TEST(Gravity, AndDampingDoNotActOnWhatIsRigid)
{
  const scene::Scene scene = scene_of(R"(materials:
  - {name: rubber, law: isotropic, youngs_modulus: 1 MPa, poisson_ratio: 0.3, density: 1000 kg/m^3}
  - {name: ram, law: rigid, velocity: [0.5 m/s, 0 m/s]}
specimen:
  size: [1 m, 0.2 m]
  shapes:
    - {box: {lower: [0 m, 0 m], upper: [0.1 m, 0.2 m]}, material: ram}
    - {box: {lower: [0.2 m, 0 m], upper: [1 m, 0.2 m]}}
grid: {cells: [20, 4], margin: 0.3 m}
numerics: {formulation: total_lagrangian}
free_motion: {end_time: 0.1 s}
loads:
  - {kind: gravity, acceleration: [2 m/s^2, -10 m/s^2]}
  - {kind: damping, rate: 1e-9 1/s}
)");
  const Preparation<2> preparation(MPI_COMM_WORLD, scene, std::nullopt);
  const Decomposition<2> decomposition(MPI_COMM_WORLD, preparation.partition.ownership);
  const auto formulation =
      make_formulation(scene, preparation.layout, decomposition,
                       make_model(scene, preparation.specimen, preparation.layout, decomposition));
  const TimeStep time_step = time_step_of(preparation.layout);
  for (int k = 0; k < 10; ++k) formulation->step(time_step.first());
  Vec<2> impulse = formulation->slots().loads.take_reaction().impulse;
  sum_over_ranks(MPI_COMM_WORLD, std::span(impulse.data(), 2));
  const double mass = 0.8 * 0.2 * density;
  EXPECT_LT((impulse - mass * formulation->time() * Vec<2>(2, -10)).norm(), 1e-6 * impulse.norm());
}

TEST(Traction, ABarIsStressedByItAndGrowsLongerByTheForceOverTheStiffness)
{
  // It ends in the middle of a cell. Where a free end comes out of a cell's side, FLIP shakes on
  // what little mass the next nodes have: 1 % of the energy, instead of none.
  const Outcome bar =
      run_scene(block("free_motion: {end_time: 1 s, sides: [symmetric, free, free, free]}\n"
                      "loads:\n"
                      "  - {kind: traction, side: right, stress: [1 kPa, 0 Pa], ramp_time: 0.2 s}\n"
                      "  - {kind: damping, rate: 60 1/s}\n",
                      "", "[0.975 m, 0.2 m]"));
  const double modulus = young / (1 - poisson * poisson);  // plane strain, free across
  double stress = 0, way = 0;
  int inside = 0, at_end = 0;
  for (const Particle& p : bar.particles) {
    if (p.start[0] > 0.25 && p.start[0] < 0.75) stress += p.stress[0], ++inside;
    if (p.start[0] > 0.95) way += p.place[0] - p.start[0], ++at_end;
  }
  ASSERT_EQ(at_end, 8);
  // Strains of 0.1 %: what is not linear is as small. The last half cell is not loaded in full.
  EXPECT_NEAR(stress / inside, 1000, 3);
  EXPECT_NEAR(way / at_end / (1000 / modulus * 0.9625), 1, 0.01);
  EXPECT_LT(bar.last().kinetic_energy, 1e-8 * bar.last().elastic_energy);
  EXPECT_LT(bar.last().momentum_error, rounding);
}

TEST(Traction, OnADiscActsOnItsHeightWhicheverRankHoldsTheRim)
{
  const std::string disc = R"(material: {law: isotropic, youngs_modulus: 1 MPa, poisson_ratio: 0.3,
  density: 1000 kg/m^3}
specimen: {size: [1 m, 1 m], shapes: [{disc: {centre: [0.5 m, 0.5 m], radius: 0.25 m}}]}
grid: {cells: [20, 20], margin: 0.2 m}
free_motion: {end_time: 10 ms}
)";
  for (const auto& [within, height] :
       {std::pair{"", 0.5}, {", within: {lower: [0 m, 0.5 m], upper: [1 m, 1 m]}", 0.25}})
    for (const char* side : {"left", "right"}) {
      const Outcome pulled = run_scene(disc + "loads: [{kind: traction, side: " + side +
                                       ", stress: [100 Pa, -300 Pa]" + within + "}]\n");
      Vec<2> momentum = Vec<2>::Zero();
      for (const Particle& p : pulled.particles) momentum += density * 0.025 * 0.025 * p.velocity;
      // Whole rows of locations lie between the disc's lowest and highest point.
      const Vec<2> impulse = height * pulled.end() * Vec<2>(100, -300);
      EXPECT_NEAR((momentum - impulse).norm() / impulse.norm(), 0, rounding) << side << within;
      EXPECT_LT(pulled.last().momentum_error, rounding);
    }
}

TEST(Traction, WithoutAParticleInItsBoxIsRefusedOnEveryRank)
{
  const std::string scene = block(
      "free_motion: {end_time: 1 ms}\n"
      "loads: [{kind: traction, side: right, stress: [1 Pa, 0 Pa], "
      "within: {lower: [2 m, 0 m], upper: [3 m, 1 m]}}]\n");
  try {
    run_scene(scene);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("loads[0] acts on nothing"));
  }
}

TEST(BodyForce, ThatShakesEverythingTheSameMakesTheMotionOfItsIntegral)
{
  const Outcome shaken =
      run_scene(block("free_motion: {end_time: 0.1 s}\n"
                      "loads: [{kind: body_force, acceleration: [20*sin(100*t), 0]}]\n"));
  double of_steps = 0, longest = 0;
  for (std::size_t k = 1; k < shaken.times.size(); ++k) {
    const double dt = shaken.times[k] - shaken.times[k - 1];
    of_steps += dt * 20 * std::sin(100 * shaken.times[k - 1]);
    longest = std::max(longest, dt);
  }
  for (const Particle& p : shaken.particles) {
    EXPECT_NEAR(p.velocity[0], of_steps, rounding);
    EXPECT_NEAR(p.velocity[1], 0, rounding);
  }
  // A sum from the left end of each step is off by half a step times the change of the integrand.
  EXPECT_NEAR(of_steps, 20 / 100.0 * (1 - std::cos(100 * shaken.end())), 0.5 * longest * 2 * 20);
  EXPECT_LT(std::abs(shaken.last().energy_error), rounding);
  EXPECT_LT(shaken.last().momentum_error, rounding);
}

/// The lowest mode of a bar between rigid ends, c = sqrt(M / rho): it turns round after L / c.
double mode_time()
{
  return 1.0 / std::sqrt(confined_modulus / density);
}

TEST(BodyForce, InAFormulaOfPlaceAndTimeDrivesAModeOfABar)
{
  // u = a sin(pi x) (1 - cos(w t)) needs rho (u_tt - c^2 u_xx), a small.
  const double w = 60, a = 1e-5, c2 = confined_modulus / density, pi = std::numbers::pi;
  const std::string formula = std::to_string(a * 1e6) + "e-6*sin(pi*x)*(" + std::to_string(w * w) +
                              "*cos(60*t) + " + std::to_string(pi * pi * c2) + "*(1 - cos(60*t)))";
  const Outcome bar =
      run_scene(block("free_motion: {end_time: 0.04 s, sides: symmetric}\n"
                      "loads: [{kind: body_force, acceleration: [\"" +
                      formula + "\", 0]}]\n"));
  // The error falls with the square of the spacing; 20 cells give less than 2 %.
  for (const Particle& p : bar.particles)
    EXPECT_NEAR(p.place[0] - p.start[0],
                a * std::sin(pi * p.start[0]) * (1 - std::cos(w * bar.end())), 0.02 * 2 * a)
        << p.start[0];
}

TEST(InitialVelocity, InTheLowestModeOfABarComesBackReversed)
{
  const Outcome bar = run_scene(
      block("free_motion: {end_time: " + std::to_string(mode_time()) + " s, sides: symmetric}\n",
            "  initial_velocity: [\"1e-3*sin(pi*x)\", 0 m/s]\n"));
  // Of 20 cells, in the middle of which the mode is largest.
  for (const Particle& p : bar.particles)
    EXPECT_NEAR(p.velocity[0], -1e-3 * std::sin(std::numbers::pi * p.start[0]), 0.03e-3);
  EXPECT_LT(std::abs(bar.last().energy_error), 0.01);
}

TEST(InitialVelocity, SetsTheLargestSpeedOfTheLayout)
{
  const scene::Scene scene = scene_of(
      block("free_motion: {end_time: 1 ms}\n", "  initial_velocity: [\"8*x\", \"-20*y\"]\n"));
  const Preparation<2> preparation(MPI_COMM_WORLD, scene, std::nullopt);
  EXPECT_NEAR(preparation.layout.largest_speed, 8 * (1 - 0.0125), rounding);
  const scene::Scene nowhere = scene_of(
      block("free_motion: {end_time: 1 ms}\n", "  initial_velocity: [sqrt(0.9 - x), 0]\n"));
  EXPECT_THROW(Preparation<2>(MPI_COMM_WORLD, nowhere, std::nullopt), InputError);
}

TEST(Damping, AloneMakesVelocitiesFallExponentially)
{
  const Outcome slow =
      run_scene(block("free_motion: {end_time: 0.05 s}\n"
                      "loads: [{kind: damping, rate: 40 1/s}]\n",
                      "  initial_velocity: [3 m/s, -1 m/s]\n"));
  const double left = std::exp(-40 * slow.end());
  for (const Particle& p : slow.particles)
    EXPECT_NEAR((p.velocity - left * Vec<2>(3, -1)).norm(), 0, rounding);
  const double start = 0.5 * 0.2 * density * 10;
  EXPECT_NEAR(slow.last().external_work / (start * (left * left - 1)), 1, rounding);
  EXPECT_LT(std::abs(slow.last().energy_error), rounding);
  EXPECT_LT(slow.last().momentum_error, rounding);
}

/// It is read every few steps, and lines may come more often.
TEST(LoadCell, HasAStressInEveryLine)
{
  for (const char* formulation : {"updated_lagrangian", "total_lagrangian"}) {
    const Outcome pressed = run_scene(
        R"(material: {law: isotropic, youngs_modulus: 1 MPa, poisson_ratio: 0.3, density: 1000 kg/m^3}
specimen: {size: [1 m, 0.2 m], shapes: [{box: {lower: [0 m, 0 m], upper: [1 m, 0.2 m]}}]}
grid: {cells: [20, 4]}
loading: {piston: right, speed: 0.4 m/s, strain: 5 %, load_cell: {cells: 3}}
output: {history_lines: 2000}
numerics: {formulation: )" +
        std::string(formulation) + "}\n");
    const std::vector<HistoryLine>& lines = pressed.result.lines;
    ASSERT_GT(lines.size(), 100u);
    for (std::size_t k = lines.size() / 2; k < lines.size(); ++k)
      ASSERT_GT(lines[k].load_cell_stress, 0.2 * lines[k].stress()) << formulation << ", " << k;
  }
}

TEST(MovingSide, ThatFollowsATableTakesABlockAlong)
{
  // 0.1 s up to 0.1 m/s and 0.1 s down again: a way of 1 cm; damping brings the block to rest.
  const Outcome pushed =
      run_scene(block("free_motion: {end_time: 0.8 s, moving_sides: [{side: left, table: "
                      "[[0 s, 0 m/s], [0.1 s, 0.1 m/s], [0.2 s, 0 m/s]]}]}\n"
                      "loads: [{kind: damping, rate: 60 1/s}]\n"));
  // The wall holds nodes, from which particles creep by a part of a percent of a cell.
  for (const Particle& p : pushed.particles)
    EXPECT_NEAR(p.place[0] - p.start[0], 0.01, 0.01 * 0.02) << p.start.transpose();
  // At its fastest it had 1 J.
  EXPECT_LT(pushed.last().kinetic_energy + pushed.last().elastic_energy, 0.01);
  EXPECT_LT(pushed.last().momentum_error, rounding);
}

TEST(RigidMaterial, ThatFollowsATableDoesTheWorkThatItsBlockHolds)
{
  const std::string text = R"(materials:
  - {name: rubber, law: isotropic, youngs_modulus: 1 MPa, poisson_ratio: 0.3, density: 1000 kg/m^3}
  - {name: ram, law: rigid, velocity_table: [[0 s, 0 m/s, 0 m/s], [50 ms, 0.8 m/s, 0 m/s]]}
specimen:
  size: [1 m, 0.2 m]
  shapes:
    - {box: {lower: [0 m, 0 m], upper: [0.1 m, 0.2 m]}, material: ram}
    - {box: {lower: [0.1 m, 0 m], upper: [1 m, 0.2 m]}}
grid: {cells: [20, 4], margin: 0.3 m}
free_motion: {end_time: 0.1 s, sides: [free, free, symmetric, symmetric]}
output: {history_lines: 10}
)";
  const scene::Scene scene = scene_of(text);
  const Preparation<2> preparation(MPI_COMM_WORLD, scene, std::nullopt);
  EXPECT_DOUBLE_EQ(preparation.layout.largest_speed, 0.8);
  const Outcome pushed = run_scene(text);
  EXPECT_GT(pushed.last().external_work, 0);
  EXPECT_LT(std::abs(pushed.last().energy_error), 0.02);
  EXPECT_LT(pushed.last().momentum_error, rounding);
  // What touches the ram goes its way: 0.02 + 0.04 m.
  for (const Particle& p : pushed.particles)
    if (p.start[0] < 0.12) {
      EXPECT_NEAR(p.place[0] - p.start[0], 0.06, 0.1 * 0.05);
    }
}

}  // namespace
}  // namespace mpm
