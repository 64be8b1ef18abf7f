#pragma once
/// Bars of the plane, plates in space, with cells across their middle that fail, on any ranks.

#include <mpm/conditions/rigid_wall.hpp>
#include <mpm/lagrangian/total_lagrangian.hpp>
#include <mpm/materials/hencky.hpp>
#include <mpm/parallel/session.hpp>

#include "sums_of_bodies.hpp"

namespace mpm {

constexpr double edge = 0.5e-3, youngs_modulus = 1e9, density = 1000;  // edge of a cell, m

template <int Dim>
struct Scene {
  IndexVec<Dim> cells;            ///< of the bar, along x
  int weak = 2;                   ///< so many in the middle are of the body that fails
  FailureLimits limits{};         ///< of those
  double rate = 0;                ///< 1/s, at which it is stretched at the start
  double fly = 0;                 ///< m/s, of the whole bar along x
  double twist = 0;               ///< rad/s, of one end against the other about x
  std::optional<double> yield{};  ///< Pa, of the weak body
  double wall_speed = 0;          ///< m/s, of walls at both ends that come together
  double step = 0.1;              ///< over what the fastest wave needs through a cell
};

template <int Dim>
class Bar {
 public:
  Bar(MPI_Comm comm, const Scene<Dim>& scene) : comm_(comm), scene_(scene)
  {
    const Decomposition<Dim> decomposition = shared_out(comm, scene);
    typename TotalLagrangian<Dim>::Setup setup{.bodies = {},
                                               .location_size = Vec<Dim>::Constant(edge),
                                               .contact_stiffness = 2,
                                               .mass_scaling = 0};
    setup.failure = {FailureLimits{}, scene.limits};
    for (const bool weak : {false, true}) setup.bodies.push_back(body(weak, decomposition));
    if (scene.wall_speed > 0)
      for (const bool upper : {false, true})
        setup.slots.conditions.push_back(std::make_unique<RigidWall<Dim>>(
            WallPlacement{0, upper, (first() + (upper ? scene.cells[0] : 0)) * edge},
            WallMotion{upper ? -scene.wall_speed : scene.wall_speed, 0}, WallGrip::contact,
            ReactionBook{}));
    stepper_ = std::make_unique<TotalLagrangian<Dim>>(decomposition, std::move(setup));
  }

  TotalLagrangian<Dim>& stepper() { return *stepper_; }
  void advance(int steps)
  {
    const double wave = stepper_->bodies().front().law->wave_speed();
    for (int k = 0; k < steps; ++k) stepper_->step(scene_.step * edge / wave);
    stepper_->check();
  }
  /// By a step; takes the reactions of both. Velocities stand half a step before what is stored,
  /// and its energy here in the middle of both. Collective.
  SumsOfBodies<Dim> balanced()
  {
    const SumsOfBodies<Dim> last = found();
    advance(1);
    SumsOfBodies<Dim> now = found();
    now.energy -= 0.5 * (now.stored - last.stored);
    now.work += last.work;
    now.impulse += last.impulse;
    return now;
  }
  /// Collective.
  SumsOfBodies<Dim> found() { return {comm_, *stepper_, scene_.cells.prod()}; }

  GlobalIndex weak_cells() const { return scene_.weak * scene_.cells.prod() / scene_.cells[0]; }
  double mass() const { return scene_.cells.prod() * density * std::pow(edge, Dim); }
  /// m, of a cell's middle along an axis.
  double place(const SumsOfBodies<Dim>& found, const IndexVec<Dim>& cell, int axis) const
  {
    return found.places[std::size_t(Dim * number(cell) + axis)];
  }

 private:
  static constexpr LocalIndex first() { return 10; }  // location of the bar; so many around it
  static Decomposition<Dim> shared_out(MPI_Comm comm, const Scene<Dim>& scene)
  {
    const int ranks = ranks_of(comm);
    IndexVec<Dim> rows = IndexVec<Dim>::Ones();
    rows[0] = ranks % 2 == 0 ? ranks / 2 : ranks;
    rows[1] = ranks % 2 == 0 ? 2 : 1;
    const GridGeometry<Dim> geometry{Vec<Dim>::Zero(), Vec<Dim>::Constant(edge),
                                     (scene.cells.array() + 2 * first() + 1).matrix()};
    return {comm, geometry, rows, {}, {}};
  }
  LocalIndex number(const IndexVec<Dim>& cell) const
  {
    LocalIndex number = 0;
    for (int d = Dim - 1; d >= 0; --d) number = number * scene_.cells[d] + cell[d];
    return number;
  }

  Body<Dim> body(bool weak, const Decomposition<Dim>& decomposition) const
  {
    std::optional<YieldConstants> yield;
    if (weak && scene_.yield) yield = YieldConstants{*scene_.yield, 0};
    std::unique_ptr<Law<Dim>> law;
    if constexpr (Dim == 2)
      law = make_hencky(PlaneAssumption::strain, {youngs_modulus, 0.3}, density, yield);
    else
      law = make_hencky_solid({youngs_modulus, 0.3}, density, yield);
    ParticleStore store(LocationCells<Dim>::columns(*law), law->state_columns(),
                        {"velocity", "mass", "initial_volume", "plastic_work"});
    Body<Dim> body{weak ? "weak" : "strong", weak, density, std::move(law), std::move(store)};
    const double volume = std::pow(edge, Dim);
    for_each_index(
        IndexBox<Dim>{IndexVec<Dim>::Zero(), scene_.cells}, [&](const IndexVec<Dim>& in) {
          const LocalIndex from = (scene_.cells[0] - scene_.weak) / 2;
          if ((in[0] >= from && in[0] < from + scene_.weak) != weak) return;
          const IndexVec<Dim> at = in + IndexVec<Dim>::Constant(first());
          if (decomposition.owner_of_cell(at) != decomposition.rank()) return;
          const LocalIndex p = body.particles.add(number(in));
          ColumnGroup& motion = body.particles.motion();
          const Vec<Dim> from_middle = edge * (in.template cast<double>().array() + 0.5 -
                                               0.5 * scene_.cells.template cast<double>().array())
                                                  .matrix();
          Vec<Dim> velocity = Vec<Dim>::Zero();
          velocity[0] = scene_.fly + scene_.rate * from_middle[0];
          if constexpr (Dim == 3) {
            const double turning = scene_.twist * from_middle[0] / (edge * scene_.cells[0]);
            velocity[1] = -turning * from_middle[2];
            velocity[2] = turning * from_middle[1];
          }
          for (int d = 0; d < Dim; ++d) {
            motion(d, p) = (at[d] + 0.5) * edge;
            motion(Dim + d, p) = velocity[d];
          }
          motion(2 * Dim, p) = density * volume;
          LocationCells<Dim>::initialise(motion, p);
          body.particles.state()(0, p) = volume;
          body.law->initialise(body.particles.state(), p);
        });
    body.particles.seal();
    return body;
  }

  MPI_Comm comm_;
  Scene<Dim> scene_;
  std::unique_ptr<TotalLagrangian<Dim>> stepper_;
};

}  // namespace mpm
