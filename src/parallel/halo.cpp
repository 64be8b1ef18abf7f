#include <mpm/core/error.hpp>
#include <mpm/parallel/halo.hpp>

#include <algorithm>
#include <cstring>

namespace mpm {

namespace {

constexpr int halo_tag = 711;

/// Where the values of a sum lie: one mass per node or none, and `width` numbers of a record.
struct Values {
  double* mass;
  double* records;
  std::size_t stride;
  int width;

  int count() const { return width + (mass ? 1 : 0); }
  void read(LocalIndex node, double* to) const
  {
    if (mass) *to++ = mass[node];
    std::copy_n(records + std::size_t(node) * stride, width, to);
  }
  void write(LocalIndex node, const double* from) const
  {
    if (mass) mass[node] = *from++;
    std::copy_n(from, width, records + std::size_t(node) * stride);
  }
};

template <int Dim>
Values values_in(NodeGrid<Dim>& grid, NodeSum sum)
{
  constexpr std::size_t record = NodeGrid<Dim>::record_width;
  double* momentum = grid.momentum_force.data();
  switch (sum) {
    case NodeSum::mass_momentum_force:
      return {grid.mass.data(), momentum, record, 2 * Dim};
    case NodeSum::mass_momentum:
      return {grid.mass.data(), momentum, record, Dim};
    case NodeSum::force:
      return {nullptr, momentum + Dim, record, Dim};
    case NodeSum::remapped_momentum:
      break;
  }
  return {nullptr, grid.remapped_momentum.data(), NodeGrid<Dim>::remap_width, Dim};
}

}  // namespace

template <int Dim>
int values_of(NodeSum sum)
{
  switch (sum) {
    case NodeSum::mass_momentum_force:
      return 1 + 2 * Dim;
    case NodeSum::mass_momentum:
      return 1 + Dim;
    case NodeSum::force:
    case NodeSum::remapped_momentum:
      break;
  }
  return Dim;
}

template <int Dim>
Halo<Dim>::Halo(const Decomposition<Dim>& decomposition, int support)
    : comm_(decomposition.comm()),
      rank_(decomposition.rank()),
      shared_(find_shared_nodes(decomposition.ownership(), support, rank_)),
      sent_(shared_.sharers.size()),
      received_(shared_.sharers.size()),
      requests_(2 * shared_.sharers.size(), MPI_REQUEST_NULL),
      notes_(shared_.sharers.size(), 0)
{
}

template <int Dim>
std::vector<int> Halo<Dim>::neighbours() const
{
  std::vector<int> ranks;
  for (const SharedNodes::Sharer& sharer : shared_.sharers) ranks.push_back(sharer.rank);
  return ranks;
}

template <int Dim>
void Halo<Dim>::begin(NodeSum sum, NodeGrid<Dim>& grid, std::span<const LocalIndex> notes)
{
  sum_ = sum;
  const Values values = values_in(grid, sum);
  const std::size_t width = std::size_t(values.count());
  own_.resize(shared_.nodes.size() * width);
  for (std::size_t k = 0; k < shared_.nodes.size(); ++k)
    values.read(shared_.nodes[k], &own_[k * width]);
  for (std::size_t s = 0; s < shared_.sharers.size(); ++s) {
    const SharedNodes::Sharer& sharer = shared_.sharers[s];
    const std::size_t size = sharer.positions.size() * width + 1;
    received_[s].resize(size);
    MPI_Irecv(received_[s].data(), int(size), MPI_DOUBLE, sharer.rank, halo_tag, comm_,
              &requests_[2 * s]);
    sent_[s].resize(size);
    double* to = sent_[s].data();
    for (const LocalIndex position : sharer.positions)
      to = std::copy_n(&own_[std::size_t(position) * width], width, to);
    *to = notes.empty() ? 0 : notes[s];
    MPI_Isend(sent_[s].data(), int(size), MPI_DOUBLE, sharer.rank, halo_tag, comm_,
              &requests_[2 * s + 1]);
    ++traffic_.messages;
    traffic_.bytes += GlobalIndex(size * sizeof(double));
  }
}

template <int Dim>
void Halo<Dim>::advance()
{
  if (requests_.empty()) return;
  int done = 0;
  MPI_Testall(int(requests_.size()), requests_.data(), &done, MPI_STATUSES_IGNORE);
}

template <int Dim>
void Halo<Dim>::end(NodeGrid<Dim>& grid)
{
  if (requests_.empty()) return;
  const double start = MPI_Wtime();
  MPI_Waitall(int(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
  traffic_.waiting_seconds += MPI_Wtime() - start;

  const Values values = values_in(grid, sum_);
  const std::size_t width = std::size_t(values.count());
  total_.assign(own_.size(), 0.0);
  const auto add_own = [&] {
    for (std::size_t k = 0; k < own_.size(); ++k) total_[k] += own_[k];
  };
  bool own_added = false;
  for (std::size_t s = 0; s < shared_.sharers.size(); ++s) {
    const SharedNodes::Sharer& sharer = shared_.sharers[s];
    if (!own_added && sharer.rank > rank_) add_own(), own_added = true;
    const double* from = received_[s].data();
    for (const LocalIndex position : sharer.positions)
      for (std::size_t v = 0; v < width; ++v) total_[std::size_t(position) * width + v] += *from++;
    notes_[s] = LocalIndex(*from);
  }
  if (!own_added) add_own();
  for (std::size_t k = 0; k < shared_.nodes.size(); ++k)
    values.write(shared_.nodes[k], &total_[k * width]);
}

template <int Dim>
bool Halo<Dim>::untouched(NodeGrid<Dim>& grid) const
{
  const Values values = values_in(grid, sum_);
  const std::size_t width = std::size_t(values.count());
  std::vector<double> now(width);
  for (std::size_t k = 0; k < shared_.nodes.size(); ++k) {
    values.read(shared_.nodes[k], now.data());
    // By bits: a NaN that has stayed is untouched too.
    if (std::memcmp(now.data(), &own_[k * width], width * sizeof(double)) != 0) return false;
  }
  return true;
}

template int values_of<2>(NodeSum);
template int values_of<3>(NodeSum);
template class Halo<2>;
template class Halo<3>;

}  // namespace mpm
