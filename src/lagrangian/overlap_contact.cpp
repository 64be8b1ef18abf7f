#include <mpm/lagrangian/overlap.hpp>
#include <mpm/lagrangian/overlap_contact.hpp>
#include <mpm/parallel/session.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

namespace mpm {

namespace {

constexpr int itself = 4;  ///< of the images

/// Lower x, lower y, upper x, upper y, m.
using Box = std::array<double, 4>;

/// Whether boxes are nearer than `distance`.
bool meet(const Box& a, const Box& b, double distance)
{
  return a[0] < b[2] + distance && b[0] < a[2] + distance && a[1] < b[3] + distance &&
         b[1] < a[3] + distance;
}

/// Which corner is more than straight, or -1.
int reflex_corner(const double* corners)
{
  const double *x = corners, *y = corners + 4;
  // Twice the areas of the triangles that the corners cut off.
  const auto cut_off = [&](std::size_t last, std::size_t at, std::size_t next) {
    return (x[at] - x[last]) * (y[next] - y[at]) - (y[at] - y[last]) * (x[next] - x[at]);
  };
  const double least[4] = {cut_off(3, 0, 1), cut_off(0, 1, 2), cut_off(1, 2, 3), cut_off(2, 3, 0)};
  const auto* narrowest = std::min_element(least, least + 4);
  return *narrowest < 0 ? int(narrowest - least) : -1;
}

/// Counter-clockwise: a whole cell, then for each corner that may be a reflex one the two triangles
/// through it.
constexpr std::array<std::array<std::size_t, 4>, 9> corners_of_piece{{{0, 1, 2, 3},
                                                                      {0, 1, 2, 2},
                                                                      {0, 2, 3, 3},
                                                                      {1, 2, 3, 3},
                                                                      {1, 3, 0, 0},
                                                                      {2, 3, 0, 0},
                                                                      {2, 0, 1, 1},
                                                                      {3, 0, 1, 1},
                                                                      {3, 1, 2, 2}}};

Box box_of(const double* corners)
{
  const auto [left, right] = std::minmax({corners[0], corners[1], corners[2], corners[3]});
  const auto [lower, upper] = std::minmax({corners[4], corners[5], corners[6], corners[7]});
  return {left, lower, right, upper};
}

}  // namespace

OverlapContact::OverlapContact(MPI_Comm comm, std::vector<Cell> cells, const Vec<2>& size,
                               const IndexVec<2>& period)
    : comm_(comm),
      ghosts_(comm),
      side_ghosts_(comm),
      cells_(std::move(cells)),
      size_(size),
      period_(period),
      area_(size[0] * size[1])
{
}

void OverlapContact::take_places(const MeshNodes<2>& nodes)
{
  const double *x = nodes.along(0), *y = nodes.along(1);
  for (LocalIndex c = 0; c < cells(); ++c) {
    double* to = corners_of(c);
    for (std::size_t k = 0; k < 4; ++k) {
      to[k] = x[cells_[std::size_t(c)].nodes[k]];
      to[k + 4] = y[cells_[std::size_t(c)].nodes[k]];
    }
  }
}

/// Neighbours with a side in common cannot, nor those around a node where all four cells are; and
/// what is behind the outer layer on both sides does not before the layers themselves.
bool OverlapContact::can_meet(LocalIndex own, LocalIndex other) const
{
  if (open_corners_[std::size_t(own)] == 0 && open_corners_[std::size_t(other)] == 0) return false;
  const IndexVec<2> apart = this->apart(own, other);
  if (apart.cwiseAbs().maxCoeff() > 1) return true;
  if (apart[0] == 0 || apart[1] == 0) return false;
  const int corner = (apart[0] > 0 ? 1 : 0) + (apart[1] > 0 ? 2 : 0);
  return open_corners_[std::size_t(own)] >> corner & 1;
}

void OverlapContact::find_boxes()
{
  boxes_.resize(stiffness_.size());
  for (std::size_t c = 0; c < stiffness_.size(); ++c)
    boxes_[c] = box_of(&corners_[c * corner_values]);
}

void OverlapContact::find_pairs(const MeshNodes<2>& nodes, double skin)
{
  skin_ = skin;
  for (int d = 0; d < 2; ++d)
    places_then_[std::size_t(d)].assign(nodes.along(d), nodes.along(d) + nodes.size());
  const std::size_t own = cells_.size();
  corners_.resize(own * corner_values);
  stiffness_.resize(own);
  locations_.resize(own);
  open_corners_.resize(own);
  images_.assign(own, itself);
  for (std::size_t c = 0; c < own; ++c) {
    stiffness_[c] = cells_[c].stiffness;
    locations_[c] = cells_[c].location;
    open_corners_[c] = cells_[c].open_corners;
  }
  take_places(nodes);
  find_boxes();
  std::vector<Ghosts::Peer> peers = add_candidates(skin);
  find_boxes();
  list_pairs(skin);
  keep_needed(std::move(peers));
}

double OverlapContact::largest_way(const MeshNodes<2>& nodes) const
{
  double squared = 0;
  const double *x = nodes.along(0), *y = nodes.along(1);
  for (std::size_t n = 0; n < places_then_[0].size(); ++n) {
    const double dx = x[n] - places_then_[0][n], dy = y[n] - places_then_[1][n];
    squared = std::max(squared, dx * dx + dy * dy);
  }
  return std::sqrt(squared);
}

/// How far an image lies from the cell itself, m; images: 0 to 8, 4 is the cell's own place.
Vec<2> OverlapContact::shift_of(int image) const
{
  return {(image % 3 - 1) * period_[0] * size_[0], (image / 3 - 1) * period_[1] * size_[1]};
}

/// All cells that may meet some of another rank's become ghosts there.
std::vector<Ghosts::Peer> OverlapContact::add_candidates(double skin)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const int ranks = ranks_of(comm_), me = rank_of(comm_);
  Box mine{infinity, infinity, -infinity, -infinity};
  for (std::size_t c = 0; c < cells_.size(); ++c)
    for (std::size_t k = 0; k < 2; ++k) {
      mine[k] = std::min(mine[k], boxes_[c][k]);
      mine[k + 2] = std::max(mine[k + 2], boxes_[c][k + 2]);
    }
  const std::vector<double> others = joined_over_ranks(comm_, mine);
  std::vector<std::vector<double>> out(static_cast<std::size_t>(ranks));
  std::vector<Ghosts::Peer> peers(static_cast<std::size_t>(ranks));
  for (int r = 0; r < ranks; ++r)
    for (int image = 0; image < 9; ++image) {
      const Vec<2> shift = shift_of(image);
      const bool is_one = (image % 3 == 1 || period_[0] > 0) && (image / 3 == 1 || period_[1] > 0);
      if (!is_one || (r == me && image == itself)) continue;
      const auto moved = [&](const Box& box) {
        return Box{box[0] + shift[0], box[1] + shift[1], box[2] + shift[0], box[3] + shift[1]};
      };
      Box theirs;
      std::copy_n(&others[std::size_t(r) * 4], 4, theirs.begin());
      if (!meet(moved(mine), theirs, skin)) continue;
      for (LocalIndex c = 0; c < cells(); ++c) {
        if (!meet(moved(boxes_[std::size_t(c)]), theirs, skin)) continue;
        peers[std::size_t(r)].sent.push_back({c, image});
        std::vector<double>& list = out[std::size_t(r)];
        const Cell& cell = cells_[std::size_t(c)];
        list.insert(list.end(), {double(cell.location[0]), double(cell.location[1]),
                                 cell.stiffness, double(cell.open_corners), double(image)});
        for (int k = 0; k < corner_values; ++k)
          list.push_back(corners_of(c)[k] + shift[k < 4 ? 0 : 1]);
      }
    }
  const auto in = traded_over_ranks(comm_, out);
  constexpr std::size_t values = 5 + corner_values;
  for (int r = 0; r < ranks; ++r) {
    const std::vector<double>& list = in[std::size_t(r)];
    Ghosts::Peer& peer = peers[std::size_t(r)];
    peer.rank = r;
    peer.first = LocalIndex(stiffness_.size());
    peer.count = LocalIndex(list.size() / values);
    for (std::size_t k = 0; k < list.size(); k += values) {
      locations_.push_back({LocalIndex(list[k]), LocalIndex(list[k + 1])});
      stiffness_.push_back(list[k + 2]);
      open_corners_.push_back(unsigned(list[k + 3]));
      images_.push_back(int(list[k + 4]));
      corners_.insert(corners_.end(), &list[k + 5], &list[k + 5] + corner_values);
    }
  }
  return peers;
}

