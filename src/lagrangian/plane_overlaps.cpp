/// Areas on which quadrilaterals lie upon each other, in lanes.

#include <mpm/core/sieve.hpp>
#include <mpm/core/transpose.hpp>
#include <mpm/lagrangian/cell_overlaps.hpp>
#include <mpm/lagrangian/overlap.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mpm {

namespace {

using overlap_detail::Sides;

/// Which corner is more than straight, or -1.
int reflex_corner(const double* corners)
{
  const double *x = corners, *y = corners + 4;
  // Twice the areas of the triangles that the corners cut off.
  const auto cut_off = [&](std::size_t last, std::size_t at, std::size_t next) {
    return (x[at] - x[last]) * (y[next] - y[at]) - (y[at] - y[last]) * (x[next] - x[at]);
  };
  const double least[4] = {cut_off(3, 0, 1), cut_off(0, 1, 2), cut_off(1, 2, 3), cut_off(2, 3, 0)};
  const auto* narrowest = std::min_element(least, least + 4);
  return *narrowest < 0 ? int(narrowest - least) : -1;
}

LaneMask has_reflex_corner(const Sides& cell)
{
  LaneMask found(false);
  for (int k = 0; k < 4; ++k) {
    const int next = (k + 1) % 4;
    found = found || cell.dx[k] * cell.dy[next] - cell.dy[k] * cell.dx[next] < 0.0;
  }
  return found;
}

/// Whether no corner of `other` lies on the inner side of some side of `one`.
LaneMask parts_them(const Sides& one, const Sides& other)
{
  LaneMask found(false);
  for (int k = 0; k < 4; ++k) {
    Lanes farthest = one.distance(k, other.x[0], other.y[0]);
    for (int c = 1; c < 4; ++c)
      farthest = stdx::max(farthest, one.distance(k, other.x[c], other.y[c]));
    found = found || farthest <= 0.0;
  }
  return found;
}

/// Corners of lane_count pairs, pair_of(lane), each from the first corner of its first cell.
template <class PairOf>
[[gnu::always_inline]] inline void put_corners(const PairOf& pair_of, Quads& one, Quads& other)
{
  to_columns([&](int lane) { return pair_of(lane).first; }, one.x);
  to_columns([&](int lane) { return pair_of(lane).first + 4; }, one.y);
  to_columns([&](int lane) { return pair_of(lane).second; }, other.x);
  to_columns([&](int lane) { return pair_of(lane).second + 4; }, other.y);
  const Lanes x = one.x[0], y = one.y[0];
  for (int k = 0; k < 4; ++k) {
    one.x[k] -= x;
    one.y[k] -= y;
    other.x[k] -= x;
    other.y[k] -= y;
  }
}

/// Counter-clockwise: a whole cell, then for each corner that may be a reflex one the two triangles
/// through it.
constexpr std::array<std::array<std::size_t, 4>, 9> pieces{{{0, 1, 2, 3},
                                                            {0, 1, 2, 2},
                                                            {0, 2, 3, 3},
                                                            {1, 2, 3, 3},
                                                            {1, 3, 0, 0},
                                                            {2, 3, 0, 0},
                                                            {2, 0, 1, 1},
                                                            {3, 0, 1, 1},
                                                            {3, 1, 2, 2}}};

}  // namespace

void CellOverlaps<2>::add_volume_slopes(const double* of, double factor, double* sum)
{
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4, last = (k + 3) % 4;
    sum[k] += factor * 0.5 * (of[next + 4] - of[last + 4]);
    sum[k + 4] += factor * 0.5 * (of[last] - of[next]);
  }
}

CornerPlaces<2> CellOverlaps<2>::by_corners(const double* sum)
{
  CornerPlaces<2> by;
  for (std::size_t k = 0; k < 4; ++k) by[k] = {sum[k], sum[k + 4]};
  return by;
}

/// Outwards of a side, which is not more than to the cell itself where that is convex.
bool CellOverlaps<2>::closes_on(const double* a, const double* b, const IndexVec<2>& apart,
                                double distance)
{
  const auto way_out = [&](std::size_t corner) {
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t side = 0; side < 4; ++side) {
      const std::size_t next = (side + 1) % 4;
      const double dx = b[next] - b[side], dy = b[next + 4] - b[side + 4];
      most = std::max(most, ((a[corner] - b[side]) * dy - (a[corner + 4] - b[side + 4]) * dx) /
                                std::sqrt(dx * dx + dy * dy));
    }
    return most;
  };
  for (std::size_t k = 0; k < 4; ++k) {
    const IndexVec<2> up(int(order[k] & 1), int(order[k] >> 1));
    if (!is_shared<2>(up, apart) && way_out(k) < distance) return true;
  }
  return false;
}

