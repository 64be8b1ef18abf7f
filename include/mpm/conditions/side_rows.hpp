#pragma once
/// The list of what a side of the grid can be. A new one is a file in src/conditions and a line in
/// sides.list there.

#include <mpm/conditions/rigid_wall.hpp>
#include <mpm/core/one_of.hpp>

#include <memory>
#include <string>

namespace mpm {

/// Where a condition acts, and beside what.
struct SideSetting {
  WallPlacement placement;  ///< of the specimen's side
  bool beside_piston;       ///< along its travel, where sides only keep particles in
  ReactionBook book;
};

/// All that the program knows of a kind of side.
struct SideRow {
  std::string keyword;
  std::string help;
  /// What leaves through it comes in through the one opposite, which is so too.
  bool periodic = false;
  /// None for a side at which nothing acts.
  std::unique_ptr<BoundaryCondition<2>> (*in_plane)(const SideSetting&) = nullptr;
  std::unique_ptr<BoundaryCondition<3>> (*in_space)(const SideSetting&) = nullptr;

  /// Whether particles may go beyond it.
  bool open() const { return !periodic && !in_plane && !in_space; }
  /// Whether a wall at rest stands there.
  bool is_wall() const { return !periodic && !open(); }
};

template <>
std::span<const SideRow> list_of<SideRow>();

/// Nothing for a side at which nothing acts.
template <int Dim>
std::unique_ptr<BoundaryCondition<Dim>> make_side(const SideRow& row, const SideSetting& setting)
{
  if constexpr (Dim == 2)
    return row.in_plane ? row.in_plane(setting) : nullptr;
  else
    return row.in_space ? row.in_space(setting) : nullptr;
}

}  // namespace mpm
