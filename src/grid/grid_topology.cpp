#include <mpm/core/error.hpp>
#include <mpm/grid/grid_topology.hpp>

#include <algorithm>
#include <cmath>

namespace mpm {

namespace {

template <int Dim>
std::vector<char> marks_of(const IndexBox<Dim>& local, const IndexBox<Dim>& part)
{
  std::vector<char> marks;
  for_each_index(local, [&](const IndexVec<Dim>& node) { marks.push_back(part.contains(node)); });
  return marks;
}

/// First index at or above a place, at most `most`.
LocalIndex index_from(double place, LocalIndex least, LocalIndex most)
{
  return LocalIndex(std::clamp(std::ceil(place), double(least), double(most)));
}

}  // namespace

template <int Dim>
GridTopology<Dim>::GridTopology(const GridGeometry<Dim>& geometry, const IndexBox<Dim>& local,
                                std::vector<char> owned)
    : geometry_(geometry), local_(local), owned_(std::move(owned))
{
  const IndexVec<Dim> count = local.count();
  LocalIndex stride = 1;
  for (int d = 0; d < Dim; ++d) {
    stride_[d] = stride;
    stride *= count[d];
  }
  size_ = stride;
  touched_.assign(size_, 0);
  kept_.assign(size_, 0);
  MPM_ASSERT(LocalIndex(owned_.size()) == size_);
}

template <int Dim>
GridTopology<Dim>::GridTopology(const GridGeometry<Dim>& geometry, const IndexBox<Dim>& local,
                                const IndexBox<Dim>& owned)
    : GridTopology(geometry, local, marks_of(local, owned))
{
}

template <int Dim>
IndexVec<Dim> GridTopology<Dim>::index(LocalIndex node) const
{
  IndexVec<Dim> at;
  for (int d = 0; d < Dim; ++d) at[d] = local_.lower[d] + node / stride_[d] % local_.count()[d];
  return at;
}

template <int Dim>
Vec<Dim> GridTopology<Dim>::position(LocalIndex node) const
{
  const IndexVec<Dim> at = geometry_.wrapped(index(node));
  Vec<Dim> place;
  for (int d = 0; d < Dim; ++d) place[d] = geometry_.node_position(d, at[d]);
  return place;
}

template <int Dim>
Vec<Dim> GridTopology<Dim>::period() const
{
  Vec<Dim> period;
  for (int d = 0; d < Dim; ++d) period[d] = geometry_.periodic[d] ? geometry_.period(d) : 0.0;
  return period;
}

template <int Dim>
void GridTopology<Dim>::find_within(const Region<Dim>& region, std::vector<LocalIndex>& nodes) const
{
  nodes.clear();
  // In indices of the grid itself. Images have other ones: along periodic axes every node is asked.
  IndexBox<Dim> inside, box = local_;
  for (int d = 0; d < Dim; ++d) {
    const double h = geometry_.spacing[d], origin = geometry_.origin[d];
    const LocalIndex least = geometry_.periodic[d] ? 0 : local_.lower[d];
    const LocalIndex most = geometry_.periodic[d] ? geometry_.nodes[d] : local_.upper[d];
    inside.lower[d] = index_from((region.lower[d] - origin) / h, least, most);
    // The first one above: of whole numbers the one after.
    const double end = std::floor((region.upper[d] - origin) / h) + 1;
    inside.upper[d] = index_from(end, least, most);
    if (geometry_.periodic[d]) continue;
    box.lower[d] = inside.lower[d];
    box.upper[d] = inside.upper[d];
  }
  if (box.empty()) return;
  for (const NodeRun<Dim>& run : runs_) {
    bool row = true;
    for (int d = 1; d < Dim; ++d)
      row = row && run.start[d] >= box.lower[d] && run.start[d] < box.upper[d];
    if (!row) continue;
    const LocalIndex from = std::max(run.start[0], box.lower[0]);
    const LocalIndex to = std::min(run.start[0] + run.length, box.upper[0]);
    IndexVec<Dim> at = run.start;
    for (at[0] = from; at[0] < to; ++at[0])
      if (inside.contains(geometry_.wrapped(at))) nodes.push_back(run.first + at[0] - run.start[0]);
  }
}

template <int Dim>
void GridTopology<Dim>::keep_active(const std::vector<LocalIndex>& shared_nodes)
{
  kept_.assign(size_, 0);
  for (const LocalIndex node : shared_nodes) kept_[node] = 1;
  grow<Dim>(kept_, local_.count(), 1, 1);
}

template <int Dim>
std::vector<LocalIndex> GridTopology<Dim>::end_activity(int support)
{
  const IndexVec<Dim> count = local_.count();
  // A particle's stencil may move by one node either way before the next call.
  std::vector<char> grown = touched_;
  grow<Dim>(grown, count, 1, support);
  for (LocalIndex node = 0; node < size_; ++node) grown[node] |= kept_[node];
  std::vector<LocalIndex> left;
  for (const NodeRun<Dim>& run : runs_)
    for (LocalIndex node = run.first; node < run.first + run.length; ++node)
      if (!grown[node]) left.push_back(node);
  runs_.clear();
  for (LocalIndex row = 0; row < size_; row += count[0])
    for (LocalIndex i = 0; i < count[0]; ++i) {
      if (!grown[row + i]) continue;
      LocalIndex end = i;
      while (end < count[0] && grown[row + end]) ++end;
      runs_.push_back({row + i, end - i, index(row + i)});
      i = end;
    }
  listing_ = Nodes<Dim>::new_listing();
  return left;
}

template <int Dim>
LocalIndex GridTopology<Dim>::active_nodes() const
{
  LocalIndex nodes = 0;
  for (const NodeRun<Dim>& run : runs_) nodes += run.length;
  return nodes;
}

template <int Dim>
LocalIndex GridTopology<Dim>::touched_nodes() const
{
  return LocalIndex(std::ranges::count(touched_, char(1)));
}

template class GridTopology<2>;
template class GridTopology<3>;

}  // namespace mpm
