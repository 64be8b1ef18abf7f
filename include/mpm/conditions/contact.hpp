#pragma once
/// What happens between velocity fields where bodies meet at a node.

#include <mpm/conditions/reaction.hpp>
#include <mpm/grid/node_fields.hpp>

#include <limits>
#include <span>

namespace mpm {

/// Acts after the fields' velocities were updated, each as if it were alone, and before boundary
/// conditions.
template <int Dim>
class Contact {
 public:
  virtual ~Contact() = default;

  /// Changes updated velocities and their increments at nodes where several fields are active.
  /// Every rank that reaches a node holds the same values there, and must come to the same result.
  virtual void exchange_momentum(const GridTopology<Dim>& grid, std::span<NodeFields<Dim>> fields,
                                 double time, double dt) = 0;
  /// The same for the velocities whose gradient is taken.
  virtual void exchange_gradient(const GridTopology<Dim>& grid, std::span<NodeFields<Dim>> fields,
                                 double time, double dt) = 0;
  /// Work taken from the bodies (friction, impact): counts as negative external work.
  virtual Reaction<Dim> take_reaction() = 0;
  /// s, that the contact bears.
  virtual double largest_step() const { return std::numeric_limits<double>::infinity(); }
  virtual void archive(Archive& archive) = 0;
};

}  // namespace mpm
