#include <mpm/core/sieve.hpp>
#include <mpm/lagrangian/overlap_contact.hpp>
#include <mpm/parallel/session.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

namespace mpm {

namespace {

// Of a cell without contact: 12, 100 and 67 ns beside 24 (drawn loblolly and poplar, one core; a
// pair whose boxes meet stands for the 1.4 to 1.6 that are close then).
constexpr double work_at_surface = 0.5, work_of_near = 4, work_of_pressing = 2.8;

}  // namespace

template <int Dim>
OverlapContact<Dim>::OverlapContact(MPI_Comm comm, Cells cells, double kappa, BodyPairs bodies,
                                    const Vec<Dim>& size, const IndexVec<Dim>& period)
    : comm_(comm),
      ghosts_(comm),
      side_ghosts_(comm),
      bodies_(std::move(bodies)),
      size_(size),
      period_(period),
      cell_volume_(size.prod()),
      cell_face_(Dim == 2 ? std::sqrt(cell_volume_) : std::pow(cell_volume_, 2.0 / 3.0)),
      kappa_(kappa)
{
  set_cells(std::move(cells));
  // Cells that failing ones lay bare later have no outlines of their own.
  if constexpr (Dim == 2) {
    for (const CellOutline& outline : outlines_) reach_ = std::max(reach_, outline.reach());
    reach_ = largest_over_ranks(comm_, reach_);
  }
}

template <int Dim>
void OverlapContact<Dim>::set_cells(Cells cells)
{
  cells_ = std::move(cells.cells);
  outlines_ = std::move(cells.outlines);
  near_.clear();
  pressing_.clear();
  work_then_.clear();
}

template <int Dim>
void OverlapContact<Dim>::take_places(const MeshNodes<Dim>& nodes)
{
  for (LocalIndex c = 0; c < cells(); ++c) {
    CornerPlaces<Dim> places;
    for (std::size_t k = 0; k < corners_of_cell; ++k) {
      const double* place = nodes.place_of(cells_[std::size_t(c)].nodes[k]);
      for (int d = 0; d < Dim; ++d) places[k][d] = place[d];
    }
    if constexpr (Dim == 2)
      if (const CellOutline* outline = outline_of(c)) outline->take_corners(places);
    Overlaps::describe(places, values_of(c));
  }
}

template <int Dim>
void OverlapContact<Dim>::find_boxes()
{
  boxes_.resize(stiffness_.size());
  for (std::size_t c = 0; c < stiffness_.size(); ++c)
    boxes_[c] = Overlaps::box_of(values_of(LocalIndex(c)));
}

/// Pairs are listed so that they last for many steps, and few of them come close in the next ones.
template <int Dim>
void OverlapContact<Dim>::list_close()
{
  constexpr double margin = 0.15;  // of a location: most often enough for 10 steps
  const double distance = margin * size_.minCoeff();
  if (boxes_then_.size() == boxes_.size()) {
    Box ways{};
    for (std::size_t c = 0; c < boxes_.size(); ++c)
      for (std::size_t d = 0; d < ways.size(); ++d)
        ways[d] = std::max(ways[d], std::abs(boxes_[c][d] - boxes_then_[c][d]));
    if (2 * std::ranges::max(ways) < distance) return;
  }
  boxes_then_ = boxes_;
  close_.clear();
  Sieve sieve(close_);
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const auto [a, b] = pairs_[k];
    sieve.item() = {{turned_[k] ? b : a, turned_[k] ? a : b}, LocalIndex(k), touched_at_[k]};
    sieve.keep(meet<Dim>(boxes_[std::size_t(a)], boxes_[std::size_t(b)], distance));
  }
}

template <int Dim>
void OverlapContact<Dim>::list_near()
{
  near_.clear();
  Sieve sieve(near_);
  for (std::size_t k = 0; k < close_.size(); ++k) {
    const auto [a, b] = close_[k].cells;
    sieve.item() = {k, values_of(a), values_of(b)};
    sieve.keep(meet<Dim>(boxes_[std::size_t(a)], boxes_[std::size_t(b)], 0));
  }
}

template <int Dim>
void OverlapContact<Dim>::list_pressing()
{
  pressing_.clear();
  Sieve sieve(pressing_);
  for (std::size_t entry = 0; entry < found_.size();) {
    const std::size_t k = found_.pair(entry);
    Pressing& pair = sieve.item();
    pair = {close_[k].cells, LocalIndex(k), close_[k].touched, LocalIndex(entry), 0, 0, 0, 0};
    do {
      const double overlap = found_.overlap(entry);
      pair.overlap += std::max(0.0, overlap);
      pair.face += double(overlap > 0) * found_.face(entry);
    } while (++entry < found_.size() && found_.pair(entry) == k);
    pair.end = LocalIndex(entry);
    sieve.keep(pair.overlap > 0);
  }
}

