#pragma once
/// What a node of the grid takes of memory, column by column.

#include <mpm/grid/node_fields.hpp>

#include <string>
#include <vector>

namespace mpm {

struct NodeBytes {
  std::string name;
  int bytes;  ///< of one node
};

/// The columns that are allocated with these needs, found by allocating them; and the marks of the
/// topology.
template <int Dim>
std::vector<NodeBytes> node_columns(const typename NodeFields<Dim>::Needs& needs);

/// The same of nodes that move with a body, and what a step keeps beside them.
template <int Dim>
std::vector<NodeBytes> mesh_node_columns(const typename NodeFields<Dim>::Needs& needs);

}  // namespace mpm
