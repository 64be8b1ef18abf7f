#pragma once
/// The list of loads. A new one is a file in src/conditions and a line in loads.list there.

#include <mpm/conditions/load.hpp>
#include <mpm/core/one_of.hpp>
#include <mpm/core/parameters.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mpm {

/// All that the program knows of a load. `number` is its place among the loads of a run, from 0.
struct LoadRow {
  std::string keyword;
  std::string help;
  std::vector<KindParameter> parameters;
  std::unique_ptr<Load<2>> (*in_plane)(const ParameterValues&, int number);
  std::unique_ptr<Load<3>> (*in_space)(const ParameterValues&, int number);
  /// What no single bound can tell, in a scene of so many dimensions.
  std::optional<Contradiction> (*check)(const ParameterValues&, int dimensions) = nullptr;
};

template <>
std::span<const LoadRow> list_of<LoadRow>();

template <int Dim>
std::unique_ptr<Load<Dim>> make_load(const LoadRow& row, const ParameterValues& values, int number)
{
  if constexpr (Dim == 2)
    return row.in_plane(values, number);
  else
    return row.in_space(values, number);
}

}  // namespace mpm
