#include <mpm/transfer/order_types.hpp>
#include <mpm/transfer/scheme_types.hpp>
#include <mpm/transfer/schemes.hpp>

namespace mpm {

template <>
std::span<const SchemeRow> list_of<SchemeRow>()
{
  return rows_of<SchemeRow>(SchemeTypes{});
}

template <>
std::span<const UpdateOrderRow> list_of<UpdateOrderRow>()
{
  return rows_of<UpdateOrderRow>(OrderTypes{});
}

std::optional<double> stable_cfl(const ShapeRow& shape, const SchemeRow& scheme,
                                 const UpdateOrderRow& order)
{
  if (order.stable_cfl && scheme.refines) return std::nullopt;
  return shape.stable_cfl.*(order.stable_cfl ? order.stable_cfl : scheme.stable_cfl);
}

}  // namespace mpm
