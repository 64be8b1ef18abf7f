#pragma once
/// The orders in which a step updates stress and velocity.

#include <mpm/stepping/step.hpp>
#include <mpm/transfer/schemes.hpp>

#include <memory>
#include <span>
#include <string_view>

namespace mpm {

/// Sulsky, Zhou & Schreyer 1995 (CPC 87:236); Bardenhagen 2002 (JCP 180:383); Nairn 2003 (CMES
/// 4:649). Between steps the grid holds the sums of the particles' present state, so that every
/// step begins with the grid update and ends with particles complete in position, velocity and
/// stress.
template <int Dim>
class UpdateOrder {
 public:
  virtual ~UpdateOrder() = default;

  /// Node columns that it names.
  virtual typename NodeFields<Dim>::Needs needs() const { return {}; }
  /// Whether the sums between steps hold the internal force.
  virtual bool begins_with_force() const { return true; }
  /// When a step leaves the stresses, counted from the moment of the velocities, in steps
  /// (leap-frog).
  virtual double stress_moment() const { return 0.5; }
  virtual void step(Step<Dim>& step, double dt) const = 0;
};

template <int Dim>
std::unique_ptr<UpdateOrder<Dim>> make_update_order(UpdateOrderKind kind);

/// Modified update stress last: the stress sees the particles' new velocities, mapped back.
template <int Dim>
std::unique_ptr<UpdateOrder<Dim>> make_musl();
/// Update stress first: the stress sees the velocity before the forces.
template <int Dim>
std::unique_ptr<UpdateOrder<Dim>> make_usf();
/// Update stress last: the stress sees the velocity that the forces have changed.
template <int Dim>
std::unique_ptr<UpdateOrder<Dim>> make_usl();

}  // namespace mpm
