#pragma once
/// The range a parameter may lie in, and the words for it.

#include <limits>
#include <optional>
#include <string>

namespace mpm {

/// One end of a range, in SI units.
struct End {
  double value;
  bool included;
  bool operator==(const End&) const = default;
};

struct Bound {
  std::optional<End> lower{}, upper{};

  /// `must be above 0`, naming the end that `value` breaks; nothing if it lies within.
  std::optional<std::string> violation(double value) const;
  /// `above -1 and below 0.5`; empty without ends.
  std::string text() const;
  bool operator==(const Bound&) const = default;
};

constexpr Bound anything()
{
  return {};
}
constexpr Bound above(double lower)
{
  return {End{lower, false}, std::nullopt};
}
constexpr Bound at_least(double lower)
{
  return {End{lower, true}, std::nullopt};
}
/// Both ends excluded.
constexpr Bound between(double lower, double upper)
{
  return {End{lower, false}, End{upper, false}};
}
/// The lower end included, the upper one not.
constexpr Bound from_below(double lower, double upper)
{
  return {End{lower, true}, End{upper, false}};
}
/// Both ends included.
constexpr Bound from_to(double lower, double upper)
{
  return {End{lower, true}, End{upper, true}};
}

}  // namespace mpm
