/// Volumes in which bricks lie upon each other, and what their corners have of it.

#include <mpm/lagrangian/cell_overlaps.hpp>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace mpm {

namespace {

double sign_of(std::size_t corner, int axis)
{
  return corner >> axis & 1 ? 1 : -1;
}

Parallelepiped brick_at(const double* values)
{
  return {Eigen::Map<const Vec<3>>(values), Eigen::Map<const Eigen::Matrix3d>(values + 3)};
}

}  // namespace

/// Mean of the corners, and means of the edges along each axis.
void CellOverlaps<3>::describe(const CornerPlaces<3>& corners, double* values)
{
  Eigen::Map<Vec<3>> centre(values);
  Eigen::Map<Eigen::Matrix3d> edges(values + 3);
  // Seen from the first corner: sums of places would lose digits.
  centre.setZero();
  edges.setZero();
  for (std::size_t c = 1; c < 8; ++c) {
    const Vec<3> way = corners[c] - corners[0];
    centre += way / 8;
    for (int k = 0; k < 3; ++k) edges.col(k) += sign_of(c, k) / 4 * way;
  }
  centre += corners[0];
}

void CellOverlaps<3>::shift(const Vec<3>& way, double* values)
{
  for (int d = 0; d < 3; ++d) values[d] += way[d];
}

CellBox<3> CellOverlaps<3>::box_of(const double* values)
{
  CellBox<3> box;
  for (std::size_t d = 0; d < 3; ++d) {
    const double half =
        0.5 * (std::abs(values[3 + d]) + std::abs(values[6 + d]) + std::abs(values[9 + d]));
    box[d] = values[d] - half;
    box[3 + d] = values[d] + half;
  }
  return box;
}

double CellOverlaps<3>::volume(const double* values)
{
  return brick_at(values).edges.determinant();
}

void CellOverlaps<3>::add_volume_slopes(const double* values, double factor, double* sum)
{
  const Eigen::Matrix3d edges = brick_at(values).edges;
  Eigen::Map<Eigen::Matrix3d> by_edges(sum + 3);
  for (int k = 0; k < 3; ++k)
    by_edges.col(k) += factor * edges.col((k + 1) % 3).cross(edges.col((k + 2) % 3));
}

CornerPlaces<3> CellOverlaps<3>::by_corners(const double* sum)
{
  CornerPlaces<3> by{Eigen::Map<const Vec<3>>(sum) / 8};
  // From one corner to two, four and eight.
  for (std::size_t k = 0, known = 1; k < 3; ++k, known *= 2) {
    const Vec<3> half = 0.25 * Eigen::Map<const Vec<3>>(sum + 3 * (k + 1));
    for (std::size_t c = 0; c < known; ++c) {
      by[c + known] = by[c] + half;
      by[c] -= half;
    }
  }
  return by;
}

bool CellOverlaps<3>::closes_on(const double* a, const double* b, const IndexVec<3>& apart,
                                double distance)
{
  const Parallelepiped one = brick_at(a), other = brick_at(b);
  const Eigen::Matrix3d across = other.edges.inverse();
  for (unsigned corner = 0; corner < 8; ++corner) {
    const IndexVec<3> up(int(corner & 1), int(corner >> 1 & 1), int(corner >> 2));
    if (is_shared<3>(up, apart)) continue;
    const Vec<3> ends = up.cast<double>() - Vec<3>::Constant(0.5);
    const Vec<3> at = across * (one.centre + one.edges * ends - other.centre);
    double way_out = -std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k)
      way_out = std::max(way_out, (std::abs(at[k]) - 0.5) / across.row(k).norm());
    if (way_out < distance) return true;
  }
  return false;
}

void CellOverlaps<3>::find(std::span<const MeetingCells> cells)
{
  near_.clear();
  for (const auto& [pair, first, second] : cells) {
    const BrickOverlap overlap = overlap_of(brick_at(first), brick_at(second));
    if (overlap.volume > 0) near_.push_back({pair, overlap});
  }
}

void CellOverlaps<3>::add_slopes(std::size_t entry, int side, double factor, double* sum) const
{
  const BrickOverlap& overlap = near_[entry].overlap;
  const BrickOverlap::Slopes& of = side == 0 ? overlap.a : overlap.b;
  Eigen::Map<Vec<3>>(sum) += factor * of.by_centre;
  Eigen::Map<Eigen::Matrix3d>(sum + 3) += factor * of.by_edges;
}

}  // namespace mpm