void OverlapContact::list_pairs(double skin)
{
  struct Entry {
    GlobalIndex bin;
    LocalIndex cell;
    auto operator<=>(const Entry&) const = default;
  };
  const double width = 1.5 * size_.maxCoeff() + skin;
  const auto bin_of = [&](double place) { return GlobalIndex(std::floor(place / width)); };
  std::vector<Entry> entries;
  for (std::size_t c = 0; c < stiffness_.size(); ++c) {
    const Box& box = boxes_[c];
    for (GlobalIndex j = bin_of(box[1] - 0.5 * skin); j <= bin_of(box[3] + 0.5 * skin); ++j)
      for (GlobalIndex i = bin_of(box[0] - 0.5 * skin); i <= bin_of(box[2] + 0.5 * skin); ++i)
        entries.push_back({j * (GlobalIndex(1) << 32) + i, LocalIndex(c)});
  }
  std::sort(entries.begin(), entries.end());
  pairs_.clear();
  for (auto first = entries.begin(); first != entries.end();) {
    const auto last = std::find_if(first, entries.end(),
                                   [&](const Entry& entry) { return entry.bin != first->bin; });
    for (auto a = first; a != last && a->cell < cells(); ++a)
      for (auto b = a + 1; b != last; ++b)
        if (can_meet(a->cell, b->cell) &&
            meet(boxes_[std::size_t(a->cell)], boxes_[std::size_t(b->cell)], skin))
          pairs_.push_back({a->cell, b->cell});
    first = last;
  }
  std::sort(pairs_.begin(), pairs_.end());
  pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
  turned_.resize(pairs_.size());
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const auto& a = locations_[std::size_t(pairs_[k].first)];
    const auto& b = locations_[std::size_t(pairs_[k].second)];
    turned_[k] = std::tie(a[1], a[0]) > std::tie(b[1], b[0]);
  }
}

