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

/// Of x, y, in space z (m) and t (s), with a value in SI units. Compiled once; copies share what
/// was compiled, so that only one thread may evaluate them.
class Formula {
 public:
  /// Zero everywhere.
  Formula() = default;
  /// Throws FormulaError.
  Formula(std::string text, int dimensions);

  /// `place`: as many coordinates as the formula has dimensions.
  double operator()(std::span<const double> place, double time) const;
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

}  // namespace mpm
