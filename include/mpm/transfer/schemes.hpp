#pragma once
/// The lists of transfer schemes and update orders. A new one is a header here and a line in
/// schemes.list or orders.list.

#include <mpm/core/one_of.hpp>
#include <mpm/shape/shapes.hpp>
#include <mpm/transfer/order.hpp>
#include <mpm/transfer/scheme.hpp>

namespace mpm {

template <>
std::span<const SchemeRow> list_of<SchemeRow>();

template <>
std::span<const UpdateOrderRow> list_of<UpdateOrderRow>();

/// Largest stable step in units of h / c; nothing where no step is stable.
std::optional<double> stable_cfl(const ShapeRow& shape, const SchemeRow& scheme,
                                 const UpdateOrderRow& order);

}  // namespace mpm
