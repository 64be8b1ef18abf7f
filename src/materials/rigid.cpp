#include <mpm/materials/laws.hpp>

#include <algorithm>

namespace mpm {

namespace {

std::optional<Contradiction> check(const ParameterValues& v)
{
  const ParameterValue *velocity = v.find("velocity"), *table = v.find("velocity_table");
  if (!velocity || !table || std::get<TimeTable>(*table).empty()) return std::nullopt;
  const auto& components = std::get<std::vector<double>>(*velocity);
  if (std::ranges::all_of(components, [](double c) { return c == 0; })) return std::nullopt;
  return Contradiction{"velocity_table", "does not go with velocity"};
}

}  // namespace

/// No stress: conditions/rigid_body moves it.
LawRow rigid_law()
{
  return {.keyword = "rigid",
          .help = "cannot be deformed; moves with its velocity",
          .parameters = {{.key = "velocity",
                          .help = "prescribed velocity",
                          .type = ParameterType::vector,
                          .quantity = Quantity::velocity,
                          .fallback = std::vector{0.0, 0.0, 0.0}},
                         {.key = "velocity_table",
                          .help = "in place of velocity: times and velocities [t, x, y], straight "
                                  "lines between them, constant before and after",
                          .type = ParameterType::time_table,
                          .quantity = Quantity::velocity,
                          .fallback = TimeTable{}}},
          .check = check};
}

}  // namespace mpm
