#pragma once
/// A cell as it was at rest, on its way to another rank.

#include <mpm/core/index_order.hpp>
#include <mpm/core/types.hpp>

#include <bit>
#include <cstddef>
#include <vector>

namespace mpm {

template <int Dim>
struct RestCell {
  int body;        ///< rigid ones after the others
  GlobalIndex id;  ///< of a rigid cell -1
  double mass;     ///< kg
  IndexVec<Dim> location;

  static constexpr std::size_t values = 3 + Dim;
  void pack(std::vector<double>& list) const
  {
    list.insert(list.end(), {double(body), std::bit_cast<double>(id), mass});
    list.insert(list.end(), location.begin(), location.end());
  }
  static RestCell unpacked(const double* at)
  {
    RestCell cell{int(at[0]), std::bit_cast<GlobalIndex>(at[1]), at[2], {}};
    for (int d = 0; d < Dim; ++d) cell.location[d] = LocalIndex(at[3 + d]);
    return cell;
  }
  /// By id; rigid cells, which have none, as a lattice is gone through.
  bool operator<(const RestCell& other) const
  {
    return id == other.id ? stands_before<Dim>(location, other.location) : id < other.id;
  }
};

}  // namespace mpm
