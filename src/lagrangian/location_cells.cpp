#include <mpm/lagrangian/location_cells.hpp>

#include <algorithm>
#include <cmath>

namespace mpm {

namespace {

constexpr int corners_of_cell = LocationMesh<2>::corners;

Lanes column(const double* block, int index)
{
  return load(block + index * lane_count);
}

}  // namespace

LocationCells::LocationCells(const Body<2>& body, std::span<const CellNodes> nodes,
                             const Vec<2>& size)
    : frame_(size),
      deformation_(body.particles.motion().find("deformation")),
      plastic_bending_(body.particles.motion().find("plastic_bending")),
      corner_modulus_(4 * body.density * body.law->wave_speed() * body.law->wave_speed())
{
  const Vec<2> modulus = body.law->bending_modulus();
  for (int axis = 0; axis < 2; ++axis) {
    const double thickness = size[1 - axis];
    fibre_stress_[axis] = modulus[axis] * thickness / 3;
    bending_[axis] = modulus[axis] * thickness * thickness / 12;
  }
  const LocalIndex cells = body.particles.size();
  corner_nodes_.resize(std::size_t(body.particles.blocks()) * corners_of_cell * lane_count);
  std::size_t at = 0;
  for (LocalIndex b = 0; b < body.particles.blocks(); ++b)
    for (int c = 0; c < corners_of_cell; ++c)
      for (int lane = 0; lane < lane_count; ++lane)
        corner_nodes_[at++] =
            nodes[std::size_t(std::min(b * lane_count + lane, cells - 1))][std::size_t(c)];
}

std::vector<Column> LocationCells::columns(const Law<2>& law)
{
  std::vector<Column> list{
      {"position", 2, "m"}, {"velocity", 2, "m/s"}, {"mass", 1, "kg"}, {"deformation", 4, "1"}};
  for (const Column& state : law.state_columns())
    if (state.name == "plastic_strain") list.push_back({"plastic_bending", 2, "1/m"});
  return list;
}

void LocationCells::initialise(ColumnGroup& motion, LocalIndex cell)
{
  const int deformation = motion.find("deformation");
  if (deformation < 0) return;
  motion(deformation, cell) = motion(deformation + 3, cell) = 1;
}

[[gnu::always_inline]] inline CellCorners LocationCells::corners(const MeshNodes<2>& nodes,
                                                                 LocalIndex block) const
{
  alignas(lane_alignment) double x[corners_of_cell * lane_count], y[corners_of_cell * lane_count];
  const LocalIndex* node = &corner_nodes_[std::size_t(block) * corners_of_cell * lane_count];
  const double *along_x = nodes.along(0), *along_y = nodes.along(1);
  for (int k = 0; k < corners_of_cell * lane_count; ++k) {
    x[k] = along_x[node[k]];
    y[k] = along_y[node[k]];
  }
  CellCorners at;
  for (int c = 0; c < corners_of_cell; ++c) {
    at.x[c] = column(x, c);
    at.y[c] = column(y, c);
  }
  return at;
}

/// Blocks that one call of the law takes, and what it takes of them.
struct LocationCells::Chunk {
  static constexpr int blocks = 16;
  alignas(lane_alignment) double gradient[blocks * 4 * lane_count];
  alignas(lane_alignment) double stress[blocks * 3 * lane_count];
  alignas(lane_alignment) double bending[blocks * 2 * lane_count];  ///< as Law::update_bent has it
  alignas(lane_alignment) double bent[blocks * 2 * lane_count];     ///< 1/m, of the cells
  bool narrow[blocks];                                              ///< whether a corner is held
};

/// Deformation, its rate and bending of one block. Returns J.
[[gnu::flatten]] Lanes LocationCells::deform(ParticleStore& cells, LocalIndex block,
                                             const MeshNodes<2>& nodes, double rate, Chunk& chunk,
                                             int k) const
{
  double* motion = cells.motion().block(block);
  const Lanes volume = load(cells.state().block(block));
  const CellDeformation now(corners(nodes, block), frame_);
  // L = (F F_old^-1 - I) / dt
  double* f = motion + deformation_ * lane_count;
  const Lanes old[4] = {column(f, 0), column(f, 1), column(f, 2), column(f, 3)};
  const Lanes per_step = rate / (old[0] * old[3] - old[1] * old[2]);
  double* l = chunk.gradient + k * 4 * lane_count;
  for (int i = 0; i < 2; ++i) {
    const Lanes dx = (now.f[i] - old[i]) * per_step, dy = (now.f[i + 2] - old[i + 2]) * per_step;
    store(dx * old[3] - dy * old[1], l + i * lane_count);
    store(dy * old[0] - dx * old[2], l + (i + 2) * lane_count);
  }
  for (int j = 0; j < 4; ++j) store(now.f[j], f + j * lane_count);
  Lanes squared = 0.0, energy = 0.0;
  for (int j = 0; j < 2; ++j) {
    store(now.bending[j], chunk.bent + (2 * k + j) * lane_count);
    Lanes elastic = now.bending[j];
    if (plastic_bending_ >= 0) elastic -= column(motion, plastic_bending_ + j);
    squared += (fibre_stress_[j] * elastic) * (fibre_stress_[j] * elastic);
    energy += 0.5 * bending_[j] * elastic * elastic;
  }
  store(squared, chunk.bending + 2 * k * lane_count);
  store(volume * energy, chunk.bending + (2 * k + 1) * lane_count);
  chunk.narrow[k] = stdx::any_of(now.narrowest_corner(frame_) < least_corner);
  return now.jacobian();
}

/// Forces of one block on its corners, once the law has spoken.
[[gnu::flatten]] void LocationCells::push(ParticleStore& cells, LocalIndex block,
                                          const MeshNodes<2>& nodes, const Chunk& chunk, int k,
                                          double* out) const
{
  double* motion = cells.motion().block(block);
  const Lanes volume = load(cells.state().block(block));
  const Lanes scale = load(chunk.bending + 2 * k * lane_count);
  CellDeformation now;
  for (int j = 0; j < 4; ++j) now.f[j] = column(motion, deformation_ + j);
  Lanes moment[2];
  for (int j = 0; j < 2; ++j) {
    now.bending[j] = load(chunk.bent + (2 * k + j) * lane_count);
    Lanes elastic = now.bending[j];
    if (plastic_bending_ >= 0) {
      double* plastic = motion + (plastic_bending_ + j) * lane_count;
      const Lanes before = load(plastic);
      elastic = scale * (elastic - before);
      store(select(scale < 1.0, now.bending[j] - elastic, before), plastic);
    }
    moment[j] = bending_[j] * volume * elastic;
  }
  const double* t = chunk.stress + k * 3 * lane_count;
  const Lanes tau[3] = {column(t, 0), column(t, 1), column(t, 2)};
  CellCorners force = corner_forces(now, tau, moment, frame_);
  if (chunk.narrow[k]) [[unlikely]]
    add_corner_forces(corners(nodes, block), corner_modulus_ * volume, frame_, force);
  for (int c = 0; c < corners_of_cell; ++c) {
    store(force.x[c], out + 2 * c * lane_count);
    store(force.y[c], out + (2 * c + 1) * lane_count);
  }
}

std::optional<LocationCells::Inverted> LocationCells::update(Body<2>& body,
                                                             const MeshNodes<2>& nodes, double dt,
                                                             double* forces) const
{
  Chunk chunk;
  std::optional<Inverted> inverted;
  ParticleStore& cells = body.particles;
  for (LocalIndex first = 0; first < cells.blocks(); first += Chunk::blocks) {
    const int count = std::min<LocalIndex>(Chunk::blocks, cells.blocks() - first);
    for (int k = 0; k < count; ++k) {
      const Lanes jacobian = deform(cells, first + k, nodes, 1 / dt, chunk, k);
      if (inverted || stdx::all_of(jacobian > 0.0)) [[likely]]
        continue;
      for (int lane = lane_count; lane-- > 0;)
        if (const LocalIndex cell = (first + k) * lane_count + lane;
            !(jacobian[lane] > 0) && cell < cells.size())
          inverted = {cell, jacobian[lane]};
    }
    body.law->update_bent(cells.state().block(first), count, chunk.gradient, dt, chunk.stress,
                          chunk.bending);
    for (int k = 0; k < count; ++k)
      push(cells, first + k, nodes, chunk, k, forces + std::size_t(first + k) * block_values);
  }
  return inverted;
}

double LocationCells::bending_energy(const Body<2>& body, const MeshNodes<2>& nodes) const
{
  Lanes sum = 0.0;
  for (LocalIndex b = 0; b < body.particles.blocks(); ++b) {
    const Lanes volume = load(body.particles.state().block(b));
    const CellCorners at = corners(nodes, b);
    const CellDeformation now(at, frame_);
    for (int j = 0; j < 2; ++j) {
      Lanes elastic = now.bending[j];
      if (plastic_bending_ >= 0)
        elastic -= column(body.particles.motion().block(b), plastic_bending_ + j);
      sum += 0.5 * bending_[j] * volume * elastic * elastic;
    }
    sum += corner_energy(at, corner_modulus_ * volume, frame_);
  }
  return stdx::reduce(sum);
}

void LocationCells::fill_motion(Body<2>& body, const MeshNodes<2>& nodes,
                                const NodeFields<2>& fields) const
{
  ColumnGroup& motion = body.particles.motion();
  const int position = motion.find("position"), velocity = motion.find("velocity");
  const std::size_t width = NodeFields<2>::record_width;
  for (LocalIndex p = 0; p < body.particles.size(); ++p) {
    const LocalIndex* node =
        &corner_nodes_[std::size_t(p / lane_count) * corners_of_cell * lane_count + p % lane_count];
    for (int d = 0; d < 2; ++d) {
      double place = 0, speed = 0;
      for (int c = 0; c < corners_of_cell; ++c) {
        place += nodes.along(d)[node[c * lane_count]];
        speed += fields.updated[std::size_t(node[c * lane_count]) * width + std::size_t(d)];
      }
      motion(position + d, p) = place / corners_of_cell;
      motion(velocity + d, p) = speed / corners_of_cell;
    }
  }
}

Lanes LocationCells::least_stretch_squared(const MeshNodes<2>& nodes, LocalIndex block) const
{
  const CellDeformation now(corners(nodes, block), frame_);
  const auto& f = now.f;
  const Lanes a = f[0] * f[0] + f[1] * f[1], b = f[2] * f[2] + f[3] * f[3],
              c = f[0] * f[2] + f[1] * f[3];
  const Lanes half = 0.5 * (a - b);
  const Lanes jacobian = now.jacobian();
  // J^2 over the square of the larger one: the difference of the two would lose digits.
  const Lanes middle = jacobian * jacobian / (0.5 * (a + b) + stdx::sqrt(half * half + c * c));
  const Lanes corner = now.narrowest_corner(frame_) / jacobian;
  return middle * corner * stdx::abs(corner);
}

double LocationCells::wave_speed_at_rest(const Body<2>& body, const MeshNodes<2>& nodes,
                                         double floor) const
{
  const double undeformed = body.law->wave_speed();
  Lanes fastest = undeformed * undeformed;
  for (LocalIndex b = 0; b < body.particles.blocks(); ++b) {
    const double* state = body.particles.state().block(b);
    const Lanes least = stdx::max(least_stretch_squared(nodes, b), Lanes(floor * floor));
    Lanes here = body.law->fastest_wave_squared(state) / stdx::min(least, Lanes(1.0));
    stdx::where(load(state) == 0.0, here) = 0.0;  // padding
    fastest = stdx::max(fastest, here);
  }
  return std::sqrt(stdx::hmax(fastest));
}

}  // namespace mpm
