#pragma once
/// The last sound state of a run that fails, as a snapshot in a folder of its own.

#include <mpm/simulation/run.hpp>

#include <filesystem>

namespace mpm {

template <int Dim>
class FailureSnapshot final : public Observer<Dim> {
 public:
  FailureSnapshot(const Preparation<Dim>& preparation, const std::filesystem::path& folder);

  /// Takes down what an earlier run has left.
  void start(const HistoryKind&) override;
  bool wants_last_sound_state() const override { return true; }
  /// Leaves FOLDER/failure/NAME.xdmf and its file.
  std::string failed(const typename Observer<Dim>::State& last_sound) override;
  void archive(Archive&) override {}

 private:
  const Preparation<Dim>& preparation_;
  std::filesystem::path folder_;
};

}  // namespace mpm
