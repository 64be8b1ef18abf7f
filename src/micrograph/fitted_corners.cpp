#include <mpm/micrograph/fitted_corners.hpp>
#include <mpm/micrograph/mirrored.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace mpm::micrograph {

namespace {

/// All in locations. A corner looks for the surface so far away, and ends at most so far from where
/// it was along an axis.
constexpr double near_search = 0.75, search = 1, most_moved = 0.45;
/// What a cell's edges span at a corner, at least, of that of a square.
constexpr double least_span = 0.5;
constexpr int relaxations = 4, partings = 8, retreats = 12;
constexpr double retreat = 0.8;
/// The same of what contact sees, and the share of the way back to the surface. Teeth are cut, and
/// notches left: filled, they would keep faces apart by some hundredths more.
constexpr double most_seen = 0.75, least_span_seen = 0.1, way_on = 0.6, way_back = 0.5;
constexpr int ways_back = 6;
constexpr double least_way = 1e-6;
static_assert(fitting_reach > 1 + relaxations + partings + retreats + ways_back + 1);

enum class Kind : char { stays, surface, interior };

class Fitter {
 public:
  Fitter(const IndexBox<2>& corners, const FittedLattice& lattice, const WallPlaces<2>& wall)
      : lattice_(lattice), wall_(wall), box_(corners)
  {
    const auto size = std::size_t(box_.size());
    nodes_.reserve(size);
    for_each_index(box_, [&](const IndexVec<2>& at) { nodes_.push_back(node_at(at)); });
    mean_.assign(size, Vec<2>::Zero());
    part_.assign(size, 1.0);
    whole_.assign(size, 1.0);
    seen_.assign(size, way_on);
    smooth();
    relax();
    const auto stands = [this](std::size_t k) { return offset(k); };
    const auto is_seen = [this](std::size_t k) -> Vec<2> { return offset(k) + way(k); };
    for (int sweep = 0; sweep < partings; ++sweep)
      go_back_where_narrow(stands, least_span, retreat, part_);
    for (int sweep = 0; sweep < retreats; ++sweep)
      go_back_where_narrow(stands, least_span, retreat, whole_);
    for (int sweep = 0; sweep < ways_back; ++sweep)
      go_back_where_narrow(is_seen, least_span_seen, way_back, seen_);
  }

  /// In locations.
  Vec<2> offset(const IndexVec<2>& at) const { return offset(place(at)); }
  Vec<2> way(const IndexVec<2>& at) const { return way(place(at)); }

 private:
  struct Node {
    Kind kind = Kind::stays;
    std::array<bool, 2> held{};   ///< at the border across an axis
    unsigned cells = 0;           ///< bit c: it is corner c of one
    std::array<bool, 4> along{};  ///< the surface goes on to the next one: -x, +x, -y, +y
    Vec<2> to_surface = Vec<2>::Zero();
    bool within = false;  ///< the wall, where it is on the lattice
  };

  std::size_t place(const IndexVec<2>& at) const { return std::size_t(number_in(box_, at)); }

  /// A corner, or a location, that stands for all its images.
  IndexVec<2> folded(IndexVec<2> corner) const
  {
    for (int d = 0; d < 2; ++d)
      if (lattice_.periodic[std::size_t(d)])
        corner[d] = (corner[d] % lattice_.count[d] + lattice_.count[d]) % lattice_.count[d];
    return corner;
  }
  /// Beyond the border there is the next period, or a mirror.
  int body(IndexVec<2> location) const
  {
    location = folded(location);
    for (int d = 0; d < 2; ++d)
      if (!lattice_.periodic[std::size_t(d)])
        location[d] = mirrored(location[d], lattice_.count[d]);
    return lattice_.body(location);
  }
  bool is_wall(Vec<2> place) const
  {
    for (int d = 0; d < 2; ++d) {
      const double count = lattice_.count[d];
      const double period = lattice_.periodic[std::size_t(d)] ? count : 2 * count;
      place[d] -= period * std::floor(place[d] / period);
      if (place[d] > count) place[d] = period - place[d];
      // Shapes do not contain their upper border.
      place[d] = std::clamp(place[d], 1e-9 * count, (1 - 1e-9) * count);
    }
    return wall_.contains(place);
  }

