#pragma once
/// Which locations of the lattice are taken, as one rank knows it.

#include <mpm/core/archive.hpp>
#include <mpm/lagrangian/location_mesh.hpp>
#include <mpm/lagrangian/location_table.hpp>

#include <array>
#include <set>

namespace mpm {

/// Its own ones, and those around them.
template <int Dim>
class Occupants {
 public:
  Occupants() = default;
  explicit Occupants(const IndexBox<Dim>& box) : taken_(box, Occupant{}) {}

  /// In the box; whoever comes first has it.
  void put(const IndexVec<Dim>& location, const Occupant& occupant)
  {
    if (Occupant& at = taken_.at(location); at.body < 0) at = occupant;
  }
  /// A cell that has failed leaves it empty.
  void remove(const IndexVec<Dim>& location) { removed_.insert(key_of(location)); }

  Occupant operator()(const IndexVec<Dim>& location) const
  {
    if (!removed_.empty() && removed_.contains(key_of(location))) return {};
    return taken_(location);
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

  LocationTable<Dim, Occupant> taken_;
  std::set<Key> removed_;
};

}  // namespace mpm
