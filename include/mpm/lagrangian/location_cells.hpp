#pragma once
/// The cells of one body in the plane: from the places of their corners to the forces on these.

#include <mpm/grid/mesh_nodes.hpp>
#include <mpm/lagrangian/location_cell.hpp>
#include <mpm/lagrangian/location_mesh.hpp>
#include <mpm/materials/body.hpp>

#include <optional>
#include <span>
#include <vector>

namespace mpm {

/// A cell is a particle: its columns are where a step of any kind has them, and `deformation` and,
/// where the law flows, `plastic_bending` (1/m) beside them.
class LocationCells {
 public:
  using CellNodes = std::array<LocalIndex, LocationMesh<2>::corners>;
  /// Values that the forces of one block take: component d of corner c of lane l stands at
  /// (2 c + d) * lane_count + l.
  static constexpr int block_values = 2 * LocationMesh<2>::corners * lane_count;

  /// `nodes` of each of the body's cells, in the order of its particles; `size` of a cell, m.
  LocationCells(const Body<2>& body, std::span<const CellNodes> nodes, const Vec<2>& size);

  static std::vector<Column> columns(const Law<2>& law);
  /// A cell at rest; nothing where particles are no cells.
  static void initialise(ColumnGroup& motion, LocalIndex cell);

  struct Inverted {
    LocalIndex cell;
    double jacobian;
  };
  /// One step's deformation and stress. `forces`: [blocks * block_values], N, of each cell on its
  /// corners. Returns the first cell that is inside out, or no longer a number.
  std::optional<Inverted> update(Body<2>& body, const MeshNodes<2>& nodes, double dt,
                                 double* forces) const;

  /// J, stored in bending and in corners that are held open.
  double bending_energy(const Body<2>& body, const MeshNodes<2>& nodes) const;
  /// The present places and velocities of the cells' centres.
  void fill_motion(Body<2>& body, const MeshNodes<2>& nodes, const NodeFields<2>& fields) const;
  /// Squares of the least stretch of the cells of one block: in the middle, and less where a corner
  /// is narrower.
  Lanes least_stretch_squared(const MeshNodes<2>& nodes, LocalIndex block) const;
  /// m/s, of the fastest wave across a cell, as if it had the size that it has at rest; stretches
  /// below `floor` count as that.
  double wave_speed_at_rest(const Body<2>& body, const MeshNodes<2>& nodes, double floor) const;

  /// [blocks * corners * lanes]; lanes of padding name those of a real cell.
  const std::vector<LocalIndex>& corner_nodes() const { return corner_nodes_; }
  std::size_t bytes() const { return corner_nodes_.size() * sizeof(LocalIndex); }

 private:
  struct Chunk;
  Lanes deform(ParticleStore& cells, LocalIndex block, const MeshNodes<2>& nodes, double rate,
               Chunk& chunk, int k) const;
  void push(ParticleStore& cells, LocalIndex block, const MeshNodes<2>& nodes, const Chunk& chunk,
            int k, double* out) const;
  CellCorners corners(const MeshNodes<2>& nodes, LocalIndex block) const;

  CellFrame frame_;
  int deformation_, plastic_bending_;
  Vec<2> fibre_stress_;    ///< Pa m: (m / (V0 h / 4)) over the elastic bending
  Vec<2> bending_;         ///< Pa m^2: m / V0 over the elastic bending
  double corner_modulus_;  ///< Pa
  std::vector<LocalIndex> corner_nodes_;
};

}  // namespace mpm
