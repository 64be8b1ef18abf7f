#include <mpm/lagrangian/overlap.hpp>
#include <mpm/lagrangian/overlap_contact.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mpm {

namespace {

/// Which corner is more than straight, or -1.
int reflex_corner(const double* corners)
{
  const double *x = corners, *y = corners + 4;
  // Twice the areas of the triangles that the corners cut off.
  const auto cut_off = [&](std::size_t last, std::size_t at, std::size_t next) {
    return (x[at] - x[last]) * (y[next] - y[at]) - (y[at] - y[last]) * (x[next] - x[at]);
  };
  const double least[4] = {cut_off(3, 0, 1), cut_off(0, 1, 2), cut_off(1, 2, 3), cut_off(2, 3, 0)};
  const auto* narrowest = std::min_element(least, least + 4);
  return *narrowest < 0 ? int(narrowest - least) : -1;
}

/// Counter-clockwise: a whole cell, then for each corner that may be a reflex one the two triangles
/// through it.
constexpr std::array<std::array<std::size_t, 4>, 9> pieces{{{0, 1, 2, 3},
                                                            {0, 1, 2, 2},
                                                            {0, 2, 3, 3},
                                                            {1, 2, 3, 3},
                                                            {1, 3, 0, 0},
                                                            {2, 3, 0, 0},
                                                            {2, 0, 1, 1},
                                                            {3, 0, 1, 1},
                                                            {3, 1, 2, 2}}};

}  // namespace

const std::array<std::size_t, 4>& OverlapContact::corners_of_piece(int piece)
{
  return pieces[std::size_t(piece)];
}

OverlapContact::OverlapContact(MPI_Comm comm, std::vector<Cell> cells, double kappa,
                               const Vec<2>& size, const IndexVec<2>& period)
    : comm_(comm),
      ghosts_(comm),
      side_ghosts_(comm),
      cells_(std::move(cells)),
      size_(size),
      period_(period),
      area_(size[0] * size[1]),
      kappa_(kappa)
{
}

void OverlapContact::take_places(const MeshNodes<2>& nodes)
{
  const double *x = nodes.along(0), *y = nodes.along(1);
  for (LocalIndex c = 0; c < cells(); ++c) {
    double* to = corners_of(c);
    for (std::size_t k = 0; k < 4; ++k) {
      to[k] = x[cells_[std::size_t(c)].nodes[k]];
      to[k + 4] = y[cells_[std::size_t(c)].nodes[k]];
    }
  }
}

void OverlapContact::find_boxes()
{
  boxes_.resize(stiffness_.size());
  for (std::size_t c = 0; c < stiffness_.size(); ++c) {
    const double* at = &corners_[c * corner_values];
    const auto [left, right] = std::minmax({at[0], at[1], at[2], at[3]});
    const auto [lower, upper] = std::minmax({at[4], at[5], at[6], at[7]});
    boxes_[c] = {left, lower, right, upper};
  }
}

/// Pairs whose boxes meet. Cells with a reflex corner come as two triangles.
void OverlapContact::list_near()
{
  near_.clear();
  const auto pieces_of = [&](LocalIndex cell) {
    const int reflex = reflex_corner(corners_of(cell));
    return reflex < 0 ? std::pair(0, 1) : std::pair(1 + 2 * reflex, 3 + 2 * reflex);
  };
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    auto [a, b] = pairs_[k];
    if (!meet(boxes_[std::size_t(a)], boxes_[std::size_t(b)], 0)) continue;
    if (turned_[k]) std::swap(a, b);
    const auto [first, last] = pieces_of(a);
    const auto [other_first, other_last] = pieces_of(b);
    for (int one = first; one < last; ++one)
      for (int other = other_first; other < other_last; ++other) near_.push_back({k, one, other});
  }
}

