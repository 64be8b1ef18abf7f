#include <mpm/micrograph/anatomy_keys.hpp>

#include <fmt/format.h>

namespace mpm::micrograph::anatomy {

namespace {

template <class T>
double number(const T& section, const Row<T>& row)
{
  if (const auto* real = std::get_if<double T::*>(&row.member)) return section.**real;
  return section.*std::get<int T::*>(row.member);
}

template <class T, std::size_t N>
void add_rows(std::string& table, std::string_view path, const Row<T> (&rows)[N], const T& defaults)
{
  for (const Row<T>& row : rows)
    table += fmt::format("| `{}.{}` | {} | {:g} ... {:g} | {:g} | {} |\n", path, row.name, row.unit,
                         row.lowest, row.highest, number(defaults, row), row.help);
}

}  // namespace

std::string key_table()
{
  std::string table =
      "| key | unit | range | default | meaning |\n|---|---|---|---|---|\n"
      "| `seed` |  | 0 ... 2^64 - 1 | 1 | which piece of wood of this kind |\n";
  Parameters wood;
  const std::vector<ResinCanal> canal(1);
  const std::vector<DensityWindow> window(1);
  add_rows(table, "picture", picture_rows, wood.picture);
  add_rows(table, "gray", gray_rows, wood.gray);
  add_rows(table, "irregularity", irregularity_rows, wood.irregularity);
  add_rows(table, "files", files_rows, wood.files);
  add_rows(table, "files.earlywood", cell_rows, wood.files.earlywood);
  add_rows(table, "files.latewood", cell_rows, wood.files.latewood);
  add_rows(table, "growth_ring", ring_rows, wood.growth_ring);
  add_rows(table, "rays", rays_rows, wood.rays.emplace());
  add_rows(table, "vessels", vessels_rows, wood.vessels.emplace());
  add_rows(table, "grain", grain_rows, wood.grain.emplace());
  add_rows(table, "resin_canals[k]", canal_rows, canal.front());
  add_rows(table, "density", density_rows, wood.density.emplace());
  add_rows(table, "density.windows[k]", window_rows, window.front());
  return table;
}

}  // namespace mpm::micrograph::anatomy