  Node node_at(const IndexVec<2>& corner) const
  {
    const IndexVec<2> at = folded(corner);
    Node node;
    std::array<int, 4> bodies;
    int first = -1;
    bool alike = true;
    for (int c = 0; c < 4; ++c) {
      const int here = bodies[std::size_t(c)] = body(at - IndexVec<2>(c & 1, c >> 1));
      if (here < 0) continue;
      node.cells |= 1u << c;
      alike = alike && (first < 0 || here == first);
      first = here;
    }
    for (int d = 0; d < 2; ++d)
      node.held[std::size_t(d)] =
          !lattice_.periodic[std::size_t(d)] && at[d] % lattice_.count[d] == 0;
    const bool hinge = node.cells == 0b0110u || node.cells == 0b1001u;
    if (node.cells == 0 || hinge || !alike || lattice_.stays(at)) return node;
    const auto has = [&](int c) { return bodies[std::size_t(c)] >= 0; };
    // Corner c of a cell: the cell lies below it where bit d is set.
    node.along = {has(1) != has(3), has(0) != has(2), has(2) != has(3), has(0) != has(1)};
    node.kind = node.cells == 0b1111u ? Kind::interior : Kind::surface;
    if (node.kind == Kind::surface) {
      node.within = is_wall(at.cast<double>());
      node.to_surface = to_surface(at, node);
    }
    return node;
  }

  /// To the nearest place along the direction in which most of the wall around a corner lies, or
  /// away from it, at which wall and void meet.
  Vec<2> to_surface(const IndexVec<2>& corner, const Node& node) const
  {
    const Vec<2> centre = corner.cast<double>();
    Vec<2> direction = towards_wall(centre, near_search, node.held);
    if (direction.isZero()) direction = towards_wall(centre, search, node.held);
    if (direction.isZero()) return direction;
    const bool within = node.within;
    if (within) direction = -direction;
    constexpr int steps = 12, halvings = 30;
    double near = 0, far = 0;
    for (int k = 1; k <= steps && far == 0; ++k) {
      const double at = search * k / steps;
      if (is_wall(centre + at * direction) != within)
        far = at;
      else
        near = at;
    }
    if (far == 0) return Vec<2>::Zero();
    for (int k = 0; k < halvings; ++k) {
      const double middle = 0.5 * (near + far);
      (is_wall(centre + middle * direction) == within ? near : far) = middle;
    }
    return 0.5 * (near + far) * direction;
  }

  /// The first moment of the wall in a circle, as a unit vector; 0 where it is small.
  Vec<2> towards_wall(const Vec<2>& centre, double radius, const std::array<bool, 2>& held) const
  {
    constexpr int samples = 12;  // across the circle
    Vec<2> moment = Vec<2>::Zero();
    for (int j = 0; j < samples; ++j)
      for (int i = 0; i < samples; ++i) {
        const Vec<2> d((2 * i + 1.0) / samples - 1, (2 * j + 1.0) / samples - 1);
        if (d.squaredNorm() < 1 && is_wall(centre + radius * d)) moment += d;
      }
    for (int d = 0; d < 2; ++d)
      if (held[std::size_t(d)]) moment[d] = 0;
    // A circle that is half wall has a sixth of a sample each.
    constexpr double least = 0.02 * samples * samples;
    const double length = moment.norm();
    if (length < least) return Vec<2>::Zero();
    return moment / length;
  }

  static const std::array<IndexVec<2>, 4>& steps()
  {
    static const std::array<IndexVec<2>, 4> list{IndexVec<2>(-1, 0), IndexVec<2>(1, 0),
                                                 IndexVec<2>(0, -1), IndexVec<2>(0, 1)};
    return list;
  }
  template <class Visit>
  void for_each_inner(Visit visit) const
  {
    const IndexVec<2> one = IndexVec<2>::Constant(1);
    for_each_index(IndexBox<2>{box_.lower + one, box_.upper - one}, visit);
  }

  /// Of what the corners of a surface have before them half is that of their neighbours: stairs
  /// move as a whole. What is left of it parts them.
  void smooth()
  {
    for_each_inner([&](const IndexVec<2>& at) {
      const Node& node = nodes_[place(at)];
      if (node.kind != Kind::surface) return;
      Vec<2> sum = Vec<2>::Zero();
      int count = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        if (!node.along[k]) continue;
        sum += nodes_[place(at + steps()[k])].to_surface;
        ++count;
      }
      mean_[place(at)] = bounded(0.5 * node.to_surface + (0.5 / count) * sum, node);
    });
  }
  static Vec<2> bounded(Vec<2> offset, const Node& node, double most = most_moved)
  {
    for (int d = 0; d < 2; ++d)
      offset[d] = node.held[std::size_t(d)] ? 0.0 : std::clamp(offset[d], -most, most);
    return offset;
  }