void OverlapContact::find_overlaps()
{
  list_near();
  const std::size_t groups = (near_.size() + lane_count - 1) / lane_count;
  overlaps_.resize(groups * values_per_group);
  for (std::size_t g = 0; g < groups; ++g) {
    alignas(lane_alignment) double a[corner_values * lane_count], b[corner_values * lane_count];
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const Near& near = near_[std::min(g * lane_count + lane, near_.size() - 1)];
      const double *first = corners_of(pairs_[near.pair].first),
                   *second = corners_of(pairs_[near.pair].second);
      if (turned_[near.pair]) std::swap(first, second);
      const auto& one = corners_of_piece(near.first_piece);
      const auto& other = corners_of_piece(near.second_piece);
      for (std::size_t k = 0; k < corner_values; ++k) {
        const std::size_t axis = k < 4 ? 0 : 4;
        a[k * lane_count + lane] = first[axis + one[k % 4]] - first[axis];
        b[k * lane_count + lane] = second[axis + other[k % 4]] - first[axis];
      }
    }
    Quads one, other;
    for (int k = 0; k < 4; ++k) {
      one.x[k] = load(a + k * lane_count);
      one.y[k] = load(a + (k + 4) * lane_count);
      other.x[k] = load(b + k * lane_count);
      other.y[k] = load(b + (k + 4) * lane_count);
    }
    const Overlap overlap = overlap_of(one, other);
    double* out = &overlaps_[g * values_per_group];
    store(overlap.area, out);
    for (int k = 0; k < 4; ++k) {
      store(overlap.a_x[k], out + (1 + k) * lane_count);
      store(overlap.a_y[k], out + (5 + k) * lane_count);
      store(overlap.b_x[k], out + (9 + k) * lane_count);
      store(overlap.b_y[k], out + (13 + k) * lane_count);
    }
  }
}

/// m, from the derivatives of the area by one cell's corners.
double OverlapContact::face_length(const double* derivative)
{
  Vec<2> way = Vec<2>::Zero();
  for (std::size_t c = 0; c < 4; ++c)
    way += Vec<2>(derivative[c * lane_count], derivative[(c + 4) * lane_count]);
  return way.norm();
}

void OverlapContact::measure(const MeshNodes<2>& nodes)
{
  take_places(nodes);
  ghosts_.update(corners_, corner_values, [this](int image, std::span<double> corners) {
    const Vec<2> shift = shift_of(image);
    for (std::size_t k = 0; k < corner_values; ++k) corners[k] += shift[k < 4 ? 0 : 1];
  });
  find_boxes();
  find_overlaps();
  areas_.assign(pairs_.size(), 0.0);
  lengths_.assign(pairs_.size(), 0.0);
  std::fill(sides_.begin(), sides_.end(), 0.0);
  touching_ = 0;
  std::vector<LocalIndex>& first = first_touch_;
  first.assign(cells_.size() + 1, 0);
  for (std::size_t k = 0; k < near_.size(); ++k) {
    const auto [number, one, other] = near_[k];
    if (*overlap_of_pair(k) > 0) {
      areas_[number] += *overlap_of_pair(k);
      lengths_[number] += face_length(overlap_of_pair(k) + lane_count);
    }
    if (areas_[number] == 0 || (k + 1 < near_.size() && near_[k + 1].pair == number)) continue;
    const Pair& pair = pairs_[number];
    ++first[std::size_t(pair.first)];
    if (pair.second < cells()) ++first[std::size_t(pair.second)];
    touching_ += pair.second < cells() ? 2 : 1;
  }
  std::exclusive_scan(first.begin(), first.end(), first.begin(), 0);
  touches_.resize(std::size_t(first.back()));
  std::vector<LocalIndex> next(first.begin(), first.end() - 1);
  for (std::size_t entry = 0; entry < near_.size(); ++entry) {
    const std::size_t k = near_[entry].pair;
    if (areas_[k] == 0 || (entry + 1 < near_.size() && near_[entry + 1].pair == k)) continue;
    const Pair& pair = pairs_[k];
    touches_[std::size_t(next[std::size_t(pair.first)]++)] = {pair.second, LocalIndex(k),
                                                              LocalIndex(k)};
    if (pair.second < cells())
      touches_[std::size_t(next[std::size_t(pair.second)]++)] = {pair.first, LocalIndex(k),
                                                                 second_side_[k]};
  }
  energy_ = 0;
  for (std::size_t c = 0; c < cells_.size(); ++c)
    answer_overlaps(c, {&touches_[std::size_t(first[c])], std::size_t(first[c + 1] - first[c])});
  side_ghosts_.update(sides_, 1);
}

