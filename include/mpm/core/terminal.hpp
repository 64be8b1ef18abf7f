#pragma once
/// What a person reads as it is printed, and what goes into files and other programs.

#include <string>

namespace mpm {

/// Whether what is written to `descriptor` (1 or 2) reaches a terminal. Under mpirun every rank has
/// a pseudo terminal or a pipe, so the launcher's own output is looked at.
bool is_terminal(int descriptor);

/// A message on stderr: folded at 80 columns for a person, a line for each of its own elsewhere, as
/// editors and logs take them.
void print_message(const std::string& text);

}  // namespace mpm
