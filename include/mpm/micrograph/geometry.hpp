#pragma once
/// Which points lie inside a shape. Coordinates in m from the specimen's lower left corner.

#include <mpm/scene/scene.hpp>

#include <array>
#include <string>

namespace mpm::micrograph {

using Point = std::array<double, 2>;

/// The lower and left edges belong to a box, the upper and right ones do not.
bool contains(const scene::Box& box, const Point& point);
bool contains(const scene::Disc& disc, const Point& point);
/// Even-odd rule: an outline that crosses itself leaves holes. Polygons that share an edge share no
/// point and leave none out.
bool contains(const scene::Polygon& polygon, const Point& point);
/// Inside the box and within half a wall thickness of a side of a hexagon. One hexagon is centred
/// on the box's lower corner; two sides of each are vertical. The box's left and lower edges are
/// thus mirror lines, and so are the others where the width is a multiple of sqrt(3)/2 side and the
/// height of 3/2 side.
bool contains(const scene::Honeycomb& honeycomb, const Point& point);

/// Smallest upright box around a shape.
scene::Box bounds(const scene::Shape& shape);

/// What makes the shape meaningless ("radius is -1 (must be above 0)"), or "".
std::string defect(const scene::Shape& shape);

/// Of a periodic regular honeycomb with side l and wall t: 1 - (1 - t / (sqrt(3) l))^2.
double relative_density(const scene::Honeycomb& honeycomb);

}  // namespace mpm::micrograph