/// Candidates without a pair go, and their owners are told which are left; and of which pairs this
/// rank must know what their other side comes to.
void OverlapContact::keep_needed(std::vector<Ghosts::Peer> peers)
{
  std::vector<std::vector<LocalIndex>> pairs_of(stiffness_.size());
  for (std::size_t k = 0; k < pairs_.size(); ++k)
    pairs_of[std::size_t(pairs_[k].second)].push_back(LocalIndex(k));
  const auto count = LocalIndex(pairs_.size());
  second_side_.assign(pairs_.size(), 0);
  LocalIndex next_side = count + 1;  // behind the first sides and a zero
  for (LocalIndex c = 0; c < cells(); ++c)
    for (const LocalIndex k : pairs_of[std::size_t(c)]) second_side_[std::size_t(k)] = next_side++;

  std::vector<std::vector<double>> out(peers.size());
  std::vector<Ghosts::Peer> sides(peers.size());
  LocalIndex next = cells();
  for (Ghosts::Peer& peer : peers) {
    std::vector<double>& list = out[std::size_t(peer.rank)];
    Ghosts::Peer& side = sides[std::size_t(peer.rank)];
    side.rank = peer.rank;
    side.first = next_side;
    const LocalIndex first = next;
    for (LocalIndex k = 0; k < peer.count; ++k) {
      const auto ghost = std::size_t(peer.first + k);
      if (pairs_of[ghost].empty()) continue;
      list.insert(list.end(), {double(k), double(pairs_of[ghost].size())});
      for (const LocalIndex pair : pairs_of[ghost]) {
        const IndexVec<2>& at = locations_[std::size_t(pairs_[std::size_t(pair)].first)];
        list.insert(list.end(), {double(at[0]), double(at[1])});
        pairs_[std::size_t(pair)].second = next;
        second_side_[std::size_t(pair)] = next_side++;
      }
      stiffness_[std::size_t(next)] = stiffness_[ghost];
      locations_[std::size_t(next)] = locations_[ghost];
      images_[std::size_t(next++)] = images_[ghost];
    }
    peer.first = first;
    peer.count = next - first;
    side.count = next_side - side.first;
  }
  stiffness_.resize(std::size_t(next));
  locations_.resize(std::size_t(next));
  images_.resize(std::size_t(next));
  corners_.resize(std::size_t(next) * corner_values);
  sides_.assign(std::size_t(next_side), 0.0);
  answer(peers, traded_over_ranks(comm_, out), sides);
  ghosts_.set(std::move(peers));
  side_ghosts_.set(std::move(sides));
}

