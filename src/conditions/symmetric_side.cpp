#include <mpm/conditions/side_rows.hpp>

namespace mpm {

namespace {

template <int Dim>
std::unique_ptr<BoundaryCondition<Dim>> make(const SideSetting& side)
{
  return std::make_unique<RigidWall<Dim>>(side.placement, WallMotion{}, WallGrip::slip, side.book);
}

}  // namespace

SideRow symmetric_side()
{
  return {.keyword = "symmetric",
          .help = "a plane of symmetry: nothing moves through it",
          .in_plane = make<2>,
          .in_space = make<3>};
}

}  // namespace mpm
