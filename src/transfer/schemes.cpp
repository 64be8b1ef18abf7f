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
  static constexpr UpdateOrderRow rows[] = {
      {.kind = UpdateOrderKind::musl,
       .keyword = "musl",
       .help = "stress after the forces, from re-mapped velocities",
       .words = "MUSL",
       .stable_cfl = nullptr},
      {.kind = UpdateOrderKind::usf,
       .keyword = "usf",
       .help = "stress before the forces",
       .words = "USF",
       .stable_cfl = nullptr},
      {.kind = UpdateOrderKind::usl,
       .keyword = "usl",
       .help = "stress after the forces, from the velocities that they changed",
       .words = "USL",
       .stable_cfl = &StableCfl::stress_last}};
  return rows;
}

std::optional<double> stable_cfl(const ShapeRow& shape, const SchemeRow& scheme,
                                 const UpdateOrderRow& order)
{
  return shape.stable_cfl.*(order.stable_cfl ? order.stable_cfl : scheme.stable_cfl);
}

}  // namespace mpm
