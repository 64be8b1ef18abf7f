#pragma once
/// How much memory there is.

#include <string>

namespace mpm {

/// Bytes that this process could have if no other one needed any: of the machine, of the control
/// group (as containers and schedulers set it) and of `ulimit -v`, the least.
double memory_limit();

/// `4.1 GB`
std::string memory_text(double bytes);

}  // namespace mpm
