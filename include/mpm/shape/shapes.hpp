#pragma once
/// The list of shape functions. A new one is a header here and a line in shapes.list.

#include <mpm/core/one_of.hpp>
#include <mpm/shape/shape_row.hpp>

namespace mpm {

template <>
std::span<const ShapeRow> list_of<ShapeRow>();

}  // namespace mpm
