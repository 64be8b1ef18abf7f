#pragma once
/// The last state of a run that was sound, in memory.

#include <mpm/core/memory_archive.hpp>
#include <mpm/simulation/history.hpp>
#include <mpm/stepping/load_balance.hpp>

namespace mpm {

/// State of the three, as it goes on: what one has saved another one on the same ranks, set up for
/// the same scene, loads. Collective where it loads.
template <int Dim>
void archive_run(Archive& archive, Formulation<Dim>& formulation, LoadBalance<Dim>& balance,
                 History<Dim>& history);

template <int Dim>
class KeptState {
 public:
  /// Steps between two states that are kept: what it costs then is below a part in a thousand.
  static constexpr GlobalIndex steps_between = 1000;

  void save(Formulation<Dim>& formulation, LoadBalance<Dim>& balance, History<Dim>& history);
  /// All three are as they were when saved, whatever became of them and of the borders between
  /// ranks since. Collective.
  void load(Formulation<Dim>& formulation, LoadBalance<Dim>& balance, History<Dim>& history);

 private:
  MemoryArchive archive_;
};

}  // namespace mpm
