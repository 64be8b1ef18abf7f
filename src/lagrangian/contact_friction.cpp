/// Coulomb friction between cells that lie upon each other.
///
/// Of a pair the force between the cells is N = p dV/dx_a, the sum over the corners of a, and its
/// share at corner c of either cell is w_c = (dV/dx_c . n) / |dV/dx_a|, n = N / |N|: shares sum to
/// one, and the contact moves with the mean of the corners' velocities by these shares. Along the
/// tangents it bears
///   f = -min(mu |N|, a m v / dt) v / |v|,   1 / m = sum w_c^2 / m_c over the corners of both,
/// v the relative velocity: what Coulomb allows, and never more than would stop a part a of the
/// motion. It sticks where that is less, and creeps by dt / a times the acceleration that pulls.
/// V is the overlap, in the plane an area.
#include <mpm/lagrangian/overlap_contact.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace mpm {

namespace {

/// Of the relative motion, that one pair may stop in a step. A corner of a flush face is in 4
/// pairs, in space in 16, and what all of them do stops half of its motion: four times as much
/// would turn it round.
template <int Dim>
constexpr double stopped_at_once = Dim == 2 ? 0.25 : 0.0625;

/// Per corner: velocity, m/s, and 1 / mass, 1/kg.
template <int Dim>
constexpr int values_per_corner = Dim + 1;

template <int Dim>
struct Shares {
  static constexpr std::size_t corners = 1 << Dim;
  double of[corners];

  /// `direction`: of the normal, over the slope of the whole cell.
  Shares(const CornerPlaces<Dim>& slopes, const Vec<Dim>& direction)
  {
    for (std::size_t c = 0; c < corners; ++c) {
      of[c] = slopes[c][0] * direction[0];
      for (int d = 1; d < Dim; ++d) of[c] += slopes[c][d] * direction[d];
    }
  }
  double velocity(const double* motion, int axis) const
  {
    double sum = 0;
    for (std::size_t c = 0; c < corners; ++c)
      sum += of[c] * motion[c * values_per_corner<Dim> + std::size_t(axis)];
    return sum;
  }
  double mobility(const double* motion) const
  {
    double sum = 0;
    for (std::size_t c = 0; c < corners; ++c)
      sum += of[c] * of[c] * motion[c * values_per_corner<Dim> + Dim];
    return sum;
  }
};

double length_of(const Vec<2>& v)
{
  return std::hypot(v[0], v[1]);
}
double length_of(const Vec<3>& v)
{
  return std::hypot(v[0], v[1], v[2]);
}

std::array<Vec<2>, 1> tangents_of(const Vec<2>& normal)
{
  return {Vec<2>(-normal[1], normal[0])};
}
std::array<Vec<3>, 2> tangents_of(const Vec<3>& normal)
{
  const Vec<3> one = normal.unitOrthogonal();
  return {one, normal.cross(one)};
}

/// From nodes to corners. Of 1 / mass what a push at the corner alone meets.
void take_corners(const CellOutline& outline, double* motion)
{
  constexpr int width = values_per_corner<2>;
  std::array<double, CellOutline::corners> of_corners, of_nodes;
  for (int v = 0; v < width; ++v) {
    for (std::size_t k = 0; k < of_nodes.size(); ++k) of_nodes[k] = motion[int(k) * width + v];
    of_corners = of_nodes;
    if (v < 2) {
      outline.take_corners(of_corners);
    } else {
      for (std::size_t k = 0; k < of_corners.size(); ++k) {
        const auto& weights = outline.shares(k);
        of_corners[k] = 0;
        for (std::size_t i = 0; i < weights.size(); ++i)
          of_corners[k] += weights[i] * weights[i] * of_nodes[i];
      }
    }
    for (std::size_t k = 0; k < of_corners.size(); ++k) motion[int(k) * width + v] = of_corners[k];
  }
}

}  // namespace

