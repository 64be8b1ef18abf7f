#pragma once
/// From the YAML library's nodes to ours; the only header that knows both.

#include <mpm/scene/document.hpp>

#include <string>

namespace mpm::scene {

/// One YAML document from text. `single_place`: everything is at `origin` itself, without lines.
/// Throws InputError.
Node parse_yaml(const std::string& text, const std::string& origin, bool single_place);

}  // namespace mpm::scene
