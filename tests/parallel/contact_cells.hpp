#pragma once
/// Cells that have their own nodes each, at any places, for contact by overlaps.

#include <mpm/lagrangian/overlap_contact.hpp>

#include <vector>

namespace mpm {

constexpr double stiffness = 4e9;  ///< Pa, in the plane N/m

template <int Dim>
Vec<Dim> size()
{
  return Vec<3>(1e-3, 0.8e-3, 1.1e-3).head<Dim>();
}

template <int Dim>
constexpr int corners = 1 << Dim;

/// Of a cell of the size 1, from its middle, in the order of CellOverlaps.
template <int Dim>
Vec<Dim> corner_at(int corner)
{
  Vec<Dim> at;
  for (int d = 0; d < Dim; ++d)
    at[d] = CellOverlaps<Dim>::order[std::size_t(corner)] >> d & 1 ? 0.5 : -0.5;
  return at;
}

/// Nodes that stand at places, m, of cells that have their own ones each.
template <int Dim>
struct Mesh {
  explicit Mesh(const std::vector<Vec<Dim>>& places)
      : nodes(std::vector<IndexVec<Dim>>(places.size(), IndexVec<Dim>::Zero()),
              std::vector<char>(places.size(), 1), size<Dim>(), IndexVec<Dim>::Zero()),
        fields(nodes.size(), {.gradient = false}, 0)
  {
    for (std::size_t n = 0; n < places.size(); ++n)
      for (int d = 0; d < Dim; ++d) fields.updated_of(LocalIndex(n))[d] = places[n][d];
    nodes.move(fields, 1);
  }
  MeshNodes<Dim> nodes;
  NodeFields<Dim> fields;
};

/// Of each node, m.
template <int Dim>
std::vector<double> rooms(const MeshNodes<Dim>& nodes)
{
  return std::vector<double>(std::size_t(nodes.size()), 0.15e-3);
}

template <int Dim>
typename OverlapContact<Dim>::Cell cell_at(int number, const IndexVec<Dim>& location)
{
  typename OverlapContact<Dim>::Cell cell{
      {}, location, stiffness, size<Dim>().prod(), OpenCorners<Dim>::all(), 0, number};
  for (int k = 0; k < corners<Dim>; ++k)
    cell.nodes[std::size_t(k)] = LocalIndex(corners<Dim> * number + k);
  return cell;
}

}  // namespace mpm
