/// Which cells may meet, on this rank and on others.

#include <mpm/core/index_order.hpp>
#include <mpm/lagrangian/overlap_contact.hpp>
#include <mpm/parallel/session.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>

namespace mpm {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

template <int Dim>
CellBox<Dim> widened(CellBox<Dim> box, double room)
{
  for (std::size_t d = 0; d < Dim; ++d) {
    box[d] -= room;
    box[Dim + d] += room;
  }
  return box;
}

}  // namespace

/// Bodies that are apart can anywhere. Neighbours with a face in common cannot, nor those around a
/// node or edge where all cells are; and what is behind the outer layer on both sides does not
/// before the layers themselves.
template <int Dim>
bool OverlapContact<Dim>::can_meet(LocalIndex own, LocalIndex other) const
{
  const OpenCorners<Dim>&open = open_[std::size_t(own)], &theirs = open_[std::size_t(other)];
  if (open.is_behind() && theirs.is_behind()) return false;
  if (is_rigid(own) && is_rigid(other)) return false;
  if (bodies_.are_apart(of_body_[std::size_t(own)], of_body_[std::size_t(other)])) return true;
  const IndexVec<Dim> apart = this->apart(own, other);
  if (apart.cwiseAbs().maxCoeff() > 1) return true;
  // A third body may be apart from one of them alone: both ranks of a pair have to agree.
  return apart.cwiseAbs().sum() > 1 && (open.towards(apart) || theirs.towards(-apart));
}

template <int Dim>
void OverlapContact<Dim>::find_pairs(const MeshNodes<Dim>& nodes, std::vector<double> rooms)
{
  if (work_then_.empty()) work_then_ = counted_work();
  rooms_then_ = std::move(rooms);
  places_then_.clear();
  for (LocalIndex node = 0; node < nodes.size(); ++node)
    places_then_.push_back(nodes.position(node));
  const std::size_t own = cells_.size();
  values_.resize(own * Overlaps::values);
  stiffness_.resize(own);
  swelling_.assign(own, 0.0);
  locations_.resize(own);
  open_.resize(own);
  of_body_.resize(own);
  for (std::size_t c = 0; c < own; ++c) {
    stiffness_[c] = cells_[c].stiffness;
    locations_[c] = cells_[c].location;
    open_[c] = cells_[c].open;
    of_body_[c] = cells_[c].body;
  }
  take_places(nodes);
  find_boxes();
  std::vector<double> of_cells;  // then of ghosts
  for (const Cell& cell : cells_) {
    double& room = of_cells.emplace_back(0);
    for (const LocalIndex node : cell.nodes) room = std::max(room, rooms_then_[std::size_t(node)]);
  }
  std::vector<Ghosts::Peer> peers = add_candidates(of_cells);
  find_boxes();
  list_pairs(of_cells);
  keep_needed(std::move(peers));
  // Nothing is known of these pairs.
  near_.clear();
  found_.find({});
  pressing_.clear();
  touches_.clear();
  first_touch_.assign(own + 1, 0);
  touched_.clear();
  touched_at_.assign(pairs_.size(), -1);
  close_.clear();
  boxes_then_.clear();
}

template <int Dim>
double OverlapContact<Dim>::beyond_rooms(const MeshNodes<Dim>& nodes,
                                         std::span<const double> ahead) const
{
  double most = -infinity;
  for (std::size_t n = 0; n < places_then_.size(); ++n) {
    if (nodes.is_free(LocalIndex(n))) continue;
    const double way = (nodes.position(LocalIndex(n)) - places_then_[n]).norm();
    most = std::max(most, reach_ * (way + ahead[n]) - rooms_then_[n]);
  }
  return most;
}

/// As many periods to either side as cells are apart, `boxes` of all ranks', rooms and all: places
/// are not taken back into the first period, and what slides along a periodic side goes on and on.
template <int Dim>
void OverlapContact<Dim>::count_images(std::span<const double> boxes)
{
  for (int d = 0; d < Dim; ++d) {
    periods_[d] = 0;
    if (period_[d] == 0) continue;
    double lower = infinity, upper = -infinity;
    for (std::size_t box = 0; box < boxes.size(); box += 2 * Dim) {
      lower = std::min(lower, boxes[box + std::size_t(d)]);
      upper = std::max(upper, boxes[box + std::size_t(Dim + d)]);
    }
    if (lower < upper)
      periods_[d] = LocalIndex(std::floor((upper - lower) / (period_[d] * size_[d])));
  }
}

