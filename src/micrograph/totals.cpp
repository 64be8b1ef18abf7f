#include <mpm/micrograph/totals.hpp>

#include <algorithm>

namespace mpm::micrograph {

namespace {

// A few MB at a time: fast, and no part ever holds its whole slab.
constexpr GlobalIndex chunk_locations = 1 << 22;

/// The locations whose centres lie in a window.
template <int Dim>
IndexBox<Dim> locations_of(const scene::Window& window, const IndexVec<Dim>& count)
{
  const std::array ranges{window.x, window.y, window.z};
  IndexBox<Dim> box;
  for (int d = 0; d < Dim; ++d) {
    const auto [from, to] = ranges[std::size_t(d)];
    LocalIndex& lower = box.lower[d];
    LocalIndex& upper = box.upper[d];
    while (lower < count[d] && centre(lower, count[d]) < from) ++lower;
    upper = lower;
    while (upper < count[d] && centre(upper, count[d]) < to) ++upper;
  }
  return box;
}

/// Adds the labels of a row; -1 is none. Equal neighbours are counted together.
template <class Label>
void add_row(const Label* first, const Label* end, std::vector<double>& filled)
{
  while (first != end) {
    const Label label = *first;
    const Label* next = first;
    while (next != end && *next == label) ++next;
    if (label >= 0) filled[std::size_t(label)] += double(next - first);
    first = next;
  }
}

template <int Dim>
void add(const Lattice<Dim>& lattice, const IndexBox<Dim>& window, std::vector<double>& filled)
{
  const IndexBox<Dim> box = intersection(lattice.part, window);
  if (box.empty()) return;
  const LocalIndex width = box.count()[0];
  IndexBox<Dim> starts = box;
  starts.upper[0] = box.lower[0] + 1;
  for_each_index(starts, [&](const IndexVec<Dim>& start) {
    const std::size_t first = lattice.place(start);
    if (lattice.shape.empty())
      add_row(&lattice.material[first], &lattice.material[first] + width, filled);
    else
      add_row(&lattice.shape[first], &lattice.shape[first] + width, filled);
  });
}

}  // namespace

template <int Dim>
std::vector<WindowCount> count_windows(const IndexVec<Dim>& count,
                                       const std::vector<scene::Window>& windows,
                                       std::size_t labels,
                                       const std::function<void(Lattice<Dim>&)>& fill,
                                       const Share& share)
{
  std::vector<IndexBox<Dim>> boxes;
  std::vector<WindowCount> counts;
  for (const scene::Window& window : windows) {
    boxes.push_back(locations_of<Dim>(window, count));
    counts.push_back({double(boxes.back().size()), std::vector<double>(labels)});
  }
  const IndexBox<Dim> own =
      slab(IndexBox<Dim>{IndexVec<Dim>::Zero(), count}, share.part, share.parts);
  for_each_chunk(own, chunk_locations, [&](const IndexBox<Dim>& chunk) {
    Lattice<Dim> lattice{count, chunk, {}, {}};
    fill(lattice);
    for (std::size_t w = 0; w < boxes.size(); ++w) add(lattice, boxes[w], counts[w].filled);
  });
  for (WindowCount& window : counts) share.sum(window.filled);
  return counts;
}

template std::vector<WindowCount> count_windows<2>(const IndexVec<2>&,
                                                   const std::vector<scene::Window>&, std::size_t,
                                                   const std::function<void(Lattice<2>&)>&,
                                                   const Share&);
template std::vector<WindowCount> count_windows<3>(const IndexVec<3>&,
                                                   const std::vector<scene::Window>&, std::size_t,
                                                   const std::function<void(Lattice<3>&)>&,
                                                   const Share&);

}  // namespace mpm::micrograph
