/// Coulomb friction between cells that lie upon each other.
///
/// Of a pair the force between the cells is N = p dA/dx_a, the sum over the corners of a, and its
/// share at corner c of either cell is w_c = (dA/dx_c . n) / |dA/dx_a|, n = N / |N|: shares sum to
/// one, and the contact moves with the mean of the corners' velocities by these shares. Along the
/// tangent it bears
///   f = -min(mu |N|, a m v / dt) v / |v|,   1 / m = sum w_c^2 / m_c over the corners of both,
/// v the relative velocity: what Coulomb allows, and never more than would stop a part a of the
/// motion. It sticks where that is less, and creeps by dt / a times the acceleration that pulls.
#include <mpm/lagrangian/overlap_contact.hpp>

#include <algorithm>
#include <cmath>

namespace mpm {

namespace {

/// Of the relative motion, that one pair may stop in a step. A corner is in up to ten pairs, and
/// what all of them do at once must not turn its motion round.
constexpr double stopped_at_once = 0.1;

/// Per corner: velocity, m/s, and 1 / mass, 1/kg.
constexpr int values_per_corner = 3;

struct Shares {
  double of[4];

  /// `derivative`: by x of the corners, then by y, each lane_count apart.
  Shares(const double* derivative, double along_x, double along_y)
  {
    for (std::size_t c = 0; c < 4; ++c)
      of[c] = derivative[c * lane_count] * along_x + derivative[(c + 4) * lane_count] * along_y;
  }
  double velocity(const double* motion, const std::array<std::size_t, 4>& corners, int axis) const
  {
    double sum = 0;
    for (std::size_t c = 0; c < 4; ++c)
      sum += of[c] * motion[corners[c] * values_per_corner + axis];
    return sum;
  }
  /// Corners that a triangle names twice have both shares.
  double mobility(const double* motion, const std::array<std::size_t, 4>& corners) const
  {
    double at[4] = {0, 0, 0, 0}, sum = 0;
    for (std::size_t c = 0; c < 4; ++c) at[corners[c]] += of[c];
    for (std::size_t k = 0; k < 4; ++k) sum += at[k] * at[k] * motion[k * values_per_corner + 2];
    return sum;
  }
};

}  // namespace

void OverlapContact::take_motion(const NodeFields<2>& fields)
{
  constexpr int width = 4 * values_per_corner;
  motion_.resize(stiffness_.size() * width);
  double* out = motion_.data();
  for (const Cell& cell : cells_)
    for (const LocalIndex node : cell.nodes) {
      const double* u = &fields.updated[std::size_t(node) * NodeFields<2>::record_width];
      *out++ = u[0];
      *out++ = u[1];
      *out++ = 1 / fields.mass_of(node);
    }
  ghosts_.update(motion_, width);
}

void OverlapContact::add_friction(const NodeFields<2>& fields, double coefficient, double dt,
                                  std::span<double> friction)
{
  take_motion(fields);
  constexpr std::size_t width = 4 * values_per_corner;
  for (std::size_t k = 0; k < near_.size(); ++k) {
    const double* values = overlap_of_pair(k);
    if (!(*values > 0)) continue;
    const auto [number, one_piece, other_piece] = near_[k];
    const double *of_one = values + lane_count, *of_other = values + 9 * lane_count;
    double slope[2] = {0, 0};
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t d = 0; d < 2; ++d) slope[d] += of_one[(c + 4 * d) * lane_count];
    const double length = std::hypot(slope[0], slope[1]);
    if (!(length > 0)) continue;
    const double normal[2] = {slope[0] / length, slope[1] / length};
    const Shares one(of_one, normal[0] / length, normal[1] / length);
    const Shares other(of_other, -normal[0] / length, -normal[1] / length);

    auto [a, b] = pairs_[number];
    if (turned_[number]) std::swap(a, b);
    const double *moving = &motion_[std::size_t(a) * width],
                 *against = &motion_[std::size_t(b) * width];
    const auto &corners = corners_of_piece(one_piece),
               &other_corners = corners_of_piece(other_piece);
    double slip = 0;  // of a over b along the tangent (-n_y, n_x)
    for (int d = 0; d < 2; ++d)
      slip += (one.velocity(moving, corners, d) - other.velocity(against, other_corners, d)) *
              (d == 0 ? -normal[1] : normal[0]);
    const double mobility = one.mobility(moving, corners) + other.mobility(against, other_corners);
    const double most = coefficient * pressure(number) * length;
    const double push =
        -std::copysign(std::min(most, stopped_at_once * std::abs(slip) / (mobility * dt)), slip);
    const auto add = [&](LocalIndex cell, const Shares& shares,
                         const std::array<std::size_t, 4>& at, double along) {
      if (cell >= cells()) return;
      for (std::size_t c = 0; c < 4; ++c) {
        const auto node = std::size_t(cells_[std::size_t(cell)].nodes[at[c]]);
        friction[2 * node] -= along * shares.of[c] * normal[1];
        friction[2 * node + 1] += along * shares.of[c] * normal[0];
      }
    };
    add(a, one, corners, push);
    add(b, other, other_corners, -push);
  }
}

}  // namespace mpm
