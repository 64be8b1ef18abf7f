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

constexpr std::array<const char*, 6> single_files{"history.csv",        "summary.json",
                                                  "exact_solution.csv", "scene.yaml",
                                                  "specimen.png",       "report.html"};

/// Folders of states.
constexpr std::array<const char*, 2> parts{"snapshots", "checkpoints"};

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
  for (const std::filesystem::path& place : files())
    for (const std::filesystem::path& input : inputs) {
      std::error_code none;
      if (std::filesystem::equivalent(input, place, none) &&
          !is_effective_scene(place, effective_scene))
        throw InputError(
            fmt::format("{}: the run reads this file, and would put its results in its place. "
                        "Choose another folder with --output.",
                        place.string()));
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

std::vector<std::filesystem::path> ResultsFolder::files() const
{
  std::vector<std::filesystem::path> found = files_of_report();
  const auto add = [&](const std::filesystem::path& folder, const char* ending) {
    const std::vector<std::filesystem::path> more = files_ending(folder, ending);
    found.insert(found.end(), more.begin(), more.end());
  };
  for (const std::filesystem::path& folder : {folder_, folder_ / "failure"}) {
    add(folder, ".xdmf");
    for (const char* part : parts) add(folder / part, ".h5");
  }
  for (const char* name : single_files)
    if (std::filesystem::exists(folder_ / name)) found.push_back(folder_ / name);
  return found;
}

std::vector<std::filesystem::path> ResultsFolder::files_of_report() const
{
  std::vector<std::filesystem::path> found;
  for (const char* ending : {".png", ".svg"})
    for (const std::filesystem::path& file : files_ending(folder_ / "report", ending))
      found.push_back(file);
  return found;
}

bool ResultsFolder::holds_a_run() const
{
  return !files().empty();
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
  for (const std::filesystem::path& file : files_of_report()) remove(file);
  std::error_code kept;  // with what else stands there
  std::filesystem::remove(folder_ / "report", kept);
}

void ResultsFolder::clear() const
{
  for (const std::filesystem::path& file : files()) remove(file);
  std::error_code kept;  // with what else stands there
  for (const std::filesystem::path& folder : {folder_, folder_ / "failure"})
    for (const char* part : parts) std::filesystem::remove(folder / part, kept);
  for (const char* folder : {"failure", "report"}) std::filesystem::remove(folder_ / folder, kept);
}

}  // namespace mpm
