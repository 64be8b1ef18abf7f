#pragma once
/// What a step does, without doing it: its passes over the particles and what each sums at shared
/// nodes. For the plan of a run.

#include <mpm/stepping/step.hpp>
#include <mpm/transfer/schemes.hpp>

#include <string>
#include <vector>

namespace mpm {

struct PassOutline {
  std::string name;               ///< as in Transfer
  std::vector<std::string> sums;  ///< of the nodes, over the ranks that share them
  int values_per_node = 0;        ///< of all sums together
  bool operator==(const PassOutline&) const = default;
};

/// In their order. The update order itself is asked: it is run with a step that only takes notes.
/// `load_force`: whether loads act on particles; `surface`: whether contact asks for surfaces.
template <int Dim>
std::vector<PassOutline> outline_step(OneOf<UpdateOrderRow> order, const StepExtras& extras,
                                      bool load_force, bool surface);

}  // namespace mpm
