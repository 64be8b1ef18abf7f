#include <mpm/core/error.hpp>
#include <mpm/core/transpose.hpp>
#include <mpm/lagrangian/location_cells.hpp>

#include <algorithm>
#include <cmath>

namespace mpm {

namespace {

template <int Dim>
constexpr int stress_columns = symmetric_components<Dim>;

/// What the edges of the narrowest corner span over what they would without bending.
[[gnu::always_inline]] inline Lanes bent_share(const CellDeformation<2>& now, const CellCorners<2>&,
                                               const CellFrame<2>& frame)
{
  return now.narrowest_corner(frame) / now.jacobian();
}
inline Lanes bent_share(const CellDeformation<3>& now, const CellCorners<3>& at,
                        const CellFrame<3>& frame)
{
  return stdx::min(narrowest_share(at, frame) / now.jacobian(), Lanes(1.0));
}

}  // namespace

template <int Dim>
LocationCells<Dim>::LocationCells(const Body<Dim>& body, std::span<const CellNodes> nodes,
                                  const Vec<Dim>& size)
    : frame_(size),
      bending_(body.law->bending_moduli(), size),
      deformation_(body.particles.motion().find("deformation")),
      rest_bending_(body.particles.motion().find("rest_bending")),
      corner_modulus_(4 * body.density * body.law->wave_speed() * body.law->wave_speed()),
      least_corners_(std::size_t(body.particles.blocks()) * lane_count, least_corner),
      rest_shares_(std::size_t(body.particles.blocks()) * lane_count, 1.0)
{
  const LocalIndex cells = body.particles.size();
  corner_nodes_.resize(std::size_t(body.particles.blocks()) * corners_of_cell * lane_count);
  std::size_t at = 0;
  for (LocalIndex b = 0; b < body.particles.blocks(); ++b)
    for (int c = 0; c < corners_of_cell; ++c)
      for (int lane = 0; lane < lane_count; ++lane)
        corner_nodes_[at++] =
            nodes[std::size_t(std::min(b * lane_count + lane, cells - 1))][std::size_t(c)];
}

template <int Dim>
std::vector<Column> LocationCells<Dim>::columns(const Law<Dim>& law, bool fitted)
{
  std::vector<Column> list{{"position", Dim, "m"},
                           {"velocity", Dim, "m/s"},
                           {"mass", 1, "kg"},
                           {"deformation", Dim * Dim, "1"}};
  const std::vector<Column> state = law.state_columns();
  if (fitted || std::ranges::find(state, "plastic_strain", &Column::name) != state.end())
    list.push_back(CellBending<Dim>::rest_column());
  return list;
}

template <int Dim>
void LocationCells<Dim>::initialise(ColumnGroup& motion, LocalIndex cell)
{
  const int deformation = motion.find("deformation");
  if (deformation < 0) return;
  for (int d = 0; d < Dim; ++d) motion(deformation + (Dim + 1) * d, cell) = 1;
}

template <>
void LocationCells<2>::take_rest(Body<2>& body, const MeshNodes<2>& nodes, double thickness)
{
  ParticleStore& cells = body.particles;
  ColumnGroup& motion = cells.motion();
  const int position = motion.find("position"), mass = motion.find("mass"),
            initial_position = motion.find("initial_position");
  for (LocalIndex p = 0; p < cells.size(); ++p) {
    const int lane = p % lane_count;
    const CellCorners<2> at = corners(nodes, p / lane_count);
    const CellDeformation<2> rest(at, frame_);
    for (int k = 0; k < 4; ++k) motion(deformation_ + k, p) = rest.f[k][lane];
    for (int j = 0; j < 2; ++j) motion(rest_bending_ + j, p) = rest.bending[j][lane];
    const double location = thickness / frame_.inverse_area;
    cells.state()(0, p) = location * rest.jacobian()[lane];
    motion(mass, p) = body.density * cells.state()(0, p);
    const double narrowest = rest.narrowest_corner(frame_)[lane];
    least_corners_[std::size_t(p)] = least_corner * narrowest;
    rest_shares_[std::size_t(p)] = narrowest / rest.jacobian()[lane];
    for (int d = 0; d < 2; ++d) {
      const Lanes(&x)[corners_of_cell] = at.along[d];
      motion(position + d, p) = 0.25 * ((x[0][lane] + x[1][lane]) + (x[2][lane] + x[3][lane]));
      if (initial_position >= 0) motion(initial_position + d, p) = motion(position + d, p);
    }
  }
  cells.seal();
}

template <>
void LocationCells<3>::take_rest(Body<3>&, const MeshNodes<3>&, double)
{
  throw InputError("cells are fitted to surfaces in the plane only");
}

template <int Dim>
[[gnu::always_inline]] inline CellCorners<Dim> LocationCells<Dim>::corners(
    const MeshNodes<Dim>& nodes, LocalIndex block) const
{
  const LocalIndex* node = &corner_nodes_[std::size_t(block) * corners_of_cell * lane_count];
  CellCorners<Dim> at;
  for (int c = 0; c < corners_of_cell; ++c, node += lane_count) {
    Lanes columns[MeshNodes<Dim>::place_width];
    to_columns([&](int lane) { return nodes.place_of(node[lane]); }, columns);
    for (int d = 0; d < Dim; ++d) at.along[d][c] = columns[d];
  }
  return at;
}

/// Blocks that one call of the law takes, and what it takes of them.
template <int Dim>
struct LocationCells<Dim>::Chunk {
  static constexpr int blocks = Dim == 2 ? 16 : 8;
  alignas(lane_alignment) double gradient[blocks * Dim * Dim * lane_count];
  alignas(lane_alignment) double stress[blocks * stress_columns<Dim> * lane_count];
  /// As Law::update_bent has it.
  alignas(lane_alignment) double bending[blocks * bending_columns<Dim> * lane_count];
  /// Of the cells' deformation.
  alignas(lane_alignment) double kept[blocks * CellDeformation<Dim>::kept * lane_count];
  bool narrow[blocks];  ///< whether a corner is held

