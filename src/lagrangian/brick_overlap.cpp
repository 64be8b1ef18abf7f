#include <mpm/core/error.hpp>
#include <mpm/lagrangian/brick_overlap.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace mpm {

namespace {

/// Of the edge of the cutting brick, by which its planes stand outside: corners of a lattice, which
/// stand on them but for rounding, are all within.
constexpr double within = 1e-12;

/// Corner v of a brick is upper along axis k where bit k is set.
struct HalfEdgesOfBrick {
  std::array<int, 32> twin{}, face{};

  constexpr HalfEdgesOfBrick()
  {
    for (int v = 0; v < 8; ++v)
      for (int slot = 0; slot < 3; ++slot) {
        const int axis = changed(v, slot), other = v ^ 1 << axis, back = changed(other, axis);
        const int next = changed(other, (back + 1) % 3), normal = 3 - axis - next;
        twin[std::size_t(4 * v + slot)] = 4 * other + back;
        face[std::size_t(4 * v + slot)] = 2 * normal + (v >> normal & 1);
      }
  }
  /// Axis of a slot and slot of an axis: at every other corner 1 and 2 change places, so that edges
  /// follow in the same turn.
  static constexpr int changed(int v, int slot)
  {
    const bool odd = ((v >> 2) ^ (v >> 1) ^ v) & 1;
    return odd ? (3 - slot) % 3 : slot;
  }
};
constexpr HalfEdgesOfBrick of_brick;

/// A convex body with three edges at every corner. Half edge 4 v + k, k < 3, leads away from corner
/// v; the next one at v, in turn, is the next side of the face along which one comes back to v.
class Polyhedron {
 public:
  static constexpr int most_corners = 96, faces_of_brick = 6;

  /// Its faces: 2 k across axis k, upper 2 k + 1.
  explicit Polyhedron(const Parallelepiped& brick) : corners_(8)
  {
    for (int v = 0; v < 8; ++v) {
      kept_[v] = true;
      for (int d = 0; d < 3; ++d) {
        double at = brick.centre[d];
        for (int k = 0; k < 3; ++k) at += (v >> k & 1 ? 0.5 : -0.5) * brick.edges(d, k);
        at_[v][d] = at;
      }
    }
    std::copy(of_brick.twin.begin(), of_brick.twin.end(), twin_);
    std::copy(of_brick.face.begin(), of_brick.face.end(), face_);
  }

  /// Keeps where side * x_axis <= 1/2; the cut becomes `face`. Returns whether anything is left.
  bool cut(int axis, double side, int face)
  {
    const int before = corners_;
    double depth[most_corners];
    bool any_in = false, any_out = false;
    for (int v = 0; v < before; ++v) {
      depth[v] = 0.5 + within - side * at_[v][axis];
      any_in = any_in || (kept_[v] && depth[v] >= 0);
      any_out = any_out || (kept_[v] && depth[v] < 0);
    }
    if (!any_out) return any_in;
    if (!any_in) return false;
    for (int v = 0; v < before; ++v) {
      if (!kept_[v] || depth[v] < 0) continue;
      for (int h = 4 * v; h < 4 * v + 3; ++h) {
        const int back = twin_[h], w = back / 4;
        if (depth[w] >= 0) continue;
        const int n = corners_++;
        MPM_ASSERT(n < most_corners);
        const double part = depth[v] / (depth[v] - depth[w]);
        for (int d = 0; d < 3; ++d) at_[n][d] = at_[v][d] + part * (at_[w][d] - at_[v][d]);
        kept_[n] = true;
        face_[4 * n] = face_[back];
        join(h, 4 * n);
      }
    }
    for (int v = 0; v < before; ++v) kept_[v] = kept_[v] && depth[v] >= 0;
    // Along each face from where it enters to where it leaves: there the cut closes it.
    for (int n = before; n < corners_; ++n) {
      int h = twin_[4 * n];
      while (h / 4 < before) h = twin_[following(h)];
      face_[h + 1] = face_[4 * n];
      face_[4 * n + 2] = face;
      join(h + 1, 4 * n + 2);
    }
    return true;
  }

  int corners() const { return corners_; }
  bool kept(int v) const { return kept_[v]; }
  Vec<3> at(int v) const { return {at_[v][0], at_[v][1], at_[v][2]}; }
  int face(int half_edge) const { return face_[half_edge]; }
  int end(int half_edge) const { return twin_[half_edge] / 4; }

 private:
  static int following(int h) { return h % 4 == 2 ? h - 2 : h + 1; }
  void join(int one, int other)
  {
    twin_[one] = other;
    twin_[other] = one;
  }

