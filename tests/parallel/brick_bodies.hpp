#pragma once
/// Bodies of bricks in a total Lagrangian step, shared out among ranks.

#include <mpm/conditions/rigid_wall.hpp>
#include <mpm/lagrangian/total_lagrangian.hpp>
#include <mpm/materials/hencky.hpp>
#include <mpm/parallel/session.hpp>

#include <Eigen/Geometry>
#include <functional>

#include "sums_of_bodies.hpp"

namespace mpm {

constexpr double cell = 1e-3, youngs_modulus = 1e9, density = 1000;
inline const Vec<3> size = Vec<3>::Constant(0.5e-3);
inline const IndexVec<3> grid_cells(12, 10, 6);

/// Up to three in a row, and two along the depth, so that edges are crossed.
inline IndexVec<3> process_grid(MPI_Comm comm)
{
  const int ranks = ranks_of(comm);
  return ranks % 2 == 0 ? IndexVec<3>(ranks / 2, 1, 2) : IndexVec<3>(ranks, 1, 1);
}

inline Decomposition<3> shared_out(MPI_Comm comm, bool periodic)
{
  GridGeometry<3> geometry{Vec<3>::Zero(), Vec<3>::Constant(cell),
                           (grid_cells.array() + 1).matrix()};
  if (periodic) {
    geometry.nodes[2] = grid_cells[2];
    geometry.periodic[2] = true;
  }
  return {comm, geometry, process_grid(comm), {}, {}};
}

/// A tube along z with a wall of one location, and a plug in a part of it.
inline const IndexVec<3> tube(12, 10, 6);
inline bool is_wall(const IndexVec<3>& at)
{
  return at[0] == 0 || at[0] == tube[0] - 1 || at[1] == 0 || at[1] == tube[1] - 1 ||
         (at[2] == 2 && at[0] < 5);
}

struct Scene {
  std::function<bool(const IndexVec<3>&)> is_taken = is_wall;  ///< within `tube`
  int first_z = 3;                                             ///< location
  Vec<3> velocity = Vec<3>::Zero();
  Vec<3> turning = Vec<3>::Zero();  ///< rad/s about its middle
  /// m/s, of what lies above and minus that of what lies below the middle plane across z.
  double apart = 0;
  std::optional<YieldConstants> yield{};
  bool pressed = false;  ///< between two walls that come together
  bool periodic = false;
};

constexpr double wall_speed = 15;

/// A body of bricks, or several of one law.
class Bricks {
 public:
  Bricks(MPI_Comm comm, const Scene& scene) : comm_(comm)
  {
    const Decomposition<3> decomposition = shared_out(comm, scene.periodic);
    TotalLagrangian<3>::Setup setup{
        .bodies = {}, .location_size = size, .contact_stiffness = 2, .mass_scaling = 0.3};
    auto law = make_hencky_solid({youngs_modulus, 0.3}, density, scene.yield);
    ParticleStore store(LocationCells<3>::columns(*law), law->state_columns(),
                        {"velocity", "mass", "initial_volume", "plastic_work"});
    setup.bodies.push_back({"tube", 0, density, std::move(law), std::move(store)});
    Body<3>& body = setup.bodies.back();
    const IndexVec<3> first(6, 5, scene.first_z);
    GlobalIndex id = 0;
    for_each_index(IndexBox<3>{IndexVec<3>::Zero(), tube}, [&](const IndexVec<3>& in_tube) {
      if (!scene.is_taken(in_tube)) return;
      const GlobalIndex number = id++;
      IndexVec<3> at = first + in_tube;
      at[2] %= 2 * grid_cells[2];
      if (decomposition.owner_of_cell((at.array() / 2).matrix()) != decomposition.rank()) return;
      const LocalIndex p = body.particles.add(number);
      ColumnGroup& motion = body.particles.motion();
      const Vec<3> from_middle =
          (in_tube.cast<double>().array() + 0.5 - 0.5 * tube.cast<double>().array()).matrix() *
          size[0];
      const Vec<3> place = (at.cast<double>().array() + 0.5).matrix() * size[0],
                   velocity = scene.velocity + scene.turning.cross(from_middle) +
                              (from_middle[2] > 0 ? 1 : -1) * scene.apart * Vec<3>::UnitZ();
      for (int d = 0; d < 3; ++d) {
        motion(d, p) = place[d];
        motion(3 + d, p) = velocity[d];
      }
      motion(6, p) = density * size.prod();
      LocationCells<3>::initialise(motion, p);
      body.particles.state()(0, p) = size.prod();
      body.law->initialise(body.particles.state(), p);
    });
    body.particles.seal();
    cells_ = id;
    if (scene.pressed)
      for (const bool upper : {false, true}) {
        const double face = (first[0] + (upper ? tube[0] : 0)) * size[0];
        setup.slots.conditions.push_back(std::make_unique<RigidWall<3>>(
            WallPlacement{0, upper, face}, WallMotion{upper ? -wall_speed : wall_speed, 0},
            WallGrip::contact, ReactionBook{}));
      }
    stepper_ = std::make_unique<TotalLagrangian<3>>(decomposition, std::move(setup));
  }

  TotalLagrangian<3>& stepper() { return *stepper_; }
  void advance(int steps)
  {
    const double wave = stepper_->bodies().front().law->wave_speed();
    for (int k = 0; k < steps; ++k) stepper_->step(0.2 * size[0] / wave);
    stepper_->check();
  }

  using Found = SumsOfBodies<3>;
  /// Collective.
  Found found() { return {comm_, *stepper_, cells_}; }
  double mass() const { return double(cells_) * density * size.prod(); }

 private:
  MPI_Comm comm_;
  GlobalIndex cells_ = 0;
  std::unique_ptr<TotalLagrangian<3>> stepper_;
};

}  // namespace mpm
