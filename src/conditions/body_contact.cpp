#include <mpm/conditions/body_contact.hpp>
#include <mpm/core/index_box.hpp>

#include <Eigen/Cholesky>
#include <algorithm>

namespace mpm {

template <int Dim>
BodyContact<Dim>::BodyContact(int fields, const std::vector<Pair>& pairs, SurfacePlace place,
                              ReactionBook book)
    : fields_(fields),
      friction_(std::size_t(fields * fields)),
      place_(std::move(place)),
      book_(book)
{
  for (const Pair& pair : pairs) {
    friction_[std::size_t(pair.first * fields + pair.second)] = pair.friction;
    friction_[std::size_t(pair.second * fields + pair.first)] = pair.friction;
  }
}

template <int Dim>
std::span<const char> BodyContact<Dim>::meet(const GridTopology<Dim>& grid, int support,
                                             std::span<NodeFields<Dim>> fields)
{
  meetings_.clear();
  asked_.assign(std::size_t(grid.size()), 0);
  for (const NodeRun<Dim>& run : grid.runs())
    for (LocalIndex node = run.first; node < run.first + run.length; ++node)
      for (int a = 0; a < fields_; ++a) {
        if (!fields[std::size_t(a)].is_active(node)) continue;
        for (int b = a + 1; b < fields_; ++b)
          if (fields[std::size_t(b)].is_active(node))
            meetings_.push_back({node, a, b, friction_of(a, b)});
      }
  const IndexBox<Dim> below{IndexVec<Dim>::Constant(1 - support), IndexVec<Dim>::Constant(1)};
  for (const Meeting& meeting : meetings_)
    for_each_index(below, [&](const IndexVec<Dim>& offset) {
      const IndexVec<Dim> first = grid.index(meeting.node) + offset;
      if ((first.array() >= grid.local().lower.array()).all())
        asked_[std::size_t(grid.index_of(first))] = 1;
    });
  return asked_;
}

/// The normal is the direction along which the masses of the two bodies around the node are best
/// told apart (Fisher 1936, Annals of Eugenics 7:179): S^-1 (X_b - X_a) with their centres X and
/// the covariance S around them, of both together.
template <int Dim>
void BodyContact<Dim>::measure(const GridTopology<Dim>& grid, std::span<NodeFields<Dim>> fields)
{
  using Matrix = Eigen::Matrix<double, Dim, Dim>;
  // Of a cell squared: two single particles have no covariance.
  constexpr double least_covariance = 1e-3;
  for (Meeting& meeting : meetings_) {
    Vec<Dim> centre[2];
    Matrix covariance = Matrix::Zero();
    double mass = 0;
    for (const int side : {0, 1}) {
      NodeFields<Dim>& field = fields[std::size_t(side == 0 ? meeting.first : meeting.second)];
      const double m = field.mass_of(meeting.node), *moment = field.surface_of(meeting.node);
      centre[side] = Eigen::Map<const Vec<Dim>>(moment) / m;
      const double* second = moment + Dim;
      for (int i = 0; i < Dim; ++i)
        for (int j = i; j < Dim; ++j)
          covariance(i, j) += *second++ - m * centre[side][i] * centre[side][j];
      mass += m;
    }
    covariance = covariance.template selfadjointView<Eigen::Upper>();
    covariance /= mass;
    covariance.diagonal() += least_covariance * grid.spacing().cwiseAbs2();
    const Vec<Dim> across = covariance.ldlt().solve(centre[1] - centre[0]);
    const double size = across.norm();
    meeting.normal = size > 0 ? Vec<Dim>(across / size) : Vec<Dim>::Unit(0);
    const double cell = meeting.normal.cwiseProduct(grid.spacing()).norm();
    meeting.gap = -cell * (place_.from_mean(centre[0].dot(meeting.normal) / cell) +
                           place_.from_mean(-centre[1].dot(meeting.normal) / cell));
  }
}

/// exchange(meeting, first field, second field), more than once where more than two fields meet:
/// what one pair exchanges another one feels.
template <int Dim>
template <class Exchange>
void BodyContact<Dim>::for_each_exchange(std::span<NodeFields<Dim>> fields, Exchange exchange)
{
  constexpr int rounds = 8;
  for (std::size_t k = 0, end; k < meetings_.size(); k = end) {
    for (end = k + 1; end < meetings_.size() && meetings_[end].node == meetings_[k].node;) ++end;
    for (int round = 0; round < (end - k > 1 ? rounds : 1); ++round)
      for (std::size_t m = k; m < end; ++m)
        exchange(meetings_[m], fields[std::size_t(meetings_[m].first)],
                 fields[std::size_t(meetings_[m].second)]);
  }
}

/// Of particles that take increments the forces only: along what is held, fields in contact share
/// velocity and acceleration as if they were one there. Were they to get the whole impulse, every
/// step would work on what the grid cannot see of their velocities.
template <int Dim>
void BodyContact<Dim>::exchange_momentum(const GridTopology<Dim>&,
                                         std::span<NodeFields<Dim>> fields, double, double dt)
{
  const double increments = 1 - book_.velocity_share;
  for_each_exchange(fields, [&](Meeting& meeting, NodeFields<Dim>& first, NodeFields<Dim>& second) {
    const double m = first.mass_of(meeting.node), n = second.mass_of(meeting.node);
    double *u = first.updated_of(meeting.node), *v = second.updated_of(meeting.node);
    Vec<Dim> approach, before;
    for (int d = 0; d < Dim; ++d) {
      approach[d] = u[d] - v[d];
      before[d] = increments * (approach[d] - u[Dim + d] + v[Dim + d]);
    }
    Vec<Dim> taken = approach, of_start = before;
    if (meeting.friction) {
      const double along_normal = approach.dot(meeting.normal), allowed = allowed_in(meeting, dt);
      const double closing = along_normal - allowed;
      if (closing <= 0) return;
      meeting.closed = true;
      const double normal_before = before.dot(meeting.normal);
      const double closing_before = std::max(0.0, normal_before - increments * allowed);
      const Vec<Dim> slip = approach - along_normal * meeting.normal;
      const double speed = slip.norm();
      const double most = *meeting.friction * std::max(0.0, closing - closing_before);
      meeting.stuck = speed <= most;
      taken = closing * meeting.normal + (meeting.stuck ? 1.0 : most / speed) * slip;
      of_start = closing_before * meeting.normal;
      if (meeting.stuck) of_start += before - normal_before * meeting.normal;
    }
    const double reduced = m * n / (m + n);
    const Vec<Dim> impulse = -reduced * (taken - of_start);
    for (int d = 0; d < Dim; ++d) {
      u[d] -= reduced / m * taken[d];
      u[Dim + d] += impulse[d] / m;
      v[d] += reduced / n * taken[d];
      v[Dim + d] -= impulse[d] / n;
    }
    meeting.impulse += impulse;
  });
}

/// Where bodies were held to each other, what is left between their re-mapped velocities strains
/// neither.
template <int Dim>
void BodyContact<Dim>::exchange_gradient(const GridTopology<Dim>&,
                                         std::span<NodeFields<Dim>> fields, double, double dt)
{
  for_each_exchange(
      fields, [&](const Meeting& meeting, NodeFields<Dim>& first, NodeFields<Dim>& second) {
        const double m = first.mass_of(meeting.node), n = second.mass_of(meeting.node);
        const double *u = first.gradient_velocity_of(meeting.node),
                     *v = second.gradient_velocity_of(meeting.node);
        Vec<Dim> approach;
        for (int d = 0; d < Dim; ++d) approach[d] = u[d] - v[d];
        Vec<Dim> taken = approach;
        if (meeting.friction) {
          if (!meeting.closed) return;
          const double along_normal = approach.dot(meeting.normal);
          taken = (along_normal - allowed_in(meeting, dt)) * meeting.normal;
          if (meeting.stuck) taken += approach - along_normal * meeting.normal;
        }
        for (int d = 0; d < Dim; ++d) {
          first.set_gradient_velocity(meeting.node, d, u[d] - taken[d] * n / (m + n));
          second.set_gradient_velocity(meeting.node, d, v[d] + taken[d] * m / (m + n));
        }
      });
}

template <int Dim>
void BodyContact<Dim>::book(const GridTopology<Dim>& grid, std::span<NodeFields<Dim>> fields)
{
  touching_ = 0;
  for (const Meeting& meeting : meetings_) {
    if (!grid.is_owned(meeting.node) || meeting.impulse.isZero(0)) continue;
    ++touching_;
    const double *u = fields[std::size_t(meeting.first)].updated_of(meeting.node),
                 *v = fields[std::size_t(meeting.second)].updated_of(meeting.node);
    Vec<Dim> approach;  // in the mean of the step
    for (int d = 0; d < Dim; ++d) approach[d] = u[d] - 0.5 * u[Dim + d] - v[d] + 0.5 * v[Dim + d];
    const double work = meeting.impulse.dot(approach);
    reaction_.work += work;
    if (!meeting.friction) continue;
    friction_work_ -= work - meeting.impulse.dot(meeting.normal) * approach.dot(meeting.normal);
  }
}

template <int Dim>
std::optional<ContactSums> BodyContact<Dim>::sums() const
{
  ContactSums sums;
  sums.pairs = touching_;
  sums.friction_work = friction_work_;
  return sums;
}

template <int Dim>
void BodyContact<Dim>::archive(Archive& archive)
{
  reaction_.archive(archive);
  archive.value("friction_work", friction_work_, Over::sum);
  archive.value("touching", touching_, Over::sum);
}

template class BodyContact<2>;
template class BodyContact<3>;

}  // namespace mpm
