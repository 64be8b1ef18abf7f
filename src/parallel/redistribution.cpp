#include <mpm/core/error.hpp>
#include <mpm/parallel/redistribution.hpp>

#include <map>

namespace mpm {

namespace {

constexpr int redistribution_tag = 751;

/// Packed particles, body after body; each body's part begins with its number of doubles.
using Packet = std::vector<double>;

/// Takes out all particles of other ranks' cells. Destination -> one part per body.
template <int Dim>
std::map<int, std::vector<Packet>> take_leavers(const Decomposition<Dim>& decomposition,
                                                std::vector<Body<Dim>>& bodies, GlobalIndex& sent)
{
  std::map<int, std::vector<Packet>> parts;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    ParticleStore& particles = bodies[b].particles;
    std::vector<LocalIndex> gone;
    for (LocalIndex p = 0; p < particles.size(); ++p) {
      Vec<Dim> position;
      for (int d = 0; d < Dim; ++d) position[d] = particles.motion()(d, p);
      const int owner = decomposition.owner_of_cell(decomposition.geometry().cell_of(position));
      if (owner == decomposition.rank()) continue;
      auto& destination = parts[owner];
      destination.resize(bodies.size());
      particles.pack(p, destination[b]);
      gone.push_back(p);
    }
    sent += GlobalIndex(gone.size());
    particles.erase(gone);
  }
  return parts;
}

/// Receives until nothing is under way on any rank. Source -> packet.
std::map<int, Packet> exchange(MPI_Comm comm, const std::map<int, Packet>& packets)
{
  std::vector<MPI_Request> sends;
  for (const auto& [owner, packet] : packets)
    MPI_Issend(packet.data(), int(packet.size()), MPI_DOUBLE, owner, redistribution_tag, comm,
               &sends.emplace_back());
  std::map<int, Packet> received;
  MPI_Request consensus = MPI_REQUEST_NULL;
  bool own_sends_arrived = false;
  for (int finished = 0; !finished;) {
    int waiting = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, redistribution_tag, comm, &waiting, &status);
    if (waiting) {
      int count = 0;
      MPI_Get_count(&status, MPI_DOUBLE, &count);
      Packet& packet = received[status.MPI_SOURCE];
      packet.resize(count);
      MPI_Recv(packet.data(), count, MPI_DOUBLE, status.MPI_SOURCE, redistribution_tag, comm,
               MPI_STATUS_IGNORE);
    }
    if (!own_sends_arrived) {
      int all_sent = 0;
      MPI_Testall(int(sends.size()), sends.data(), &all_sent, MPI_STATUSES_IGNORE);
      if (all_sent) {
        own_sends_arrived = true;
        MPI_Ibarrier(comm, &consensus);
      }
    } else {
      MPI_Test(&consensus, &finished, MPI_STATUS_IGNORE);
    }
  }
  // A rank that is done must not send for the next time while another still probes for this one.
  MPI_Barrier(comm);
  return received;
}

}  // namespace

template <int Dim>
Redistributed redistribute(const Decomposition<Dim>& decomposition, std::vector<Body<Dim>>& bodies)
{
  Redistributed outcome;
  outcome.arrived.assign(bodies.size(), 0);
  std::map<int, Packet> packets;
  for (const auto& [owner, parts] : take_leavers(decomposition, bodies, outcome.sent))
    for (const Packet& part : parts) {
      packets[owner].push_back(double(part.size()));
      packets[owner].insert(packets[owner].end(), part.begin(), part.end());
    }
  for (const auto& [source, packet] : exchange(decomposition.comm(), packets)) {
    const double* at = packet.data();
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      ParticleStore& particles = bodies[b].particles;
      const std::size_t count = std::size_t(*at++);
      particles.unpack({at, count});
      at += count;
      outcome.arrived[b] += LocalIndex(count / particles.packed_size());
    }
  }
  for (Body<Dim>& body : bodies) body.particles.seal();
  return outcome;
}

template Redistributed redistribute(const Decomposition<2>&, std::vector<Body<2>>&);
template Redistributed redistribute(const Decomposition<3>&, std::vector<Body<3>>&);

}  // namespace mpm
