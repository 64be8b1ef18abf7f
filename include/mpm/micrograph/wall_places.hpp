#pragma once
/// Where a specimen is wall, finer than its lattice.

#include <mpm/core/types.hpp>
#include <mpm/micrograph/section.hpp>
#include <mpm/scene/scene.hpp>

#include <memory>
#include <span>

namespace mpm::micrograph {

template <int Dim>
class WallPlaces {
 public:
  virtual ~WallPlaces() = default;
  /// `place`: in locations from the specimen's lower corner, within it.
  virtual bool contains(const Vec<Dim>& place) const = 0;
};

/// What shapes contain. `materials`: of each shape, Lattice::empty for void; `count` locations
/// cover the specimen's `size`, m.
template <int Dim>
std::unique_ptr<WallPlaces<Dim>> places_of_shapes(std::span<const scene::Shape> shapes,
                                                  std::span<const std::int8_t> materials,
                                                  const Vec<Dim>& size, const IndexVec<Dim>& count);

/// How much each pixel is wall, in any measure.
struct WallLevels {
  int width, height;
  std::vector<double> level;  ///< top row first
  double density;             ///< share of the pixels that are wall

  double operator()(int column, int row) const { return level[std::size_t(row) * width + column]; }
};

/// By the mean level of a box around a place, three quarters of a location wide, or a pixel where
/// that is larger. Blur moves what is thin or bent: wall is where the mean is above the quantile at
/// which the picture's density is met, as it is for locations. What lies beyond the picture is its
/// mirror image, or along periodic axes the picture again.
template <int Dim>
std::unique_ptr<WallPlaces<Dim>> places_of_picture(const WallLevels& pixels,
                                                   const IndexVec<Dim>& count,
                                                   const std::array<bool, 2>& periodic);

}  // namespace mpm::micrograph
