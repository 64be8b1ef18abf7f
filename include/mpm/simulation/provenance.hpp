#pragma once
#include <string>
#include <utility>
#include <vector>

namespace mpm {

/// What the program was built from and with: name and version, git hash first.
std::vector<std::pair<std::string, std::string>> provenance();
/// The same as the text of --version.
std::string version_text();

}  // namespace mpm
