#include <mpm/core/error.hpp>
#include <mpm/parallel/migration.hpp>

#include <algorithm>
#include <map>

namespace mpm {

namespace {

constexpr int first_tag = 731;

/// Packed particles, body after body; each body's part begins with its number of doubles.
using Packet = std::vector<double>;

}  // namespace

template <int Dim>
typename Migration<Dim>::Outcome Migration<Dim>::exchange(std::span<const Leavers> leavers,
                                                          bool failed)
{
  Outcome outcome;
  outcome.arrived.assign(leavers.size(), 0);
  round_ = 1 - round_;
  const int tag = first_tag + round_;
  const MPI_Comm comm = decomposition_.comm();
  const IndexBox<Dim> home = decomposition_.owned(decomposition_.rank());

  // Destination -> one part per body.
  std::map<int, std::vector<Packet>> parts;
  for (std::size_t b = 0; b < leavers.size(); ++b) {
    ParticleStore& particles = leavers[b].body->particles;
    std::vector<LocalIndex> gone;
    for (const LocalIndex block : leavers[b].blocks) {
      const LocalIndex end = std::min((block + 1) * lane_count, particles.size());
      for (LocalIndex p = block * lane_count; p < end; ++p) {
        Vec<Dim> position;
        for (int d = 0; d < Dim; ++d) position[d] = particles.motion()(d, p);
        const IndexVec<Dim> cell = decomposition_.geometry().cell_of(position);
        if (home.contains(cell)) continue;
        const int owner = decomposition_.owner_of_cell(cell);
        if (owner == decomposition_.rank()) continue;
        auto& destination = parts[owner];
        destination.resize(leavers.size());
        particles.pack(p, destination[b]);
        gone.push_back(p);
      }
    }
    if (gone.empty()) continue;
    outcome.sent += GlobalIndex(gone.size());
    particles.erase(gone);
    particles.seal();
  }

  std::vector<Packet> packets;
  std::vector<MPI_Request> sends;
  packets.reserve(parts.size());
  for (const auto& [owner, bodies] : parts) {
    Packet& packet = packets.emplace_back();
    for (const Packet& body : bodies) {
      packet.push_back(double(body.size()));
      packet.insert(packet.end(), body.begin(), body.end());
    }
    MPI_Issend(packet.data(), int(packet.size()), MPI_DOUBLE, owner, tag, comm,
               &sends.emplace_back());
  }

  std::map<int, Packet> received;
  int any_failed = failed;
  MPI_Request consensus = MPI_REQUEST_NULL;
  bool own_sends_arrived = false;
  for (int finished = 0; !finished;) {
    int waiting = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, tag, comm, &waiting, &status);
    if (waiting) {
      int count = 0;
      MPI_Get_count(&status, MPI_DOUBLE, &count);
      Packet& packet = received[status.MPI_SOURCE];
      packet.resize(count);
      MPI_Recv(packet.data(), count, MPI_DOUBLE, status.MPI_SOURCE, tag, comm, MPI_STATUS_IGNORE);
    }
    if (!own_sends_arrived) {
      int all_sent = 0;
      MPI_Testall(int(sends.size()), sends.data(), &all_sent, MPI_STATUSES_IGNORE);
      if (all_sent) {
        own_sends_arrived = true;
        MPI_Iallreduce(MPI_IN_PLACE, &any_failed, 1, MPI_INT, MPI_MAX, comm, &consensus);
      }
    } else {
      MPI_Test(&consensus, &finished, MPI_STATUS_IGNORE);
    }
  }
  outcome.failed = any_failed != 0;

  for (const auto& [source, packet] : received) {
    const double* at = packet.data();
    for (std::size_t b = 0; b < leavers.size(); ++b) {
      ParticleStore& particles = leavers[b].body->particles;
      const std::size_t count = std::size_t(*at++);
      particles.unpack({at, count});
      at += count;
      outcome.arrived[b] += LocalIndex(count / particles.packed_size());
    }
  }
  for (std::size_t b = 0; b < leavers.size(); ++b)
    if (outcome.arrived[b] > 0) leavers[b].body->particles.seal();
  return outcome;
}

template class Migration<2>;
template class Migration<3>;

}  // namespace mpm
