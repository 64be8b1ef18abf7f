#pragma once
/// Expressions of place and time, as a scene gives them.

#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace mpm {

/// A text that is no formula: what() says why.
class FormulaError : public std::runtime_error {
 public:
  FormulaError(const std::string& reason, std::string remedy)
      : std::runtime_error(reason), remedy_(std::move(remedy))
  {
  }
  const std::string& remedy() const { return remedy_; }

 private:
  std::string remedy_;
};

/// A name that formulas may use for another formula.
struct Definition {
  std::string name;
  std::string text;
  bool operator==(const Definition&) const = default;
};
/// Each may use those before it.
using Definitions = std::vector<Definition>;

/// Of x, y, in space z (m), of the place X, Y, Z at t = 0 (m), of t (s) and of defined names, with a
/// value in SI units. Compiled once; copies share what was compiled, so that only one thread may
/// evaluate them.
class Formula {
 public:
  /// Zero everywhere.
  Formula() = default;
  /// Throws FormulaError.
  Formula(std::string text, int dimensions, const Definitions& definitions = {});

  /// `place`: as many coordinates as the formula has dimensions; `initial_place` the same.
  double operator()(std::span<const double> place, std::span<const double> initial_place,
                    double time) const;
  /// Of something that is where it was at t = 0.
  double operator()(std::span<const double> place, double time) const
  {
    return (*this)(place, place, time);
  }
  bool uses_initial_place() const;
  const std::string& text() const { return text_; }
  /// Word for word.
  friend bool operator==(const Formula& a, const Formula& b) { return a.text_ == b.text_; }

 private:
  struct Compiled;

  std::string text_ = "0";
  std::shared_ptr<Compiled> compiled_;
};

/// One per axis.
using Formulas = std::vector<Formula>;

/// Throws FormulaError if it is a name that formulas have already, or no name at all.
void check_name(const Definition& definition, const Definitions& others);

}  // namespace mpm
