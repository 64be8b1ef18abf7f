#pragma once
/// Pictures of all particles at the moments that a scene asks for.

#include <mpm/output/snapshot.hpp>
#include <mpm/simulation/run.hpp>

#include <filesystem>

namespace mpm {

/// All particles of this rank as they are, with the fields that the scene asks for.
template <int Dim>
output::Snapshot snapshot_of(const Preparation<Dim>& preparation, Formulation<Dim>& formulation,
                             double strain);

/// Ascending, s; those after the end of the run are not taken.
template <int Dim>
std::vector<double> snapshot_moments(const Preparation<Dim>& preparation);

inline bool asks_for_snapshots(const scene::Scene& scene)
{
  return !scene.output.snapshot_strains.empty() || !scene.output.snapshot_times.empty();
}

/// Of every run, so that one may go on with other moments, or with none.
template <int Dim>
class Snapshots final : public Observer<Dim> {
 public:
  Snapshots(const Preparation<Dim>& preparation, const std::filesystem::path& folder);
  void start(const HistoryKind&) override { series_.begin(); }
  void look(const typename Observer<Dim>::State& state) override;
  void kept() override;
  void went_back(const GoingBack& back) override;
  void archive(Archive& archive) override;

 private:
  bool pass_moments();

  const Preparation<Dim>& preparation_;
  output::SnapshotSeries series_;
  std::vector<double> moments_;  ///< s, ascending
  double looked_ = -1;           ///< s, when last
  std::size_t next_ = 0;
  std::size_t next_when_kept_ = 0;
  int written_when_kept_ = 0;
};

}  // namespace mpm
