#pragma once
#include <mpm/stepping/step.hpp>
#include <mpm/transfer/schemes.hpp>

namespace mpm {

/// A whole step in one of the update orders.
template <int Dim>
using StepFunction = void (*)(Step<Dim>& step, double dt);

template <int Dim>
StepFunction<Dim> step_function(OneOf<UpdateOrderRow> order);

/// What the nodes carry for it, with so many refinements of the updated velocity.
template <int Dim>
typename NodeFields<Dim>::Needs node_needs(const UpdateOrderRow& order, int refinements,
                                           const Loads<Dim>& loads)
{
  return {.remap = order.remaps || refinements > 0, .load_force = !loads.empty()};
}

}  // namespace mpm
