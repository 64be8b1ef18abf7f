#include <mpm/core/formula.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <map>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <muParser.h>

namespace mpm {

namespace {

std::string without_stop(std::string text)
{
  while (text.ends_with('.') || text.ends_with('\n')) text.pop_back();
  return text;
}

}  // namespace

/// The parsers look their variables up here. What a formula uses of the definitions is evaluated
/// before it, in their order; what depends on neither place nor time once only.
struct Formula::Compiled {
  struct Named {
    mu::Parser parser;
    double value = 0;
  };
  std::array<double, 3> place{}, initial_place{};
  double time = 0;
  std::vector<std::unique_ptr<Named>> changing;  ///< in their order
  std::vector<std::unique_ptr<Named>> fixed;
  mu::Parser parser;
  bool uses_initial_place = false;

  Compiled(const std::string& text, int dimensions, const Definitions& definitions)
  {
    compile(parser, text, dimensions, definitions);
  }

  double evaluate()
  {
    for (const auto& named : changing) named->value = named->parser.Eval();
    return parser.Eval();
  }

 private:
  /// Returns whether the value depends on place or time.
  bool compile(mu::Parser& target, const std::string& text, int dimensions,
               const Definitions& definitions)
  {
    for (int d = 0; d < dimensions; ++d) {
      target.DefineVar(std::string(1, "xyz"[d]), &place[std::size_t(d)]);
      target.DefineVar(std::string(1, "XYZ"[d]), &initial_place[std::size_t(d)]);
    }
    target.DefineVar("t", &time);
    target.DefineConst("pi", std::numbers::pi);
    // Those that the text names, and through them others, each once.
    for (const Definition& definition : definitions) target.DefineVar(definition.name, &unknown_);
    target.SetExpr(text);
    const auto used = target.GetUsedVar();
    bool changes = false;
    for (const auto& [name, variable] : used) {
      const bool initial =
          name.size() == 1 && std::string_view("XYZ").find(name[0]) != std::string_view::npos;
      uses_initial_place = uses_initial_place || initial;
      if (variable != &unknown_) {
        changes = true;
        continue;
      }
      const Named& named = found(name, dimensions, definitions);
      target.DefineVar(name, const_cast<double*>(&named.value));
      changes = changes || std::ranges::any_of(this->changing, [&](const auto& held) {
                  return held.get() == &named;
                });
    }
    if (target.Eval(); target.GetNumResults() != 1)
      throw mu::Parser::exception_type("it has several values");
    return changes;
  }

  const Named& found(const std::string& name, int dimensions, const Definitions& definitions)
  {
    if (const auto known = named_.find(name); known != named_.end()) return *known->second;
    const auto at = std::ranges::find(definitions, name, &Definition::name);
    auto named = std::make_unique<Named>();
    const bool changes =
        compile(named->parser, at->text, dimensions, Definitions(definitions.begin(), at));
    named->value = named->parser.Eval();
    named_[name] = named.get();
    return *(changes ? changing : fixed).emplace_back(std::move(named));
  }

  std::map<std::string, const Named*> named_;
  double unknown_ = 0;
};

Formula::Formula(std::string text, int dimensions, const Definitions& definitions)
    : text_(std::move(text))
{
  std::vector<std::string> names;
  for (const Definition& definition : definitions) names.push_back(definition.name + ", ");
  const bool in_space = dimensions == 3;
  const std::string remedy = fmt::format(
      "Use numbers, x, y, {}t, pi, X, Y{} (the place at t = 0), {}+ - * / ^ and functions such as "
      "sin, exp and sqrt; everything in SI units",
      in_space ? "z, " : "", in_space ? ", Z" : "", fmt::join(names, ""));
  try {
    compiled_ = std::make_shared<Compiled>(text_, dimensions, definitions);
  } catch (const mu::Parser::exception_type& error) {
    throw FormulaError("is no formula: " + without_stop(error.GetMsg()), remedy);
  }
}

double Formula::operator()(std::span<const double> place, std::span<const double> initial_place,
                           double time) const
{
  if (!compiled_) return 0;
  std::ranges::copy(place, compiled_->place.begin());
  std::ranges::copy(initial_place, compiled_->initial_place.begin());
  compiled_->time = time;
  return compiled_->evaluate();
}

bool Formula::uses_initial_place() const
{
  return compiled_ && compiled_->uses_initial_place;
}

void check_name(const Definition& definition, const Definitions& others)
{
  const std::string& name = definition.name;
  const std::string remedy = "Use another name, of letters, digits and underscores";
  const bool word =
      !name.empty() && !std::isdigit(static_cast<unsigned char>(name.front())) &&
      std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c) || c == '_'; });
  if (!word) throw FormulaError("is no name for a formula", remedy);
  static const auto taken =
      std::to_array<std::string_view>({"x", "y", "z", "X", "Y", "Z", "t", "pi"});
  if (std::ranges::find(taken, name) != taken.end() || mu::Parser().GetFunDef().contains(name) ||
      std::ranges::find(others, name, &Definition::name) != others.end())
    throw FormulaError("is a name that formulas have already", remedy);
}

}  // namespace mpm