/// Those that have not yet since the last check.
template <int Dim>
void OverlapContact<Dim>::list_touched()
{
  for (Pressing& pair : pressing_) {
    if (pair.touched >= 0) continue;
    const LocalIndex number = close_[std::size_t(pair.close)].pair;
    pair.touched = LocalIndex(touched_.size());
    close_[std::size_t(pair.close)].touched = touched_at_[std::size_t(number)] = pair.touched;
    touched_.push_back({pair.cells, number, {}, {}});
  }
}

template <int Dim>
void OverlapContact<Dim>::measure(const MeshNodes<Dim>& nodes)
{
  take_places(nodes);
  ghosts_.update(values_, Overlaps::values, [this](int image, std::span<double> values) {
    Overlaps::shift(shift_of(image), values.data());
  });
  find_boxes();
  list_close();
  list_near();
  found_.find(near_);
  list_pressing();
  list_touched();
  list_touches();
  energy_ = 0;
  for (LocalIndex c = 0; c < cells(); ++c)
    if (const std::span<const Touch> touches = touches_of(c); !touches.empty())
      answer_overlaps(std::size_t(c), touches);
  trade_answers();
  work_then_.clear();
}

/// Of this rank's cells, by cell.
template <int Dim>
void OverlapContact<Dim>::list_touches()
{
  std::vector<LocalIndex>& first = first_touch_;
  first.assign(cells_.size() + 1, 0);
  for (const Pressing& pair : pressing_)
    for (const LocalIndex cell : pair.cells)
      if (cell < cells()) ++first[std::size_t(cell)];
  std::exclusive_scan(first.begin(), first.end(), first.begin(), 0);
  touches_.resize(std::size_t(first.back()));
  next_touch_.assign(first.begin(), first.end() - 1);
  LocalIndex number = 0;
  for (const Pressing& pair : pressing_)
    for (const std::size_t side : {0, 1}) {
      const LocalIndex cell = pair.cells[side];
      if (cell < cells())
        touches_[std::size_t(next_touch_[std::size_t(cell)]++)] = {pair.cells[1 - side], number,
                                                                   pair.overlap, pair.face};
      ++number;
    }
}

/// Of pairs with cells of other ranks.
template <int Dim>
void OverlapContact<Dim>::trade_answers()
{
  const auto for_each_shared = [&](const auto& visit) {
    for (Pressing& pair : pressing_)
      if (is_with_a_copy(pair.cells)) visit(pair, std::size_t(close_[pair.close].pair));
  };
  for_each_shared([&](const Pressing& pair, std::size_t k) { sides_[k] = pair.pressure; });
  side_ghosts_.update(sides_, 1);
  for_each_shared([&](Pressing& pair, std::size_t k) {
    pair.pressure += sides_[std::size_t(other_side_[k])];
    sides_[k] = 0;
  });
}

