#pragma once
/// Weights of one block of particles on the nodes around them: a tensor product of one-dimensional
/// shape functions.

#include <mpm/core/lanes.hpp>
#include <mpm/grid/grid_topology.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace mpm {

/// What a stencil needs of the grid, as plain numbers that a pass keeps at hand.
template <int Dim>
struct GridFrame {
  double origin[Dim], spacing[Dim], inverse_spacing[Dim];  ///< m, m, 1/m
  double gradient_scale[Dim];                              ///< 1/m
  double lower[Dim], stride[Dim];                          ///< of the local node numbering
  double lower_wall[Dim], upper_wall[Dim];  ///< node on which a wall stands, or infinite
  bool near_walls;                          ///< whether a stencil may reach beyond one of them

  /// Turns the sign of gradients: the minus of f = - sum V0 tau g costs nothing there.
  GridFrame with_negative_gradients() const
  {
    GridFrame frame = *this;
    for (double& scale : frame.gradient_scale) scale = -scale;
    return frame;
  }

  explicit GridFrame(const GridTopology<Dim>& grid, bool may_be_near_walls = true)
      : near_walls(may_be_near_walls)
  {
    for (int d = 0; d < Dim; ++d) {
      origin[d] = grid.geometry().origin[d];
      spacing[d] = grid.geometry().spacing[d];
      inverse_spacing[d] = 1.0 / spacing[d];
      gradient_scale[d] = inverse_spacing[d];
      lower[d] = grid.local().lower[d];
      stride[d] = grid.stride(d);
      const auto& [below, above] = grid.geometry().walls[std::size_t(d)];
      constexpr double infinity = std::numeric_limits<double>::infinity();
      lower_wall[d] = below ? double(*below) : -infinity;
      upper_wall[d] = above ? double(*above) : infinity;
    }
  }
};

/// Kept in memory, one column of lanes per value: the kernels read the weights of one particle
/// after the other as scalars.
template <int Dim, class Shape>
struct Stencil {
  static constexpr int support = Shape::support;
  using Columns = double[Dim][support][lane_count];

  alignas(lane_alignment) Columns weight;
  alignas(lane_alignment) Columns gradient;         ///< 1/m
  alignas(lane_alignment) Columns offset;           ///< x_i - x_p, m; filled by `measure_offsets`
  alignas(lane_alignment) double base[lane_count];  ///< first node, local numbering (whole numbers)

  /// Without gradients where nobody asks for them: what a call could read, no compiler drops.
  template <bool WithGradient = true>
  [[gnu::always_inline]] Stencil(const Lanes (&position)[Dim], const GridFrame<Dim>& frame,
                                 const Shape& shape, std::bool_constant<WithGradient> = {})
  {
    Lanes node = 0.0;
    for (int d = 0; d < Dim; ++d) {
      const Lanes x = in_cells(position[d], frame, d);
      const Lanes first = stdx::floor(x - shape.base_shift());
      put<WithGradient>(shape, frame, d, x, first, node);
    }
    store(node, base);
    // Everything anew and elsewhere: what a call could see or change would have to be in memory.
    if constexpr (Shape::ends_at_walls)
      if (frame.near_walls) [[unlikely]]
        if (reaches_beyond(position, frame, shape))
          *this = ended_at_walls<WithGradient>(position, frame, shape);
  }

  /// For the affine schemes.
  void measure_offsets(const GridFrame<Dim>& frame)
  {
    for (int d = 0; d < Dim; ++d)
      for (int a = 0; a < support; ++a)
        store((double(a) - local_[d]) * frame.spacing[d], offset[d][a]);
  }

  /// Weights w (x_i - x_p) / D with D = sum w (x_i - x_p)^2 per axis, for APIC. For linear
  /// functions they equal the gradients, and are taken as such: D vanishes on grid lines.
  void affine_weights(Columns& affine) const
  {
    for (int d = 0; d < Dim; ++d) {
      if constexpr (support == 2) {
        std::copy_n(&gradient[d][0][0], support * lane_count, &affine[d][0][0]);
      } else {
        Lanes moment = 0.0;
        for (int a = 0; a < support; ++a)
          moment += load(weight[d][a]) * load(offset[d][a]) * load(offset[d][a]);
        // At a wall, where it vanishes, so do all its parts.
        moment = stdx::max(moment, Lanes(std::numeric_limits<double>::min()));
        for (int a = 0; a < support; ++a)
          store(load(weight[d][a]) * load(offset[d][a]) / moment, affine[d][a]);
      }
    }
  }

