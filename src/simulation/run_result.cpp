#include <mpm/parallel/session.hpp>
#include <mpm/simulation/run_result.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace mpm {

std::string GoingBack::text() const
{
  return fmt::format("{} Went back to step {}, t = {:.6g} s, and on with {:.4g} of the step.",
                     reason, step, time, step_share);
}

double judged_energy_error(const HistoryLine& line, bool under_a_piston)
{
  constexpr double judged_from = 0.01;
  return line.strain > judged_from || !under_a_piston ? std::abs(line.energy_error) : 0.0;
}

template <int Dim>
Cooperation cooperation_of(const Formulation<Dim>& formulation, const LoadBalance<Dim>& balance)
{
  const MPI_Comm comm = formulation.decomposition().comm();
  const Counters mine = formulation.counters();
  const double steps = double(std::max<GlobalIndex>(formulation.steps(), 1));
  std::array<double, 4> largest{double(mine.messages) / steps, double(mine.bytes) / steps,
                                mine.waiting_seconds, double(formulation.particles())};
  largest_over_ranks(comm, largest);
  std::array<GlobalIndex, 2> sums{mine.migrated, formulation.particles()};
  sum_over_ranks(comm, std::span(sums));
  const auto [migrated, particles] = sums;
  const Ownership<Dim>& ownership = formulation.decomposition().ownership();
  std::string words = "metis";
  if (ownership.by_cuts()) {
    words = "cuts";
    for (int d = 0; d < Dim; ++d)
      words += fmt::format("{} {}", d ? " x" : "", ownership.ranks_per_axis()[d]);
  }
  return {words,
          migrated,
          balance.repartitions(),
          largest[0],
          largest[1],
          largest[2],
          largest[3] * ranks_of(comm) / double(std::max<GlobalIndex>(particles, 1)),
          balance.mean_imbalance(),
          balance.mean_work_imbalance()};
}

void archive_goings_back(Archive& archive, std::vector<GoingBack>& goings_back)
{
  GlobalIndex count = GlobalIndex(goings_back.size());
  archive.value("goings_back", count);
  goings_back.resize(std::size_t(count));
  for (std::size_t k = 0; k < goings_back.size(); ++k) {
    const Archive::Section section(archive, "going_back" + std::to_string(k));
    GoingBack& back = goings_back[k];
    GlobalIndex lines = GlobalIndex(back.lines);
    archive.value("failed_step", back.failed_step);
    archive.value("failed_time", back.failed_time);
    archive.text("reason", back.reason);
    archive.value("step", back.step);
    archive.value("time", back.time);
    archive.value("lines", lines);
    archive.value("step_share", back.step_share);
    back.lines = std::size_t(lines);
  }
}

template Cooperation cooperation_of(const Formulation<2>&, const LoadBalance<2>&);
template Cooperation cooperation_of(const Formulation<3>&, const LoadBalance<3>&);

}  // namespace mpm
