/// Which cells may meet, on this rank and on others.

#include <mpm/lagrangian/overlap_contact.hpp>
#include <mpm/parallel/session.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace mpm {

namespace {

constexpr int itself = 4;  ///< of the images

}  // namespace

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
        list.insert(list.end(), {double(cell.location[0]), double(cell.location[1]), cell.stiffness,
                                 double(cell.open_corners), double(image)});
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
  for (auto* values : {&sides_, &stiffnesses_, &parts_of_face_})
    values->assign(std::size_t(next_side), 0.0);
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
        const auto found = numbers.find(
            {cell.item, LocalIndex(list[at]), LocalIndex(list[at + 1]), 2 * itself - cell.image});
        // Where rounding keeps a pair out on this side it does not touch: the zero.
        sides[std::size_t(peer.rank)].sent.push_back(
            {found == numbers.end() ? LocalIndex(pairs_.size()) : found->second, itself});
      }
    }
    peer.sent = std::move(sent);
  }
}

}  // namespace mpm
