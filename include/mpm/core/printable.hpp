#pragma once
/// What a user wrote, fit to be repeated in a message, a file or a title.

#include <optional>
#include <string>
#include <string_view>

namespace mpm {

/// What keeps a text from being printed as it stands: bytes that are no UTF-8 (RFC 3629), or
/// control characters other than tab and line ends. Nothing if it can be.
std::optional<std::string> unprintable(std::string_view text);

/// On one line, and cut off with dots behind at most `longest` bytes, between two characters.
std::string shortened(std::string text, std::size_t longest = 60);

}  // namespace mpm
