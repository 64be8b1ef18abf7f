#pragma once
/// Text for a terminal of 80 columns.

#include <string>

namespace mpm {

/// Words in lines that end before column 80, those after the first behind `indent` blanks; the
/// first begins behind as much that stands there already. A word is never cut.
std::string folded(const std::string& text, std::size_t indent);

/// Each line of a message folded by itself if it is longer than that, four blanks further in.
std::string folded_message(const std::string& text);

}  // namespace mpm
