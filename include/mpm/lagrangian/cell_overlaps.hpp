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
  /// Adds `factor` times the derivatives of the volume by what describes a cell.
  static void add_volume_slopes(const double* of, double factor, double* sum);
  /// Of such a sum of derivatives, by the corners.
  static CornerPlaces<2> by_corners(const double* sum);
  /// Of neighbours around a node, b lies `apart` from a in the lattice: whether another corner of a
  /// than the one there is nearer than `distance`, m, to b.
  static bool closes_on(const double* a, const double* b, const IndexVec<2>& apart,
                        double distance);

  /// Those that are not apart, in the order of `cells`. One with a reflex corner comes as two
  /// triangles, so that a pair may have several entries, which stand side by side.
  void find(std::span<const MeetingCells> cells);
  std::size_t size() const { return near_.size(); }
  std::size_t pair(std::size_t entry) const { return near_[entry].cells.pair; }
  double overlap(std::size_t entry) const { return areas_[entry]; }  ///< m^2
  /// By the way of a cell, m: the length of the face that they share.
  double face(std::size_t entry) const { return faces_[entry]; }
  /// Adds `factor` times the overlap's derivatives by what describes the first cell, `side` 0, or
  /// the other one, 1.
  void add_slopes(std::size_t entry, int side, double factor, double* sum) const
  {
    const double* of = &slopes_[(2 * entry + std::size_t(side)) * values];
    for (int k = 0; k < values; ++k) sum[k] += factor * of[k];
  }
  std::size_t bytes() const
  {
    return near_.capacity() * sizeof(Near) +
           (areas_.capacity() + faces_.capacity() + slopes_.capacity()) * sizeof(double);
  }

 private:
  /// Parts of a pair's cells: 0 is all of one, the others are triangles.
  struct Near {
    MeetingCells cells;
    std::array<int, 2> pieces;
  };
  void list_near(std::span<const MeetingCells> cells);
  static void put_pieces(const Near* const (&near)[lane_count], Quads& one, Quads& other);
  void give_corners(std::size_t entry);

  std::vector<Near> near_;
  /// Of the entries, and of some behind them that fill lanes.
  LaneVector<double> areas_, faces_;
  LaneVector<double> slopes_;  ///< [2 * n * values], of the first cell of each entry and the other
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
  static void add_volume_slopes(const double* values, double factor, double* sum);
  static CornerPlaces<3> by_corners(const double* sum);
  /// Of neighbours around a node or an edge, as in the plane.
  static bool closes_on(const double* a, const double* b, const IndexVec<3>& apart,
                        double distance);

  /// Those that lie upon each other, in the order of `cells`.
  void find(std::span<const MeetingCells> cells);
  std::size_t size() const { return near_.size(); }
  std::size_t pair(std::size_t entry) const { return near_[entry].pair; }
  double overlap(std::size_t entry) const { return near_[entry].overlap.volume; }           ///< m^3
  double face(std::size_t entry) const { return near_[entry].overlap.a.by_centre.norm(); }  ///< m^2
  void add_slopes(std::size_t entry, int side, double factor, double* sum) const;
  std::size_t bytes() const { return near_.capacity() * sizeof(Near); }

 private:
  struct Near {
    std::size_t pair;
    BrickOverlap overlap;
  };
  std::vector<Near> near_;
};

}  // namespace mpm