/// What the others asked for: cells of this rank, and for each the cells of theirs that it meets.
void OverlapContact::answer(std::vector<Ghosts::Peer>& peers,
                            const std::vector<std::vector<double>>& asked,
                            std::vector<Ghosts::Peer>& sides) const
{
  std::map<std::array<LocalIndex, 4>, LocalIndex> numbers;  // by cell, the other's location, image
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const auto other = std::size_t(pairs_[k].second);
    if (pairs_[k].second >= cells())
      numbers[{pairs_[k].first, locations_[other][0], locations_[other][1], images_[other]}] =
          LocalIndex(k);
  }
  for (Ghosts::Peer& peer : peers) {
    const std::vector<double>& list = asked[std::size_t(peer.rank)];
    std::vector<Ghosts::Sent> sent;
    for (std::size_t at = 0; at < list.size();) {
      const Ghosts::Sent& cell = peer.sent[std::size_t(list[at])];
      sent.push_back(cell);
      const auto met = std::size_t(list[at + 1]);
      at += 2;
      for (std::size_t k = 0; k < met; ++k, at += 2) {
        // Seen from here, theirs is as far the other way.
        const auto found = numbers.find({cell.item, LocalIndex(list[at]), LocalIndex(list[at + 1]),
                                         2 * itself - cell.image});
        // Where rounding keeps a pair out on this side it does not touch: the zero.
        sides[std::size_t(peer.rank)].sent.push_back(
            {found == numbers.end() ? LocalIndex(pairs_.size()) : found->second, itself});
      }
    }
    peer.sent = std::move(sent);
  }
}

/// Pairs whose boxes meet. Cells with a reflex corner come as two triangles.
void OverlapContact::list_near()
{
  near_.clear();
  const auto pieces_of = [&](LocalIndex cell) {
    const int reflex = reflex_corner(corners_of(cell));
    return reflex < 0 ? std::pair(0, 1) : std::pair(1 + 2 * reflex, 3 + 2 * reflex);
  };
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    auto [a, b] = pairs_[k];
    if (!meet(boxes_[std::size_t(a)], boxes_[std::size_t(b)], 0)) continue;
    if (turned_[k]) std::swap(a, b);
    const auto [first, last] = pieces_of(a);
    const auto [other_first, other_last] = pieces_of(b);
    for (int one = first; one < last; ++one)
      for (int other = other_first; other < other_last; ++other) near_.push_back({k, one, other});
  }
}

void OverlapContact::find_overlaps()
{
  list_near();
  const std::size_t groups = (near_.size() + lane_count - 1) / lane_count;
  overlaps_.resize(groups * values_per_group);
  for (std::size_t g = 0; g < groups; ++g) {
    alignas(lane_alignment) double a[corner_values * lane_count], b[corner_values * lane_count];
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const Near& near = near_[std::min(g * lane_count + lane, near_.size() - 1)];
      const double *first = corners_of(pairs_[near.pair].first),
                   *second = corners_of(pairs_[near.pair].second);
      if (turned_[near.pair]) std::swap(first, second);
      const auto& one = corners_of_piece[std::size_t(near.first_piece)];
      const auto& other = corners_of_piece[std::size_t(near.second_piece)];
      for (std::size_t k = 0; k < corner_values; ++k) {
        const std::size_t axis = k < 4 ? 0 : 4;
        a[k * lane_count + lane] = first[axis + one[k % 4]] - first[axis];
        b[k * lane_count + lane] = second[axis + other[k % 4]] - first[axis];
      }
    }
    Quads one, other;
    for (int k = 0; k < 4; ++k) {
      one.x[k] = load(a + k * lane_count);
      one.y[k] = load(a + (k + 4) * lane_count);
      other.x[k] = load(b + k * lane_count);
      other.y[k] = load(b + (k + 4) * lane_count);
    }
    const Overlap overlap = overlap_of(one, other);
    double* out = &overlaps_[g * values_per_group];
    store(overlap.area, out);
    for (int k = 0; k < 4; ++k) {
      store(overlap.a_x[k], out + (1 + k) * lane_count);
      store(overlap.a_y[k], out + (5 + k) * lane_count);
      store(overlap.b_x[k], out + (9 + k) * lane_count);
      store(overlap.b_y[k], out + (13 + k) * lane_count);
    }
  }
}