/// How far an image lies from the cell itself, m.
template <int Dim>
Vec<Dim> OverlapContact<Dim>::shift_of(int image) const
{
  Vec<Dim> shift;
  for (int d = 0; d < Dim; ++d) {
    const int places = 2 * periods_[d] + 1;
    shift[d] = (image % places - periods_[d]) * period_[d] * size_[d];
    image /= places;
  }
  return shift;
}

/// All cells that may meet some of another rank's become ghosts there.
template <int Dim>
std::vector<Ghosts::Peer> OverlapContact<Dim>::add_candidates(std::vector<double>& rooms)
{
  const int ranks = ranks_of(comm_), me = rank_of(comm_);
  std::vector<Box> wide;
  for (std::size_t c = 0; c < rooms.size(); ++c) wide.push_back(widened<Dim>(boxes_[c], rooms[c]));
  Box mine;
  for (std::size_t d = 0; d < Dim; ++d) {
    mine[d] = infinity;
    mine[Dim + d] = -infinity;
    for (const Box& box : wide) {
      mine[d] = std::min(mine[d], box[d]);
      mine[Dim + d] = std::max(mine[Dim + d], box[Dim + d]);
    }
  }
  const std::vector<double> others = joined_over_ranks(comm_, mine);
  count_images(others);
  images_.assign(cells_.size(), itself());
  std::vector<std::vector<double>> out(static_cast<std::size_t>(ranks));
  std::vector<Ghosts::Peer> peers(static_cast<std::size_t>(ranks));
  for (int r = 0; r < ranks; ++r)
    for (int image = 0; image <= 2 * itself(); ++image) {
      if (r == me && image == itself()) continue;
      const Vec<Dim> shift = shift_of(image);
      const auto moved = [&](Box box) {
        for (std::size_t d = 0; d < box.size(); ++d) box[d] += shift[int(d % Dim)];
        return box;
      };
      Box theirs;
      std::copy_n(&others[std::size_t(r) * theirs.size()], theirs.size(), theirs.begin());
      if (!meet<Dim>(moved(mine), theirs, 0)) continue;
      for (LocalIndex c = 0; c < cells(); ++c) {
        if (!meet<Dim>(moved(wide[std::size_t(c)]), theirs, 0)) continue;
        peers[std::size_t(r)].sent.push_back({c, image});
        std::vector<double>& list = out[std::size_t(r)];
        const Cell& cell = cells_[std::size_t(c)];
        list.insert(list.end(), cell.location.begin(), cell.location.end());
        list.insert(list.end(), {cell.stiffness, double(cell.open.bits()), double(cell.body),
                                 double(image), rooms[std::size_t(c)]});
        list.insert(list.end(), values_of(c), values_of(c) + Overlaps::values);
        Overlaps::shift(shift, &*list.end() - Overlaps::values);
      }
    }
  add_ghosts(peers, traded_over_ranks(comm_, out), rooms);
  return peers;
}

template <int Dim>
void OverlapContact<Dim>::add_ghosts(std::vector<Ghosts::Peer>& peers,
                                     const std::vector<std::vector<double>>& sent,
                                     std::vector<double>& rooms)
{
  constexpr std::size_t values = Dim + 5 + std::size_t(Overlaps::values);
  for (std::size_t r = 0; r < peers.size(); ++r) {
    const std::vector<double>& list = sent[r];
    Ghosts::Peer& peer = peers[r];
    peer.rank = int(r);
    peer.first = LocalIndex(stiffness_.size());
    peer.count = LocalIndex(list.size() / values);
    for (std::size_t k = 0; k < list.size(); k += values) {
      IndexVec<Dim>& location = locations_.emplace_back();
      for (int d = 0; d < Dim; ++d) location[d] = LocalIndex(list[k + std::size_t(d)]);
      const double* of_cell = &list[k + Dim];
      stiffness_.push_back(of_cell[0]);
      open_.emplace_back(unsigned(of_cell[1]));
      of_body_.push_back(int(of_cell[2]));
      images_.push_back(int(of_cell[3]));
      rooms.push_back(of_cell[4]);
      values_.insert(values_.end(), of_cell + 5, of_cell + 5 + Overlaps::values);
    }
  }
}

