#pragma once
/// The sides of an upright box.

#include <array>
#include <string_view>

namespace mpm {

/// The lower and upper side of each axis: x, y, z. The last two belong to space.
enum class Side { left, right, bottom, top, back, front };
inline constexpr std::array<std::string_view, 6> side_words{"left", "right", "bottom",
                                                            "top",  "back",  "front"};

constexpr int axis_of(Side side)
{
  return int(side) / 2;
}
constexpr bool upper_of(Side side)
{
  return int(side) % 2 == 1;
}

}  // namespace mpm