 private:
  Stencil() = default;

  /// Whether the stencil of a lane reaches beyond a wall.
  [[gnu::always_inline]] static bool reaches_beyond(const Lanes (&position)[Dim],
                                                    const GridFrame<Dim>& frame, const Shape& shape)
  {
    LaneMask within(true);
    for (int d = 0; d < Dim; ++d) {
      const Lanes first = stdx::floor(in_cells(position[d], frame, d) - shape.base_shift());
      within =
          within && first >= frame.lower_wall[d] && first <= frame.upper_wall[d] + (1.0 - support);
    }
    return !stdx::all_of(within);
  }

  /// Where a stencil reaches one node beyond a wall, that node moves as the straight line through
  /// the wall's node and the next one has it, v_-1 = 2 v_0 - v_1: its share goes to these two, as
  /// at the end of a spline of open knots, and constant and linear fields stay exact. Without that
  /// the wall stands in for material behind it, and the last cell is too stiff by half.
  ///
  /// What has slipped behind a wall, by less than a cell, counts as standing at it: no weight is
  /// negative.
  template <bool WithGradient>
  [[gnu::noinline]] static Stencil ended_at_walls(const Lanes (&position)[Dim],
                                                  const GridFrame<Dim>& frame, const Shape& shape)
  {
    Stencil stencil;
    Lanes node = 0.0;
    for (int d = 0; d < Dim; ++d) {
      const double lower = frame.lower_wall[d], upper = frame.upper_wall[d];
      Lanes x = in_cells(position[d], frame, d);
      stdx::where(x < lower && x > lower - 1.0, x) = lower;
      // Just in front of it: the wall's node stays the last but one.
      stdx::where(x >= upper && x < upper + 1.0, x) = std::nextafter(upper, lower);
      const Lanes first = stdx::floor(x - shape.base_shift());
      stencil.template put<WithGradient>(shape, frame, d, x, first, node);
      const LaneMask at_lower = first == lower - 1.0, at_upper = first == upper + (2.0 - support);
      const auto end = [&](auto* values) {
        hand_over(at_lower, values[0], values[1], values[2]);
        hand_over(at_upper, values[support - 1], values[support - 2], values[support - 3]);
      };
      end(stencil.weight[d]);
      if constexpr (WithGradient) end(stencil.gradient[d]);
    }
    store(node, stencil.base);
    return stencil;
  }

  /// From the node behind a wall to the wall's and the next one.
  static void hand_over(const LaneMask& where, double* behind, double* wall, double* next)
  {
    Lanes share = 0.0, rest = load(behind);
    stdx::where(where, share) = rest;
    stdx::where(where, rest) = 0.0;
    store(load(wall) + 2.0 * share, wall);
    store(load(next) - share, next);
    store(rest, behind);
  }

  /// Measured from node 0 of the whole grid: the same bits on any number of ranks.
  static Lanes in_cells(const Lanes& position, const GridFrame<Dim>& frame, int d)
  {
    return (position - frame.origin[d]) * frame.inverse_spacing[d];
  }

  /// Weights and gradients along one axis; adds its share to the number of the first node.
  template <bool WithGradient>
  [[gnu::always_inline]] void put(const Shape& shape, const GridFrame<Dim>& frame, int d,
                                  const Lanes& x, const Lanes& first, Lanes& node)
  {
    Lanes w[support], g[support];
    shape.weights(x - first, frame.gradient_scale[d], w, g);
    for (int a = 0; a < support; ++a) {
      store(w[a], weight[d][a]);
      if constexpr (WithGradient) store(g[a], gradient[d][a]);
    }
    node += (first - frame.lower[d]) * frame.stride[d];
    local_[d] = x - first;
  }

  Lanes local_[Dim];  ///< position from the first node, in cells
};

}  // namespace mpm
