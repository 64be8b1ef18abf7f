#pragma once
#include <mpm/stepping/step.hpp>
#include <mpm/transfer/schemes.hpp>

namespace mpm {

/// A whole step in one of the update orders.
template <int Dim>
using StepFunction = void (*)(Step<Dim>& step, double dt);

template <int Dim>
StepFunction<Dim> step_function(OneOf<UpdateOrderRow> order);

}  // namespace mpm
