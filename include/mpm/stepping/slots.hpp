#pragma once
/// What acts in a step beside the bodies themselves, in the order in which the method has it.

#include <mpm/conditions/boundary_condition.hpp>
#include <mpm/conditions/contact.hpp>
#include <mpm/conditions/loads.hpp>

#include <memory>
#include <vector>

namespace mpm {

template <int Dim>
class Exchange;

/// Scalars that particles carry and the grid spreads (heat, moisture), once the bodies have moved.
template <int Dim>
class Transport {
 public:
  virtual ~Transport() = default;
  virtual void advance(Exchange<Dim>& exchange, std::vector<Body<Dim>>& bodies, double time,
                       double dt) = 0;
  /// s, that explicit transport bears.
  virtual double largest_step() const { return std::numeric_limits<double>::infinity(); }
  virtual void archive(Archive& archive) = 0;
};

template <int Dim>
struct Slots {
  Loads<Dim> loads{};
  std::vector<std::unique_ptr<Contact<Dim>>> contacts{};
  std::vector<std::unique_ptr<BoundaryCondition<Dim>>> conditions{};
  std::vector<std::unique_ptr<Transport<Dim>>> transports{};

  bool need_surfaces() const;
  /// P2G of the forces on particles, of loads and of conditions that push: a partial sum, as other
  /// node values.
  void scatter(const BodyPart<Dim>& part, const Transfer<Dim>& transfer,
               const GridTopology<Dim>& grid, NodeFields<Dim>& fields, double time) const;
  /// s, that all of them bear.
  double largest_step() const;
  void archive(Archive& archive);
};

}  // namespace mpm
