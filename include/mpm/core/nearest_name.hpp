#pragma once
/// "Did you mean": the name a misspelt word most likely stands for.

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace mpm {

/// Number of single-letter changes (insert, remove, replace, swap two neighbours) from `a` to `b`;
/// letters that differ in case only count as equal.
int edit_distance(std::string_view a, std::string_view b);

/// The nearest of `names`, or nothing when more than a third of the word would have to change.
std::optional<std::string> nearest_name(std::string_view word, std::span<const std::string> names);

/// `did you mean 'x'?`, or, with nothing near, `known: a, b, c`.
std::string suggestion(std::string_view word, std::span<const std::string> names);

}  // namespace mpm
