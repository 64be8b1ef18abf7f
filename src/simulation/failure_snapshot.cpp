#include <mpm/core/error.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/simulation/failure_snapshot.hpp>
#include <mpm/simulation/snapshots.hpp>

#include <system_error>

#include <fmt/format.h>

namespace mpm {

template <int Dim>
FailureSnapshot<Dim>::FailureSnapshot(const Preparation<Dim>& preparation,
                                      const std::filesystem::path& folder)
    : preparation_(preparation), folder_(folder / "failure")
{
}

template <int Dim>
void FailureSnapshot<Dim>::start(const HistoryKind&)
{
  on_rank_zero(preparation_.comm, [this] {
    std::error_code ignored;  // usually there is none
    for (const std::filesystem::path& file :
         {folder_ / (preparation_.scene.name + ".xdmf"), folder_ / "snapshots" / "000000.h5",
          folder_ / "snapshots", folder_})
      std::filesystem::remove(file, ignored);
  });
}

template <int Dim>
std::string FailureSnapshot<Dim>::failed(const typename Observer<Dim>::State& last_sound)
{
  const scene::Scene& scene = preparation_.scene;
  const std::string when = fmt::format("step {}, t = {:.6g} s", last_sound.formulation.steps(),
                                       last_sound.formulation.time());
  try {
    output::SnapshotSeries series(preparation_.comm, folder_, scene.name,
                                  {.compress = scene.output.compress});
    series.begin();
    series.write(snapshot_of(preparation_, last_sound.formulation, last_sound.strain));
  } catch (const FileError& error) {
    return fmt::format(" The last sound state ({}) could not be written: {}", when, error.what());
  }
  return fmt::format(" The last sound state ({}) is in {}.", when,
                     (folder_ / (scene.name + ".xdmf")).string());
}

template class FailureSnapshot<2>;
template class FailureSnapshot<3>;

}  // namespace mpm
