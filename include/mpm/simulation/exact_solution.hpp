#pragma once
/// How far a run is from the exact solution that its scene gives.

#include <mpm/output/history.hpp>
#include <mpm/output/summary.hpp>
#include <mpm/simulation/run.hpp>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mpm {

/// Errors over all particles but the load cell's, weighted with mass: the root of the mean square,
/// and the largest. One line of exact_solution.csv per line of the history.
template <int Dim>
class ExactSolution final : public Observer<Dim> {
 public:
  /// Nothing is done for a scene without an exact solution. The preparation lives as long as this.
  ExactSolution(const Preparation<Dim>& preparation, const std::filesystem::path& folder);

  void start(const HistoryKind&) override;
  /// Collective.
  void line(const typename Observer<Dim>::State& state, const HistoryLine& line) override;

  void went_back(const GoingBack& back) override;
  void archive(Archive& archive) override;
  void resumed(const std::vector<HistoryLine>& lines) override;

  /// The errors at the end, and over the largest size of the exact solution in the run.
  void describe(output::Summary& summary) const;
  /// A line for each quantity on the terminal.
  void print() const;

 private:
  enum class Quantity { displacement, velocity, stress };
  struct Comparison {
    Quantity quantity;
    std::string what, unit;
    std::vector<const Formula*> exact;  ///< per component; nullptr: not compared
    /// Of each line: root mean square and largest error, root mean square of the exact solution.
    std::vector<double> error{}, largest_error{}, size{};
    double whole_size() const { return std::ranges::max(size); }
  };
  /// Calls visit(comparison, whether it is its first component, mass, value, exact value) for each
  /// particle.
  template <class Visit>
  void for_each_value(const Body<Dim>& body, const Formulation<Dim>& formulation, double last_step,
                      Visit visit);

  void write_row(std::size_t line, double time);

  const Preparation<Dim>& preparation_;
  std::filesystem::path folder_;
  std::vector<Comparison> comparisons_;
  std::optional<output::HistoryFile> file_;
};

}  // namespace mpm
