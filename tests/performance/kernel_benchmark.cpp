// Nanoseconds per particle of each pass, of the material update and of the sort, by themselves.
#include "benchmark_block.hpp"
#include "node_grid.hpp"
#include <benchmark/benchmark.h>

namespace mpm::performance {
namespace {

constexpr double dt = 1e-9;   // s
constexpr double rate = 1e2;  // 1/s: a strain of 1e-7 in each call, so that nothing leaves its cell
constexpr double past_yield = 1e-3;

enum class Pass { musl_velocity, musl_stress, usf_stress, usf_velocity, usl };
constexpr const char* pass_names[] = {"musl_velocity", "musl_stress", "usf_stress", "usf_velocity",
                                      "usl"};

/// Body and grid with the velocities of compression along x, sorted; plastic ones past yield.
template <int Dim>
struct Block {
  Case parameters;
  bool musl;
  std::unique_ptr<Transfer<Dim>> transfer;
  NodeGrid<Dim> grid;
  Body<Dim> body;
  std::vector<LocalIndex> nodes, counts, order;

  Block(const Case& c, bool with_musl)
      : parameters(c),
        musl(with_musl),
        transfer(make_transfer<Dim>(c.shape, c.scheme, {0.5})),
        grid(geometry<Dim>(cells_per_axis<Dim>), whole_grid(), whole_grid(), 0),
        body(make_body<Dim>(*transfer, musl, c.plastic, cells_per_axis<Dim>, rate))
  {
    for (LocalIndex node = 0; node < grid.topology.size(); ++node) {
      grid.topology.touch(node);
      const LocalIndex along_x = node % grid.topology.local().count()[0];
      const double v = -rate * grid.topology.geometry().node_position(0, along_x);
      grid.fields.updated_of(node)[0] = v;
      grid.fields.set_gradient_velocity(node, 0, v);
    }
    grid.end_activity(transfer->support());
    sort();
    transfer->usf_stress(body, grid.topology, grid.fields, past_yield / rate);
  }

  static IndexBox<Dim> whole_grid()
  {
    return {IndexVec<Dim>::Zero(), geometry<Dim>(cells_per_axis<Dim>).nodes};
  }

  void sort()
  {
    transfer->first_nodes(body.particles, grid.topology, nodes);
    order_by_node(nodes, grid.topology.size(), counts, order);
    body.particles.permute(order);
    body.particles.seal();
  }

  void run(Pass pass)
  {
    const Vec<Dim> far = Vec<Dim>::Constant(1);
    const MoveBounds<Dim> bounds{-far, far};
    switch (pass) {
      case Pass::musl_velocity:
        transfer->musl_velocity(body, grid.topology, grid.fields);
        return;
      case Pass::musl_stress:
        transfer->musl_stress(body, grid.topology, grid.fields, dt, bounds);
        return;
      case Pass::usf_stress:
        transfer->usf_stress(body, grid.topology, grid.fields, dt);
        return;
      case Pass::usf_velocity:
        transfer->usf_velocity(body, grid.topology, grid.fields, dt, bounds);
        return;
      case Pass::usl:
        transfer->usl(body, grid.topology, grid.fields, dt, bounds);
        return;
    }
  }
};

/// The block of the last case: repetitions and passes that fit it take it as it is.
template <int Dim>
Block<Dim>& block_of(const Case& c, bool musl)
{
  static std::unique_ptr<Block<Dim>> kept;
  if (!kept || kept->parameters != c || kept->musl != musl) {
    kept.reset();
    kept = std::make_unique<Block<Dim>>(c, musl);
  }
  return *kept;
}

template <int Dim, class Work>
void measure(const std::string& name, const Case& c, bool musl, Work work)
{
  benchmark::RegisterBenchmark(
      (dimension<Dim>() + '/' + name).c_str(),
      [c, musl, work](benchmark::State& state) {
        Block<Dim>& block = block_of<Dim>(c, musl);
        work(block);  // memory and caches as in the calls that follow
        for (auto _ : state) work(block);
        state.counters["ns_per_particle"] = benchmark::Counter(
            1e-9 * block.body.particles.size(),
            benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
      })
      ->Iterations(Dim == 2 ? 8 : 1)
      ->Unit(benchmark::kMillisecond);
}

template <int Dim>
void register_passes(const Case& c)
{
  for (const Pass pass :
       {Pass::musl_velocity, Pass::musl_stress, Pass::usf_stress, Pass::usf_velocity, Pass::usl}) {
    const bool updates_stress = pass != Pass::musl_velocity && pass != Pass::usf_velocity;
    if (c.plastic && !updates_stress) continue;
    const bool musl = pass == Pass::musl_velocity || pass == Pass::musl_stress;
    measure<Dim>(std::string(pass_names[int(pass)]) + '/' + name_of(c), c, musl,
                 [pass](Block<Dim>& block) { block.run(pass); });
  }
}

/// The law with nothing around it, in pieces that stay in the first-level cache as in the passes.
template <int Dim>
void update_stress(Block<Dim>& block)
{
  constexpr LocalIndex chunk = std::max(1, 128 / lane_count);
  constexpr int width = Dim * Dim * lane_count;
  alignas(lane_alignment) static double gradient[chunk * width];
  alignas(lane_alignment) static double force[chunk * symmetric_components<Dim> * lane_count];
  for (int k = 0; k < chunk * Dim * Dim; ++k)
    for (int lane = 0; lane < lane_count; ++lane)
      gradient[k * lane_count + lane] = k % (Dim * Dim) % (Dim + 1) == 0 ? -rate : 0.1 * rate;
  ParticleStore& particles = block.body.particles;
  for (LocalIndex b = 0; b < particles.blocks(); b += chunk) {
    block.body.law->update(particles.state().block(b), std::min(chunk, particles.blocks() - b),
                           gradient, dt, force);
    benchmark::DoNotOptimize(force[0]);
  }
}

template <int Dim>
void register_all()
{
  for (const bool plastic : {false, true}) {
    const Case c{"linear", "flip", plastic};
    measure<Dim>(std::string("law/") + (plastic ? "plastic" : "elastic"), c, true,
                 update_stress<Dim>);
  }
  measure<Dim>("sort", Case{"gimp", "flip", true}, true, [](Block<Dim>& block) { block.sort(); });
  for_each_case(register_passes<Dim>);
}

}  // namespace
}  // namespace mpm::performance

int main(int argc, char** argv)
{
  mpm::performance::register_all<2>();
  mpm::performance::register_all<3>();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
}
