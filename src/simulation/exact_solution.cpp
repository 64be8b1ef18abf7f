#include <mpm/parallel/session.hpp>
#include <mpm/simulation/exact_solution.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace mpm {

template <int Dim>
ExactSolution<Dim>::ExactSolution(const Preparation<Dim>& preparation,
                                  const std::filesystem::path& folder)
    : preparation_(preparation), folder_(folder)
{
  const auto& given = preparation.scene.exact_solution;
  if (!given) return;
  const auto compare = [&](Quantity quantity, const char* what, const char* unit,
                           std::vector<const Formula*> exact) {
    if (std::ranges::any_of(exact, [](const Formula* formula) { return formula != nullptr; }))
      comparisons_.push_back({quantity, what, unit, std::move(exact)});
  };
  const auto axes = [](const std::optional<scene::PerAxis<Formula>>& formulas) {
    std::vector<const Formula*> list;
    for (std::size_t d = 0; formulas && d < std::size_t(Dim); ++d) list.push_back(&(*formulas)[d]);
    return list;
  };
  const auto component = [](const std::optional<Formula>& formula) {
    return formula ? &*formula : nullptr;
  };
  compare(Quantity::displacement, "displacement", "m", axes(given->displacement));
  compare(Quantity::velocity, "velocity", "m/s", axes(given->velocity));
  // In the order of Law::cauchy_stress.
  compare(Quantity::stress, "stress", "Pa",
          {component(given->stress_xx), component(given->stress_yy), component(given->stress_zz),
           component(given->stress_xy), component(given->stress_yz), component(given->stress_xz)});
}

template <int Dim>
void ExactSolution<Dim>::start(const HistoryKind&)
{
  if (comparisons_.empty()) return;
  std::vector<output::HistoryColumn> columns{{"time", "s"}};
  for (const Comparison& c : comparisons_)
    for (const char* what : {"_error", "_largest_error", "_size"})
      columns.push_back({c.what + what, c.unit});
  on_rank_zero(preparation_.comm,
               [&] { file_.emplace(folder_ / "exact_solution.csv", std::move(columns)); });
}

template <int Dim>
template <class Visit>
void ExactSolution<Dim>::for_each_value(const Body<Dim>& body, const Formulation<Dim>& formulation,
                                        double last_step, Visit visit)
{
  const GridGeometry<Dim>& geometry = formulation.decomposition().geometry();
  const ColumnGroup& motion = body.particles.motion();
  const int initial = motion.find("initial_position"), velocity = motion.find("velocity");
  const int mass = motion.find("mass");
  // The positions' time is the step's end; velocities stand where the leap-frog leaves them.
  const double time = formulation.time();
  const double velocity_time = time - formulation.stress_moment() * last_step;
  std::array<double, Dim> place, start;
  alignas(lane_alignment) double stress[6 * lane_count];
  for (LocalIndex p = 0; p < body.particles.size(); ++p) {
    const LocalIndex block = p / lane_count, lane = p % lane_count;
    if (lane == 0) body.law->cauchy_stress(body.particles.state().block(block), stress);
    for (int d = 0; d < Dim; ++d) {
      start[std::size_t(d)] = motion(initial + d, p);
      place[std::size_t(d)] = motion(LeadingColumns<Dim>::position + d, p);
    }
    for (Comparison& c : comparisons_) {
      bool first = true;
      for (std::size_t k = 0; k < c.exact.size(); ++k) {
        if (!c.exact[k]) continue;
        const int column = int(k);
        const double at = c.quantity == Quantity::velocity ? velocity_time : time;
        const double exact = (*c.exact[k])(place, start, at);
        double value = 0;
        if (c.quantity == Quantity::stress) value = stress[column * lane_count + lane];
        if (c.quantity == Quantity::velocity) value = motion(velocity + column, p);
        if (c.quantity == Quantity::displacement) {
          value = place[k] - start[k];
          // How often it went round, its place does not tell: of its images the nearest.
          if (geometry.periodic[k])
            value -=
                geometry.period(column) * std::round((value - exact) / geometry.period(column));
        }
        visit(c, std::exchange(first, false), motion(mass, p), value, exact);
      }
    }
  }
}

