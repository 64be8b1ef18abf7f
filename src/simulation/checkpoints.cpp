#include <mpm/core/error.hpp>
#include <mpm/output/regrouped_state.hpp>
#include <mpm/output/replace_file.hpp>
#include <mpm/output/state_file.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/simulation/checkpoints.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <system_error>

#include <fmt/format.h>

namespace mpm {

namespace {

std::string name_of(GlobalIndex step)
{
  return fmt::format("{:012}.h5", step);
}

/// Whether a run gives this name to its checkpoints. What else stands there is the user's.
bool is_of_a_step(const std::filesystem::path& file)
{
  const std::string stem = file.stem().string();
  return file.extension() == ".h5" && stem.size() == 12 &&
         std::ranges::all_of(stem, [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

void CheckpointFolder::write(MPI_Comm comm, GlobalIndex step, const MemoryArchive& state,
                             int keep) const
{
  on_rank_zero(comm, [&] { output::make_directory(folder_); });
  const std::filesystem::path written = folder_ / name_of(step);
  output::write_state(comm, written, state);
  on_rank_zero(comm, [&] {
    int kept = 0;
    for (const std::filesystem::path& file : files()) {
      if (file <= written && ++kept <= keep) continue;
      std::error_code ignored;  // one that stays harms nobody
      std::filesystem::remove(file, ignored);
    }
  });
}

std::vector<std::filesystem::path> CheckpointFolder::files() const
{
  std::vector<std::filesystem::path> found;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder_, none))
    if (is_of_a_step(entry.path())) found.push_back(entry.path());
  std::ranges::sort(found, std::greater());
  return found;
}

void CheckpointFolder::clear() const
{
  std::error_code failure;
  std::filesystem::remove_all(folder_, failure);
  if (failure)
    throw FileError(fmt::format("{}: cannot be removed ({}). Choose another folder with --output.",
                                folder_.string(), failure.message()));
}

LoadedState load_state(MPI_Comm comm, const CheckpointFolder& folder,
                       const std::optional<std::filesystem::path>& file)
{
  const std::vector<std::filesystem::path> files = file ? std::vector{*file} : folder.files();
  LoadedState loaded;
  for (const std::filesystem::path& candidate : files) {
    try {
      agree(comm, [&] { loaded.ranks = output::ranks_of_state(candidate); });
      if (loaded.ranks == ranks_of(comm)) {
        auto state = std::make_unique<MemoryArchive>(output::read_state(comm, candidate));
        state->start_loading();
        loaded.state = std::move(state);
      } else {
        loaded.state = std::make_unique<output::RegroupedState>(comm, candidate);
      }
      loaded.file = candidate;
      return loaded;
    } catch (const FileError& error) {
      loaded.passed_over.emplace_back(error.what());
    }
  }
  if (loaded.passed_over.empty())
    throw InputError(
        "--restart: there is no checkpoint in the folder of results. Name the folder of the run "
        "with --output, and write checkpoints with output.checkpoints.");
  throw InputError(fmt::format("{} There is no other checkpoint to go on from.",
                               fmt::join(loaded.passed_over, " ")));
}

void CheckpointSchedule::start(GlobalIndex steps, double strain, double seconds)
{
  go_back(steps, strain);
  seconds_ = seconds;
}

void CheckpointSchedule::go_back(GlobalIndex steps, double strain)
{
  steps_ = steps;
  strain_ = strain;
}

/// Multiples of what was asked for, so that a run that went on writes them where it would have.
bool CheckpointSchedule::is_due(GlobalIndex steps, double strain) const
{
  if (!asked_) return false;
  if (asked_->steps && steps / *asked_->steps > steps_ / *asked_->steps) return true;
  return asked_->strain &&
         std::floor(strain / *asked_->strain) > std::floor(strain_ / *asked_->strain);
}

}  // namespace mpm
