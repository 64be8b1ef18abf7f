#pragma once
/// Which locations of the lattice are taken, as one rank knows it.

#include <mpm/core/archive.hpp>
#include <mpm/lagrangian/location_mesh.hpp>

#include <array>
#include <map>
#include <set>

namespace mpm {

/// Its own ones, and those around them.
template <int Dim>
class Occupants {
 public:
  /// Whoever comes first has it.
  void put(const IndexVec<Dim>& location, const Occupant& occupant)
  {
    taken_.try_emplace(key_of(location), occupant);
  }
  /// A cell that has failed leaves it empty.
  void remove(const IndexVec<Dim>& location) { removed_.insert(key_of(location)); }

  Occupant operator()(const IndexVec<Dim>& location) const
  {
    const Key key = key_of(location);
    const auto found = taken_.find(key);
    return found == taken_.end() || removed_.contains(key) ? Occupant{} : found->second;
  }

  /// What has been removed.
  void archive(Archive& archive)
  {
    std::vector<std::int64_t> list;
    for (const Key& key : removed_) list.insert(list.end(), key.begin(), key.end());
    archive.list("removed", list);
    removed_.clear();
    for (auto at = list.begin(); at != list.end(); at += Dim) {
      Key key;
      std::copy_n(at, Dim, key.begin());
      removed_.insert(key);
    }
  }

 private:
  using Key = std::array<LocalIndex, std::size_t(Dim)>;
  static Key key_of(const IndexVec<Dim>& location)
  {
    Key key;
    std::copy_n(location.data(), Dim, key.begin());
    return key;
  }

  std::map<Key, Occupant> taken_;
  std::set<Key> removed_;
};

}  // namespace mpm
