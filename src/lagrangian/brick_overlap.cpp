#include <mpm/core/error.hpp>
#include <mpm/lagrangian/brick_overlap.hpp>

#include <Eigen/Geometry>
#include <array>
#include <cmath>

namespace mpm {

namespace {

/// Of the edge of the cutting brick, by which its planes stand outside: corners of a lattice, which
/// stand on them but for rounding, are all within.
constexpr double within = 1e-12;

/// A convex body with three edges at every corner. Half edge 3 v + k leads away from corner v, the
/// next one at v, in turn, is the next side of the face on which it comes back.
class Polyhedron {
 public:
  static constexpr int most_corners = 96, faces_of_brick = 6;

  /// Corner v of a brick is upper along axis k where bit k is set. Its faces: 2 k, upper 2 k + 1.
  explicit Polyhedron(const Parallelepiped& brick) : corners_(8)
  {
    for (int v = 0; v < 8; ++v) {
      kept_[v] = true;
      Vec<3> at = brick.centre;
      for (int k = 0; k < 3; ++k) at += (v >> k & 1 ? 0.5 : -0.5) * brick.edges.col(k);
      for (int d = 0; d < 3; ++d) at_[v][d] = at[d];
      for (int slot = 0; slot < 3; ++slot) {
        const int axis = axis_in(v, slot), other = v ^ 1 << axis;
        // Where they differ in one bit, axes come in the other turn: slots 1 and 2 change places.
        twin_[3 * v + slot] = 3 * other + slot_of(other, axis);
        const int next = axis_in(other, (slot_of(other, axis) + 1) % 3), normal = 3 - axis - next;
        face_[3 * v + slot] = 2 * normal + (v >> normal & 1);
      }
    }
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
      for (int h = 3 * v; h < 3 * v + 3; ++h) {
        const int back = twin_[h], w = back / 3;
        if (depth[w] >= 0) continue;
        const int n = corners_++;
        MPM_ASSERT(n < most_corners);
        const double part = depth[v] / (depth[v] - depth[w]);
        for (int d = 0; d < 3; ++d) at_[n][d] = at_[v][d] + part * (at_[w][d] - at_[v][d]);
        kept_[n] = true;
        face_[3 * n] = face_[back];
        join(h, 3 * n);
      }
    }
    for (int v = 0; v < before; ++v) kept_[v] = kept_[v] && depth[v] >= 0;
    // Along each face from where it enters to where it leaves: there the cut closes it.
    for (int n = before; n < corners_; ++n) {
      int h = twin_[3 * n];
      while (h / 3 < before) h = twin_[following(h)];
      face_[h + 1] = face_[3 * n];
      face_[3 * n + 2] = face;
      join(h + 1, 3 * n + 2);
    }
    return true;
  }

  int corners() const { return corners_; }
  bool kept(int v) const { return kept_[v]; }
  Vec<3> at(int v) const { return {at_[v][0], at_[v][1], at_[v][2]}; }
  int face(int half_edge) const { return face_[half_edge]; }
  int end(int half_edge) const { return twin_[half_edge] / 3; }

 private:
  static constexpr int axis_in(int v, int slot)
  {
    const bool odd = ((v >> 2) ^ (v >> 1) ^ v) & 1;
    return odd ? (3 - slot) % 3 : slot;
  }
  static constexpr int slot_of(int v, int axis) { return axis_in(v, axis); }
  static int following(int h) { return h / 3 * 3 + (h + 1) % 3; }
  void join(int one, int other)
  {
    twin_[one] = other;
    twin_[other] = one;
  }

  int corners_;
  bool kept_[most_corners];
  double at_[most_corners][3];
  int twin_[3 * most_corners];  ///< the other half of an edge
  int face_[3 * most_corners];  ///< on the side of which it runs, counter-clockwise from outside
};

/// Of a face, in the coordinates xi of its brick: area, with the sign of its side, and first
/// moments along the two axes in it.
struct FaceSums {
  double area = 0, moments[2] = {0, 0};
};
using Faces = std::array<FaceSums, 6>;

/// The edge from p to q of a face across `axis`.
void add_edge(const double* p, const double* q, int axis, FaceSums& sums)
{
  const int u = (axis + 1) % 3, w = (axis + 2) % 3;
  const double cross = p[u] * q[w] - p[w] * q[u];
  sums.area += 0.5 * cross;
  sums.moments[0] += (p[u] + q[u]) * cross / 6;
  sums.moments[1] += (p[w] + q[w]) * cross / 6;
}

/// `cofactors`: of the edges, area vectors of the whole faces, m^2.
BrickOverlap::Slopes slopes_of(const Faces& faces, const Eigen::Matrix3d& cofactors)
{
  BrickOverlap::Slopes slopes;
  for (int k = 0; k < 3; ++k) {
    const FaceSums &lower = faces[std::size_t(2 * k)], &upper = faces[std::size_t(2 * k + 1)];
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

/// Whether a brick lies beyond a plane of the unit cube, or so little within that it counts for
/// nothing: neighbours across an edge do, all over a lattice.
bool is_beyond(const Parallelepiped& brick)
{
  constexpr double least = 1e-10;
  const Vec<3> half = 0.5 * brick.edges.cwiseAbs().rowwise().sum();
  return ((brick.centre.cwiseAbs() - half).array() > 0.5 - least).any();
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
  for (int axis = 0; axis < 3; ++axis)
    for (const int upper : {0, 1})
      if (!common.cut(axis, upper ? 1.0 : -1.0, Polyhedron::faces_of_brick + 2 * axis + upper))
        return overlap;

  double in_a[Polyhedron::most_corners][3], in_b[Polyhedron::most_corners][3];
  for (int v = 0; v < common.corners(); ++v) {
    if (!common.kept(v)) continue;
    const Vec<3> at = common.at(v), xi = back * (at - a_in_b.centre);
    for (int d = 0; d < 3; ++d) {
      in_a[v][d] = xi[d];
      in_b[v][d] = at[d];
    }
  }
  Faces of_a, of_b;
  for (int v = 0; v < common.corners(); ++v) {
    if (!common.kept(v)) continue;
    for (int h = 3 * v; h < 3 * v + 3; ++h) {
      const int face = common.face(h), end = common.end(h);
      if (face < Polyhedron::faces_of_brick)
        add_edge(in_a[v], in_a[end], face / 2, of_a[std::size_t(face)]);
      else {
        const int of_other = face - Polyhedron::faces_of_brick;
        add_edge(in_b[v], in_b[end], of_other / 2, of_b[std::size_t(of_other)]);
      }
    }
  }
  overlap.a = slopes_of(of_a, a_faces);
  overlap.b = slopes_of(of_b, b_faces);
  overlap.volume =
      (overlap.a.by_centre.dot(apart) + a.edges.cwiseProduct(overlap.a.by_edges).sum() +
       b.edges.cwiseProduct(overlap.b.by_edges).sum()) /
      3;
  return overlap;
}

}  // namespace mpm
