#include <mpm/core/error.hpp>
#include <mpm/materials/laws.hpp>

#include <algorithm>

namespace mpm {

#define MPM_LAW(keyword) LawRow keyword##_law();
#include "laws.list"
#undef MPM_LAW

template <>
std::span<const LawRow> list_of<LawRow>()
{
#define MPM_LAW(keyword) keyword##_law(),
  static const LawRow rows[] = {
#include "laws.list"
  };
#undef MPM_LAW
  return rows;
}

bool LawRow::has(std::string_view key) const
{
  return std::ranges::find(parameters, key, &KindParameter::key) != parameters.end();
}

std::vector<std::string> laws_there(int dimensions)
{
  std::vector<std::string> keywords;
  for (const LawRow& row : list_of<LawRow>())
    if (row.is_there(dimensions)) keywords.push_back(row.keyword);
  return keywords;
}

template <int Dim>
std::unique_ptr<Law<Dim>> make_law(const LawRow& law, const ParameterValues& values,
                                   PlaneAssumption plane)
{
  if (!law.is_there(Dim)) {
    std::string words;
    for (const std::string& other : laws_there(Dim)) words += (words.empty() ? "" : ", ") + other;
    const std::string reason = !law.deformable() ? "has no stress"
                               : Dim == 2        ? "is there in space only"
                                                 : "is there in the plane only";
    throw InputError("law " + law.keyword + " " + reason + ". Use one of: " + words + ".");
  }
  if constexpr (Dim == 2)
    return law.in_plane(values, plane);
  else
    return law.in_space(values);
}

template std::unique_ptr<Law<2>> make_law(const LawRow&, const ParameterValues&, PlaneAssumption);
template std::unique_ptr<Law<3>> make_law(const LawRow&, const ParameterValues&, PlaneAssumption);

}  // namespace mpm
