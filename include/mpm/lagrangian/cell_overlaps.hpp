#pragma once
/// What contact has to know of the form of its cells: quadrilaterals of the plane (overlap.hpp), or
/// the affine part of bricks (brick_overlap.hpp).

#include <mpm/core/lane_vector.hpp>
#include <mpm/core/lanes.hpp>
#include <mpm/core/types.hpp>
#include <mpm/lagrangian/brick_overlap.hpp>
#include <mpm/lagrangian/cell_outline.hpp>
#include <mpm/lagrangian/overlap.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace mpm {

/// Lower corner, then upper one, m.
template <int Dim>
using CellBox = std::array<double, 2 * std::size_t(Dim)>;

/// Whether boxes are nearer than `distance`, m.
template <int Dim>
bool meet(const CellBox<Dim>& a, const CellBox<Dim>& b, double distance)
{
  bool found = true;
  for (std::size_t d = 0; d < Dim; ++d)  // all of them: a branch that nobody foresees costs more
    found &= bool(a[d] < b[Dim + d] + distance) & bool(b[d] < a[Dim + d] + distance);
  return found;
}

/// Whether the corner at the ends `up` of a location's edges is one of the location that lies
/// `apart` from it, too.
template <int Dim>
bool is_shared(const IndexVec<Dim>& up, const IndexVec<Dim>& apart)
{
  for (int d = 0; d < Dim; ++d)
    if (apart[d] != 0 && (apart[d] > 0) != (up[d] > 0)) return false;
  return true;
}

template <int Dim>
using CornerPlaces = std::array<Vec<Dim>, std::size_t(1 << Dim)>;

/// Derivatives of an overlap by corners of a cell, and which these are: a triangle names one twice.
template <int Dim>
struct OverlapSlopes {
  CornerPlaces<Dim> by;  ///< m, in space m^2
  std::array<std::size_t, std::size_t(1 << Dim)> corner;

  /// By the place of the whole cell.
  Vec<Dim> together() const
  {
    Vec<Dim> sum = Vec<Dim>::Zero();
    for (const Vec<Dim>& slope : by) sum += slope;
    return sum;
  }
  /// By the nodes of a cell that has an outline, in the plane.
  void take_nodes(const CellOutline& outline)
  {
    CornerPlaces<Dim> of_corners;
    of_corners.fill(Vec<Dim>::Zero());
    for (std::size_t c = 0; c < corner.size(); ++c) of_corners[corner[c]] += by[c];
    outline.give_nodes(of_corners);
    by = of_corners;
    std::iota(corner.begin(), corner.end(), std::size_t(0));
  }
};

/// Two cells that may lie upon each other: a number, and what CellOverlaps::describe says of
/// either.
struct MeetingCells {
  std::size_t pair;
  const double *first, *second;
};

/// Overlaps of many pairs. `order`: of a location's corners (LocationMesh), as they are here;
/// `values`: how many describe a cell.
template <int Dim>
class CellOverlaps;

template <>
class CellOverlaps<2> {
 public:
  static constexpr std::array<std::size_t, 4> order{0, 1, 3, 2};  ///< counter-clockwise
  static constexpr int values = 8;                                ///< x and y of the corners, m
  static constexpr double reach = 1;  ///< way of a cell's corners over that of its nodes, at most

  static void describe(const CornerPlaces<2>& corners, double* values)
  {
    for (std::size_t k = 0; k < 4; ++k) {
      values[k] = corners[k][0];
      values[k + 4] = corners[k][1];
    }
  }
  static void shift(const Vec<2>& way, double* values)
  {
    for (int k = 0; k < CellOverlaps::values; ++k) values[k] += way[k < 4 ? 0 : 1];
  }
  static CellBox<2> box_of(const double* at)
  {
    const auto least = [](const double* of) {
      return std::min(std::min(of[0], of[1]), std::min(of[2], of[3]));
    };
    const auto most = [](const double* of) {
      return std::max(std::max(of[0], of[1]), std::max(of[2], of[3]));
    };
    return {least(at), least(at + 4), most(at), most(at + 4)};
  }
  static double volume(const double* of)  ///< m^2
  {
    return 0.5 * ((of[2] - of[0]) * (of[7] - of[5]) - (of[3] - of[1]) * (of[6] - of[4]));
  }
  static OverlapSlopes<2> volume_slopes(const double* of);
  /// Of neighbours around a node, b lies `apart` from a in the lattice: whether another corner of a
  /// than the one there is nearer than `distance`, m, to b.
  static bool closes_on(const double* a, const double* b, const IndexVec<2>& apart,
                        double distance);

  /// Those that are not apart, in the order of `cells`. One with a reflex corner comes as two
  /// triangles, so that a pair may have several entries, which stand side by side.
  void find(std::span<const MeetingCells> cells);
  std::size_t size() const { return near_.size(); }
  std::size_t pair(std::size_t entry) const { return near_[entry].cells.pair; }
  double overlap(std::size_t entry) const { return *values_of(entry); }  ///< m^2
  /// By the way of a cell, m: the length of the face that they share.
  double face(std::size_t entry) const { return values_of(entry)[17 * lane_count]; }
  /// `side`: 0, of the first cell, or 1.
  OverlapSlopes<2> slopes(std::size_t entry, int side) const;
  std::size_t bytes() const
  {
    return near_.capacity() * sizeof(Near) + overlaps_.capacity() * sizeof(double);
  }

 private:
  /// Parts of a pair's cells: 0 is all of one, the others are triangles.
  struct Near {
    MeetingCells cells;
    std::array<int, 2> pieces;
  };
  /// Of lane_count entries: areas, their derivatives by 16 coordinates, and faces.
  static constexpr int values_per_group = 18 * lane_count;
  const double* values_of(std::size_t entry) const
  {
    return &overlaps_[entry / lane_count * values_per_group + entry % lane_count];
  }
  void list_near(std::span<const MeetingCells> cells);
  static void put_pieces(const Near* const (&near)[lane_count], Quads& one, Quads& other);

  std::vector<Near> near_;
  LaneVector<double> overlaps_;
};

template <>
class CellOverlaps<3> {
 public:
  static constexpr std::array<std::size_t, 8> order{0, 1, 2, 3, 4, 5, 6, 7};
  static constexpr int values = 12;  ///< centre and edges, m
  /// A corner of the affine part moves with 1/2 of its own node, 1/4 of three, -1/4 of the last.
  static constexpr double reach = 1.5;

  static void describe(const CornerPlaces<3>& corners, double* values);
  static void shift(const Vec<3>& way, double* values);
  static CellBox<3> box_of(const double* values);
  static double volume(const double* values);  ///< m^3
  static OverlapSlopes<3> volume_slopes(const double* values);
  /// Of neighbours around a node or an edge, as in the plane.
  static bool closes_on(const double* a, const double* b, const IndexVec<3>& apart,
                        double distance);

  /// Those that lie upon each other, in the order of `cells`.
  void find(std::span<const MeetingCells> cells);
  std::size_t size() const { return near_.size(); }
  std::size_t pair(std::size_t entry) const { return near_[entry].pair; }
  double overlap(std::size_t entry) const { return near_[entry].overlap.volume; }           ///< m^3
  double face(std::size_t entry) const { return near_[entry].overlap.a.by_centre.norm(); }  ///< m^2
  OverlapSlopes<3> slopes(std::size_t entry, int side) const;
  std::size_t bytes() const { return near_.capacity() * sizeof(Near); }

 private:
  struct Near {
    std::size_t pair;
    BrickOverlap overlap;
  };
  std::vector<Near> near_;
};

}  // namespace mpm
