#include <mpm/micrograph/pieces.hpp>

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <unordered_map>

namespace mpm::micrograph {

namespace {

/// Disjoint sets of provisional labels; the smallest label of a set is its root.
class DisjointSets {
 public:
  std::int32_t add()
  {
    parent_.push_back(std::int32_t(parent_.size()));
    return parent_.back();
  }
  std::int32_t root(std::int32_t label)
  {
    while (parent_[label] != label) label = parent_[label] = parent_[parent_[label]];
    return label;
  }
  std::int32_t join(std::int32_t a, std::int32_t b)
  {
    const auto [smaller, larger] = std::minmax({root(a), root(b)});
    return parent_[larger] = smaller;
  }

 private:
  std::vector<std::int32_t> parent_;
};

}  // namespace

template <int Dim>
Pieces connected_pieces(const Lattice<Dim>& lattice, const PeriodicAxes& periodic)
{
  // Two passes over the rows: provisional labels from the neighbours that came before, then one
  // number for each set of labels that met.
  Pieces pieces;
  pieces.label.assign(lattice.material.size(), Pieces::none);
  DisjointSets sets;
  std::size_t location = 0;
  for_each_index(lattice.part, [&](const IndexVec<Dim>& at) {
    const std::size_t here = location++;
    if (lattice.material[here] == Lattice<Dim>::empty) return;
    std::int32_t& label = pieces.label[here];
    const auto hang_on = [&](std::int32_t other) {
      if (other == Pieces::none) return;
      label = label == Pieces::none ? other : sets.join(label, other);
    };
    std::size_t stride = 1;
    for (int d = 0; d < Dim; stride *= std::size_t(lattice.part.count()[d++])) {
      if (at[d] > lattice.part.lower[d]) hang_on(pieces.label[here - stride]);
      if (periodic[std::size_t(d)] && lattice.part.lower[d] == 0 && at[d] + 1 == lattice.count[d])
        hang_on(pieces.label[here - stride * std::size_t(at[d])]);
    }
    if (label == Pieces::none) label = sets.add();
  });

  std::vector<std::int32_t> number_of_root;
  location = 0;
  for_each_index(lattice.part, [&](const IndexVec<Dim>& at) {
    std::int32_t& label = pieces.label[location++];
    if (label == Pieces::none) return;
    const auto root = std::size_t(sets.root(label));
    if (root >= number_of_root.size()) number_of_root.resize(root + 1, Pieces::none);
    if (number_of_root[root] == Pieces::none) {
      number_of_root[root] = std::int32_t(pieces.size.size());
      pieces.size.push_back(0);
      pieces.first.push_back(lattice.id(at));
    }
    label = number_of_root[root];
    ++pieces.size[std::size_t(label)];
  });
  return pieces;
}

namespace {

/// A piece, or the pieces of several parts that are one.
struct Group {
  GlobalIndex first;
  double size;
};
bool is_larger(const Group& a, const Group& b)
{
  return a.size > b.size || (a.size == b.size && a.first < b.first);
}

/// The pieces that reach a border between parts, joined across the borders. A piece is known by the
/// number of its first location.
class BorderPieces {
 public:
  template <int Dim>
  BorderPieces(const Lattice<Dim>& held, const Pieces& pieces, bool is_periodic, const Share& share)
  {
    // Slabs are cut across the last axis into layers; in the plane a layer is a row.
    constexpr int last = Dim - 1;
    const IndexBox<Dim> whole{IndexVec<Dim>::Zero(), held.count};
    const auto layer_size = std::size_t(whole.size() / held.count[last]);
    // Layers that are the first of a part, without the lowest if it goes on from none.
    std::vector<LocalIndex> borders;
    if (is_periodic) borders.push_back(0);
    for (int part = 0; part < share.parts; ++part)
      if (const LocalIndex layer = slab(whole, part, share.parts).lower[last];
          layer > 0 && layer < held.count[last] && (borders.empty() || layer > borders.back()))
        borders.push_back(layer);

    // Below and above each border: the piece's first location + 1 (0: void) and its size.
    std::vector<double> sides(borders.size() * layer_size * 4);
    for (std::size_t border = 0; border < borders.size(); ++border)
      for (int above = 0; above < 2; ++above) {
        const LocalIndex layer =
            (borders[border] - 1 + above + held.count[last]) % held.count[last];
        if (layer < held.part.lower[last] || layer >= held.part.upper[last]) continue;
        const std::size_t first = std::size_t(layer - held.part.lower[last]) * layer_size;
        for (std::size_t i = 0; i < layer_size; ++i) {
          const std::int32_t piece = pieces.label[first + i];
          if (piece == Pieces::none) continue;
          double* side = &sides[((border * layer_size + i) * 2 + std::size_t(above)) * 2];
          side[0] = double(pieces.first[std::size_t(piece)] + 1);
          side[1] = double(pieces.size[std::size_t(piece)]);
        }
      }
    share.sum(sides);
    for (std::size_t at = 0; at < sides.size(); at += 4) {
      const std::int32_t below = number_of(sides[at], sides[at + 1]);
      const std::int32_t above = number_of(sides[at + 2], sides[at + 3]);
      if (below != Pieces::none && above != Pieces::none) sets_.join(below, above);
    }
    joined_.assign(own_.size(), Group{std::numeric_limits<GlobalIndex>::max(), 0});
    for (std::size_t piece = 0; piece < own_.size(); ++piece) {
      Group& group = joined_[std::size_t(sets_.root(std::int32_t(piece)))];
      group.size += own_[piece].size;
      group.first = std::min(group.first, own_[piece].first);
    }
  }

