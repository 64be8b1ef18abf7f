#include <mpm/micrograph/anatomy_cells.hpp>
#include <mpm/micrograph/anatomy_random.hpp>

#include <algorithm>
#include <cmath>

namespace mpm::micrograph::anatomy {

namespace {

double squared(double a)
{
  return a * a;
}

/// Keeps the part with normal . (p - origin) <= offset (Sutherland and Hodgman 1974).
void clip(Polygon& polygon, Point origin, Point normal, double offset)
{
  Polygon kept;
  kept.reserve(polygon.size() + 1);
  const auto excess = [&](Point p) {
    return normal.x * (p.x - origin.x) + normal.y * (p.y - origin.y) - offset;
  };
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point a = polygon[k], b = polygon[(k + 1) % polygon.size()];
    const double ea = excess(a), eb = excess(b);
    if (ea <= 0) kept.push_back(a);
    if ((ea < 0 && eb > 0) || (ea > 0 && eb < 0)) {
      const double t = ea / (ea - eb);
      kept.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
    }
  }
  polygon.swap(kept);
}

double reach_squared(const Polygon& polygon, Point from)
{
  double reach = 0;
  for (const Point p : polygon)
    reach = std::max(reach, squared(p.x - from.x) + squared(p.y - from.y));
  return reach;
}

Point centroid(const Polygon& polygon)
{
  double area = 0, x = 0, y = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point a = polygon[k], b = polygon[(k + 1) % polygon.size()];
    const double cross = a.x * b.y - b.x * a.y;
    area += cross;
    x += cross * (a.x + b.x);
    y += cross * (a.y + b.y);
  }
  return {x / (3 * area), y / (3 * area)};
}

double area(const Polygon& polygon)
{
  double twice = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point a = polygon[k], b = polygon[(k + 1) % polygon.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return twice / 2;
}

}  // namespace

double Cell::depth(Point p) const
{
  double nearest = 1e30;
  for (const Edge& edge : edges)
    nearest = std::min(nearest, edge.offset - edge.normal.x * p.x - edge.normal.y * p.y);
  return nearest;
}

double Cell::lumen_depth(Point p, double scale) const
{
  // However thick the wall, a fifth of the cell stays open: lumens do not vanish from a micrograph.
  const double wall = std::min(style.wall * scale, 0.8 * inradius);
  const double radius = std::max(style.roundness * (inradius - wall), 0.05);
  // Exact distance to rounded right angles, close to it for the blunter ones of a hexagon.
  double sum = 0, nearest = 1e30;
  for (const Edge& edge : edges) {
    const double from_rim =
        edge.offset - edge.normal.x * p.x - edge.normal.y * p.y - wall * edge.wall_factor;
    nearest = std::min(nearest, from_rim);
    if (from_rim < radius) sum += squared(radius - from_rim);
  }
  return (sum > 0 ? radius - std::sqrt(sum) : nearest) - style.filled * inradius;
}

Cell make_cell(const Polygon& polygon, CellStyle style, double wall_scatter, Random& random)
{
  Cell cell{{}, centroid(polygon), polygon[0], polygon[0], 0, style};
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point a = polygon[k], b = polygon[(k + 1) % polygon.size()];
    cell.low = {std::min(cell.low.x, a.x), std::min(cell.low.y, a.y)};
    cell.high = {std::max(cell.high.x, a.x), std::max(cell.high.y, a.y)};
    const double length = std::sqrt(squared(b.x - a.x) + squared(b.y - a.y));
    if (length < 1e-6) continue;
    const Point normal{(b.y - a.y) / length, (a.x - b.x) / length};
    const double factor = 1 + 0.5 * wall_scatter * random.scatter();
    cell.edges.push_back({normal, normal.x * a.x + normal.y * a.y, factor});
  }
  cell.inradius = std::max(cell.depth(cell.centre), 0.0);
  return cell;
}

std::vector<Cell> partition(const std::vector<Site>& sites, Point low, Point high, double stretch,
                            double wall_scatter, Random& random)
{
  std::vector<Cell> cells;
  for (const Site& site : sites) {
    const Point centre{site.at.x / stretch, site.at.y};
    Polygon polygon{{low.x / stretch, low.y},
                    {high.x / stretch, low.y},
                    {high.x / stretch, high.y},
                    {low.x / stretch, high.y}};
    double reach = reach_squared(polygon, centre);
    for (const Site& other : sites) {
      const Point way{other.at.x / stretch - centre.x, other.at.y - centre.y};
      const double distance_squared = squared(way.x) + squared(way.y);
      if (&other == &site || distance_squared < 1e-12) continue;
      const double offset = (distance_squared + site.weight - other.weight) / 2;
      if (offset > 0 && squared(offset) > reach * distance_squared) continue;
      clip(polygon, centre, way, offset);
      if (polygon.size() < 3) break;
      reach = reach_squared(polygon, centre);
    }
    // Slivers of a square micrometre are crowded out by their neighbours, as in growing wood.
    if (polygon.size() < 3 || area(polygon) * stretch < 1) continue;
    for (Point& p : polygon) p.x *= stretch;
    cells.push_back(make_cell(polygon, site.style, wall_scatter, random));
  }
  return cells;
}

}  // namespace mpm::micrograph::anatomy
