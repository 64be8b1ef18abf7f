#pragma once
/// The page that mpm_report makes of a folder of results, as the last thing of a run.

#include <filesystem>
#include <string>

namespace mpm {

/// Starts the mpm_report beside this program and waits for it; on one rank, after MPI has ended.
/// `remark`, if there is one, is what the run said of its end. What goes wrong is one line on the
/// terminal and nothing else: the results are there with or without their page.
void leave_report(const std::filesystem::path& results, const std::string& remark);

}  // namespace mpm