template <int Dim>
void ExactSolution<Dim>::line(const typename Observer<Dim>::State& state, const HistoryLine& line)
{
  if (comparisons_.empty()) return;
  // Per comparison: sums of m e^2 and m exact^2; then the mass. Largest squares beside.
  std::vector<double> sums(2 * comparisons_.size() + 1), largest(comparisons_.size());
  double square = 0;  // of one particle's error
  for (const Body<Dim>& body : state.formulation.bodies()) {
    if (body.material >= int(preparation_.scene.materials.size())) continue;  // the load cell
    const int mass = body.particles.motion().find("mass");
    for (LocalIndex p = 0; p < body.particles.size(); ++p)
      sums.back() += body.particles.motion()(mass, p);
    for_each_value(
        body, state.formulation, line.time_step,
        [&](const Comparison& c, bool first_component, double m, double value, double exact) {
          const std::size_t k = std::size_t(&c - comparisons_.data());
          const double error = value - exact;
          square = (first_component ? 0 : square) + error * error;
          sums[2 * k] += m * error * error;
          sums[2 * k + 1] += m * exact * exact;
          largest[k] = std::max(largest[k], square);
        });
  }
  sum_over_ranks(preparation_.comm, sums);
  largest_over_ranks(preparation_.comm, largest);
  for (std::size_t k = 0; k < comparisons_.size(); ++k) {
    Comparison& c = comparisons_[k];
    c.error.push_back(std::sqrt(sums[2 * k] / sums.back()));
    c.largest_error.push_back(std::sqrt(largest[k]));
    c.size.push_back(std::sqrt(sums[2 * k + 1] / sums.back()));
  }
  on_rank_zero(preparation_.comm,
               [&] { write_row(comparisons_.front().error.size() - 1, line.time); });
}

/// By rank 0.
template <int Dim>
void ExactSolution<Dim>::write_row(std::size_t line, double time)
{
  std::vector<double> row{time};
  for (const Comparison& c : comparisons_)
    row.insert(row.end(), {c.error[line], c.largest_error[line], c.size[line]});
  file_->append(row);
}

template <int Dim>
void ExactSolution<Dim>::archive(Archive& archive)
{
  for (std::size_t k = 0; k < comparisons_.size(); ++k) {
    const Archive::Section section(archive, "comparison" + std::to_string(k));
    archive.list("error", comparisons_[k].error);
    archive.list("largest_error", comparisons_[k].largest_error);
    archive.list("size", comparisons_[k].size);
  }
}

template <int Dim>
void ExactSolution<Dim>::resumed(const std::vector<HistoryLine>& lines)
{
  if (comparisons_.empty()) return;
  on_rank_zero(preparation_.comm, [&] {
    for (std::size_t k = 0; k < lines.size(); ++k) write_row(k, lines[k].time);
  });
}

template <int Dim>
void ExactSolution<Dim>::went_back(const GoingBack& back)
{
  if (comparisons_.empty()) return;
  for (Comparison& c : comparisons_)
    for (std::vector<double>* lines : {&c.error, &c.largest_error, &c.size})
      lines->resize(back.lines);
  on_rank_zero(preparation_.comm, [&] { file_->cut(back.lines); });
}

template <int Dim>
void ExactSolution<Dim>::describe(output::Summary& summary) const
{
  if (comparisons_.empty()) return;
  output::Summary& section = summary.section("exact_solution");
  for (const Comparison& c : comparisons_) {
    section.set(c.what + "_error", c.error.back());
    section.set(c.what + "_largest_error", c.largest_error.back());
    section.set(c.what + "_relative_error", c.error.back() / c.whole_size());
    section.set(c.what + "_worst_relative_error", std::ranges::max(c.error) / c.whole_size());
  }
}

template <int Dim>
void ExactSolution<Dim>::print() const
{
  for (const Comparison& c : comparisons_)
    fmt::print("{:<24} {:8.3g} % of the exact solution, at worst {:.3g} %\n", c.what + " error",
               100 * c.error.back() / c.whole_size(),
               100 * std::ranges::max(c.error) / c.whole_size());
}

template class ExactSolution<2>;
template class ExactSolution<3>;

}  // namespace mpm
