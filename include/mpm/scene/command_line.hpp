#pragma once
/// What the user asks of mpm_par on the command line.

#include <mpm/scene/scene.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace mpm::scene {

struct CommandLine {
  std::filesystem::path scene;
  std::optional<std::filesystem::path> output;      ///< --output
  bool check = false;                               ///< --check: print the plan, leave no results
  std::optional<std::filesystem::path> preview;     ///< --preview: picture of the specimen
  std::vector<int> ranks;                           ///< --ranks: numbers of ranks to study
  std::vector<std::string> overrides;               ///< --set
  bool restart = false;                             ///< --restart: from the newest checkpoint
  std::optional<std::filesystem::path> checkpoint;  ///< or from the one named
  bool overwrite = false;                           ///< --overwrite: results of another run
  std::optional<double> time_limit;                 ///< --time-limit, s
  bool report = false;                              ///< --report: leave a page behind
  bool quiet = false;                               ///< --quiet: warnings and errors alone
  bool self_test = false;                           ///< --self-test: of the machine, no scene
  std::vector<std::string> petsc;  ///< options for PETSc with their values, in order
};

/// A question answered without a run (--help, --version, --input-reference): print on one rank and
/// end with status 0.
struct Answer {
  std::string text;
};

/// `arguments` without the program's name; `version` is the answer to --version. Throws InputError
/// on wrong usage.
std::variant<CommandLine, Answer> parse_command_line(const std::vector<std::string>& arguments,
                                                     const std::string& version);

/// Where the results go: --output, or results/NAME.
std::filesystem::path results_folder(const CommandLine& command_line, const Scene& scene);

}  // namespace mpm::scene
