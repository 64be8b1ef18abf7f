/// The slots of a step: what stands in them acts in its turn, on every velocity field.

#include <array>
#include <cmath>

#include "flying_block.hpp"
#include <gmock/gmock.h>

namespace mpm {
namespace {

using namespace testing_blocks;

/// Bodies of all fields share one velocity wherever they meet: as if there were one field.
class Sticking final : public Contact<2> {
 public:
  void exchange_momentum(const GridTopology<2>& grid, std::span<NodeFields<2>> fields, double,
                         double) override
  {
    ++calls;
    for_each_node(grid, [&](LocalIndex node) {
      const double mass = fields[0].mass_of(node) + fields[1].mass_of(node);
      if (mass <= 0) return;
      for (int c = 0; c < 4; ++c) {
        const double shared = (fields[0].mass_of(node) * fields[0].updated_of(node)[c] +
                               fields[1].mass_of(node) * fields[1].updated_of(node)[c]) /
                              mass;
        for (NodeFields<2>& field : fields) field.updated_of(node)[c] = shared;
      }
    });
  }
  void exchange_gradient(const GridTopology<2>& grid, std::span<NodeFields<2>> fields, double,
                         double) override
  {
    for_each_node(grid, [&](LocalIndex node) {
      const double mass = fields[0].mass_of(node) + fields[1].mass_of(node);
      if (mass <= 0) return;
      for (int d = 0; d < 2; ++d) {
        const double shared = (fields[0].mass_of(node) * fields[0].gradient_velocity_of(node)[d] +
                               fields[1].mass_of(node) * fields[1].gradient_velocity_of(node)[d]) /
                              mass;
        for (NodeFields<2>& field : fields) field.set_gradient_velocity(node, d, shared);
      }
    });
  }
  Reaction<2> take_reaction() override { return {}; }
  void archive(Archive&) override {}

  int calls = 0;

 private:
  template <class Visit>
  static void for_each_node(const GridTopology<2>& grid, Visit visit)
  {
    for (const NodeRun<2>& run : grid.runs())
      for (LocalIndex node = run.first; node < run.first + run.length; ++node) visit(node);
  }
};

/// Two blocks that fly into each other, in one velocity field or in one each.
struct Collision {
  static constexpr double speed = 20;  // m/s
  BlockRun run;

  explicit Collision(int fields)
      : run(Decomposition<2>(MPI_COMM_WORLD, BlockRun::grid_of({26, 18}), {0, 0}, {}, {}),
            {"gimp", "flip", "musl"},
            {{{4, 4}, {9, 8}, {speed, 0}},
             {{14, 5}, {7, 6}, {-speed, 0.2 * speed}, {}, fields - 1}},
            {})
  {
  }
};

double farthest_apart(const Gathered& a, const Gathered& b)
{
  double farthest = 0;
  for (std::size_t k = 0; k < a.position.size(); ++k)
    farthest = std::max(farthest, std::abs(a.position[k] - b.position[k]));
  return farthest;
}

TEST(VelocityFields, BodiesThatStickWhereTheyMeetMoveAsInOneField)
{
  Collision one(1), two(2);
  auto sticking = std::make_unique<Sticking>();
  const Sticking& contact = *sticking;
  two.run.stepper().slots().contacts.push_back(std::move(sticking));
  constexpr int steps = 200;
  one.run.advance(steps, 0.4, Collision::speed);
  two.run.advance(steps, 0.4, Collision::speed);
  EXPECT_EQ(contact.calls, steps);
  // They have met (the gap was one cell) and slowed each other down; rounding of sums in another
  // order, amplified by some hundred elastic steps.
  EXPECT_LT(farthest_apart(one.run.gather(), two.run.gather()), 1e-9 * cell);
}

TEST(VelocityFields, WithoutContactBodiesPassThroughEachOther)
{
  Collision apart(2);
  constexpr int steps = 900;
  const Gathered before = apart.run.gather();
  apart.run.advance(steps, 0.4, Collision::speed);
  const Gathered after = apart.run.gather();
  const double way = Collision::speed * apart.run.stepper().time();
  ASSERT_GT(way, 4 * cell) << "they must have overlapped";
  for (std::size_t k = 0; k < after.mass.size(); ++k) {
    const double along_x = after.position[k] - before.position[k];
    EXPECT_NEAR(std::abs(along_x), way, 1e-9 * way);
  }
}

/// Notes when it was called.
class Clock final : public Transport<2> {
 public:
  explicit Clock(std::vector<double>& times) : times_(times) {}
  void advance(Exchange<2>&, std::vector<Body<2>>&, double time, double dt) override
  {
    times_.push_back(time);
    times_.push_back(dt);
  }
  double largest_step() const override { return 1e-7; }
  void archive(Archive&) override {}

 private:
  std::vector<double>& times_;
};

TEST(Transport, ActsOnceAStepAndItsLimitIsAsked)
{
  Collision one(1);
  std::vector<double> times;
  EXPECT_EQ(one.run.stepper().largest_step(), std::numeric_limits<double>::infinity());
  one.run.stepper().slots().transports.push_back(std::make_unique<Clock>(times));
  EXPECT_EQ(one.run.stepper().largest_step(), 1e-7);
  one.run.stepper().step(1e-8);
  one.run.stepper().step(2e-8);
  EXPECT_THAT(times, testing::ElementsAre(0, 1e-8, 1e-8, 2e-8));
}

}  // namespace
}  // namespace mpm
