#pragma once
/// What happens between velocity fields where bodies meet at a node.

#include <mpm/conditions/reaction.hpp>
#include <mpm/grid/node_fields.hpp>

#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace mpm {

/// Acts after the fields' velocities were updated, each as if it were alone, and before boundary
/// conditions.
template <int Dim>
class Contact {
 public:
  virtual ~Contact() = default;

  /// Whether it needs to know where the surfaces of bodies are: fields then have the column
  /// `surface`, and `meet` and `measure` come before anything else of a step.
  virtual bool needs_surfaces() const { return false; }
  /// Finds the nodes where bodies meet, by their mass. Returns marks, by the first node, of the
  /// stencils whose particles tell about these nodes.
  virtual std::span<const char> meet(const GridTopology<Dim>&, int /*support*/,
                                     std::span<NodeFields<Dim>>)
  {
    return {};
  }
  /// Looks at the surfaces, summed over the ranks.
  virtual void measure(const GridTopology<Dim>&, std::span<NodeFields<Dim>>) {}

  /// Changes updated velocities and their increments at nodes where several fields are active.
  /// Every rank that reaches a node holds the same values there, and must come to the same result.
  virtual void exchange_momentum(const GridTopology<Dim>& grid, std::span<NodeFields<Dim>> fields,
                                 double time, double dt) = 0;
  /// The same for the velocities whose gradient is taken.
  virtual void exchange_gradient(const GridTopology<Dim>& grid, std::span<NodeFields<Dim>> fields,
                                 double time, double dt) = 0;
  /// Once the velocities of the step stand, and conditions have acted on them: the work of what was
  /// exchanged.
  virtual void book(const GridTopology<Dim>&, std::span<NodeFields<Dim>>) {}
  /// Work taken from the bodies (friction, impact): counts as negative external work.
  virtual Reaction<Dim> take_reaction() = 0;
  /// What the history tells of it.
  virtual std::optional<ContactSums> sums() const { return std::nullopt; }
  /// s, that the contact bears.
  virtual double largest_step() const { return std::numeric_limits<double>::infinity(); }
  virtual void archive(Archive& archive) = 0;
};

}  // namespace mpm
