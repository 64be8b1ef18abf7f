#pragma once
/// How the work on a specimen is shared out: equal slabs along the last axis, one per part.

#include <mpm/core/index_box.hpp>

#include <functional>
#include <span>

namespace mpm::micrograph {

/// One of so many parts that raster a specimen together.
struct Share {
  int part = 0, parts = 1;
  /// Replaces each value by its sum over all parts. Collective: all parts call it in the same order
  /// with as many values.
  std::function<void(std::span<double>)> sum = [](std::span<double>) {};
};

/// The slab of a box that a part counts.
template <int Dim>
IndexBox<Dim> slab(IndexBox<Dim> box, int part, int parts)
{
  const LocalIndex first = box.lower[Dim - 1];
  const GlobalIndex layers = box.count()[Dim - 1];
  box.lower[Dim - 1] = first + LocalIndex(layers * part / parts);
  box.upper[Dim - 1] = first + LocalIndex(layers * (part + 1) / parts);
  return box;
}

/// Visits a box in pieces of at most `most` indices, in the order of their numbers.
template <int Dim, class Visit>
void for_each_chunk(const IndexBox<Dim>& box, GlobalIndex most, Visit visit)
{
  if (box.empty()) return;
  int axis = Dim - 1;
  while (axis > 0 && box.count()[axis] == 1) --axis;
  if (box.size() <= most || box.count()[axis] == 1) {
    visit(box);
    return;
  }
  IndexBox<Dim> lower = box, upper = box;
  lower.upper[axis] = upper.lower[axis] = box.lower[axis] + box.count()[axis] / 2;
  for_each_chunk(lower, most, visit);
  for_each_chunk(upper, most, visit);
}

}  // namespace mpm::micrograph
