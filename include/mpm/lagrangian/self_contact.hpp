#pragma once
/// What a total Lagrangian step knows of the contact of its cells with each other.

#include <mpm/core/lane_vector.hpp>
#include <mpm/grid/mesh_nodes.hpp>
#include <mpm/lagrangian/cell_outline.hpp>
#include <mpm/lagrangian/open_corners.hpp>

#include <array>
#include <functional>
#include <span>
#include <vector>

namespace mpm {

/// Of the stiffness that a flush contact has before it hardens: what a step bears that is made for
/// contact. Cells that bear more become heavier.
inline constexpr double borne_contact = 0.5;

/// Pairs of cells that can meet are found now and then, what they bear in every step. Each rank
/// answers for its own cells.
template <int Dim>
class SelfContact {
 public:
  virtual ~SelfContact() = default;

  struct Cell {
    /// In the order of CellOverlaps.
    std::array<LocalIndex, std::size_t(1 << Dim)> nodes;
    IndexVec<Dim> location;
    double stiffness;  ///< S_c, Pa, in the plane N/m; 0 of a rigid cell: of what it meets
    double volume;     ///< m^3, in the plane m^2, at rest, of what contact sees
    OpenCorners<Dim> open;
    int body;                 ///< whose cell it is
    LocalIndex particle;      ///< and which
    LocalIndex outline = -1;  ///< which one it has; none: its corners are its nodes
  };
  /// Those of this rank that can meet others.
  struct Cells {
    std::vector<Cell> cells;
    std::vector<CellOutline> outlines{};  ///< in the plane only
  };
  /// `find_pairs` follows.
  virtual void set_cells(Cells cells) = 0;

  /// Finds all pairs that can meet as long as no corner of a cell goes further than the room that
  /// one of its nodes has, `rooms` by node, m. Collective.
  virtual void find_pairs(const MeshNodes<Dim>& nodes, std::vector<double> rooms) = 0;
  /// Way of a corner of a cell over that of its nodes, at most, of all ranks' cells.
  virtual double reach() const = 0;
  /// By how much corners of this rank's cells will have gone beyond their rooms, m, at most, once
  /// nodes have gone `ahead` from where they are, by node; negative where all stay within.
  virtual double beyond_rooms(const MeshNodes<Dim>& nodes, std::span<const double> ahead) const = 0;
  /// Overlaps at the present places. Every rank calls it.
  virtual void measure(const MeshNodes<Dim>& nodes) = 0;

  /// Divides squares of least stretches, of each body's cells, by how much stiffer than
  /// borne_contact contact has made the cells at some `measure` since the last call, or may before
  /// the next one if two cells come nearer by `way`, m. Every rank calls it.
  virtual void count_stiffness(std::span<LaneVector<double>> least_stretches, double way) = 0;
  /// As after a count: the present overlaps, found again in the middle of a step, have counted.
  virtual void forget_stiffness() = 0;

  // At the last call of `measure`, of this rank's cells.
  virtual void add_forces(NodeFields<Dim>& fields) const = 0;
  /// To friction[node * Dim + axis], N. Every rank calls it.
  virtual void add_friction(const NodeFields<Dim>& fields, double dt,
                            std::span<double> friction) = 0;
  virtual double energy() const = 0;  ///< J
  /// m^2, in space m^3; every overlap counts once on either cell, half each
  virtual double overlapped_area() const = 0;
  /// The largest part of a cell that those of one wall lie on together.
  virtual double deepest_overlap() const = 0;
  virtual GlobalIndex touching() const = 0;  ///< pairs, with others' halves

  /// visit(location, work), in the work of a cell without contact, for what a step does at it.
  virtual void visit_work(
      const std::function<void(const IndexVec<Dim>& location, double work)>& visit) const = 0;

  virtual GlobalIndex messages() const = 0;
  virtual GlobalIndex bytes_sent() const = 0;
  virtual double waiting_seconds() const = 0;
  virtual std::size_t bytes() const = 0;
};

}  // namespace mpm