template <int Dim>
void OverlapContact<Dim>::take_motion(const NodeFields<Dim>& fields)
{
  constexpr int width = int(corners_of_cell) * values_per_corner<Dim>;
  motion_.resize(stiffness_.size() * width);
  double* out = motion_.data();
  for (LocalIndex c = 0; c < cells(); ++c) {
    for (const LocalIndex node : cells_[std::size_t(c)].nodes) {
      const double* u = &fields.updated[std::size_t(node) * NodeFields<Dim>::record_width];
      for (int d = 0; d < Dim; ++d) *out++ = u[d];
      *out++ = 1 / fields.mass_of(node);
    }
    if constexpr (Dim == 2)
      if (const CellOutline* outline = outline_of(c)) take_corners(*outline, out - width);
  }
  ghosts_.update(motion_, width);
}

template <int Dim>
void OverlapContact<Dim>::add_friction(const NodeFields<Dim>& fields, double dt,
                                       std::span<double> friction)
{
  take_motion(fields);
  const auto slopes_of = [&](std::size_t entry, int side) {
    std::array<double, Overlaps::values> slopes{};
    found_.add_slopes(entry, side, 1, slopes.data());
    return Overlaps::by_corners(slopes.data());
  };
  constexpr std::size_t width = corners_of_cell * values_per_corner<Dim>;
  for_each_overlap([&](std::size_t entry, const Pressing& pair) {
    const auto [a, b] = pair.cells;
    const double coefficient = bodies_.friction(of_body_[std::size_t(a)], of_body_[std::size_t(b)]);
    if (coefficient == 0) return;
    const CornerPlaces<Dim> of_one = slopes_of(entry, 0), of_other = slopes_of(entry, 1);
    Vec<Dim> slope = Vec<Dim>::Zero();
    for (const Vec<Dim>& of_corner : of_one) slope += of_corner;
    const double face = length_of(slope);
    if (!(face > 0)) return;
    const Vec<Dim> normal = slope / face;
    const Vec<Dim> direction = normal / face;
    const Shares<Dim> one(of_one, direction), other(of_other, -direction);
    const double *moving = &motion_[std::size_t(a) * width],
                 *against = &motion_[std::size_t(b) * width];
    const auto tangents = tangents_of(normal);
    Vec<Dim - 1> slip = Vec<Dim - 1>::Zero();  // of a over b along the tangents
    for (int t = 0; t < Dim - 1; ++t)
      for (int d = 0; d < Dim; ++d)
        slip[t] +=
            (one.velocity(moving, d) - other.velocity(against, d)) * tangents[std::size_t(t)][d];
    const double speed = slip.norm();
    if (!(speed > 0)) return;
    const double mobility = one.mobility(moving) + other.mobility(against);
    const double most = coefficient * pair.pressure * face;
    const Vec<Dim - 1> push =
        -std::min(most, stopped_at_once<Dim> * speed / (mobility * dt)) * (slip / speed);
    const auto add = [&](LocalIndex cell, CornerPlaces<Dim> slopes, double sign) {
      if (cell >= cells()) return;
      if constexpr (Dim == 2)
        if (const CellOutline* outline = outline_of(cell)) outline->give_nodes(slopes);
      const Shares<Dim> shares(slopes, sign * direction);
      for (std::size_t c = 0; c < corners_of_cell; ++c) {
        const auto node = std::size_t(cells_[std::size_t(cell)].nodes[c]);
        for (int t = 0; t < Dim - 1; ++t) {
          const double along = sign * push[t] * shares.of[c];
          for (int d = 0; d < Dim; ++d)
            friction[Dim * node + std::size_t(d)] += along * tangents[std::size_t(t)][d];
        }
      }
    };
    add(a, of_one, 1);
    add(b, of_other, -1);
  });
}

template void OverlapContact<2>::take_motion(const NodeFields<2>&);
template void OverlapContact<3>::take_motion(const NodeFields<3>&);
template void OverlapContact<2>::add_friction(const NodeFields<2>&, double, std::span<double>);
template void OverlapContact<3>::add_friction(const NodeFields<3>&, double, std::span<double>);

}  // namespace mpm
