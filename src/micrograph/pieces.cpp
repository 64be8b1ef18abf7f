#include <mpm/micrograph/pieces.hpp>

#include <algorithm>
#include <numeric>

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

/// Empties the locations of every piece that `keep` refuses.
template <class Keep>
std::int64_t remove_pieces(Lattice& lattice, const Pieces& pieces, Keep keep)
{
  std::int64_t removed = 0;
  for (std::size_t location = 0; location < lattice.material.size(); ++location) {
    const std::int32_t piece = pieces.label[location];
    if (piece == Pieces::none || keep(piece)) continue;
    lattice.material[location] = Lattice::empty;
    if (!lattice.shape.empty()) lattice.shape[location] = -1;
    ++removed;
  }
  return removed;
}

}  // namespace

Pieces connected_pieces(const Lattice& lattice)
{
  // Two passes over the rows: provisional labels from the neighbours at the left and below, then
  // one number for each set of labels that met.
  Pieces pieces;
  pieces.label.assign(lattice.material.size(), Pieces::none);
  DisjointSets sets;
  for (int j = 0; j < lattice.ny; ++j)
    for (int i = 0; i < lattice.nx; ++i) {
      if (lattice(i, j) == Lattice::empty) continue;
      std::int32_t* label = &pieces.label[std::size_t(j) * lattice.nx + i];
      const std::int32_t left = i > 0 ? label[-1] : Pieces::none;
      const std::int32_t below = j > 0 ? *(label - lattice.nx) : Pieces::none;
      if (left != Pieces::none && below != Pieces::none)
        *label = sets.join(left, below);
      else
        *label = left != Pieces::none ? left : below != Pieces::none ? below : sets.add();
    }

  std::vector<std::int32_t> number_of_root;
  for (std::int32_t& label : pieces.label) {
    if (label == Pieces::none) continue;
    const auto root = std::size_t(sets.root(label));
    if (root >= number_of_root.size()) number_of_root.resize(root + 1, Pieces::none);
    if (number_of_root[root] == Pieces::none) {
      number_of_root[root] = std::int32_t(pieces.size.size());
      pieces.size.push_back(0);
    }
    label = number_of_root[root];
    ++pieces.size[std::size_t(label)];
  }
  return pieces;
}

std::int64_t remove_specks(Lattice& lattice, std::int64_t fewest_locations)
{
  const Pieces pieces = connected_pieces(lattice);
  return remove_pieces(lattice, pieces, [&](std::int32_t piece) {
    return pieces.size[std::size_t(piece)] >= fewest_locations;
  });
}

std::int64_t keep_largest_piece(Lattice& lattice)
{
  const Pieces pieces = connected_pieces(lattice);
  const auto largest = std::ranges::max_element(pieces.size) - pieces.size.begin();
  return remove_pieces(lattice, pieces, [&](std::int32_t piece) { return piece == largest; });
}

}  // namespace mpm::micrograph
