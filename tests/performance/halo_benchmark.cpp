// Nanoseconds per shared node of the halo sums of a step, started with mpirun.
#include <mpm/parallel/halo.hpp>
#include <mpm/parallel/session.hpp>

#include "benchmark_block.hpp"
#include <benchmark/benchmark.h>

namespace mpm::performance {
namespace {

template <int Dim>
using Columns = std::vector<NodeColumn> (*)(NodeFields<Dim>& fields);

template <int Dim>
void sum_halo(benchmark::State& state, Columns<Dim> columns_of)
{
  constexpr int support = 3;
  const Decomposition<Dim> decomposition(MPI_COMM_WORLD, geometry<Dim>(cells_per_axis<Dim>),
                                         IndexVec<Dim>::Zero(), {}, {});
  Halo halo(decomposition, support);
  NodeFields<Dim> fields(LocalIndex(decomposition.local(decomposition.rank(), support).size()),
                         {.remap = true}, 0);
  const std::vector<NodeColumn> columns = columns_of(fields);
  MPI_Barrier(MPI_COMM_WORLD);
  for (auto _ : state) halo.sum(columns);
  const double shared = double(halo.shared_nodes().size());
  state.counters["shared_nodes"] = shared;
  state.counters["ns_per_node"] = benchmark::Counter(
      1e-9 * shared, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// The same number of calls on every rank: the sums are collective.
template <int Dim>
void register_sums()
{
  const auto add = [](const char* name, Columns<Dim> columns) {
    benchmark::RegisterBenchmark((dimension<Dim>() + "/halo/" + name).c_str(), sum_halo<Dim>,
                                 columns)
        ->Iterations(Dim == 2 ? 2000 : 200)
        ->UseRealTime()
        ->Unit(benchmark::kMicrosecond);
  };
  add("mass_momentum_force", [](NodeFields<Dim>& fields) -> std::vector<NodeColumn> {
    return {fields.mass_column(), fields.momentum_force_column()};
  });
  add("remapped_momentum",
      [](NodeFields<Dim>& fields) -> std::vector<NodeColumn> { return {fields.remap_column()}; });
}

class Silent : public benchmark::BenchmarkReporter {
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>&) override {}
};

}  // namespace
}  // namespace mpm::performance

int main(int argc, char** argv)
{
  using namespace mpm;
  const Session session(1, argv, {});
  performance::register_sums<2>();
  performance::register_sums<3>();
  const bool first = rank_of(MPI_COMM_WORLD) == 0;
  // Results are the first rank's to write.
  std::vector<char*> arguments;
  for (int k = 0; k < argc; ++k)
    if (first || !std::string_view(argv[k]).starts_with("--benchmark_out"))
      arguments.push_back(argv[k]);
  int count = int(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  performance::Silent silent;
  if (first)
    benchmark::RunSpecifiedBenchmarks();
  else
    benchmark::RunSpecifiedBenchmarks(&silent);
}
