#include <mpm/core/bound.hpp>

#include <fmt/format.h>

namespace mpm {

namespace {
std::string lower_text(const End& end)
{
  return fmt::format("{} {}", end.included ? "at least" : "above", end.value);
}
std::string upper_text(const End& end)
{
  return fmt::format("{} {}", end.included ? "at most" : "below", end.value);
}
}  // namespace

std::optional<std::string> Bound::violation(double value) const
{
  if (lower && (lower->included ? !(value >= lower->value) : !(value > lower->value)))
    return "must be " + lower_text(*lower);
  if (upper && (upper->included ? !(value <= upper->value) : !(value < upper->value)))
    return "must be " + upper_text(*upper);
  return std::nullopt;
}

std::string Bound::text() const
{
  std::string text;
  if (lower) text = lower_text(*lower);
  if (upper) text += (text.empty() ? "" : " and ") + upper_text(*upper);
  return text;
}

}  // namespace mpm
