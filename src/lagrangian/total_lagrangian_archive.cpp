/// Checkpoints: what is kept of a run, and how it goes on from that.

#include <mpm/core/archive.hpp>
#include <mpm/lagrangian/total_lagrangian.hpp>

#include <string>
#include <vector>

namespace mpm {

template <int Dim>
void TotalLagrangian<Dim>::archive(Archive& archive)
{
  archive.value("time", time_);
  archive.value("kicked_time", kicked_time_);
  archive.value("steps", steps_);
  archive.value("checked", checked_);
  archive.value("last_step", last_step_);
  archive.value("largest_speed", largest_speed_, Over::largest);
  archive.value("fastest", fastest_);
  archive.value("friction_work", friction_work_, Over::sum);
  {
    const Archive::Section section(archive, "agreed");
    agreed_.archive(archive);
  }
  {
    const Archive::Section section(archive, "counters");
    Counters all = counters();
    all.archive(archive);
    if (archive.is_loading()) earlier_ += all -= counters();
  }
  for (std::size_t b = 0; b < setup_.bodies.size(); ++b) {
    const Archive::Section section(archive, "body" + std::to_string(b));
    archive_cells(archive, b);
  }
  {
    const Archive::Section section(archive, "given");
    given_.archive(archive);
  }
  {
    const Archive::Section section(archive, "nodes");
    const std::vector<std::int64_t> rows = nodes_->archive(archive);
    fields_->archive(archive, rows);
    archive.rows("friction", rows, friction_);
  }
  archive_failure(archive);
  setup_.slots.archive(archive);
  if (!archive.is_loading()) return;
  loss_.reset();
  particles_are_present_ = false;
  if (!contact_) return;
  renew_pairs();
}

/// Regrouped, the cells that are this rank's without those that have failed.
template <int Dim>
void TotalLagrangian<Dim>::archive_cells(Archive& archive, std::size_t number)
{
  ParticleStore& particles = setup_.bodies[number].particles;
  if (!archive.regroups()) return particles.archive(archive);
  std::vector<std::int64_t> rows = archive.places_of("id", particles.ids());
  if (cells_may_fail()) {
    std::vector<LocalIndex> failed;
    for (std::size_t cell = 0; cell < rows.size(); ++cell)
      if (rows[cell] < 0) failed.push_back(LocalIndex(cell));
    remove(number, failed);
    rows = archive.places_of("id", particles.ids());  // which all ranks ask
  }
  particles.take(archive, rows);
}

/// Regrouped, they are known by what has become of particles.
template <int Dim>
void TotalLagrangian<Dim>::archive_removed(Archive& archive)
{
  if (archive.regroups()) return archive.pass_over("removed_cells");
  const Archive::Section section(archive, "removed_cells");
  std::vector<double> list;
  for (const RestCell<Dim>& cell : removed_) cell.pack(list);
  archive.list("at_rest", list);
  removed_.clear();
  for (std::size_t k = 0; k < list.size(); k += RestCell<Dim>::values)
    removed_.push_back(RestCell<Dim>::unpacked(&list[k]));
}

template <int Dim>
void TotalLagrangian<Dim>::archive_failure(Archive& archive)
{
  if (!cells_may_fail()) return;
  const Archive::Section section(archive, "failure");
  archive.value("cells", failed_.cells, Over::sum);
  archive.value("id_sum", failed_.id_sum, Over::sum);
  archive.value("mass", failed_.mass, Over::sum);
  archive.value("energy", failed_.energy, Over::sum);
  archive.value("plastic_work", failed_.plastic_work, Over::sum);
  occupants_.archive(archive);
  archive_removed(archive);
  for (std::size_t b = 0; b < cells_.size(); ++b) {
    const std::string name = "body" + std::to_string(b);
    if (archive.regroups()) {
      archive.pass_over(name);
      continue;
    }
    const Archive::Section of_body(archive, name);
    cells_[b].archive(archive);
  }
  if (archive.is_loading()) list_what_is_left();
}

template void TotalLagrangian<2>::archive(Archive&);
template void TotalLagrangian<3>::archive(Archive&);

}  // namespace mpm
