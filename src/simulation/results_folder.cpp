#include <mpm/core/error.hpp>
#include <mpm/output/replace_file.hpp>
#include <mpm/simulation/results_folder.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>

namespace mpm {

namespace {

constexpr std::array<const char*, 6> files_of_a_run{"history.csv",        "summary.json",
                                                    "exact_solution.csv", "scene.yaml",
                                                    "specimen.png",       "report.html"};

/// Without the title of an effective scene, which names the file that it was made of.
std::string without_title(const std::string& text)
{
  return text.starts_with('#') ? text.substr(std::min(text.find('\n'), text.size())) : text;
}

bool is_effective_scene(const std::filesystem::path& file, const std::string& effective_scene)
{
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return without_title(text.str()) == without_title(effective_scene);
}

/// Files of a folder with one of these endings; none if there is no such folder.
std::vector<std::filesystem::path> files_ending(const std::filesystem::path& folder,
                                                std::string_view ending)
{
  std::vector<std::filesystem::path> found;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(ending) || name.ends_with(std::string(ending) + ".part"))
      found.push_back(entry.path());
  }
  return found;
}

}  // namespace

void ResultsFolder::expect_no_input(std::span<const std::filesystem::path> inputs,
                                    const std::string& effective_scene) const
{
  for (const std::filesystem::path& input : inputs)
    for (const char* name : files_of_a_run) {
      const std::filesystem::path place = folder_ / name;
      std::error_code none;
      if (std::filesystem::equivalent(input, place, none) &&
          !is_effective_scene(place, effective_scene))
        throw InputError(fmt::format(
            "{}: the run reads this file, and would write its {} there. Choose another folder with "
            "--output.",
            place.string(), name));
    }
}

void ResultsFolder::expect_no_run() const
{
  if (!holds_a_run()) return;
  std::optional<output::FolderLock> free;
  if (!lock_) free.emplace(folder_);  // if a run is writing there, that is what to say
  throw InputError(fmt::format(
      "{}: holds the results of a run. Replace them with --overwrite, go on with that run with "
      "--restart, or choose another folder with --output.",
      folder_.string()));
}

void ResultsFolder::expect_same_run(const std::filesystem::path& checkpoint) const
{
  std::error_code none;
  if (holds_a_run() &&
      !std::filesystem::equivalent(std::filesystem::absolute(checkpoint).parent_path(),
                                   folder_ / "checkpoints", none))
    throw InputError(fmt::format(
        "{}: holds the results of a run, and {} is not among its checkpoints. Choose another "
        "folder with --output.",
        folder_.string(), checkpoint.string()));
}

void ResultsFolder::start_anew(bool overwrite)
{
  occupy();
  if (!overwrite) expect_no_run();
  if (holds_a_run()) clear();
}

void ResultsFolder::go_on()
{
  occupy();
  remove(folder_ / "summary.json");
  clear_report();
  // Of whatever name the run had: the state that they name is taken away.
  for (const std::filesystem::path& list : files_ending(folder_ / "failure", ".xdmf")) remove(list);
}

void ResultsFolder::occupy()
{
  output::make_directory(folder_);
  lock_.emplace(folder_);
}

bool ResultsFolder::holds_a_run() const
{
  return std::ranges::any_of(
             files_of_a_run,
             [&](const char* name) { return std::filesystem::exists(folder_ / name); }) ||
         !files_ending(folder_ / "checkpoints", ".h5").empty();
}

void ResultsFolder::remove(const std::filesystem::path& file) const
{
  std::error_code failure;
  std::filesystem::remove(file, failure);
  if (failure)
    throw FileError(fmt::format("{}: cannot be removed ({}). Choose another folder with --output.",
                                file.string(), failure.message()));
}

void ResultsFolder::clear_report() const
{
  remove(folder_ / "report.html");
  for (const char* ending : {".png", ".svg"})
    for (const std::filesystem::path& file : files_ending(folder_ / "report", ending)) remove(file);
  std::error_code kept;  // with what else stands there
  std::filesystem::remove(folder_ / "report", kept);
}

void ResultsFolder::clear() const
{
  clear_report();
  const std::filesystem::path failure = folder_ / "failure";
  for (const std::filesystem::path& folder : {folder_, failure}) {
    for (const std::filesystem::path& list : files_ending(folder, ".xdmf")) remove(list);
    for (const char* part : {"snapshots", "checkpoints"}) {
      for (const std::filesystem::path& file : files_ending(folder / part, ".h5")) remove(file);
      std::error_code kept;  // with what else stands there
      std::filesystem::remove(folder / part, kept);
    }
  }
  std::error_code kept;
  std::filesystem::remove(failure, kept);
  for (const char* name : files_of_a_run) remove(folder_ / name);
}

}  // namespace mpm
