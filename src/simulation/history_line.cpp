#include <mpm/simulation/history_line.hpp>

#include <iterator>
#include <span>

namespace mpm {

namespace {

/// Everything that a line holds.
template <class T>
struct Member {
  const char* name;
  T HistoryLine::*member;
};
constexpr Member<double> measured[] = {{"time", &HistoryLine::time},
                                       {"strain", &HistoryLine::strain},
                                       {"piston_stress", &HistoryLine::piston_stress},
                                       {"edge_stress", &HistoryLine::edge_stress},
                                       {"load_cell_stress", &HistoryLine::load_cell_stress},
                                       {"kinetic_energy", &HistoryLine::kinetic_energy},
                                       {"elastic_energy", &HistoryLine::elastic_energy},
                                       {"plastic_work", &HistoryLine::plastic_work},
                                       {"external_work", &HistoryLine::external_work},
                                       {"contact_energy", &HistoryLine::contact_energy},
                                       {"overlapped_area", &HistoryLine::overlapped_area},
                                       {"deepest_overlap", &HistoryLine::deepest_overlap},
                                       {"friction_work", &HistoryLine::friction_work},
                                       {"failed_energy", &HistoryLine::failed_energy},
                                       {"added_mass", &HistoryLine::added_mass},
                                       {"energy_error", &HistoryLine::energy_error},
                                       {"momentum_error", &HistoryLine::momentum_error},
                                       {"time_step", &HistoryLine::time_step}};
constexpr Member<GlobalIndex> counted[] = {{"particles", &HistoryLine::particles},
                                           {"contact_pairs", &HistoryLine::contact_pairs},
                                           {"failed_cells", &HistoryLine::failed_cells},
                                           {"behind_piston", &HistoryLine::behind_piston},
                                           {"outside_walls", &HistoryLine::outside_walls}};

}  // namespace

void archive_lines(Archive& archive, std::vector<HistoryLine>& lines)
{
  const Archive::Section section(archive, "lines");
  GlobalIndex count = GlobalIndex(lines.size());
  archive.value("count", count);
  lines.resize(std::size_t(count));
  const auto columns = [&]<class T>(const Member<T>* members, std::size_t size) {
    for (const auto& [name, member] : std::span(members, size)) {
      std::vector<T> column;
      for (const HistoryLine& line : lines) column.push_back(line.*member);
      archive.values(name, column);
      for (std::size_t k = 0; k < lines.size(); ++k) lines[k].*member = column[k];
    }
  };
  columns(measured, std::size(measured));
  columns(counted, std::size(counted));
}

std::vector<output::HistoryColumn> history_columns(const HistoryKind& kind)
{
  std::vector<output::HistoryColumn> list{{"time", "s"}};
  if (kind.piston) {
    list.push_back({"strain", "1"});
    list.push_back({"stress", "Pa"});
    list.push_back({"stress_piston", "Pa"});
    list.push_back({"stress_edge", "Pa"});
    if (kind.load_cell) list.push_back({"stress_load_cell", "Pa"});
  }
  for (const char* energy : {"kinetic_energy", "elastic_energy", "plastic_work", "external_work"})
    list.push_back({energy, "J"});
  if (kind.contact) {
    list.push_back({"contact_energy", "J"});
    list.push_back(kind.space ? output::HistoryColumn{"overlapped_volume", "m3"}
                              : output::HistoryColumn{"overlapped_area", "m2"});
    list.push_back({"deepest_overlap", "1"});
    list.push_back({"contact_pairs", "1"});
  }
  if (kind.friction) list.push_back({"friction_work", "J"});
  if (kind.failure) {
    list.push_back({"failed_cells", "1"});
    list.push_back({"failed_energy", "J"});
  }
  if (kind.added_mass) list.push_back({"added_mass", "1"});
  list.push_back({"energy_error", "1"});
  list.push_back({"momentum_error", "1"});
  list.push_back({"particles", "1"});
  list.push_back({"time_step", "s"});
  if (kind.piston) {
    list.push_back({"behind_piston", "1"});
    list.push_back({"outside_walls", "1"});
  }
  return list;
}

std::vector<double> history_row(const HistoryLine& line, const HistoryKind& kind)
{
  std::vector<double> values{line.time};
  if (kind.piston) {
    values.insert(values.end(), {line.strain, line.stress(), line.piston_stress, line.edge_stress});
    if (kind.load_cell) values.push_back(line.load_cell_stress);
  }
  values.insert(values.end(),
                {line.kinetic_energy, line.elastic_energy, line.plastic_work, line.external_work});
  if (kind.contact)
    values.insert(values.end(), {line.contact_energy, line.overlapped_area, line.deepest_overlap,
                                 double(line.contact_pairs)});
  if (kind.friction) values.push_back(line.friction_work);
  if (kind.failure) values.insert(values.end(), {double(line.failed_cells), line.failed_energy});
  if (kind.added_mass) values.push_back(line.added_mass);
  values.insert(values.end(),
                {line.energy_error, line.momentum_error, double(line.particles), line.time_step});
  if (kind.piston)
    values.insert(values.end(), {double(line.behind_piston), double(line.outside_walls)});
  return values;
}

}  // namespace mpm
