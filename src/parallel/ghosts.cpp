#include <mpm/parallel/ghosts.hpp>

#include <algorithm>
#include <chrono>

namespace mpm {

void Ghosts::set(std::vector<Peer> peers)
{
  peers_ = std::move(peers);
  std::erase_if(peers_, [](const Peer& peer) { return peer.sent.empty() && peer.count == 0; });
}

void Ghosts::update(std::span<double> values, int width, const Adjust& adjust)
{
  if (peers_.empty()) return;
  constexpr int tag = 17;
  const auto size = std::size_t(width);
  requests_.clear();
  std::size_t sent = 0;
  for (const Peer& peer : peers_) sent += peer.sent.size() * size;
  buffer_.resize(sent);
  std::size_t at = 0;
  for (const Peer& peer : peers_) {
    if (peer.count > 0)
      MPI_Irecv(&values[std::size_t(peer.first) * size], peer.count * width, MPI_DOUBLE, peer.rank,
                tag, comm_, &requests_.emplace_back());
    if (peer.sent.empty()) continue;
    const std::size_t start = at;
    for (const auto& [item, image] : peer.sent) {
      std::copy_n(&values[std::size_t(item) * size], size, &buffer_[at]);
      if (adjust) adjust(image, {&buffer_[at], size});
      at += size;
    }
    MPI_Isend(&buffer_[start], int(at - start), MPI_DOUBLE, peer.rank, tag, comm_,
              &requests_.emplace_back());
    ++messages_;
    bytes_sent_ += GlobalIndex((at - start) * sizeof(double));
  }
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  MPI_Waitall(int(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
  waiting_seconds_ += std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace mpm
