/// mpm_par: start, read, run, and say on one rank what went wrong.

#include <mpm/core/error.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/scene/command_line.hpp>
#include <mpm/scene/reader.hpp>
#include <mpm/simulation/provenance.hpp>
#include <mpm/simulation/run.hpp>

#include <cstdio>
#include <optional>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace {

using namespace mpm;

void print_once(const std::string& text)
{
  if (rank_of(MPI_COMM_WORLD) == 0) fmt::print("{}", text);
}

template <int Dim>
void plan_and_run(const scene::CommandLine& command_line, const scene::Scene& scene,
                  std::optional<micrograph::Picture> picture)
{
  const Preparation<Dim> preparation(MPI_COMM_WORLD, scene, std::move(picture));
  print_once(plan_text(preparation));
  if (!command_line.ranks.empty() && rank_of(MPI_COMM_WORLD) == 0)
    print_once(rank_study_text(preparation, command_line.ranks));
  if (command_line.check) return;
  std::vector<std::filesystem::path> pictures;
  if (scene.specimen.micrograph) pictures.push_back(scene.specimen.micrograph->file);
  run_in_folder(preparation, {scene::results_folder(command_line, scene), command_line.restart,
                              command_line.checkpoint, command_line.overwrite,
                              command_line.time_limit, command_line.scene, std::move(pictures)});
}

void read_and_run(const scene::CommandLine& command_line)
{
  scene::Scene scene;
  std::optional<micrograph::Picture> picture;
  // Every rank reads: the same file gives the same scene, and an unreadable one stops all of them.
  agree(MPI_COMM_WORLD, [&] {
    scene = scene::read_scene(command_line.scene, command_line.overrides);
    picture = micrograph::read_picture(scene);
  });
  if (scene.dimensions == 2)
    plan_and_run<2>(command_line, scene, std::move(picture));
  else
    plan_and_run<3>(command_line, scene, std::move(picture));
}

int report(ExitStatus status, const char* what)
{
  if (rank_of(MPI_COMM_WORLD) == 0) {
    std::fflush(stdout);
    fmt::print(stderr, "{}\n", what);
  }
  return int(status);
}

int run(const std::variant<scene::CommandLine, scene::Answer>& asked)
{
  try {
    if (const auto* answer = std::get_if<scene::Answer>(&asked))
      print_once(answer->text);
    else
      read_and_run(std::get<scene::CommandLine>(asked));
    return int(ExitStatus::done);
  } catch (const InputError& error) {
    return report(ExitStatus::bad_input, error.what());
  } catch (const NumericalError& error) {
    return report(ExitStatus::numerical_failure, error.what());
  } catch (const Interruption& interruption) {
    return report(ExitStatus::interrupted, interruption.what());
  } catch (const FileError& error) {
    return report(ExitStatus::file_failure, error.what());
  } catch (const std::exception& error) {
    // Not foreseen, and perhaps on this rank only: the others must not wait for it.
    fmt::print(stderr, "rank {}: {}\n", rank_of(MPI_COMM_WORLD), error.what());
    MPI_Abort(MPI_COMM_WORLD, 1);
    return 1;
  }
}

}  // namespace

int main(int argc, char** argv)
{
  std::variant<scene::CommandLine, scene::Answer> asked;
  std::string wrong_usage;
  std::vector<std::string> petsc;
  try {
    asked = scene::parse_command_line({argv + 1, argv + argc}, version_text());
    if (const auto* command_line = std::get_if<scene::CommandLine>(&asked))
      petsc = command_line->petsc;
  } catch (const InputError& error) {
    wrong_usage = error.what();
  }
  const Session session(argc, argv, petsc);
  spdlog::set_pattern("%l: %v");
  if (!wrong_usage.empty()) return report(ExitStatus::bad_input, wrong_usage.c_str());
  return run(asked);
}