  /// Corners within follow those around them.
  void relax()
  {
    for (int sweep = 0; sweep < relaxations; ++sweep) {
      const std::vector<Vec<2>> before = mean_;
      for_each_inner([&](const IndexVec<2>& at) {
        const Node& node = nodes_[place(at)];
        if (node.kind != Kind::interior) return;
        Vec<2> sum = Vec<2>::Zero();
        for (const IndexVec<2>& step : steps()) sum += before[place(at + step)];
        mean_[place(at)] = bounded(0.25 * sum, node);
      });
    }
  }

  Vec<2> offset(std::size_t k) const
  {
    const Node& node = nodes_[k];
    if (node.kind != Kind::surface) return whole_[k] * mean_[k];
    return whole_[k] * bounded(mean_[k] + part_[k] * (node.to_surface - mean_[k]), node);
  }
  /// From there to the surface, if that lies on the wall's side.
  Vec<2> way(std::size_t k) const
  {
    const Node& node = nodes_[k];
    if (node.kind != Kind::surface || node.to_surface.isZero(0)) return Vec<2>::Zero();
    const Vec<2> way = bounded(node.to_surface, node, most_seen) - offset(k);
    const bool outwards = (way.dot(node.to_surface) > 0) == node.within;
    if (outwards || way.norm() < least_way) return Vec<2>::Zero();
    return seen_[k] * way;
  }

  /// The corners of every cell with too narrow a corner, as they stand in `place_of`, keep so much
  /// of a share.
  template <class PlaceOf>
  void go_back_where_narrow(const PlaceOf& place_of, double span, double kept,
                            std::vector<double>& share)
  {
    std::vector<char> narrow(nodes_.size(), 0);
    const IndexVec<2> one = IndexVec<2>::Constant(1);
    for_each_index(IndexBox<2>{box_.lower, box_.upper - one}, [&](const IndexVec<2>& at) {
      // The cell is there if the node at its lower corner is its corner 0.
      if (!(nodes_[place(at)].cells & 1u)) return;
      std::array<std::size_t, 4> corner;
      std::array<Vec<2>, 4> x;
      for (std::size_t c = 0; c < 4; ++c) {
        const IndexVec<2> up(int(c & 1), int(c >> 1));
        corner[c] = place(at + up);
        x[c] = up.cast<double>() + place_of(corner[c]);
      }
      constexpr std::array<std::size_t, 4> next{1, 3, 0, 2}, last{2, 0, 3, 1};
      double least = 1;
      for (std::size_t c = 0; c < 4; ++c) {
        const Vec<2> u = x[next[c]] - x[c], w = x[last[c]] - x[c];
        least = std::min(least, u[0] * w[1] - u[1] * w[0]);
      }
      if (least >= span) return;
      for (const std::size_t c : corner) narrow[c] = 1;
    });
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      if (narrow[k]) share[k] *= kept;
  }

  const FittedLattice& lattice_;
  const WallPlaces<2>& wall_;
  IndexBox<2> box_;
  std::vector<Node> nodes_;
  std::vector<Vec<2>> mean_;   ///< what corners of a surface do together
  std::vector<double> part_;   ///< of what parts them
  std::vector<double> whole_;  ///< of all
  std::vector<double> seen_;   ///< of the ways from there
};

}  // namespace

CornerOffsets<2> fitted_corners(const IndexBox<2>& locations, const FittedLattice& lattice,
                                const WallPlaces<2>& wall)
{
  CornerOffsets<2> fitted;
  if (locations.empty()) return fitted;
  const IndexVec<2> one = IndexVec<2>::Constant(1);
  const IndexBox<2> corners{locations.lower, locations.upper + one};
  const auto reach = IndexVec<2>::Constant(fitting_reach);
  const Fitter fitter({corners.lower - reach, corners.upper + reach}, lattice, wall);
  fitted.reserve(std::size_t(corners.size()));
  for_each_index(corners, [&](const IndexVec<2>& at) {
    fitted.add(at, fitter.offset(at).cwiseProduct(lattice.location_size),
               fitter.way(at).cwiseProduct(lattice.location_size));
  });
  fitted.seal();
  return fitted;
}

}  // namespace mpm::micrograph
