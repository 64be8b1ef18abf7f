/// mpm_par: start, read, run, and say on one rank what went wrong.

#include <mpm/core/error.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/scene/command_line.hpp>
#include <mpm/scene/reader.hpp>
#include <mpm/simulation/provenance.hpp>
#include <mpm/simulation/run.hpp>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <span>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace {

using namespace mpm;

void print_once(const std::string& text)
{
  if (rank_of(MPI_COMM_WORLD) == 0) fmt::print("{}", text);
}

void refuse_what_cannot_run(const scene::Scene& scene)
{
  if (scene.dimensions != 2)
    throw InputError(scene.file.string() +
                     ": a scene in space can be read, but not run yet. Give specimen.size two "
                     "components, and no specimen.depth.");
  const auto is_periodic = [](scene::Lateral side) { return side == scene::Lateral::periodic; };
  const auto* loading = std::get_if<scene::Loading>(&scene.motion);
  if (loading ? std::ranges::any_of(loading->lateral, is_periodic)
              : std::ranges::any_of(std::get<scene::FreeMotion>(scene.motion).sides, is_periodic))
    throw InputError(
        scene.file.string() +
        ": periodic sides can be read, but not run yet. Use rigid, free or symmetric.");
}

void read_and_run(const scene::CommandLine& command_line)
{
  scene::Scene scene;
  std::optional<micrograph::Picture> picture;
  Layout layout;
  // Every rank reads: the same file gives the same scene, and an unreadable one stops all of them.
  agree(MPI_COMM_WORLD, [&] {
    scene = scene::read_scene(command_line.scene, command_line.overrides);
    refuse_what_cannot_run(scene);
    picture = micrograph::read_picture(scene);
  });
  const auto sum = [](std::span<double> values) { sum_over_ranks(MPI_COMM_WORLD, values); };
  const micrograph::Share share{rank_of(MPI_COMM_WORLD), ranks_of(MPI_COMM_WORLD), sum};
  const micrograph::Specimen<2> specimen(scene, std::move(picture), share);
  agree(MPI_COMM_WORLD, [&] { layout = make_layout(scene, specimen); });
  const Decomposition<2> decomposition =
      make_decomposition(MPI_COMM_WORLD, scene, specimen, layout);
  print_once(plan_text(scene, specimen, layout, decomposition));
  if (!command_line.ranks.empty())
    print_once(rank_study_text(scene, specimen, layout, command_line.ranks));
  if (command_line.check) return;
  run_scene(scene, specimen, layout, decomposition, scene::results_folder(command_line, scene));
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
