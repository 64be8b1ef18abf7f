#pragma once
/// Integer and vector types by role.

#include <Eigen/Core>
#include <cstdint>

namespace mpm {

using LocalIndex = std::int32_t;   ///< particles, nodes, cells of this rank
using GlobalIndex = std::int64_t;  ///< particles, nodes, cells of the whole run

template <int Dim>
using Vec = Eigen::Matrix<double, Dim, 1>;
template <int Dim>
using IndexVec = Eigen::Matrix<LocalIndex, Dim, 1>;

}  // namespace mpm
