#pragma once
/// Volume in which two bricks lie upon each other, and how it changes with their motion.

#include <mpm/core/types.hpp>

#include <Eigen/Core>

namespace mpm {

/// The affine part of a brick: x = centre + edges xi, each xi from -1/2 to 1/2.
struct Parallelepiped {
  Vec<3> centre;          ///< m
  Eigen::Matrix3d edges;  ///< columns, m
};

/// Of the volume and its derivatives.
struct BrickOverlap {
  struct Slopes {
    Vec<3> by_centre = Vec<3>::Zero();                   ///< m^2
    Eigen::Matrix3d by_edges = Eigen::Matrix3d::Zero();  ///< m^2
  };
  double volume = 0;  ///< m^3
  Slopes a{}, b{};
};

/// One brick is cut by the planes of the other (Powell & Abel 2015, J. Comput. Phys. 297:340): what
/// is left is closed whatever rounding says of a corner near a plane. With A_f and c_f the area
/// vectors and centroids of its faces, and v the affine motion of the brick whose face it is,
///   dV = sum A_f . v(c_f) ,  3 V = sum A_f . c_f .
/// A face that both share counts as a's. Nothing where a brick is turned inside out.
BrickOverlap overlap_of(const Parallelepiped& a, const Parallelepiped& b);

}  // namespace mpm
