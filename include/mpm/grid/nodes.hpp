#pragma once
/// The nodes of this rank as loads and conditions see them, whatever numbers them: a grid that
/// forgets, or nodes that belong to a body.

#include <mpm/core/types.hpp>

#include <vector>

namespace mpm {

/// An upright box in space, m; both ends belong to it and may be infinite.
template <int Dim>
struct Region {
  Vec<Dim> lower, upper;

  bool contains(const Vec<Dim>& position) const
  {
    return (position.array() >= lower.array()).all() && (position.array() <= upper.array()).all();
  }
};

template <int Dim>
class Nodes {
 public:
  virtual ~Nodes() = default;

  /// One more than the highest number of a node.
  virtual LocalIndex size() const = 0;
  /// Numbers, ascending, of the nodes in a region that particles may have reached; images of
  /// periodic nodes count with the place that they stand for.
  virtual void find_within(const Region<Dim>& region, std::vector<LocalIndex>& nodes) const = 0;
  /// A number that no other nodes have had in this process: as long as it stays, so do the answers
  /// of `find_within`.
  virtual GlobalIndex listing() const = 0;
  virtual Vec<Dim> position(LocalIndex node) const = 0;  ///< m
  /// Every node of the whole run has one owner; images are owned by nobody.
  virtual bool is_owned(LocalIndex node) const = 0;
  /// m, distance of nodes along each axis.
  virtual const Vec<Dim>& spacing() const = 0;
  /// m, after which an axis begins again; 0 for one that does not.
  virtual Vec<Dim> period() const = 0;

 protected:
  static GlobalIndex new_listing()
  {
    static GlobalIndex last = 0;
    return ++last;
  }
};

}  // namespace mpm
