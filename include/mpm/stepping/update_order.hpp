#pragma once
#include <mpm/stepping/step.hpp>
#include <mpm/transfer/schemes.hpp>

namespace mpm {

/// A whole step in one of the update orders.
template <int Dim>
using StepFunction = void (*)(Step<Dim>& step, double dt);

template <int Dim>
StepFunction<Dim> step_function(OneOf<UpdateOrderRow> order);

/// What the nodes carry for it. `surface`: whether contact asks for surfaces.
template <int Dim>
typename NodeFields<Dim>::Needs node_needs(const UpdateOrderRow& order, const StepExtras& extras,
                                           const Loads<Dim>& loads, bool surface)
{
  return {
      .remap = order.remaps || extras.remap(), .load_force = !loads.empty(), .surface = surface};
}

}  // namespace mpm
