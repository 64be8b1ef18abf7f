#include <mpm/core/error.hpp>
#include <mpm/simulation/model.hpp>

#include "placement.hpp"

namespace mpm {

double default_cfl(const scene::Numerics& numerics)
{
  if (numerics.cfl) return *numerics.cfl;
  // Half of the measured limits or less; without re-mapping the limit at free edges is lower.
  if (numerics.update_order == scene::UpdateOrder::usl) return 0.4;
  return numerics.shape_function == scene::ShapeFunction::quadratic ? 1.0 : 0.6;
}

UpdateOrderKind update_order_of(const scene::Scene& scene)
{
  switch (scene.numerics.update_order) {
    case scene::UpdateOrder::musl:
      return UpdateOrderKind::musl;
    case scene::UpdateOrder::usf:
      return UpdateOrderKind::usf;
    case scene::UpdateOrder::usl:
      return UpdateOrderKind::usl;
  }
  throw InputError("unknown update order");
}

std::unique_ptr<Transfer<2>> make_transfer(const scene::Numerics& numerics, int particles_per_cell)
{
  const auto shape = [&] {
    switch (numerics.shape_function) {
      case scene::ShapeFunction::linear:
        return ShapeKind::linear;
      case scene::ShapeFunction::gimp:
        return ShapeKind::gimp;
      case scene::ShapeFunction::quadratic:
        return ShapeKind::quadratic;
    }
    throw InputError("unknown shape function");
  };
  const auto scheme = [&] {
    switch (numerics.scheme) {
      case scene::TransferScheme::flip:
        return SchemeKind::flip;
      case scene::TransferScheme::pic:
        return SchemeKind::pic;
      case scene::TransferScheme::apic:
        return SchemeKind::apic;
      case scene::TransferScheme::tpic:
        return SchemeKind::tpic;
    }
    throw InputError("unknown transfer scheme");
  };
  return make_transfer<2>(shape(), scheme(), particles_per_cell);
}

Decomposition<2> make_decomposition(MPI_Comm comm, const scene::Scene& scene, const Layout& layout)
{
  std::optional<int> keep_whole;
  if (const auto* loading = std::get_if<scene::Loading>(&scene.motion))
    keep_whole = axis_of(loading->piston);
  return {comm, layout.geometry, IndexVec<2>(scene.numerics.ranks[0], scene.numerics.ranks[1]),
          layout.layer_weights, keep_whole};
}

}  // namespace mpm