void OverlapContact::measure(const MeshNodes<2>& nodes)
{
  take_places(nodes);
  ghosts_.update(corners_, corner_values, [this](int image, std::span<double> corners) {
    const Vec<2> shift = shift_of(image);
    for (std::size_t k = 0; k < corner_values; ++k) corners[k] += shift[k < 4 ? 0 : 1];
  });
  find_boxes();
  find_overlaps();
  areas_.assign(pairs_.size(), 0.0);
  std::fill(sides_.begin(), sides_.end(), 0.0);
  touching_ = 0;
  std::vector<LocalIndex>& first = first_touch_;
  first.assign(cells_.size() + 1, 0);
  for (std::size_t k = 0; k < near_.size(); ++k) {
    const auto [number, one, other] = near_[k];
    if (*overlap_of_pair(k) > 0) areas_[number] += *overlap_of_pair(k);
    if (areas_[number] == 0 || (k + 1 < near_.size() && near_[k + 1].pair == number)) continue;
    const Pair& pair = pairs_[number];
    ++first[std::size_t(pair.first)];
    if (pair.second < cells()) ++first[std::size_t(pair.second)];
    touching_ += pair.second < cells() ? 2 : 1;
  }
  std::exclusive_scan(first.begin(), first.end(), first.begin(), 0);
  touches_.resize(std::size_t(first.back()));
  std::vector<LocalIndex> next(first.begin(), first.end() - 1);
  for (std::size_t entry = 0; entry < near_.size(); ++entry) {
    const std::size_t k = near_[entry].pair;
    if (areas_[k] == 0 || (entry + 1 < near_.size() && near_[entry + 1].pair == k)) continue;
    const Pair& pair = pairs_[k];
    touches_[std::size_t(next[std::size_t(pair.first)]++)] = {pair.second, LocalIndex(k),
                                                              LocalIndex(k)};
    if (pair.second < cells())
      touches_[std::size_t(next[std::size_t(pair.second)]++)] = {pair.first, LocalIndex(k),
                                                                 second_side_[k]};
  }
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const std::span<const Touch> touches(&touches_[std::size_t(first[c])],
                                         std::size_t(first[c + 1] - first[c]));
    for (const Touch& touch : touches) {
      double together = 0;
      for (const Touch& beside : touches)
        if (&beside == &touch || are_of_one_wall(beside.other, touch.other))
          together += areas_[std::size_t(beside.pair)];
      sides_[std::size_t(touch.side)] = stiffness_[c] / area_ * together;
    }
  }
  side_ghosts_.update(sides_, 1);
}

/// Whether cells are so near in the lattice that what a third one presses them with adds up.
bool OverlapContact::are_of_one_wall(LocalIndex a, LocalIndex b) const
{
  return apart(a, b).cwiseAbs().maxCoeff() <= 2;
}

/// In locations, the short way around where an axis is periodic.
IndexVec<2> OverlapContact::apart(LocalIndex from, LocalIndex to) const
{
  IndexVec<2> apart = locations_[std::size_t(to)] - locations_[std::size_t(from)];
  for (int d = 0; d < 2; ++d)
    if (period_[d] > 0) {
      if (apart[d] > period_[d] / 2) apart[d] -= period_[d];
      if (apart[d] < -period_[d] / 2) apart[d] += period_[d];
    }
  return apart;
}

void OverlapContact::add_forces(NodeFields<2>& fields) const
{
  for (std::size_t k = 0; k < near_.size(); ++k) {
    const double* values = overlap_of_pair(k);
    if (!(*values > 0)) continue;
    const auto [number, one, other] = near_[k];
    const auto& [first, second] = pairs_[number];
    const double push = pressure(number);
    const auto push_corners = [&](LocalIndex cell, int piece, const double* derivative) {
      if (cell >= cells()) return;
      for (std::size_t c = 0; c < 4; ++c) {
        const std::size_t corner = corners_of_piece[std::size_t(piece)][c];
        double* force = fields.force_of(cells_[std::size_t(cell)].nodes[corner]);
        force[0] -= push * derivative[c * lane_count];
        force[1] -= push * derivative[(c + 4) * lane_count];
      }
    };
    push_corners(turned_[number] ? second : first, one, values + lane_count);
    push_corners(turned_[number] ? first : second, other, values + 9 * lane_count);
  }
}

/// Half of it where the pair has its other side elsewhere.
double OverlapContact::energy() const
{
  double energy = 0;
  for (const Touch& touch : touches_)
    energy += 0.5 * areas_[std::size_t(touch.pair)] * sides_[std::size_t(touch.side)];
  return energy;
}

double OverlapContact::overlapped_area() const
{
  double area = 0;
  for (const Touch& touch : touches_) area += 0.5 * areas_[std::size_t(touch.pair)];
  return area;
}

std::size_t OverlapContact::bytes() const
{
  return cells_.size() * sizeof(Cell) + pairs_.capacity() * sizeof(Pair) +
         near_.capacity() * sizeof(Near) +
         (corners_.capacity() + 4 * boxes_.capacity() + overlaps_.capacity()) * sizeof(double);
}

}  // namespace mpm