/// Cells stand in the bins that their boxes and rooms reach into. From the last to the first, each
/// meets those that came before it in its bins.
template <int Dim>
void OverlapContact<Dim>::list_pairs(std::span<const double> rooms)
{
  struct Entry {
    GlobalIndex bin;
    LocalIndex cell, next;
  };
  constexpr GlobalIndex bins_per_axis = GlobalIndex(1) << (62 / Dim);
  const double width = 1.5 * size_.maxCoeff() + (rooms.empty() ? 0.0 : 2 * std::ranges::min(rooms));
  const auto bin_of = [&](double place) { return LocalIndex(std::floor(place / width)); };
  const auto number_of = [](const IndexVec<Dim>& at) {
    GlobalIndex bin = 0;
    for (int d = Dim - 1; d >= 0; --d) bin = bin * bins_per_axis + at[d];
    return bin;
  };
  std::vector<LocalIndex> first_entry(std::bit_ceil(4 * stiffness_.size() + 1), -1);
  const auto slot_of = [&](GlobalIndex bin) -> LocalIndex& {
    // Fibonacci hashing: its upper bits depend on all of the number's.
    return first_entry[(std::uint64_t(bin) * 0x9e3779b97f4a7c15u >> 32) & (first_entry.size() - 1)];
  };
  std::vector<Entry> entries;
  std::vector<Box> wide(rooms.size());
  std::vector<IndexVec<Dim>> first_bins(stiffness_.size());
  std::vector<LocalIndex> met;
  pairs_.clear();
  for (LocalIndex c = LocalIndex(stiffness_.size()); c-- > 0;) {
    const Box& box = wide[std::size_t(c)] =
        widened<Dim>(boxes_[std::size_t(c)], rooms[std::size_t(c)]);
    IndexBox<Dim> bins;
    for (int d = 0; d < Dim; ++d) {
      bins.lower[d] = bin_of(box[std::size_t(d)]);
      bins.upper[d] = bin_of(box[std::size_t(Dim + d)]) + 1;
    }
    first_bins[std::size_t(c)] = bins.lower;
    met.clear();
    for_each_index(bins, [&](const IndexVec<Dim>& at) {
      const GlobalIndex bin = number_of(at);
      LocalIndex& slot = slot_of(bin);
      for (LocalIndex e = c < cells() ? slot : -1; e >= 0; e = entries[std::size_t(e)].next) {
        const Entry& entry = entries[std::size_t(e)];
        // Of the bins that both are in the first one counts.
        if (entry.bin == bin && meet<Dim>(box, wide[std::size_t(entry.cell)], 0) &&
            bins.lower.cwiseMax(first_bins[std::size_t(entry.cell)]) == at &&
            can_meet(c, entry.cell))
          met.push_back(entry.cell);
      }
      entries.push_back({bin, c, slot});
      slot = LocalIndex(entries.size()) - 1;
    });
    std::ranges::sort(met, std::greater<>());
    for (const LocalIndex other : met) pairs_.push_back({c, other});
  }
  std::ranges::reverse(pairs_);
  turned_.resize(pairs_.size());
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    turned_[k] = stands_before<Dim>(locations_[std::size_t(pairs_[k].second)],
                                    locations_[std::size_t(pairs_[k].first)]);
  }
}