  int corners_;
  bool kept_[most_corners];
  double at_[most_corners][3];
  int twin_[4 * most_corners];  ///< the other half of an edge
  int face_[4 * most_corners];  ///< on the side of which it runs, counter-clockwise from outside
};

/// Of a face, in the coordinates xi of its brick: area, with the sign of its side, and first
/// moments along the two axes in it.
struct FaceSums {
  double area = 0, moments[2] = {0, 0};
};
using Faces = FaceSums[6];

/// Adds the edge from p to q of a face across `axis`.
void add_edge(const double* p, const double* q, int axis, FaceSums& sums)
{
  constexpr int next[] = {1, 2, 0}, last[] = {2, 0, 1};
  const int u = next[axis], w = last[axis];
  const double half = 0.5 * (p[u] * q[w] - p[w] * q[u]);
  sums.area += half;
  sums.moments[0] += (p[u] + q[u]) * (half / 3);
  sums.moments[1] += (p[w] + q[w]) * (half / 3);
}

/// `cofactors`: of the edges, area vectors of the whole faces, m^2.
BrickOverlap::Slopes slopes_of(const Faces& faces, const Eigen::Matrix3d& cofactors)
{
  BrickOverlap::Slopes slopes;
  for (int k = 0; k < 3; ++k) {
    const FaceSums &lower = faces[2 * k], &upper = faces[2 * k + 1];
    Vec<3> moments;
    moments[k] = 0.5 * (upper.area - lower.area);
    for (int j = 0; j < 2; ++j) moments[(k + 1 + j) % 3] = upper.moments[j] + lower.moments[j];
    slopes.by_centre += (upper.area + lower.area) * cofactors.col(k);
    slopes.by_edges += cofactors.col(k) * moments.transpose();
  }
  return slopes;
}

Eigen::Matrix3d cofactors_of(const Eigen::Matrix3d& edges)
{
  Eigen::Matrix3d cofactors;
  for (int k = 0; k < 3; ++k)
    cofactors.col(k) = edges.col((k + 1) % 3).cross(edges.col((k + 2) % 3));
  return cofactors;
}

/// Of a brick: from its centre along each axis.
Vec<3> half_extent(const Parallelepiped& brick)
{
  return 0.5 * brick.edges.cwiseAbs().rowwise().sum();
}

/// Whether a brick lies beyond a plane of the unit cube, or so little within that it counts for
/// nothing: neighbours across an edge do, all over a lattice.
bool is_beyond(const Parallelepiped& brick)
{
  constexpr double least = 1e-10;
  return ((brick.centre.cwiseAbs() - half_extent(brick)).array() > 0.5 - least).any();
}

}  // namespace

BrickOverlap overlap_of(const Parallelepiped& a, const Parallelepiped& b)
{
  BrickOverlap overlap;
  const Eigen::Matrix3d a_faces = cofactors_of(a.edges), b_faces = cofactors_of(b.edges);
  const double a_volume = a_faces.col(0).dot(a.edges.col(0)),
               b_volume = b_faces.col(0).dot(b.edges.col(0));
  if (!(a_volume > 0 && b_volume > 0)) return overlap;
  const Vec<3> apart = a.centre - b.centre;
  // Seen from b as a unit cube, and the other way round.
  const Parallelepiped a_in_b{b_faces.transpose() * apart / b_volume,
                              b_faces.transpose() * a.edges / b_volume};
  if (is_beyond(a_in_b)) return overlap;
  const Eigen::Matrix3d back = a_faces.transpose() * b.edges / a_volume;
  if (is_beyond({-(back * a_in_b.centre), back})) return overlap;

  Polyhedron common(a_in_b);
  const Vec<3> half = half_extent(a_in_b);
  for (int axis = 0; axis < 3; ++axis)
    for (const int upper : {0, 1}) {
      const double side = upper ? 1 : -1;
      if (side * a_in_b.centre[axis] + half[axis] <= 0.5) continue;
      if (!common.cut(axis, side, Polyhedron::faces_of_brick + 2 * axis + upper)) return overlap;
    }

  // Of either brick: places in its own coordinates, and its faces.
  double places[2][Polyhedron::most_corners][3];
  Faces faces[2];
  for (int v = 0; v < common.corners(); ++v) {
    if (!common.kept(v)) continue;
    const Vec<3> at = common.at(v), xi = back * (at - a_in_b.centre);
    for (int d = 0; d < 3; ++d) {
      places[0][v][d] = xi[d];
      places[1][v][d] = at[d];
    }
  }
  for (int v = 0; v < common.corners(); ++v) {
    if (!common.kept(v)) continue;
    for (int h = 4 * v; h < 4 * v + 3; ++h) {
      const int face = common.face(h);
      const bool of_b = face >= Polyhedron::faces_of_brick;
      const int number = of_b ? face - Polyhedron::faces_of_brick : face;
      add_edge(places[of_b][v], places[of_b][common.end(h)], number / 2, faces[of_b][number]);
    }
  }
  overlap.a = slopes_of(faces[0], a_faces);
  overlap.b = slopes_of(faces[1], b_faces);
  overlap.volume =
      (overlap.a.by_centre.dot(apart) + a.edges.cwiseProduct(overlap.a.by_edges).sum() +
       b.edges.cwiseProduct(overlap.b.by_edges).sum()) /
      3;
  return overlap;
}

}  // namespace mpm
