#pragma once
/// Closed cells: convex polygons that tile the plane, so that neighbours share their walls.

#include <vector>

namespace mpm::micrograph::anatomy {

class Random;

struct Point {
  double x, y;
};

/// What every cell of one sort has in common.
struct CellStyle {
  double wall;        ///< um, from the polygon's edge to the lumen: half of the double wall
  double roundness;   ///< of the lumen's corners: 0 polygon, 1 as round as its width allows
  double filled = 0;  ///< of the cell's inner radius, what lies on the wall and narrows the lumen
};

/// Half-plane normal . p <= offset; the normal points out of the cell and has length 1.
struct Edge {
  Point normal;
  double offset;
  double wall_factor;  ///< scatter of the wall along this edge
};

struct Cell {
  std::vector<Edge> edges;
  Point centre, low, high;
  double inradius;  ///< um, distance from the centre to the nearest edge
  CellStyle style;

  /// Distance from p to the nearest edge, negative outside.
  double depth(Point p) const;
  /// Distance from p to the rim of the lumen, positive inside the lumen, walls `scale` times as
  /// thick.
  double lumen_depth(Point p, double scale) const;
};

/// Centre of a cell. Weights w_i = r_i^2 put the shared wall of two neighbours that touch at r_i
/// from the one and r_j from the other, as in a power diagram.
struct Site {
  Point at;
  double weight;
  CellStyle style;
};

using Polygon = std::vector<Point>;

Cell make_cell(const Polygon& polygon, CellStyle style, double wall_scatter, Random& random);

/// The power diagram of the sites inside [low, high], with x measured in units of `stretch`: values
/// above 1 turn the hexagons of alternating files into bricks.
std::vector<Cell> partition(const std::vector<Site>& sites, Point low, Point high, double stretch,
                            double wall_scatter, Random& random);

}  // namespace mpm::micrograph::anatomy
