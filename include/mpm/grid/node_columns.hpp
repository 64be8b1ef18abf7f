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

}  // namespace mpm
