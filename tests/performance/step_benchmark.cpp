// Nanoseconds per particle of a whole step one rank: grid update, passes, checks.
#include <mpm/conditions/rigid_wall.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/stepping/updated_lagrangian.hpp>

#include "benchmark_block.hpp"
#include <benchmark/benchmark.h>

namespace mpm::performance {
namespace {

constexpr double rate = 5e4;  // 1/s: a strain of 5e-5 in each step
constexpr double dt = 1e-9;   // s

/// These take the gradient of a velocity that the force has just changed: no stable step.
bool unstable(const Case& c, OneOf<UpdateOrderRow> order)
{
  return !stable_cfl(*c.shape, *c.scheme, *order);
}

/// A block between walls, the upper one along x pressed towards the lower.
template <int Dim>
class PressedBlock {
 public:
  PressedBlock(const Case& c, OneOf<UpdateOrderRow> order)
      : parameters(c),
        order(order),
        decomposition_(MPI_COMM_WORLD, geometry<Dim>(cells_per_axis<Dim>), IndexVec<Dim>::Zero(),
                       {}, {}),
        stepper_(make_stepper())
  {
    for (int k = 0; k < 4; ++k) step();  // past yield
  }

  void step() { stepper_->step(dt); }
  LocalIndex particles() const { return stepper_->particles(); }

  const Case parameters;
  const OneOf<UpdateOrderRow> order;

 private:
  std::unique_ptr<UpdatedLagrangian<Dim>> make_stepper() const
  {
    constexpr LocalIndex cells = cells_per_axis<Dim>;
    auto transfer = make_transfer<Dim>(parameters.shape, parameters.scheme, {0.5});
    std::vector<Body<Dim>> bodies;
    bodies.push_back(make_body<Dim>(*transfer, order->remaps, parameters.plastic, cells, rate));
    std::vector<std::unique_ptr<BoundaryCondition<Dim>>> walls;
    const ReactionBook book = parameters.scheme->book;
    for (int d = 0; d < Dim; ++d) {
      const double length = cells * spacing;
      walls.push_back(std::make_unique<RigidWall<Dim>>(WallPlacement{d, false, 0.0}, WallMotion{},
                                                       WallGrip::slip, book));
      walls.push_back(std::make_unique<RigidWall<Dim>>(WallPlacement{d, true, length},
                                                       WallMotion{d == 0 ? -rate * length : 0, 0},
                                                       WallGrip::slip, book));
    }
    typename UpdatedLagrangian<Dim>::Setup setup{std::move(transfer), order, std::move(bodies)};
    setup.slots.conditions = std::move(walls);
    setup.mass_cut = 1e-24 * density * std::pow(spacing, Dim);
    return std::make_unique<UpdatedLagrangian<Dim>>(decomposition_, std::move(setup));
  }

  Decomposition<Dim> decomposition_;
  std::unique_ptr<UpdatedLagrangian<Dim>> stepper_;
};

/// The block of the last case, which its repetitions take as it is.
template <int Dim>
std::unique_ptr<PressedBlock<Dim>> kept;

template <int Dim>
PressedBlock<Dim>& block_of(const Case& c, OneOf<UpdateOrderRow> order)
{
  if (!kept<Dim> || kept<Dim>->parameters != c || kept<Dim>->order != order) {
    kept<Dim>.reset();
    kept<Dim> = std::make_unique<PressedBlock<Dim>>(c, order);
  }
  return *kept<Dim>;
}

template <int Dim>
void register_steps()
{
  for (const OneOf<UpdateOrderRow> order : all_of_list<UpdateOrderRow>())
    for_each_case([order](const Case& c) {
      if (unstable(c, order)) return;
      benchmark::RegisterBenchmark(
          (dimension<Dim>() + "/step_" + std::string(order->keyword) + '/' + name_of(c)).c_str(),
          [order, c](benchmark::State& state) {
            PressedBlock<Dim>& block = block_of<Dim>(c, order);
            for (auto _ : state) block.step();
            state.counters["ns_per_particle"] = benchmark::Counter(
                1e-9 * block.particles(),
                benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
          })
          ->Iterations(Dim == 2 ? 8 : 1)
          ->Unit(benchmark::kMillisecond);
    });
}

}  // namespace
}  // namespace mpm::performance

int main(int argc, char** argv)
{
  using namespace mpm;
  const Session session(1, argv, {});
  performance::register_steps<2>();
  performance::register_steps<3>();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  // Steppers hold PETSc objects: they end before the session.
  performance::kept<2>.reset();
  performance::kept<3>.reset();
}