/// Candidates without a pair go, and their owners are told which are left; and of which pairs this
/// rank must know what their other side comes to.
template <int Dim>
void OverlapContact<Dim>::keep_needed(std::vector<Ghosts::Peer> peers)
{
  std::vector<std::vector<LocalIndex>> pairs_of(stiffness_.size() - cells_.size());  // of ghosts
  for (std::size_t k = 0; k < pairs_.size(); ++k)
    if (pairs_[k].second >= cells())
      pairs_of[std::size_t(pairs_[k].second - cells())].push_back(LocalIndex(k));
  const auto count = LocalIndex(pairs_.size());
  other_side_.assign(pairs_.size(), count);
  LocalIndex next_side = count + 1;  // behind this rank's sides and a zero

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
      const std::vector<LocalIndex>& of_ghost = pairs_of[ghost - cells_.size()];
      if (of_ghost.empty()) continue;
      list.insert(list.end(), {double(k), double(of_ghost.size())});
      for (const LocalIndex pair : of_ghost) {
        const IndexVec<Dim>& at = locations_[std::size_t(pairs_[std::size_t(pair)].first)];
        list.insert(list.end(), at.begin(), at.end());
        pairs_[std::size_t(pair)].second = next;
        other_side_[std::size_t(pair)] = next_side++;
      }
      stiffness_[std::size_t(next)] = stiffness_[ghost];
      locations_[std::size_t(next)] = locations_[ghost];
      of_body_[std::size_t(next)] = of_body_[ghost];
      images_[std::size_t(next++)] = images_[ghost];
    }
    peer.first = first;
    peer.count = next - first;
    side.count = next_side - side.first;
  }
  stiffness_.resize(std::size_t(next));
  locations_.resize(std::size_t(next));
  of_body_.resize(std::size_t(next));
  images_.resize(std::size_t(next));
  values_.resize(std::size_t(next) * Overlaps::values);
  sides_.assign(std::size_t(next_side), 0.0);
  answer(peers, traded_over_ranks(comm_, out), sides);
  ghosts_.set(std::move(peers));
  side_ghosts_.set(std::move(sides));
}

/// What the others asked for: cells of this rank, and for each the cells of theirs that it meets.
template <int Dim>
void OverlapContact<Dim>::answer(std::vector<Ghosts::Peer>& peers,
                                 const std::vector<std::vector<double>>& asked,
                                 std::vector<Ghosts::Peer>& sides) const
{
  // By cell, the other's location and image.
  using Key = std::array<LocalIndex, Dim + 2>;
  std::map<Key, LocalIndex> numbers;
  const auto key_of = [](LocalIndex cell, const auto* location, int image) {
    Key key;
    key[0] = cell;
    for (std::size_t d = 0; d < Dim; ++d) key[1 + d] = LocalIndex(location[d]);
    key[Dim + 1] = image;
    return key;
  };
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const auto other = std::size_t(pairs_[k].second);
    if (pairs_[k].second >= cells())
      numbers[key_of(pairs_[k].first, locations_[other].data(), images_[other])] = LocalIndex(k);
  }
  for (Ghosts::Peer& peer : peers) {
    const std::vector<double>& list = asked[std::size_t(peer.rank)];
    std::vector<Ghosts::Sent> sent;
    for (std::size_t at = 0; at < list.size();) {
      const Ghosts::Sent& cell = peer.sent[std::size_t(list[at])];
      sent.push_back(cell);
      const auto met = std::size_t(list[at + 1]);
      at += 2;
      for (std::size_t k = 0; k < met; ++k, at += Dim) {
        // Seen from here, theirs is as far the other way.
        const auto found = numbers.find(key_of(cell.item, &list[at], 2 * itself() - cell.image));
        // Where rounding keeps a pair out on this side it does not touch: the zero.
        sides[std::size_t(peer.rank)].sent.push_back(
            {found == numbers.end() ? LocalIndex(pairs_.size()) : found->second, itself()});
      }
    }
    peer.sent = std::move(sent);
  }
}

template Vec<2> OverlapContact<2>::shift_of(int) const;
template void OverlapContact<2>::find_pairs(const MeshNodes<2>&, std::vector<double>);
template double OverlapContact<2>::beyond_rooms(const MeshNodes<2>&, std::span<const double>) const;
template Vec<3> OverlapContact<3>::shift_of(int) const;
template void OverlapContact<3>::find_pairs(const MeshNodes<3>&, std::vector<double>);
template double OverlapContact<3>::beyond_rooms(const MeshNodes<3>&, std::span<const double>) const;

}  // namespace mpm
