#pragma once
/// Every law in the list, with the example of each parameter and every combination of its words, in
/// the plane (strain and stress) and in space as far as it is there: a new row is tested with it.

#include <mpm/materials/laws.hpp>

#include "material_point.hpp"
#include <gmock/gmock.h>

namespace mpm {

struct ListedLaw {
  OneOf<LawRow> row;
  ParameterValues values;
  int dim;
  PlaneAssumption plane;
  std::string name;

  double density() const { return values.number("density"); }
  template <int Dim>
  std::shared_ptr<const Law<Dim>> make() const
  {
    return make_law<Dim>(*row, values, plane);
  }
  /// work.template operator()<Dim>()
  template <class Work>
  void in_its_dimension(Work work) const
  {
    if (dim == 2)
      work.template operator()<2>();
    else
      work.template operator()<3>();
  }
};

/// All combinations of words, numbers as in the examples.
inline void add_values(const LawRow& row, std::size_t next, const ParameterValues& values,
                       const std::string& name, std::vector<ListedLaw>& list)
{
  if (next < row.parameters.size()) {
    const KindParameter& parameter = row.parameters[next];
    ParameterValues more = values;
    if (parameter.choices.empty()) more.set(parameter.key, parameter.example);
    for (const std::string& word : parameter.choices) {
      more.set(parameter.key, word);
      add_values(row, next + 1, more, name + '_' + word, list);
    }
    if (parameter.choices.empty()) add_values(row, next + 1, more, name, list);
    return;
  }
  if (row.in_plane) {
    list.push_back(
        {OneOf<LawRow>(row.keyword), values, 2, PlaneAssumption::strain, name + "_plane_strain"});
    list.push_back(
        {OneOf<LawRow>(row.keyword), values, 2, PlaneAssumption::stress, name + "_plane_stress"});
  }
  if (row.in_space)
    list.push_back(
        {OneOf<LawRow>(row.keyword), values, 3, PlaneAssumption::strain, name + "_space"});
}

inline std::vector<ListedLaw> listed_laws()
{
  std::vector<ListedLaw> list;
  for (const LawRow& row : list_of<LawRow>())
    if (row.deformable()) add_values(row, 0, {}, row.keyword, list);
  return list;
}

inline void PrintTo(const ListedLaw& law, std::ostream* out)
{
  *out << law.name;
}

}  // namespace mpm
