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

/// What shapes contain. `materials`: of each shape, Lattice::empty for void; `count` locations cover
/// the specimen's `size`, m.
template <int Dim>
std::unique_ptr<WallPlaces<Dim>> places_of_shapes(std::span<const scene::Shape> shapes,
                                                  std::span<const std::int8_t> materials,
                                                  const Vec<Dim>& size, const IndexVec<Dim>& count);

/// How much of each pixel is wall.
struct WallShares {
  int width, height;
  std::vector<double> share;  ///< 0 to 1, top row first

  double operator()(int column, int row) const { return share[std::size_t(row) * width + column]; }
};

/// Places around which half of a box of three quarters of a location, or of one and a half pixels
/// where these are larger, is wall. What lies beyond the picture is its mirror image, or along
/// periodic axes the picture again.
template <int Dim>
std::unique_ptr<WallPlaces<Dim>> places_of_picture(const WallShares& pixels,
                                                   const IndexVec<Dim>& count,
                                                   const std::array<bool, 2>& periodic);

}  // namespace mpm::micrograph
