#include <mpm/core/error.hpp>
#include <mpm/parallel/migration.hpp>

#include <algorithm>
#include <utility>

namespace mpm {

namespace {

constexpr int migration_tag = 731;

}  // namespace

template <int Dim>
Migration<Dim>::Migration(const Decomposition<Dim>& decomposition, int support,
                          std::vector<int> neighbours)
    : comm_(decomposition.comm()),
      geometry_(decomposition.geometry()),
      periodic_(std::ranges::find(geometry_.periodic, true) != geometry_.periodic.end()),
      local_(decomposition.local(decomposition.rank(), support)),
      neighbours_(std::move(neighbours)),
      packets_(neighbours_.size()),
      buffers_(neighbours_.size()),
      notes_(neighbours_.size(), 0)
{
  std::vector<char> near = owned_nodes(decomposition, support);
  grow<Dim>(near, local_.count(), 1, 1);
  target_.assign(near.size(), beyond);
  std::size_t number = 0;
  for_each_index(local_, [&](const IndexVec<Dim>& cell) {
    int& target = target_[number];
    if (near[number]) {
      const int owner = decomposition.owner_of_cell(cell);
      const auto at = std::ranges::find(neighbours_, owner);
      MPM_ASSERT(owner == decomposition.rank() || at != neighbours_.end());
      target = owner == decomposition.rank() ? home : int(at - neighbours_.begin());
    }
    ++number;
  });
}

template <int Dim>
std::optional<LocalIndex> Migration<Dim>::collect(const BodyPart<Dim>& part, std::size_t body)
{
  std::optional<LocalIndex> strayed;
  if (gone_.size() <= body) gone_.resize(body + 1);
  ParticleStore& particles = part.body.particles;
  const LocalIndex end = std::min(part.end * lane_count, particles.size());
  for (LocalIndex p = part.first * lane_count; p < end; ++p) {
    Vec<Dim> position;
    for (int d = 0; d < Dim; ++d) position[d] = particles.motion()(d, p);
    const IndexVec<Dim> cell = geometry_.cell_of(position);
    const int target = local_.contains(cell) ? target_[number_in(local_, cell)] : beyond;
    if (periodic_ && target != beyond) {
      const IndexVec<Dim> periods = geometry_.periods_of(cell);
      for (int d = 0; d < Dim; ++d)
        if (periods[d] != 0) {
          particles.motion()(d, p) -= periods[d] * geometry_.period(d);
          moved_back_ = true;
        }
    }
    if (target == home) continue;
    if (target == beyond) {
      strayed = p;
      continue;
    }
    Packet& packet = packets_[target];
    if (packet.size() <= body) packet.resize(body + 1);
    particles.pack(p, packet[body]);
    gone_[body].push_back(p);
  }
  return strayed;
}

template <int Dim>
void Migration<Dim>::send()
{
  for (std::size_t n = 0; n < neighbours_.size(); ++n) {
    std::vector<double>& buffer = buffers_[n];
    buffer.clear();
    for (std::size_t body = 0; body < packets_[n].size(); ++body) {
      std::vector<double>& particles = packets_[n][body];
      if (particles.empty()) continue;
      buffer.push_back(double(body));
      buffer.push_back(double(particles.size()));
      buffer.insert(buffer.end(), particles.begin(), particles.end());
      particles.clear();
    }
    notes_[n] = LocalIndex(buffer.size());
    if (buffer.empty()) continue;
    MPI_Isend(buffer.data(), int(buffer.size()), MPI_DOUBLE, neighbours_[n], migration_tag, comm_,
              &sends_.emplace_back());
    ++messages_;
    bytes_ += GlobalIndex(buffer.size() * sizeof(double));
  }
}

template <int Dim>
typename Migration<Dim>::Outcome Migration<Dim>::finish(std::vector<Body<Dim>>& bodies,
                                                        std::span<const LocalIndex> expected)
{
  Outcome outcome;
  gone_.resize(bodies.size());
  bool changed = std::exchange(moved_back_, false);  // padding stays with its particle
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    std::ranges::sort(gone_[b]);
    bodies[b].particles.erase(gone_[b]);
    changed = changed || !gone_[b].empty();
    outcome.sent += GlobalIndex(gone_[b].size());
    outcome.stayed.push_back(bodies[b].particles.size());
    gone_[b].clear();
  }
  std::vector<double> buffer;
  for (std::size_t n = 0; n < neighbours_.size(); ++n) {
    if (expected[n] == 0) continue;
    buffer.resize(std::size_t(expected[n]));
    MPI_Recv(buffer.data(), expected[n], MPI_DOUBLE, neighbours_[n], migration_tag, comm_,
             MPI_STATUS_IGNORE);
    unpack(bodies, buffer);
    changed = true;
  }
  if (changed)
    for (Body<Dim>& body : bodies) body.particles.seal();
  MPI_Waitall(int(sends_.size()), sends_.data(), MPI_STATUSES_IGNORE);
  sends_.clear();
  return outcome;
}

template <int Dim>
void Migration<Dim>::unpack(std::vector<Body<Dim>>& bodies, const std::vector<double>& buffer) const
{
  for (std::size_t at = 0; at < buffer.size();) {
    const std::size_t body = std::size_t(buffer[at]), count = std::size_t(buffer[at + 1]);
    bodies[body].particles.unpack({&buffer[at + 2], count});
    at += 2 + count;
  }
}

template class Migration<2>;
template class Migration<3>;

}  // namespace mpm
