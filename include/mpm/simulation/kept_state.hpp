#pragma once
/// The last state of a run that was sound, in memory.

#include <mpm/core/memory_archive.hpp>
#include <mpm/simulation/history.hpp>
#include <mpm/stepping/load_balance.hpp>

#include <optional>

namespace mpm {

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
  void archive(Formulation<Dim>& formulation, LoadBalance<Dim>& balance, History<Dim>& history);

  MemoryArchive archive_;
  std::optional<Ownership<Dim>> ownership_;
};

}  // namespace mpm
