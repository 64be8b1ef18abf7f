#pragma once
/// Area on which two cells of the plane lie upon each other, and how it changes with their corners.

#include <mpm/core/lanes.hpp>

namespace mpm {

/// Convex quadrilaterals side by side, corners counter-clockwise, m. A triangle names a corner
/// twice.
struct Quads {
  Lanes x[4], y[4];
};

namespace overlap_detail {

/// The quadrilateral and its sides: to the next corner, m.
struct Sides : Quads {
  Lanes dx[4], dy[4];
  Lanes from_origin[4];  ///< of each side, times its length, m^2
  Lanes squared[4];      ///< lengths, m^2

  [[gnu::always_inline]] explicit Sides(const Quads& quads) : Quads(quads)
  {
    for (int k = 0; k < 4; ++k) {
      dx[k] = x[(k + 1) % 4] - x[k];
      dy[k] = y[(k + 1) % 4] - y[k];
      from_origin[k] = dx[k] * y[k] - dy[k] * x[k];
      squared[k] = dx[k] * dx[k] + dy[k] * dy[k];
    }
  }
  /// Of a point from side k, times its length, m^2; positive within.
  [[gnu::always_inline]] Lanes distance(int k, const Lanes& px, const Lanes& py) const
  {
    return dx[k] * py - dy[k] * px - from_origin[k];
  }
};

/// Of the squares of two sides' lengths: ends so near to the other's line are on it. Rounding is a
/// millionth of that, so where nearly parallel sides cross is known to a millionth of a side: a gap
/// in the boundary there is a force without its counterpart.
inline constexpr double on_line = 1e-10;

/// The part [first, last] of an edge, from 0 to 1, that lies in a quadrilateral.
struct Part {
  Lanes first = 0.0, last = 1.0;

  /// By one side, from which start and end of the edge are so far; `crossing` is where it crosses
  /// that. `along`: where it runs along the side, of these `out`: where it does not count as
  /// within.
  [[gnu::always_inline]] void cut(const Lanes& start, const Lanes& end, const Lanes& crossing,
                                  const LaneMask& along, const LaneMask& out)
  {
    const LaneMask starts_out = start < 0.0 && !along, ends_out = end < 0.0 && !along;
    stdx::where(starts_out && !ends_out, first) = stdx::max(first, crossing);
    stdx::where(ends_out && !starts_out, last) = stdx::min(last, crossing);
    stdx::where((starts_out && ends_out) || (along && out), last) = 0.0;
  }
};

/// Adds what edge k gives to the area and to its derivatives.
[[gnu::always_inline]] inline void add_edge(const Sides& of, int k, const Part& part, Lanes& area,
                                            Lanes (&by_x)[4], Lanes (&by_y)[4])
{
  const int next = (k + 1) % 4;
  const Lanes length = stdx::max(part.last - part.first, Lanes(0.0));
  area -= 0.5 * length * of.from_origin[k];
  // The boundary moves by (1 - t) da + t db, outward n dt = (dy, -dx) dt.
  const Lanes at_end = 0.5 * length * (part.first + part.last), at_start = length - at_end;
  by_x[k] += of.dy[k] * at_start;
  by_y[k] -= of.dx[k] * at_start;
  by_x[next] += of.dy[k] * at_end;
  by_y[next] -= of.dx[k] * at_end;
}

}  // namespace overlap_detail

/// Of the area and its derivatives with respect to the corners of both, m.
struct Overlap {
  Lanes area = 0.0;  ///< m^2
  Lanes a_x[4], a_y[4], b_x[4], b_y[4];
};

/// By Gauss over the boundary of the overlap: parts of the edges of either that lie in the other. A
/// side that both share counts once, and not at all where they lie on different sides of it.
/// Coordinates are best taken from a point near both.
[[gnu::always_inline]] inline Overlap overlap_of(const Quads& quads_a, const Quads& quads_b)
{
  using namespace overlap_detail;
  const Sides a(quads_a), b(quads_b);
  Lanes a_from[4][4], b_from[4][4];  // corner k from side j of the other
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 4; ++j) {
      a_from[k][j] = b.distance(j, a.x[k], a.y[k]);
      b_from[k][j] = a.distance(j, b.x[k], b.y[k]);
    }
  Overlap found;
  for (int k = 0; k < 4; ++k) found.a_x[k] = found.a_y[k] = found.b_x[k] = found.b_y[k] = 0.0;
  Part parts_a[4], parts_b[4];
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 4; ++j) {
      const Lanes &a0 = a_from[k][j], &a1 = a_from[(k + 1) % 4][j];
      const Lanes &b0 = b_from[j][k], &b1 = b_from[(j + 1) % 4][k];
      // Both crossings have the same denominator, twice the area between the directions. It is
      // exact where the ends lie on either side: of nearly parallel sides it may be lost elsewhere.
      const LaneMask b_crosses = (b0 < 0.0) != (b1 < 0.0);
      const Lanes inverse = 1.0 / select(b_crosses, b1 - b0, a0 - a1);
      const Lanes bound = on_line * (a.squared[k] + b.squared[j]);
      const LaneMask same_line = stdx::max(stdx::abs(a0), stdx::abs(a1)) <= bound ||
                                 stdx::max(stdx::abs(b0), stdx::abs(b1)) <= bound;
      const Lanes along = a.dx[k] * b.dx[j] + a.dy[k] * b.dy[j];
      parts_a[k].cut(a0, a1, a0 * inverse, same_line, along < 0.0);
      parts_b[j].cut(b0, b1, -b0 * inverse, same_line, along != 0.0);
    }
  for (int k = 0; k < 4; ++k) {
    add_edge(a, k, parts_a[k], found.area, found.a_x, found.a_y);
    add_edge(b, k, parts_b[k], found.area, found.b_x, found.b_y);
  }
  return found;
}

}  // namespace mpm
