// Every load in the list: the force it makes, when, and the work and impulse that are booked.
#include <mpm/conditions/load_rows.hpp>
#include <mpm/conditions/loads.hpp>

#include <cmath>
#include <numeric>

#include "moving_nodes.hpp"
#include <gmock/gmock.h>

namespace mpm {
namespace {

/// Sums over some hundred nodes or tens of particles, relative to the largest term.
constexpr double rounding = 1e-12;

/// All values of a load, defaults filled in.
ParameterValues complete(const LoadRow& row, ParameterValues values)
{
  fill_defaults(row, values);
  return values;
}

template <int Dim>
Loads<Dim> only(const char* keyword, const ParameterValues& values)
{
  const OneOf<LoadRow> row = keyword;
  std::vector<std::unique_ptr<Load<Dim>>> list;
  list.push_back(make_load<Dim>(*row, complete(*row, values), 0));
  return Loads<Dim>(std::move(list));
}

/// Moving nodes with momentum, and columns for the load's force.
template <int Dim>
struct LoadedNodes : MovingNodes<Dim> {
  NodeFields<Dim> fields;

  LoadedNodes() : fields(this->grid.topology.size(), {.load_force = true}, 0)
  {
    const NodeColumn momentum = fields.momentum_column();
    for (LocalIndex node = 0; node < this->grid.topology.size(); ++node) {
      fields.mass_of(node) = this->grid.fields.mass_of(node);
      for (int d = 0; d < Dim; ++d)
        momentum.values[node * momentum.stride + d] =
            fields.mass_of(node) * this->velocity(node, d);
    }
  }

