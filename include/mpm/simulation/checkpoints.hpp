#pragma once
/// States of a run in files, from which it can go on.

#include <mpm/core/memory_archive.hpp>
#include <mpm/core/types.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/scene/scene.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mpm {

/// Where the words on what the run is of stand in its state.
inline constexpr const char* checkpoint_record = "record";

/// FOLDER/checkpoints/STEP.h5.
class CheckpointFolder {
 public:
  explicit CheckpointFolder(const std::filesystem::path& results) : folder_(results / "checkpoints")
  {
  }
  /// Then takes away all but the last `keep` ones, and those of later steps: the run has gone back
  /// behind them, and what it does from there on is what counts. Collective.
  void write(MPI_Comm comm, GlobalIndex step, const MemoryArchive& state, int keep) const;
  std::vector<std::filesystem::path> files() const;  ///< the newest first
  void clear() const;                                ///< on one rank

 private:
  std::filesystem::path folder_;
};

struct LoadedState {
  std::filesystem::path file;
  std::unique_ptr<Archive> state;        ///< to be loaded; regrouped if it is of other ranks
  int ranks;                             ///< that wrote it
  std::vector<std::string> passed_over;  ///< what is wrong with newer ones
};

/// Of a file, or the newest one of a folder that is whole. Collective. Throws InputError on every
/// rank where there is none.
LoadedState load_state(MPI_Comm comm, const CheckpointFolder& folder,
                       const std::optional<std::filesystem::path>& file);

/// When the next one is due.
class CheckpointSchedule {
 public:
  explicit CheckpointSchedule(const std::optional<scene::Checkpoints>& asked) : asked_(asked) {}

  /// They count from here.
  void start(GlobalIndex steps, double strain, double seconds);
  /// The run is here again; the clock has not gone back.
  void go_back(GlobalIndex steps, double strain);
  bool by_clock() const { return asked_ && asked_->wall_time; }
  bool is_due_by_clock(double seconds) const
  {
    return by_clock() && seconds - seconds_ >= *asked_->wall_time;
  }
  bool is_due(GlobalIndex steps, double strain) const;
  int keep() const { return asked_.value_or(scene::Checkpoints{}).keep; }

 private:
  std::optional<scene::Checkpoints> asked_;
  GlobalIndex steps_ = 0;
  double strain_ = 0, seconds_ = 0;
};

}  // namespace mpm