/// Most cells whose boxes meet do not, and are neighbours around a corner.
void CellOverlaps<2>::list_near(std::span<const MeetingCells> cells)
{
  near_.clear();
  const auto pieces_of = [](const double* corners) {
    const int reflex = reflex_corner(corners);
    return reflex < 0 ? std::pair(0, 1) : std::pair(1 + 2 * reflex, 3 + 2 * reflex);
  };
  Sieve sieve(near_);
  for (std::size_t first = 0; first < cells.size(); first += lane_count) {
    const std::size_t count = std::min<std::size_t>(lane_count, cells.size() - first);
    Quads quads_one, quads_other;
    put_corners(
        [&](int lane) -> const MeetingCells& {
          return cells[first + std::min(std::size_t(lane), count - 1)];
        },
        quads_one, quads_other);
    const Sides one(quads_one), other(quads_other);
    const LaneMask reflex = has_reflex_corner(one) || has_reflex_corner(other);
    const LaneMask apart = !reflex && (parts_them(one, other) || parts_them(other, one));
    for (std::size_t lane = 0; lane < count; ++lane) {
      const MeetingCells& pair = cells[first + lane];
      if (!reflex[lane]) [[likely]] {
        sieve.item() = {pair, {0, 0}};
        sieve.keep(!apart[lane]);
        continue;
      }
      const auto [one_first, one_last] = pieces_of(pair.first);
      const auto [other_first, other_last] = pieces_of(pair.second);
      for (int a = one_first; a < one_last; ++a)
        for (int b = other_first; b < other_last; ++b) {
          sieve.item() = {pair, {a, b}};
          sieve.keep(true);
        }
    }
  }
}

/// As put_corners, of whole cells and triangles.
void CellOverlaps<2>::put_pieces(const Near* const (&near)[lane_count], Quads& one, Quads& other)
{
  alignas(lane_alignment) double a[values * lane_count], b[values * lane_count];
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const auto& [pair, parts] = *near[lane];
    const auto& of_one = pieces[std::size_t(parts[0])];
    const auto& of_other = pieces[std::size_t(parts[1])];
    for (std::size_t k = 0; k < values; ++k) {
      const std::size_t axis = k < 4 ? 0 : 4;
      a[k * lane_count + lane] = pair.first[axis + of_one[k % 4]] - pair.first[axis];
      b[k * lane_count + lane] = pair.second[axis + of_other[k % 4]] - pair.first[axis];
    }
  }
  for (int k = 0; k < 4; ++k) {
    one.x[k] = load(a + k * lane_count);
    one.y[k] = load(a + (k + 4) * lane_count);
    other.x[k] = load(b + k * lane_count);
    other.y[k] = load(b + (k + 4) * lane_count);
  }
}

void CellOverlaps<2>::find(std::span<const MeetingCells> cells)
{
  list_near(cells);
  const std::size_t groups = (near_.size() + lane_count - 1) / lane_count;
  areas_.resize(groups * lane_count);
  faces_.resize(groups * lane_count);
  slopes_.resize(2 * groups * lane_count * values);
  for (std::size_t g = 0; g < groups; ++g) {
    const Near* near[lane_count];
    bool are_whole = true;
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      near[lane] = &near_[std::min(g * lane_count + lane, near_.size() - 1)];
      are_whole &= (near[lane]->pieces[0] | near[lane]->pieces[1]) == 0;
    }
    Quads one, other;
    if (are_whole) [[likely]]
      put_corners([&](int lane) -> const MeetingCells& { return near[lane]->cells; }, one, other);
    else
      put_pieces(near, one, other);
    const Overlap overlap = overlap_of(one, other);
    const auto put = [&](const Lanes(&of)[4], std::size_t place) {
      to_rows(of[0], of[1], of[2], of[3], &slopes_[2 * g * lane_count * values + place],
              2 * values);
    };
    store(overlap.area, &areas_[g * lane_count]);
    put(overlap.a_x, 0);
    put(overlap.a_y, 4);
    put(overlap.b_x, values);
    put(overlap.b_y, values + 4);
    const Lanes x = overlap.a_x[0] + overlap.a_x[1] + overlap.a_x[2] + overlap.a_x[3],
                y = overlap.a_y[0] + overlap.a_y[1] + overlap.a_y[2] + overlap.a_y[3];
    store(stdx::sqrt(x * x + y * y), &faces_[g * lane_count]);
    if (!are_whole) [[unlikely]]
      for (std::size_t entry = g * lane_count; entry < std::min((g + 1) * lane_count, size());
           ++entry)
        give_corners(entry);
  }
}

/// To the corners of whole cells what those of triangles have, which name a corner twice.
void CellOverlaps<2>::give_corners(std::size_t entry)
{
  for (const std::size_t side : {0, 1}) {
    double* slopes = &slopes_[(2 * entry + side) * values];
    const auto& corners = pieces[std::size_t(near_[entry].pieces[side])];
    std::array<double, values> sum{};
    for (std::size_t k = 0; k < values; ++k) sum[(k < 4 ? 0 : 4) + corners[k % 4]] += slopes[k];
    std::ranges::copy(sum, slopes);
  }
}

}  // namespace mpm
