// A block of elastic-plastic particles pressed between two walls for 100 steps, with every shape
// function and both strain measures: prints what width_test.py compares. Compiled once per vector
// width, from the sources of the physics alone.
#include <mpm/conditions/rigid_wall.hpp>
#include <mpm/materials/hencky.hpp>
#include <mpm/materials/hypoelastic.hpp>
#include <mpm/shape/cpdi.hpp>
#include <mpm/shape/gimp.hpp>
#include <mpm/shape/linear.hpp>
#include <mpm/shape/quadratic.hpp>
#include <mpm/transfer/flip.hpp>
#include <mpm/transfer/kernel_transfer.hpp>

#include <cstdio>

#include "node_grid.hpp"

namespace mpm {
namespace {

constexpr IsotropicConstants wall_material{10.6e9, 0.33};  // Pa
constexpr YieldConstants yield{500e6, 1e9};
constexpr double density = 1500;  // kg/m^3
constexpr double h = 5e-6;        // m
constexpr double speed = 250;     // m/s: the block yields at the first blow
constexpr double dt = 0.4e-9;     // s, a quarter of what the wave needs for a cell
constexpr int steps = 100;        // the piston passes two cells
constexpr LocalIndex cells[] = {16, 10}, margin = 3;

Body<2> block(std::unique_ptr<Law<2>> law, const Transfer<2>& transfer)
{
  auto state = law->state_columns();
  ParticleStore particles(transfer.motion_columns(true), std::move(state),
                          {"velocity", "mass", "grid_velocity", "initial_volume", "plastic_work"});
  Body<2> body{"block", 0, density, std::move(law), std::move(particles)};
  // One particle short of full: the last block has lanes without a particle at every width.
  for (LocalIndex k = 0; k < 4 * cells[0] * cells[1] - 1; ++k) {
    const LocalIndex p = body.particles.add(k);
    ColumnGroup &motion = body.particles.motion(), &start = body.particles.state();
    motion(0, p) = (0.25 + 0.5 * (k % (2 * cells[0]))) * h;
    motion(1, p) = (0.25 + 0.5 * (k / (2 * cells[0]))) * h;
    set_domain_at_rest<2>(motion, p, Vec<2>::Constant(0.25 * h));
    motion(motion.find("mass"), p) = density * 0.25 * h * h;
    start(0, p) = 0.25 * h * h;
    body.law->initialise(start, p);
  }
  body.particles.seal();
  return body;
}

NodeGrid<2> grid_around(int support)
{
  const IndexVec<2> nodes(cells[0] + 2 * margin + 1, cells[1] + 2 * margin + 1);
  const IndexBox<2> all{IndexVec<2>::Zero(), nodes};
  NodeGrid<2> grid({Vec<2>::Constant(-margin * h), Vec<2>::Constant(h), nodes}, all, all,
                   1e-24 * density * h * h);
  for (LocalIndex node = 0; node < grid.topology.size(); ++node) grid.topology.touch(node);
  grid.end_activity(support);
  return grid;
}

struct Walls {
  RigidWall<2> piston{
      {0, true, cells[0] * h}, {-speed, 0}, WallGrip::stick, ReactionBook::increments};
  RigidWall<2> edge{{0, false, 0}, {}, WallGrip::stick, ReactionBook::increments};
};

void print(const char* name, const Body<2>& body, Walls& walls)
{
  const ParticleStore& particles = body.particles;
  alignas(lane_alignment) double stress[6 * lane_count];
  double kinetic = 0, elastic = 0, plastic = 0;
  const int work = particles.state().find("plastic_work");
  for (LocalIndex p = 0; p < particles.size(); ++p) {
    const int lane = p % lane_count;
    const double* state = particles.state().block(p / lane_count);
    body.law->cauchy_stress(state, stress);
    std::printf("%s particle %.17g %.17g", name, particles.motion()(0, p),
                particles.motion()(1, p));
    for (int c = 0; c < 4; ++c) std::printf(" %.17g", stress[c * lane_count + lane]);
    std::printf("\n");
    for (int d = 2; d < 4; ++d)
      kinetic +=
          0.5 * particles.motion()(4, p) * particles.motion()(d, p) * particles.motion()(d, p);
    elastic += body.law->elastic_energy(state)[lane];
    plastic += particles.state()(work, p);
  }
  std::printf("%s energies %.17g %.17g %.17g %.17g\n", name, kinetic, elastic, plastic,
              walls.piston.take_reaction().work);
}

/// MUSL with FLIP, as the stepper does it on one rank.
void press(const char* name, const Transfer<2>& transfer, std::unique_ptr<Law<2>> law)
{
  Body<2> body = block(std::move(law), transfer);
  NodeGrid<2> grid = grid_around(transfer.support());
  Walls walls;
  const Vec<2> far = Vec<2>::Constant(1);
  const MoveBounds<2> bounds{-far, far};
  transfer.prime(body, grid.topology, grid.fields, true);
  for (int step = 0; step < steps; ++step) {
    grid.fields.update_velocity(grid.topology.runs(), dt);
    walls.piston.constrain_updated(grid.topology, grid.fields, step * dt, dt);
    walls.edge.constrain_updated(grid.topology, grid.fields, step * dt, dt);
    grid.fields.reset_remap(grid.topology.runs());
    transfer.musl_velocity(body, grid.topology, grid.fields);
    grid.fields.gradient_from_remap(grid.topology.runs());
    walls.piston.constrain_gradient(grid.topology, grid.fields, step * dt, dt);
    walls.edge.constrain_gradient(grid.topology, grid.fields, step * dt, dt);
    grid.fields.reset(grid.topology.runs());
    transfer.musl_stress(body, grid.topology, grid.fields, dt, bounds);
  }
  print(name, body, walls);
}

template <class Shape>
void press_with()
{
  const KernelTransfer<2, Shape, Kernels<Flip>> transfer(TransferOptions{0.5});
  const std::string name(Shape::row.keyword);
  press((name + "-hencky").c_str(), transfer,
        make_hencky(PlaneAssumption::strain, wall_material, density, yield));
  press((name + "-hypoelastic").c_str(), transfer,
        make_hypoelastic_von_mises(PlaneAssumption::strain, wall_material, yield, density));
}

}  // namespace
}  // namespace mpm

int main()
{
  std::printf("width %d\n", mpm::lane_count);
  mpm::press_with<mpm::Linear>();
  mpm::press_with<mpm::Gimp>();
  mpm::press_with<mpm::Quadratic>();
  mpm::press_with<mpm::Cpdi>();
}
