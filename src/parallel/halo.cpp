#include <mpm/parallel/halo.hpp>
#include <mpm/parallel/session.hpp>

#include <algorithm>
#include <cstring>

namespace mpm {

namespace {

constexpr int halo_tag = 711;

}  // namespace

Halo::Halo(MPI_Comm comm, SharedNodes shared)
    : comm_(comm),
      rank_(rank_of(comm)),
      shared_(std::move(shared)),
      sent_(shared_.sharers.size()),
      received_(shared_.sharers.size()),
      requests_(2 * shared_.sharers.size(), MPI_REQUEST_NULL),
      notes_(shared_.sharers.size(), 0)
{
}

std::vector<int> Halo::neighbours() const
{
  std::vector<int> ranks;
  for (const SharedNodes::Sharer& sharer : shared_.sharers) ranks.push_back(sharer.rank);
  return ranks;
}

void Halo::read(LocalIndex node, double* to) const
{
  for (const NodeColumn& column : columns_)
    to = std::copy_n(column.values + std::size_t(node) * column.stride, column.width, to);
}

void Halo::write(LocalIndex node, const double* from) const
{
  for (const NodeColumn& column : columns_) {
    std::copy_n(from, column.width, column.values + std::size_t(node) * column.stride);
    from += column.width;
  }
}

void Halo::begin(std::span<const NodeColumn> columns, std::span<const LocalIndex> notes)
{
  columns_.assign(columns.begin(), columns.end());
  width_ = 0;
  for (const NodeColumn& column : columns) width_ += std::size_t(column.width);
  own_.resize(shared_.nodes.size() * width_);
  for (std::size_t k = 0; k < shared_.nodes.size(); ++k)
    read(shared_.nodes[k], own_.data() + k * width_);
  for (std::size_t s = 0; s < shared_.sharers.size(); ++s) {
    const SharedNodes::Sharer& sharer = shared_.sharers[s];
    const std::size_t size = sharer.positions.size() * width_ + 1;
    received_[s].resize(size);
    MPI_Irecv(received_[s].data(), int(size), MPI_DOUBLE, sharer.rank, halo_tag, comm_,
              &requests_[2 * s]);
    sent_[s].resize(size);
    double* to = sent_[s].data();
    for (const LocalIndex position : sharer.positions)
      to = std::copy_n(own_.data() + std::size_t(position) * width_, width_, to);
    *to = notes.empty() ? 0 : notes[s];
    MPI_Isend(sent_[s].data(), int(size), MPI_DOUBLE, sharer.rank, halo_tag, comm_,
              &requests_[2 * s + 1]);
    ++traffic_.messages;
    traffic_.bytes += GlobalIndex(size * sizeof(double));
  }
}

void Halo::advance()
{
  if (requests_.empty()) return;
  int done = 0;
  MPI_Testall(int(requests_.size()), requests_.data(), &done, MPI_STATUSES_IGNORE);
}

void Halo::end()
{
  if (!requests_.empty()) {
    const double start = MPI_Wtime();
    MPI_Waitall(int(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
    traffic_.waiting_seconds += MPI_Wtime() - start;
  }
  total_.assign(own_.size(), 0.0);
  const auto add = [&](LocalIndex position, const double* from) {
    double* to = total_.data() + std::size_t(position) * width_;
    for (std::size_t v = 0; v < width_; ++v) to[v] += from[v];
  };
  const auto add_own = [&] {
    for (const auto& [to, from] : shared_.own) add(to, own_.data() + std::size_t(from) * width_);
  };
  bool own_added = false;
  for (std::size_t s = 0; s < shared_.sharers.size(); ++s) {
    const SharedNodes::Sharer& sharer = shared_.sharers[s];
    if (!own_added && sharer.rank > rank_) add_own(), own_added = true;
    const double* from = received_[s].data();
    for (const LocalIndex position : sharer.positions) {
      add(position, from);
      from += width_;
    }
    notes_[s] = LocalIndex(*from);
  }
  if (!own_added) add_own();
  for (std::size_t k = 0; k < shared_.nodes.size(); ++k)
    write(shared_.nodes[k], total_.data() + k * width_);
}

bool Halo::untouched() const
{
  if (width_ == 0) return true;
  std::vector<double> now(width_);
  for (std::size_t k = 0; k < shared_.nodes.size(); ++k) {
    read(shared_.nodes[k], now.data());
    // By bits: a NaN that has stayed is untouched too.
    if (std::memcmp(now.data(), own_.data() + k * width_, width_ * sizeof(double)) != 0)
      return false;
  }
  return true;
}

}  // namespace mpm