  /// The grid update of a step.
  void step(Loads<Dim>& loads, double time, double dt)
  {
    const auto& topology = this->grid.topology;
    loads.apply(topology, topology.runs(), fields, time, dt);
    fields.update_velocity(topology.runs(), dt);
    loads.book(topology, topology.runs(), fields, dt);
  }
  double force(LocalIndex node, int d) const { return fields.load_force[node * Dim + d]; }
  double mass(LocalIndex node) const { return fields.mass_of(node); }
};

template <class Case>
class LoadsOnNodes : public testing::Test {
};
template <int Dim>
struct In {
  static constexpr int dim = Dim;
};
using PlaneAndSpace = testing::Types<In<2>, In<3>>;
TYPED_TEST_SUITE(LoadsOnNodes, PlaneAndSpace);

TYPED_TEST(LoadsOnNodes, GravityIsMassTimesAccelerationAndRisesSmoothly)
{
  constexpr int Dim = TypeParam::dim;
  const std::vector<double> g{0.5, -9.81, 2};
  for (const auto& [time, share] : {std::pair{0.0, 0.0}, {0.5, 0.5}, {0.25, 0.15625}, {7.0, 1.0}}) {
    LoadedNodes<Dim> nodes;
    Loads<Dim> loads = only<Dim>("gravity", {{"acceleration", g}, {"ramp_time", 1.0}});
    EXPECT_FALSE(loads.act_on_particles());
    nodes.step(loads, time, 0.1);
    for (const LocalIndex node : {0, 17, 63})
      for (int d = 0; d < Dim; ++d)
        EXPECT_DOUBLE_EQ(nodes.force(node, d), share * nodes.mass(node) * g[std::size_t(d)]);
  }
}

TYPED_TEST(LoadsOnNodes, DampingTakesTheSameShareOfEveryVelocityWhateverTheStep)
{
  constexpr int Dim = TypeParam::dim;
  for (const double dt : {1e-3, 0.5, 20.0}) {
    LoadedNodes<Dim> nodes;
    Loads<Dim> loads = only<Dim>("damping", {{"rate", 3.0}});
    nodes.step(loads, 0, dt);
    for (const LocalIndex node : {1, 40})
      for (int d = 0; d < Dim; ++d)
        EXPECT_NEAR(nodes.fields.updated_of(node)[d], nodes.velocity(node, d) * std::exp(-3 * dt),
                    rounding);
  }
}

TYPED_TEST(LoadsOnNodes, WorkIsTheChangeOfKineticEnergyAndImpulseThatOfMomentum)
{
  constexpr int Dim = TypeParam::dim;
  const std::vector<double> g{0.5, -9.81, 2};
  for (const char* load : {"gravity", "damping"}) {
    LoadedNodes<Dim> nodes;
    Loads<Dim> loads = std::string(load) == "gravity" ? only<Dim>(load, {{"acceleration", g}})
                                                      : only<Dim>(load, {{"rate", 3.0}});
    nodes.step(loads, 0, 0.1);
    double energy = 0, size = 0;
    Vec<Dim> momentum = Vec<Dim>::Zero();
    for (LocalIndex node = 0; node < nodes.grid.topology.size(); ++node) {
      if (!nodes.grid.topology.is_owned(node)) continue;
      for (int d = 0; d < Dim; ++d) {
        const double before = nodes.velocity(node, d), after = nodes.fields.updated_of(node)[d];
        energy += 0.5 * nodes.mass(node) * (after * after - before * before);
        momentum[d] += nodes.mass(node) * (after - before);
        size += 0.5 * nodes.mass(node) * before * before;
      }
    }
    const Reaction<Dim> booked = loads.take_reaction();
    EXPECT_GT(std::abs(energy), 1e-3 * size);
    EXPECT_NEAR(booked.work, energy, rounding * size) << load;
    EXPECT_NEAR((booked.impulse - momentum).norm(), 0, rounding * size) << load;
    EXPECT_EQ(loads.take_reaction().work, 0);
  }
}

/// Particles with a column for the area on which load 0 acts, in lanes that they do not fill.
Body<2> particles(int count)
{
  Body<2> body{"cloud",
               0,
               1.0,
               nullptr,
               {{{"position", 2, "m"},
                 {"velocity", 2, "m/s"},
                 {"mass", 1, "kg"},
                 {"loaded_area_0", 1, "m2"}},
                {{"initial_volume", 1, "m3"}},
                {"mass", "loaded_area_0", "initial_volume"}}};
  for (int p = 0; p < count; ++p) {
    const LocalIndex at = body.particles.add(p);
    ColumnGroup& motion = body.particles.motion();
    motion(0, at) = 0.1 * p;
    motion(1, at) = 1 - 0.2 * p;
    motion(4, at) = 1 + p;
    motion(5, at) = p % 3 == 0 ? 0.25 : 0.0;
  }
  body.particles.seal();
  return body;
}

std::vector<Vec<2>> forces_of(const char* keyword, const ParameterValues& values, double time,
                              const Body<2>& body)
{
  const OneOf<LoadRow> row = keyword;
  const auto load = make_load<2>(*row, complete(*row, values), 0);
  EXPECT_TRUE(load->acts_on_particles());
  std::vector<Vec<2>> all;
  for (LocalIndex b = 0; b < body.particles.blocks(); ++b) {
    Lanes force[2] = {0.0, 0.0};
    load->add_to_particles(body, b, time, force);
    for (int lane = 0; lane < lane_count; ++lane) all.push_back({force[0][lane], force[1][lane]});
  }
  return all;
}

TEST(LoadsOnParticles, BodyForceIsMassTimesTheFormulaWhereTheParticleIsNow)
{
  const Body<2> body = particles(11);
  const Formulas a{Formula("x*y + t", 2), Formula("-sin(y)", 2), Formula()};
  for (const auto& [time, share] : {std::pair{0.5, 0.5}, {3.0, 1.0}}) {
    const auto forces =
        forces_of("body_force", {{"acceleration", a}, {"ramp_time", 1.0}}, time, body);
    for (int p = 0; p < 11; ++p) {
      const double x = 0.1 * p, y = 1 - 0.2 * p, mass = 1 + p;
      EXPECT_NEAR(forces[std::size_t(p)][0], share * mass * (x * y + time), rounding);
      EXPECT_NEAR(forces[std::size_t(p)][1], -share * mass * std::sin(y), rounding);
    }
    for (std::size_t lane = 11; lane < forces.size(); ++lane) EXPECT_EQ(forces[lane].norm(), 0);
  }
}

TEST(LoadsOnParticles, TractionIsStressTimesAreaOfTheMarkedAlone)
{
  const Body<2> body = particles(11);
  const ParameterValues values{
      {"side", "top"}, {"stress", std::vector{3.0, -8.0, 0.0}}, {"ramp_time", 2.0}};
  for (const auto& [time, share] : {std::pair{1.0, 0.5}, {2.0, 1.0}}) {
    const auto forces = forces_of("traction", values, time, body);
    for (std::size_t p = 0; p < forces.size(); ++p) {
      const double area = p < 11 && p % 3 == 0 ? 0.25 : 0;
      EXPECT_DOUBLE_EQ(forces[p][0], share * 3 * area);
      EXPECT_DOUBLE_EQ(forces[p][1], -share * 8 * area);
    }
  }
}

TEST(LoadsOnParticles, TractionMarksTheSideAndTheBoxThatItNames)
{
  const OneOf<LoadRow> row = "traction";
  const ParameterValues values =
      complete(*row, {{"side", "back"},
                      {"stress", std::vector{0.0, 0.0, 1.0}},
                      {"within", Corners{.lower = {0, 1, 2}, .upper = {3, 4, 5}}}});
  const auto mark = make_load<3>(*row, values, 7)->mark();
  ASSERT_TRUE(mark);
  EXPECT_EQ(mark->axis, 2);
  EXPECT_FALSE(mark->upper);
  EXPECT_EQ(mark->column(), "loaded_area_7");
  EXPECT_TRUE(mark->within.contains({3, 1, 2}));
  EXPECT_FALSE(mark->within.contains({3, 0.9, 2}));
  EXPECT_TRUE(row->check(values, 2));
  EXPECT_FALSE(row->check(values, 3));
}

TEST(LoadList, ExamplesOfAllNumbersLieWithinTheirBounds)
{
  for (const LoadRow& row : list_of<LoadRow>())
    for (const KindParameter& parameter : row.parameters) {
      EXPECT_FALSE(parameter.help.empty());
      const bool numbers =
          parameter.type == ParameterType::number || parameter.type == ParameterType::vector;
      if (!parameter.choices.empty() || !numbers) continue;
      EXPECT_NE(parameter.example, 0) << row.keyword << " " << parameter.key;
      EXPECT_EQ(parameter.bound.violation(parameter.example), std::nullopt) << parameter.key;
    }
}

}  // namespace
}  // namespace mpm
