#include <mpm/core/formula.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>

#include <fmt/format.h>
#include <muParser.h>

namespace mpm {

/// The parser looks its variables up here.
struct Formula::Compiled {
  mu::Parser parser;
  std::array<double, 3> place{};
  double time = 0;

  Compiled(const std::string& text, int dimensions)
  {
    for (int d = 0; d < dimensions; ++d)
      parser.DefineVar(std::string(1, "xyz"[d]), &place[std::size_t(d)]);
    parser.DefineVar("t", &time);
    parser.DefineConst("pi", std::numbers::pi);
    parser.SetExpr(text);
    parser.Eval();
  }
};

Formula::Formula(std::string text, int dimensions) : text_(std::move(text))
{
  const std::string remedy = fmt::format(
      "Use numbers, x, y, {}t, pi, + - * / ^ and functions such as sin, exp and sqrt; "
      "everything in SI units",
      dimensions == 3 ? "z, " : "");
  try {
    compiled_ = std::make_shared<Compiled>(text_, dimensions);
  } catch (const mu::Parser::exception_type& error) {
    std::string reason = error.GetMsg();
    while (reason.ends_with('.') || reason.ends_with('\n')) reason.pop_back();
    throw FormulaError("is no formula: " + reason, remedy);
  }
  if (compiled_->parser.GetNumResults() != 1)
    throw FormulaError("is no formula: it has several values", remedy);
}

double Formula::operator()(std::span<const double> place, double time) const
{
  if (!compiled_) return 0;
  std::ranges::copy(place, compiled_->place.begin());
  compiled_->time = time;
  return compiled_->parser.Eval();
}

}  // namespace mpm