/// dW/ds_d = S_c A0 (H(T_d) + sum over d and its neighbours e of s_e H'(T_e)).
void OverlapContact::answer_overlaps(std::size_t cell, std::span<const Touch> touches)
{
  const auto add_beside = [&](const Touch& touch, const auto& value_of) {
    double sum = value_of(touch);
    for (const Touch& beside : touches)
      if (&beside != &touch && are_of_one_wall(beside.other, touch.other)) sum += value_of(beside);
    return sum;
  };
  const auto share = [this](const Touch& touch) { return share_of(touch); };
  const auto length = [this](const Touch& touch) { return lengths_[std::size_t(touch.pair)]; };
  const double size = std::sqrt(area_);
  parts_.clear();
  for (const Touch& touch : touches) {
    const double together = add_beside(touch, share);
    const OverlapPotential potential(together);
    parts_.push_back({potential.part, share(touch) * potential.slope});
    energy_ += stiffness_[cell] * area_ * share(touch) * parts_.back().own;
    if (!(together > 0)) continue;
    const auto grow = [&](std::vector<double>& largest, double now) {
      largest[std::size_t(touch.side)] = std::max(largest[std::size_t(touch.side)], now);
    };
    grow(stiffnesses_, OverlapPotential::stiffness(together) * add_beside(touch, length) / size);
    grow(parts_of_face_, share(touch) / together);
  }
  const auto change_of = [&](const Touch& touch) {
    return parts_[std::size_t(&touch - touches.data())].change;
  };
  for (const Touch& touch : touches)
    sides_[std::size_t(touch.side)] =
        stiffness_[cell] *
        (parts_[std::size_t(&touch - touches.data())].own + add_beside(touch, change_of));
}

/// Whether cells are so near in the lattice that what a third one presses them with adds up.
bool OverlapContact::are_of_one_wall(LocalIndex a, LocalIndex b) const
{
  return apart(a, b).cwiseAbs().maxCoeff() <= 2;
}

void OverlapContact::add_forces(NodeFields<2>& fields) const
{
  for (std::size_t k = 0; k < near_.size(); ++k) {
    const double* values = overlap_of_pair(k);
    if (!(*values > 0)) continue;
    const auto [number, one, other] = near_[k];
    const auto& [first, second] = pairs_[number];
    const double push = pressure(number);
    const auto push_corners = [&](LocalIndex cell, int piece, const double* derivative) {
      if (cell >= cells()) return;
      for (std::size_t c = 0; c < 4; ++c) {
        const std::size_t corner = corners_of_piece(piece)[c];
        double* force = fields.force_of(cells_[std::size_t(cell)].nodes[corner]);
        force[0] -= push * derivative[c * lane_count];
        force[1] -= push * derivative[(c + 4) * lane_count];
      }
    };
    push_corners(turned_[number] ? second : first, one, values + lane_count);
    push_corners(turned_[number] ? first : second, other, values + 9 * lane_count);
  }
}

void OverlapContact::count_stiffness(std::span<LaneVector<double>> least_stretches)
{
  constexpr double borne = 2;  // what the default step has room for
  side_ghosts_.update(stiffnesses_, 1);
  std::vector<double> pressed(cells_.size(), 0.0);
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const auto other = std::size_t(second_side_[k]);
    const double both = 0.5 * (stiffnesses_[k] + stiffnesses_[other]);
    pressed[std::size_t(pairs_[k].first)] += parts_of_face_[k] * both;
    if (pairs_[k].second < cells())
      pressed[std::size_t(pairs_[k].second)] += parts_of_face_[other] * both;
  }
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const double harder = (1 + 2 * kappa_ * pressed[c]) / (1 + 2 * kappa_ * borne);
    if (harder > 1)
      least_stretches[std::size_t(cells_[c].body)][std::size_t(cells_[c].particle)] /= harder;
  }
  std::fill(stiffnesses_.begin(), stiffnesses_.end(), 0.0);
  std::fill(parts_of_face_.begin(), parts_of_face_.end(), 0.0);
}

double OverlapContact::overlapped_area() const
{
  double area = 0;
  for (const Touch& touch : touches_) area += 0.5 * areas_[std::size_t(touch.pair)];
  return area;
}

std::size_t OverlapContact::bytes() const
{
  return cells_.size() * sizeof(Cell) + pairs_.capacity() * sizeof(Pair) +
         near_.capacity() * sizeof(Near) +
         (corners_.capacity() + 4 * boxes_.capacity() + overlaps_.capacity()) * sizeof(double);
}

}  // namespace mpm