/// dW/ds_d = S_c V0 (H(T_d) + sum over d and its neighbours e of s_e H'(T_e)); with the stiffness
/// of d and e in place of S_c where c is rigid. A share falls with the overlap as it grows with
/// the cell: dW/dV_c = - sum over d of dW/dA_cd A_cd / V_c, A the overlap.
template <int Dim>
void OverlapContact<Dim>::answer_overlaps(std::size_t cell, std::span<const Touch> touches)
{
  const std::size_t count = touches.size();
  const bool rigid = is_rigid(LocalIndex(cell));
  const double stiffness = rigid ? 1.0 : stiffness_[cell];
  const double volume = Overlaps::volume(values_of(LocalIndex(cell)));
  const bool bears_less = !rigid && volume > least_squeezed * cells_[cell].volume;
  const double squeezed = bears_less ? volume / cells_[cell].volume : rigid ? 1.0 : least_squeezed;
  const double whole = 1 / (squeezed * cell_volume_), side = 1 / (squeezed * squeezed * cell_face_);
  if (parts_.size() < count) parts_.resize(count);
  if (beside_.size() < count * count / 2) beside_.resize(count * count / 2);
  std::size_t of_one_wall = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const OverlapShare share(touches[k].overlap * whole);
    const IndexVec<Dim> location = locations_[std::size_t(touches[k].other)];
    double together = share.value, face = touches[k].face;
    for (std::size_t j = 0; j < k; ++j) {
      Part& other = parts_[j];
      // Nobody foresees it: no branch.
      const bool counts = are_of_one_wall(location, other.location);
      beside_[of_one_wall] = {j, k};
      of_one_wall += std::size_t(counts);
      together += double(counts) * other.share;
      face += double(counts) * touches[j].face;
      other.together += double(counts) * share.value;
      other.face += double(counts) * touches[k].face;
    }
    parts_[k] = {location, share.value, share.slope, together, face, 0, 0};
  }
  for (std::size_t k = 0; k < count; ++k) {
    Part& part = parts_[k];
    const OverlapPotential potential(part.together);
    const double of_other = rigid ? stiffness_[std::size_t(touches[k].other)] : 1.0;
    part.answer = of_other * potential.part;
    part.change = of_other * part.share * potential.slope;
    energy_ += stiffness * cell_volume_ * part.share * part.answer;
    part.answer += part.change;
    if (!(part.together > 0)) continue;
    const std::size_t pressing = std::size_t(touches[k].pressing) / 2,
                      of = std::size_t(touches[k].pressing) % 2;
    Touched& largest = touched_[std::size_t(pressing_[pressing].touched)];
    largest.stiffness[of] = std::max(largest.stiffness[of],
                                     OverlapPotential::stiffness(part.together) * part.face * side);
    largest.share[of] = std::max(largest.share[of], part.share / part.together);
  }
  for (const auto& [j, k] : std::span(beside_).first(of_one_wall)) {
    parts_[j].answer += parts_[k].change;
    parts_[k].answer += parts_[j].change;
  }
  const double answer = stiffness / squeezed;
  double work = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double slope = answer * parts_[k].answer * parts_[k].slope;
    pressing_[std::size_t(touches[k].pressing / 2)].pressure += slope;
    work += slope * touches[k].overlap;
  }
  swelling_[cell] = bears_less ? work / volume : 0;
}

template <int Dim>
void OverlapContact<Dim>::add_forces(NodeFields<Dim>& fields) const
{
  for (LocalIndex cell = 0; cell < cells(); ++cell) {
    const std::span<const Touch> touches = touches_of(cell);
    if (touches.empty()) continue;
    // By what describes the cell: its nodes are pushed once, whatever touches it.
    std::array<double, Overlaps::values> sum{};
    Overlaps::add_volume_slopes(values_of(cell), swelling_[std::size_t(cell)], sum.data());
    for (const Touch& touch : touches) {
      const Pressing& pair = pressing_[std::size_t(touch.pressing / 2)];
      for (auto entry = std::size_t(pair.first); entry < std::size_t(pair.end); ++entry)
        if (found_.overlap(entry) > 0)
          found_.add_slopes(entry, touch.pressing % 2, -pair.pressure, sum.data());
    }
    CornerPlaces<Dim> push = Overlaps::by_corners(sum.data());
    if constexpr (Dim == 2)
      if (const CellOutline* outline = outline_of(cell)) outline->give_nodes(push);
    const auto& nodes = cells_[std::size_t(cell)].nodes;
    for (std::size_t c = 0; c < corners_of_cell; ++c) {
      double* force = fields.force_of(nodes[c]);
      for (int d = 0; d < Dim; ++d) force[d] += push[c][d];
    }
  }
}

/// Before they have come nearer by `way`, m. Those around a node of one body, where a wall ends or
/// a corner is open, touch at rest, and press where the corner has closed.
template <int Dim>
bool OverlapContact<Dim>::can_press(const Pair& pair, double way) const
{
  const auto a = std::size_t(pair.first), b = std::size_t(pair.second);
  if (!meet<Dim>(boxes_[a], boxes_[b], way)) return false;
  const IndexVec<Dim> apart = this->apart(pair.first, pair.second);
  if (of_body_[a] != of_body_[b] || apart.cwiseAbs().maxCoeff() > 1) return true;
  const double *one = values_of(pair.first), *other = values_of(pair.second);
  return Overlaps::closes_on(one, other, apart, way) ||
         Overlaps::closes_on(other, one, -apart, way);
}