  double* gradient_of(int k) { return gradient + k * Dim * Dim * lane_count; }
  const double* stress_of(int k) const { return stress + k * stress_columns<Dim> * lane_count; }
  double* bending_of(int k) { return bending + k * bending_columns<Dim> * lane_count; }
  const double* bending_of(int k) const { return bending + k * bending_columns<Dim> * lane_count; }
  double* kept_of(int k) { return kept + k * CellDeformation<Dim>::kept * lane_count; }
  const double* kept_of(int k) const { return kept + k * CellDeformation<Dim>::kept * lane_count; }
};

/// Deformation, its rate and bending of one block. Returns J.
template <int Dim>
[[gnu::flatten]] Lanes LocationCells<Dim>::deform(ParticleStore& cells, LocalIndex block,
                                                  const MeshNodes<Dim>& nodes, double rate,
                                                  Chunk& chunk, int k) const
{
  double* motion = cells.motion().block(block);
  const CellDeformation<Dim> now(corners(nodes, block), frame_);
  double* f = motion + deformation_ * lane_count;
  now.put_gradient(f, rate, chunk.gradient_of(k));
  for (int j = 0; j < Dim * Dim; ++j) store(now.f[j], f + j * lane_count);
  now.keep(chunk.kept_of(k));
  bending_.put_trial(now, rest_of(motion), chunk.bending_of(k));
  chunk.narrow[k] =
      stdx::any_of(now.narrowest_corner(frame_) < column(least_corners_.data(), block));
  return now.jacobian();
}

template <int Dim>
[[gnu::always_inline]] inline void LocationCells<Dim>::put_forces(const CellCorners<Dim>& force,
                                                                  LocalIndex block,
                                                                  Forces forces) const
{
  if constexpr (Dim == 2) {
    for (int c = 0; c < corners_of_cell; ++c)
      to_rows(force.along[0][c], force.along[1][c], forces + force_at(block * lane_count, c));
  } else {
    using Row = Record<4>;
    alignas(lane_alignment) double rows[lane_count * 4];
    const LocalIndex* node = &corner_nodes_[std::size_t(block) * corners_of_cell * lane_count];
    for (int c = 0; c < corners_of_cell; ++c, node += lane_count) {
      // The fourth value is added to the mass, which stands behind the force.
      to_rows(force.along[0][c], force.along[1][c], force.along[2][c], Lanes(0.0), rows, 4);
      for (int lane = 0; lane < lane_count; ++lane) {
        double* sum = forces->force_of(node[lane]);
        const Row with =
            Row(sum, stdx::element_aligned) + Row(rows + 4 * lane, stdx::vector_aligned);
        with.copy_to(sum, stdx::element_aligned);
      }
    }
  }
}

/// Forces of one block on its corners, once the law has spoken.
template <int Dim>
[[gnu::flatten]] void LocationCells<Dim>::push(ParticleStore& cells, LocalIndex block,
                                               const MeshNodes<Dim>& nodes, const Chunk& chunk,
                                               int k, Forces forces) const
{
  double* motion = cells.motion().block(block);
  const Lanes volume = load(cells.state().block(block));
  const CellDeformation<Dim> now(motion + deformation_ * lane_count, chunk.kept_of(k));
  Lanes moment[CellBending<Dim>::modes];
  bending_.moments(now.bending, chunk.bending_of(k), volume, rest_of(motion), moment);
  Lanes tau[stress_columns<Dim>];
  for (int j = 0; j < stress_columns<Dim>; ++j) tau[j] = column(chunk.stress_of(k), j);
  CellCorners<Dim> force = corner_forces(now, tau, moment, frame_);
  if (chunk.narrow[k]) [[unlikely]] {
    const Lanes least = column(least_corners_.data(), block);
    add_corner_forces(corners(nodes, block), corner_stiffness(least, volume), frame_, force, least);
  }
  put_forces(force, block, forces);
}

template <int Dim>
auto LocationCells<Dim>::update(Body<Dim>& body, const MeshNodes<Dim>& nodes, double dt,
                                Forces forces) const -> std::optional<Inverted>
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
    for (int k = 0; k < count; ++k) push(cells, first + k, nodes, chunk, k, forces);
  }
  return inverted;
}