  /// The whole that a piece is part of; nothing if it reaches no border.
  std::optional<Group> whole_of(GlobalIndex first)
  {
    const auto found = numbers_.find(first);
    if (found == numbers_.end()) return std::nullopt;
    return joined_[std::size_t(sets_.root(found->second))];
  }

 private:
  std::int32_t number_of(double first_and_one, double size)
  {
    if (first_and_one == 0) return Pieces::none;
    const GlobalIndex first = GlobalIndex(first_and_one) - 1;
    const auto [found, is_new] = numbers_.try_emplace(first, std::int32_t(own_.size()));
    if (is_new) {
      sets_.add();
      own_.push_back({first, size});
    }
    return found->second;
  }

  std::unordered_map<GlobalIndex, std::int32_t> numbers_;
  std::vector<Group> own_, joined_;
  DisjointSets sets_;
};

/// The largest of the groups that the parts name.
Group largest_over_parts(const Group& own, const Share& share)
{
  std::vector<double> all(std::size_t(share.parts) * 2);
  all[std::size_t(share.part) * 2] = own.size;
  all[std::size_t(share.part) * 2 + 1] = double(own.first);
  share.sum(all);
  Group largest = own;
  for (std::size_t at = 0; at < all.size(); at += 2) {
    if (all[at] == 0) continue;  // a part without wall: its place is none that a number can hold
    const Group group{GlobalIndex(all[at + 1]), all[at]};
    if (is_larger(group, largest)) largest = group;
  }
  return largest;
}

/// The runs of all parts, in the order of the parts.
std::vector<Run> gathered(const std::vector<Run>& own, const Share& share)
{
  std::vector<double> count(std::size_t(share.parts));
  count[std::size_t(share.part)] = double(own.size());
  share.sum(count);
  const auto before = std::size_t(std::accumulate(count.begin(), count.begin() + share.part, 0.0));
  const auto total = std::size_t(std::accumulate(count.begin(), count.end(), 0.0));
  std::vector<double> numbers(3 * total);
  for (std::size_t k = 0; k < own.size(); ++k) {
    numbers[3 * (before + k)] = double(own[k].row);
    numbers[3 * (before + k) + 1] = own[k].begin;
    numbers[3 * (before + k) + 2] = own[k].end;
  }
  share.sum(numbers);
  std::vector<Run> all;
  for (std::size_t at = 0; at < numbers.size(); at += 3)
    all.push_back(
        {GlobalIndex(numbers[at]), LocalIndex(numbers[at + 1]), LocalIndex(numbers[at + 2])});
  return all;
}

}  // namespace

template <int Dim>
std::vector<Run> removed_runs(const Lattice<Dim>& slab_of_part, const PieceRules& rules,
                              const Share& share)
{
  PeriodicAxes within = rules.periodic;
  within[Dim - 1] = false;  // along it parts are slabs
  const Pieces pieces = connected_pieces(slab_of_part, within);
  BorderPieces at_borders(slab_of_part, pieces, rules.periodic[Dim - 1], share);
  std::vector<Group> groups;  // the whole that each piece is part of
  Group largest{std::numeric_limits<GlobalIndex>::max(), 0};
  for (std::size_t piece = 0; piece < pieces.size.size(); ++piece) {
    const Group alone{pieces.first[piece], double(pieces.size[piece])};
    groups.push_back(at_borders.whole_of(alone.first).value_or(alone));
    if (is_larger(groups.back(), largest)) largest = groups.back();
  }
  largest = largest_over_parts(largest, share);

  std::vector<Run> runs;
  std::size_t location = 0;
  for_each_index(slab_of_part.part, [&](const IndexVec<Dim>& at) {
    const std::int32_t piece = pieces.label[location++];
    if (piece == Pieces::none) return;
    const Group& group = groups[std::size_t(piece)];
    if (group.size >= double(rules.fewest_locations) &&
        (!rules.only_largest || group.first == largest.first))
      return;
    const GlobalIndex row = slab_of_part.id(at) / slab_of_part.count[0];
    if (!runs.empty() && runs.back().row == row && runs.back().end == at[0])
      ++runs.back().end;
    else
      runs.push_back({row, at[0], at[0] + 1});
  });
  return gathered(runs, share);
}

template Pieces connected_pieces<2>(const Lattice<2>&, const PeriodicAxes&);
template Pieces connected_pieces<3>(const Lattice<3>&, const PeriodicAxes&);
template std::vector<Run> removed_runs<2>(const Lattice<2>&, const PieceRules&, const Share&);
template std::vector<Run> removed_runs<3>(const Lattice<3>&, const PieceRules&, const Share&);

}  // namespace mpm::micrograph