template <int Dim>
void OverlapContact<Dim>::count_stiffness(std::span<LaneVector<double>> least_stretches, double way)
{
  // Faces that meet between two checks would press long before their cells are heavier: those that
  // may are taken to press twice as hard as flush ones do at first.
  constexpr double expected = 2;
  std::vector<double> told(sides_.size(), 0.0);  // as sides_: the stiffness of this rank's cells
  for (const Touched& pair : touched_)
    if (is_with_a_copy(pair.cells))
      told[std::size_t(pair.pair)] = pair.stiffness[pair.cells[0] < cells() ? 0 : 1];
  side_ghosts_.update(told, 1);
  // A contact is as stiff as both of its sides together.
  const auto over_own = [&](LocalIndex own, LocalIndex other) {
    return is_rigid(own) || is_rigid(other)
               ? 1.0
               : stiffness_[std::size_t(other)] / stiffness_[std::size_t(own)];
  };
  std::vector<double> pressed(cells_.size(), 0.0);
  for (const Touched& pair : touched_)
    for (const std::size_t side : {0, 1}) {
      if (pair.cells[side] >= cells()) continue;
      const double other = pair.cells[1 - side] < cells()
                               ? pair.stiffness[1 - side]
                               : told[std::size_t(other_side_[std::size_t(pair.pair)])];
      const double of_other = over_own(pair.cells[side], pair.cells[1 - side]) * other;
      pressed[std::size_t(pair.cells[side])] +=
          pair.share[side] * 0.5 * (pair.stiffness[side] + of_other);
    }
  for (const Pair& pair : pairs_) {
    if (!can_press(pair, way)) continue;
    for (const auto& [cell, other] :
         {std::pair(pair.first, pair.second), {pair.second, pair.first}})
      if (cell < cells())
        pressed[std::size_t(cell)] =
            std::max(pressed[std::size_t(cell)], 0.5 * (1 + over_own(cell, other)) * expected);
  }
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    if (is_rigid(LocalIndex(c))) continue;
    const double harder = (1 + 2 * kappa_ * pressed[c]) / (1 + 2 * kappa_ * borne_contact);
    if (harder > 1)
      least_stretches[std::size_t(cells_[c].body)][std::size_t(cells_[c].particle)] /= harder;
  }
  forget_stiffness();
}

template <int Dim>
void OverlapContact<Dim>::forget_stiffness()
{
  for (const Touched& pair : touched_) touched_at_[std::size_t(pair.pair)] = -1;
  touched_.clear();
  for (Close& pair : close_) pair.touched = -1;
}

template <int Dim>
double OverlapContact<Dim>::overlapped_area() const
{
  double area = 0;
  for (const Touch& touch : touches_) area += 0.5 * touch.overlap;
  return area;
}

template <int Dim>
double OverlapContact<Dim>::deepest_overlap() const
{
  double deepest = 0;
  for (LocalIndex c = 0; c + 1 < LocalIndex(first_touch_.size()); ++c) {
    const std::span<const Touch> touches = touches_of(c);
    const double volume = Overlaps::volume(values_of(c));
    for (const Touch& one : touches) {
      double together = 0;
      for (const Touch& other : touches)
        if (are_of_one_wall(locations_[std::size_t(one.other)],
                            locations_[std::size_t(other.other)]))
          together += other.overlap;
      deepest = std::max(deepest, together / volume);
    }
  }
  return deepest;
}

/// A pair counts half at either cell, as if both were of this rank, and none does for being listed:
/// so it is behind other borders, and where a run goes on with new lists.
template <int Dim>
std::vector<double> OverlapContact<Dim>::counted_work() const
{
  std::vector<double> work(cells_.size(), work_at_surface);
  const auto add = [&](const std::array<LocalIndex, 2>& pair, double amount) {
    for (const LocalIndex cell : pair)
      if (cell < cells()) work[std::size_t(cell)] += 0.5 * amount;
  };
  for (const MeetingCells& pair : near_) add(close_[pair.pair].cells, work_of_near);
  for (const Pressing& pair : pressing_) add(pair.cells, work_of_pressing);
  return work;
}

template <int Dim>
void OverlapContact<Dim>::visit_work(
    const std::function<void(const IndexVec<Dim>&, double)>& visit) const
{
  const std::vector<double> work = work_then_.empty() ? counted_work() : work_then_;
  for (std::size_t c = 0; c < work.size(); ++c) visit(cells_[c].location, work[c]);
}

template <int Dim>
std::size_t OverlapContact<Dim>::bytes() const
{
  return cells_.size() * sizeof(Cell) + outlines_.size() * sizeof(CellOutline) +
         pairs_.capacity() * sizeof(Pair) + close_.capacity() * sizeof(Close) +
         touched_.capacity() * sizeof(Touched) + pressing_.capacity() * sizeof(Pressing) +
         near_.capacity() * sizeof(MeetingCells) + found_.bytes() +
         values_.capacity() * sizeof(double) + boxes_.capacity() * sizeof(Box);
}

template class OverlapContact<2>;
template class OverlapContact<3>;

}  // namespace mpm
