#include <mpm/conditions/side_rows.hpp>

namespace mpm {

namespace {

template <int Dim>
std::unique_ptr<BoundaryCondition<Dim>> make(const SideSetting& side)
{
  return std::make_unique<RigidWall<Dim>>(side.placement, WallMotion{},
                                          side.beside_piston ? WallGrip::slip : WallGrip::stick,
                                          side.book);
}

}  // namespace

SideRow rigid_side()
{
  return {.keyword = "rigid",
          .help = "a wall to which particles stick; along a piston's travel they slide on it",
          .in_plane = make<2>,
          .in_space = make<3>};
}

}  // namespace mpm
