#pragma once
/// Walls made thicker or thinner all around, where no threshold gives a picture the density of the
/// wood.

#include <mpm/micrograph/image.hpp>
#include <mpm/scene/scene.hpp>

#include <array>

namespace mpm::micrograph {

/// The two kinds of pixels that Otsu's threshold parts.
struct GrayClasses {
  double threshold = 0;
  double dark = 0, bright = 0;  ///< mean grays
};

/// Throws InputError for an image of one level.
GrayClasses gray_classes(const GrayImage& image);

/// A picture in which every threshold makes the walls of another one thicker or thinner by the same
/// length all around.
struct GrownWalls {
  GrayImage image;
  double surface = 0;    ///< level at the surface of the walls as Otsu's threshold has them
  double per_pixel = 0;  ///< levels that a pixel's width moves it, towards the lumen below 0

  /// Pixels by which a threshold moves the surface, above 0 where walls become thicker.
  double growth(double threshold) const { return (threshold - surface) / per_pixel; }
};

/// Distances to the surface, exact for whole pixels (P. F. Felzenszwalb, D. P. Huttenlocher, Theory
/// of Computing 8 (2012) 415), within a pixel in the order of the grays; a pixel's width counts as
/// half the difference between the classes' grays. `pixel`: width and height of a pixel, m.
GrownWalls grown_walls(const GrayImage& image, const GrayClasses& classes, scene::Wall wall,
                       const std::array<double, 2>& pixel);

}  // namespace mpm::micrograph
