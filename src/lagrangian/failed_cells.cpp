/// Cells of one body that fail.

#include <mpm/core/archive.hpp>
#include <mpm/core/lane_matrix.hpp>
#include <mpm/lagrangian/location_cells.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace mpm {

template <int Dim>
void LocationCells<Dim>::keep_rest(const Body<Dim>& body)
{
  const ColumnGroup& motion = body.particles.motion();
  rest_.clear();
  for (LocalIndex block = 0; block < body.particles.blocks(); ++block) {
    const double* f = motion.block(block) + deformation_ * lane_count;
    rest_.insert(rest_.end(), f, f + Dim * Dim * lane_count);
  }
}

/// Of the largest one of F F0^-1.
template <int Dim>
Lanes LocationCells<Dim>::squared_stretch(const Body<Dim>& body, LocalIndex block) const
{
  constexpr int components = Dim * Dim;
  const double* deformation = body.particles.motion().block(block) + deformation_ * lane_count;
  Lanes f[components];
  for (int k = 0; k < components; ++k) f[k] = column(deformation, k);
  if (!rest_.empty()) {
    Lanes rest[components], inverse[components], since[components];
    for (int k = 0; k < components; ++k)
      rest[k] = column(&rest_[std::size_t(block) * components * lane_count], k);
    invert<Dim>(rest, inverse);
    for (int j = 0; j < Dim; ++j)
      for (int i = 0; i < Dim; ++i) {
        since[i + Dim * j] = f[i] * inverse[Dim * j];
        for (int k = 1; k < Dim; ++k) since[i + Dim * j] += f[i + Dim * k] * inverse[k + Dim * j];
      }
    std::copy_n(since, components, f);
  }
  return largest_stretch_squared(f);
}

template <int Dim>
std::vector<LocalIndex> LocationCells<Dim>::find_failed(const Body<Dim>& body,
                                                        const FailureLimits& limits) const
{
  const ParticleStore& particles = body.particles;
  const int plastic_strain = particles.state().find("plastic_strain");
  std::vector<LocalIndex> failed;
  for (LocalIndex block = 0; block < particles.blocks(); ++block) {
    LaneMask beyond(false);
    if (plastic_strain >= 0)
      beyond = column(particles.state().block(block), plastic_strain) >= limits.plastic_strain;
    if (limits.limit_stretch())
      beyond = beyond || squared_stretch(body, block) >= limits.stretch * limits.stretch;
    if (stdx::none_of(beyond)) [[likely]]
      continue;
    const LocalIndex first = block * lane_count;
    for (int lane = 0; lane < lane_count && first + lane < particles.size(); ++lane)
      if (beyond[std::size_t(lane)]) failed.push_back(first + lane);
  }
  return failed;
}

template <int Dim>
void LocationCells<Dim>::copy_cell(LocalIndex from, LocalIndex to)
{
  for (int c = 0; c < corners_of_cell; ++c)
    corner_nodes_[place(to, c)] = corner_nodes_[place(from, c)];
  least_corners_[std::size_t(to)] = least_corners_[std::size_t(from)];
  rest_shares_[std::size_t(to)] = rest_shares_[std::size_t(from)];
  if (rest_.empty()) return;
  const auto component = [](LocalIndex cell, int k) {
    return (std::size_t(cell / lane_count) * Dim * Dim + std::size_t(k)) * lane_count +
           std::size_t(cell % lane_count);
  };
  for (int k = 0; k < Dim * Dim; ++k) rest_[component(to, k)] = rest_[component(from, k)];
}

template <int Dim>
void LocationCells<Dim>::erase(Body<Dim>& body, std::span<const LocalIndex> cells,
                               LaneVector<double>& least_stretches)
{
  LocalIndex last = body.particles.size();
  for (std::size_t k = cells.size(); k-- > 0;) {
    --last;
    copy_cell(last, cells[k]);
    least_stretches[std::size_t(cells[k])] = least_stretches[std::size_t(last)];
  }
  body.particles.erase(cells);
  body.particles.seal();
  const auto blocks = std::size_t(body.particles.blocks());
  corner_nodes_.resize(blocks * corners_of_cell * lane_count);
  if (!rest_.empty()) rest_.resize(blocks * Dim * Dim * lane_count);
  for (auto* values : {&least_corners_, &rest_shares_, &least_stretches})
    values->resize(blocks * lane_count);
  for (LocalIndex lane = last; lane < LocalIndex(blocks) * lane_count; ++lane)
    copy_cell(last - 1, lane);
}

template <int Dim>
void LocationCells<Dim>::archive(Archive& archive)
{
  std::vector<std::int64_t> nodes(corner_nodes_.begin(), corner_nodes_.end());
  archive.list("corner_nodes", nodes);
  corner_nodes_.assign(nodes.begin(), nodes.end());
  const auto list = [&](const char* name, LaneVector<double>& values) {
    std::vector<double> copy(values.begin(), values.end());
    archive.list(name, copy);
    values.assign(copy.begin(), copy.end());
  };
  list("least_corners", least_corners_);
  list("rest_shares", rest_shares_);
  list("rest", rest_);
}

template void LocationCells<2>::keep_rest(const Body<2>&);
template std::vector<LocalIndex> LocationCells<2>::find_failed(const Body<2>&,
                                                               const FailureLimits&) const;
template void LocationCells<2>::erase(Body<2>&, std::span<const LocalIndex>, LaneVector<double>&);
template void LocationCells<2>::archive(Archive&);
template void LocationCells<3>::keep_rest(const Body<3>&);
template std::vector<LocalIndex> LocationCells<3>::find_failed(const Body<3>&,
                                                               const FailureLimits&) const;
template void LocationCells<3>::erase(Body<3>&, std::span<const LocalIndex>, LaneVector<double>&);
template void LocationCells<3>::archive(Archive&);

}  // namespace mpm
