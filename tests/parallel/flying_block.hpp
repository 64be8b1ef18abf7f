#pragma once
/// An elastic block on a grid of 1 mm cells, set up on any communicator: the same motion on any
/// number of ranks.

#include <mpm/conditions/rigid_wall.hpp>
#include <mpm/materials/hencky.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/stepping/updated_lagrangian.hpp>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mpm::testing_blocks {

inline constexpr double cell = 1e-3;           ///< m
inline constexpr double youngs_modulus = 1e9;  ///< Pa
inline constexpr double density = 1000;        ///< kg/m^3

struct Method {
  OneOf<ShapeRow> shape;
  OneOf<SchemeRow> scheme;
  OneOf<UpdateOrderRow> order;
};

/// As a test's name.
inline std::string name_of(const Method& m)
{
  return std::string(m.shape->keyword) + "_" + std::string(m.scheme->keyword) + "_" +
         std::string(m.order->keyword);
}

struct Block {
  IndexVec<2> first_cell, cells;  ///< of the grid
  Vec<2> velocity;                ///< m/s
  std::optional<YieldConstants> yield{};
  int field = 0;  ///< velocity field
};

/// Everything that all ranks hold of all particles, by id.
struct Gathered {
  std::vector<double> position, velocity, mass, largest_stress;
  std::vector<int> holders;  ///< ranks that hold the particle: 1
};

class BlockRun {
 public:
  using Conditions = std::vector<std::unique_ptr<BoundaryCondition<2>>>;
  using Contacts = std::vector<std::unique_ptr<Contact<2>>>;

  /// `ranks`: of the process grid; 0 lets the decomposition choose.
  BlockRun(MPI_Comm comm, const IndexVec<2>& ranks, const IndexVec<2>& grid_cells,
           const Method& method, const std::vector<Block>& blocks, Conditions conditions)
      : BlockRun(Decomposition<2>(comm, grid_of(grid_cells), ranks, {}, {}), method, blocks,
                 std::move(conditions))
  {
  }
  BlockRun(const Decomposition<2>& decomposition, const Method& method,
           const std::vector<Block>& blocks, Conditions conditions, Contacts contacts = {})
      : decomposition_(decomposition),
        stepper_(make_stepper(method, blocks, std::move(conditions), std::move(contacts)))
  {
  }

  static GridGeometry<2> grid_of(const IndexVec<2>& cells)
  {
    return {Vec<2>::Zero(), Vec<2>::Constant(cell), (cells.array() + 1).matrix()};
  }

  UpdatedLagrangian<2>& stepper() { return *stepper_; }

  /// Collective. At this share of the step in which a wave crosses a cell.
  void advance(int steps, double share, double speed)
  {
    const double wave_speed = stepper_->bodies().front().law->wave_speed();
    for (int k = 0; k < steps; ++k) stepper_->step(share * cell / (wave_speed + speed));
    stepper_->check();
  }

  /// Collective.
  Gathered gather() const
  {
    const std::size_t n = std::size_t(particles_);
    std::vector<double> values(7 * n, 0.0);
    alignas(lane_alignment) double stress[6 * lane_count];
    for (const Body<2>& body : stepper_->bodies())
      for (LocalIndex p = 0; p < body.particles.size(); ++p) {
        const std::size_t id = std::size_t(body.particles.ids()[p]);
        const ColumnGroup& motion = body.particles.motion();
        for (int c = 0; c < 5; ++c) values[c * n + id] += motion(c, p);
        body.law->cauchy_stress(body.particles.state().block(p / lane_count), stress);
        for (int c = 0; c < 6; ++c)
          values[5 * n + id] =
              std::max(values[5 * n + id], std::abs(stress[c * lane_count + p % lane_count]));
        values[6 * n + id] += 1;
      }
    sum_over_ranks(decomposition_.comm(), values);
    const auto part = [&](std::size_t from, std::size_t to) {
      return std::vector<double>(values.begin() + from * n, values.begin() + to * n);
    };
    return {part(0, 2), part(2, 4), part(4, 5), part(5, 6),
            std::vector<int>(values.begin() + 6 * n, values.end())};
  }

 private:
  std::unique_ptr<UpdatedLagrangian<2>> make_stepper(const Method& method,
                                                     const std::vector<Block>& blocks,
                                                     Conditions conditions, Contacts contacts)
  {
    auto transfer = make_transfer<2>(method.shape, method.scheme, {0.5});
    std::vector<Body<2>> bodies;
    for (const Block& block : blocks) {
      auto law = make_hencky(PlaneAssumption::strain, {youngs_modulus, 0.3}, density, block.yield);
      auto state = law->state_columns();
      bodies.push_back(
          {"block", int(bodies.size()), density, std::move(law),
           ParticleStore(transfer->motion_columns(method.order->remaps), std::move(state),
                         {"velocity", "mass", "affine_velocity", "grid_velocity", "initial_volume",
                          "plastic_work"})});
      bodies.back().field = block.field;
      fill(bodies.back(), block);
    }
    constexpr double volume = 0.25 * cell * cell;
    UpdatedLagrangian<2>::Setup setup{std::move(transfer), method.order, std::move(bodies)};
    setup.extras.refinements = method.scheme->refines ? 3 : 0;
    setup.extras.refine_before_forces = method.scheme->refines_before_forces;
    setup.slots.conditions = std::move(conditions);
    setup.slots.contacts = std::move(contacts);
    setup.mass_cut = 1e-12 * density * volume;
    return std::make_unique<UpdatedLagrangian<2>>(decomposition_, std::move(setup));
  }

  /// Two by two particles in each cell, 1 m thick.
  void fill(Body<2>& body, const Block& block)
  {
    for (LocalIndex j = 0; j < 2 * block.cells[1]; ++j)
      for (LocalIndex i = 0; i < 2 * block.cells[0]; ++i) {
        const GlobalIndex id = particles_++;
        const IndexVec<2> home = block.first_cell + IndexVec<2>(i / 2, j / 2);
        if (decomposition_.owner_of_cell(home) != decomposition_.rank()) continue;
        const LocalIndex p = body.particles.add(id);
        ColumnGroup& motion = body.particles.motion();
        const std::array<double, 5> values{(block.first_cell[0] + 0.5 * i + 0.25) * cell,
                                           (block.first_cell[1] + 0.5 * j + 0.25) * cell,
                                           block.velocity[0], block.velocity[1],
                                           density * 0.25 * cell * cell};
        for (int c = 0; c < 5; ++c) motion(c, p) = values[c];
        set_domain_at_rest<2>(motion, p, Vec<2>::Constant(0.25 * cell));
        body.particles.state()(0, p) = 0.25 * cell * cell;
        body.law->initialise(body.particles.state(), p);
      }
    body.particles.seal();
  }

  GlobalIndex particles_ = 0;
  Decomposition<2> decomposition_;
  std::unique_ptr<UpdatedLagrangian<2>> stepper_;
};

}  // namespace mpm::testing_blocks
