#pragma once
/// The cells of one body: from the places of their corners to the forces on these.

#include <mpm/core/lane_vector.hpp>
#include <mpm/grid/mesh_nodes.hpp>
#include <mpm/lagrangian/brick_bending.hpp>
#include <mpm/lagrangian/location_mesh.hpp>
#include <mpm/lagrangian/plane_cell.hpp>
#include <mpm/materials/body.hpp>

#include <limits>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

namespace mpm {

/// Where cells fail; out of reach unless said otherwise.
struct FailureLimits {
  double plastic_strain = std::numeric_limits<double>::infinity();
  double stretch = std::numeric_limits<double>::infinity();  ///< largest principal one

  bool limit_stretch() const { return stretch < std::numeric_limits<double>::infinity(); }
};

/// A cell is a particle: its columns are where a step of any kind has them, and `deformation` and,
/// where the law flows, `plastic_bending` beside them.

template <int Dim>
class LocationCells {
  static constexpr int corners_of_cell = LocationMesh<Dim>::corners;

 public:
  using CellNodes = std::array<LocalIndex, std::size_t(corners_of_cell)>;
  /// Where forces go, N. In the plane to [blocks * block_values], aligned for lanes, each cell's
  /// apart, for nodes that gather them: both components on a corner at force_at. In space that
  /// would be as much memory to go through as all else together: they are added to the nodes'.
  using Forces = std::conditional_t<Dim == 2, double*, NodeFields<Dim>*>;
  static constexpr int block_values = Dim * corners_of_cell * lane_count;
  static std::size_t force_at(LocalIndex cell, int corner) { return Dim * place(cell, corner); }

  /// `nodes` of each of the body's cells, in the order of its particles; `size` of a cell, m.
  LocationCells(const Body<Dim>& body, std::span<const CellNodes> nodes, const Vec<Dim>& size);

  /// `fitted`: cells may be of any shape at rest.
  static std::vector<Column> columns(const Law<Dim>& law, bool fitted = false);
  /// A cell at rest; nothing where particles are no cells.
  static void initialise(ColumnGroup& motion, LocalIndex cell);
  /// Cells of any shape are at rest with their corners where they are: volumes, masses, places and
  /// what they are deformed and bent by, relative to the lattice, follow. `thickness`, m.
  void take_rest(Body<Dim>& body, const MeshNodes<Dim>& nodes, double thickness);

  struct Inverted {
    LocalIndex cell;
    double jacobian;
  };
  /// One step's deformation and stress, and what each cell does to its corners. Returns the first
  /// cell that is inside out, or no longer a number.
  std::optional<Inverted> update(Body<Dim>& body, const MeshNodes<Dim>& nodes, double dt,
                                 Forces forces) const;

  /// J, stored in bending and in corners that are held open.
  double bending_energy(const Body<Dim>& body, const MeshNodes<Dim>& nodes) const;
  /// The present places and velocities of the cells' centres.
  void fill_motion(Body<Dim>& body, const MeshNodes<Dim>& nodes,
                   const NodeFields<Dim>& fields) const;
  /// A cell at the point of being turned inside out, or with a corner that is, counts as this.
  static constexpr double least_of_all = 1e-4;
  /// Squares of the least stretch of every cell, [blocks * lanes]: in the middle, and less where a
  /// corner has become narrower than at rest.
  void find_least_stretches(const MeshNodes<Dim>& nodes, LaneVector<double>& squared) const;
  /// m/s, of the fastest wave across a cell, as if it had the size that it has at rest; stretches
  /// below `floor` count as that.
  double wave_speed_at_rest(const Body<Dim>& body, const LaneVector<double>& least_squared,
                            double floor) const;

  CellNodes nodes_of(LocalIndex cell) const
  {
    CellNodes nodes;
    for (int c = 0; c < corners_of_cell; ++c) nodes[std::size_t(c)] = corner_nodes_[place(cell, c)];
    return nodes;
  }

  /// From now on stretches count from here.
  void keep_rest(const Body<Dim>& body);
  /// Cells beyond a limit, ascending.
  std::vector<LocalIndex> find_failed(const Body<Dim>& body, const FailureLimits& limits) const;
  /// J, of one cell: elastic, in bending and in corners that are held open.
  double stored_energy(const Body<Dim>& body, const MeshNodes<Dim>& nodes, LocalIndex cell) const;
  /// Removes cells (ascending) and their particles; the last ones fill the gaps, here, among the
  /// particles and in `least_stretches`, which has one for each cell.
  void erase(Body<Dim>& body, std::span<const LocalIndex> cells,
             LaneVector<double>& least_stretches);
  /// What `erase` changes.
  void archive(Archive& archive);

  /// [blocks * corners * lanes]; lanes of padding name those of a real cell.
  const std::vector<LocalIndex>& corner_nodes() const { return corner_nodes_; }
  std::size_t bytes() const
  {
    return corner_nodes_.size() * sizeof(LocalIndex) +
           (2 * least_corners_.size() + rest_.size()) * sizeof(double);
  }

 private:
  struct Chunk;
  Lanes deform(ParticleStore& cells, LocalIndex block, const MeshNodes<Dim>& nodes, double rate,
               Chunk& chunk, int k) const;
  void push(ParticleStore& cells, LocalIndex block, const MeshNodes<Dim>& nodes, const Chunk& chunk,
            int k, Forces forces) const;
  /// J at which a corner held open at `least` has the energy that one at rest has at least_corner.
  Lanes corner_stiffness(const Lanes& least, const Lanes& volume) const
  {
    const Lanes share = least_corner / least;
    return corner_modulus_ * volume * share * share;
  }
  void put_forces(const CellCorners<Dim>& force, LocalIndex block, Forces forces) const;
  CellCorners<Dim> corners(const MeshNodes<Dim>& nodes, LocalIndex block) const;
  void add_bending_energy(const Body<Dim>& body, const MeshNodes<Dim>& nodes, LocalIndex block,
                          Lanes& sum) const;
  Lanes squared_stretch(const Body<Dim>& body, LocalIndex block) const;
  void copy_cell(LocalIndex from, LocalIndex to);
  static std::size_t place(LocalIndex cell, int corner)
  {
    return (std::size_t(cell / lane_count) * corners_of_cell + std::size_t(corner)) * lane_count +
           std::size_t(cell % lane_count);
  }

  /// Columns of the modes without moments; none where they are 0 for good.
  const double* rest_of(const double* motion) const
  {
    return rest_bending_ < 0 ? nullptr : motion + rest_bending_ * lane_count;
  }
  double* rest_of(double* motion) const
  {
    return const_cast<double*>(rest_of(static_cast<const double*>(motion)));
  }

  CellFrame<Dim> frame_;
  CellBending<Dim> bending_;
  int deformation_, rest_bending_;
  double corner_modulus_;  ///< Pa
  /// [blocks * lanes], of what a location's corner spans: corners below are held open.
  LaneVector<double> least_corners_;
  /// [blocks * lanes], of what its middle would span: the narrowest corner of a cell at rest.
  LaneVector<double> rest_shares_;
  LaneVector<double> rest_;  ///< [blocks * Dim * Dim * lanes], F at rest; empty where it is I
  std::vector<LocalIndex> corner_nodes_;
};

}  // namespace mpm