template <int Dim>
void LocationCells<Dim>::add_bending_energy(const Body<Dim>& body, const MeshNodes<Dim>& nodes,
                                            LocalIndex block, Lanes& sum) const
{
  const Lanes volume = load(body.particles.state().block(block));
  const CellCorners<Dim> at = corners(nodes, block);
  const CellDeformation<Dim> now(at, frame_);
  bending_.add_energy(now.bending, rest_of(body.particles.motion().block(block)), volume, sum);
  const Lanes least = column(least_corners_.data(), block);
  sum += corner_energy(at, corner_stiffness(least, volume), frame_, least);
}

template <int Dim>
double LocationCells<Dim>::bending_energy(const Body<Dim>& body, const MeshNodes<Dim>& nodes) const
{
  Lanes sum = 0.0;
  for (LocalIndex b = 0; b < body.particles.blocks(); ++b) add_bending_energy(body, nodes, b, sum);
  return stdx::reduce(sum);
}

template <int Dim>
double LocationCells<Dim>::stored_energy(const Body<Dim>& body, const MeshNodes<Dim>& nodes,
                                         LocalIndex cell) const
{
  const LocalIndex block = cell / lane_count;
  Lanes energy = body.law->elastic_energy(body.particles.state().block(block));
  add_bending_energy(body, nodes, block, energy);
  return energy[std::size_t(cell % lane_count)];
}

template <int Dim>
void LocationCells<Dim>::fill_motion(Body<Dim>& body, const MeshNodes<Dim>& nodes,
                                     const NodeFields<Dim>& fields) const
{
  ColumnGroup& motion = body.particles.motion();
  const int position = motion.find("position"), velocity = motion.find("velocity");
  const std::size_t width = NodeFields<Dim>::record_width;
  for (LocalIndex p = 0; p < body.particles.size(); ++p) {
    const CellNodes corners = nodes_of(p);
    for (int d = 0; d < Dim; ++d) {
      double place = 0, speed = 0;
      for (const LocalIndex node : corners) {
        place += nodes.place_of(node)[d];
        speed += fields.updated[std::size_t(node) * width + std::size_t(d)];
      }
      motion(position + d, p) = place / corners_of_cell;
      motion(velocity + d, p) = speed / corners_of_cell;
    }
  }
}

template <int Dim>
void LocationCells<Dim>::find_least_stretches(const MeshNodes<Dim>& nodes,
                                              LaneVector<double>& squared) const
{
  squared.resize(corner_nodes_.size() / corners_of_cell);
  for (std::size_t first = 0; first < squared.size(); first += lane_count) {
    const CellCorners<Dim> at = corners(nodes, LocalIndex(first / lane_count));
    const CellDeformation<Dim> now(at, frame_);
    // What a cell is bent by at rest does not make its waves faster, other than its least stretch.
    const Lanes middle = least_stretch_squared(now),
                corner = stdx::min(bent_share(now, at, frame_) / load(rest_shares_.data() + first),
                                   Lanes(1.0));
    store(stdx::max(middle * corner * stdx::abs(corner), Lanes(least_of_all)),
          squared.data() + first);
  }
}

template <int Dim>
double LocationCells<Dim>::wave_speed_at_rest(const Body<Dim>& body,
                                              const LaneVector<double>& least_squared,
                                              double floor) const
{
  const double undeformed = body.law->wave_speed();
  Lanes fastest = undeformed * undeformed;
  for (LocalIndex b = 0; b < body.particles.blocks(); ++b) {
    const double* state = body.particles.state().block(b);
    const Lanes least = stdx::max(column(least_squared.data(), b), Lanes(floor * floor));
    Lanes here = body.law->fastest_wave_squared(state) / stdx::min(least, Lanes(1.0));
    stdx::where(load(state) == 0.0, here) = 0.0;  // padding
    fastest = stdx::max(fastest, here);
  }
  return std::sqrt(stdx::hmax(fastest));
}

template class LocationCells<2>;
template class LocationCells<3>;

}  // namespace mpm
