/// mpm_par: start, read, run, and say on one rank what went wrong.

#include <mpm/core/error.hpp>
#include <mpm/core/folded.hpp>
#include <mpm/core/interruption.hpp>
#include <mpm/core/memory.hpp>
#include <mpm/core/terminal.hpp>
#include <mpm/micrograph/preview.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/scene/command_line.hpp>
#include <mpm/scene/reader.hpp>
#include <mpm/simulation/leave_report.hpp>
#include <mpm/simulation/long_stage.hpp>
#include <mpm/simulation/provenance.hpp>
#include <mpm/simulation/run.hpp>
#include <mpm/simulation/self_test.hpp>
#include <mpm/simulation/step_measurement.hpp>

#include <cstdio>
#include <memory>
#include <new>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

namespace {

using namespace mpm;

/// What is logged, folded at 80 columns for a person.
class FoldedText final : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&,
              spdlog::memory_buf_t& to) override
  {
    std::string text(message.payload.data(), message.payload.size());
    if (on_terminal_) text = folded(text, std::string_view("warning: ").size());
    to.append(text.data(), text.data() + text.size());
  }
  std::unique_ptr<custom_flag_formatter> clone() const override
  {
    return std::make_unique<FoldedText>();
  }

 private:
  bool on_terminal_ = is_terminal(STDOUT_FILENO);
};

std::unique_ptr<spdlog::formatter> warning_format()
{
  auto format = std::make_unique<spdlog::pattern_formatter>();
  format->add_flag<FoldedText>('*').set_pattern("%l: %*");
  return format;
}

/// Starting thousands of ranks takes a minute on some machines.
constexpr int seconds_of_a_check = 180;

void print_once(const std::string& text)
{
  if (rank_of(MPI_COMM_WORLD) == 0) fmt::print("{}", text);
}

/// Does it, and says so where it takes long.
template <class Action>
auto in_stage(const scene::CommandLine& command_line, const char* what, Action&& action)
{
  std::optional<LongStage> stage;
  if (!command_line.quiet && rank_of(MPI_COMM_WORLD) == 0) stage.emplace(what);
  return action();
}

/// Of steps, to say how long a run takes.
constexpr double seconds_of_measurement = 1;

/// How the program ends, on this rank.
struct Ending {
  int status = int(ExitStatus::done);
  std::string message{};            ///< what was wrong; empty if nothing was
  std::filesystem::path results{};  ///< of a run that has begun; empty without one
};

/// The specimen as it was understood. Collective.
template <int Dim>
void leave_preview(const Preparation<Dim>& preparation, const std::filesystem::path& file)
{
  on_rank_zero(preparation.comm, [&] {
    std::vector<std::filesystem::path> read;
    if (const auto& micrograph = preparation.scene.specimen.micrograph)
      read = micrograph::files_of_image(micrograph->file);
    std::error_code none;
    for (const std::filesystem::path& picture : read)
      if (std::filesystem::equivalent(picture, file, none))
        throw InputError(fmt::format(
            "--preview {} is the micrograph of the scene. Name another file.", file.string()));
    micrograph::write_preview(preparation.specimen, file);
  });
}

template <int Dim>
void plan_and_run(const scene::CommandLine& command_line, const scene::Scene& scene,
                  std::optional<micrograph::Picture> picture, Ending& ending)
{
  const Preparation<Dim> preparation = in_stage(command_line, "looking at the specimen", [&] {
    return Preparation<Dim>(MPI_COMM_WORLD, scene, std::move(picture));
  });
  std::optional<StepMeasurement> measured;
  if (command_line.check && !command_line.quiet)
    measured = in_stage(command_line, "measuring a second of steps",
                        [&] { return measure_steps(preparation, seconds_of_measurement); });
  if (rank_of(MPI_COMM_WORLD) == 0) {
    if (command_line.quiet) {
      for (const std::string& warning : preparation.warnings) spdlog::warn(warning);
    } else {
      fmt::print("{}", plan_text(preparation, measured ? &*measured : nullptr));
      if (!command_line.ranks.empty())
        fmt::print("{}", rank_study_text(preparation, command_line.ranks));
    }
  }
  if (command_line.preview) leave_preview(preparation, *command_line.preview);
  if (command_line.check) return;
  if (const double share = share_of_memory(preparation); share > 1)
    throw InputError(
        fmt::format("{}: takes {} of memory and more, {:.3g} times what there is. Give fewer "
                    "grid.cells, or use more machines.",
                    command_line.scene.string(), memory_text(preparation.plan.bytes()), share));
  std::vector<std::filesystem::path> pictures;
  if (scene.specimen.micrograph)
    pictures = micrograph::files_of_image(scene.specimen.micrograph->file);
  ending.results = scene::results_folder(command_line, scene);
  run_in_folder(preparation, {ending.results, command_line.restart, command_line.checkpoint,
                              command_line.overwrite, command_line.time_limit, command_line.scene,
                              std::move(pictures), command_line.quiet});
}

void read_and_run(const scene::CommandLine& command_line, Ending& ending)
{
  scene::Scene scene;
  std::optional<micrograph::Picture> picture;
  // Every rank reads: the same file gives the same scene, and an unreadable one stops all of them.
  in_stage(command_line, "reading the scene and its picture", [&] {
    agree(MPI_COMM_WORLD, [&] {
      scene = scene::read_scene(command_line.scene, command_line.overrides);
      picture = micrograph::read_picture(scene);
    });
  });
  if (scene.dimensions == 2)
    plan_and_run<2>(command_line, scene, std::move(picture), ending);
  else
    plan_and_run<3>(command_line, scene, std::move(picture), ending);
}

/// All ranks, with the words of this one.
void end_alone(int status, const std::string& what)
{
  print_message(fmt::format("rank {}: {}", rank_of(MPI_COMM_WORLD), what));
  MPI_Abort(MPI_COMM_WORLD, status);
}

/// How the program ends after an error: all ranks together, or at once where this one is alone.
class Endings {
 public:
  Endings() { MPI_Comm_dup(MPI_COMM_WORLD, &comm_); }
  ~Endings() { MPI_Comm_free(&comm_); }
  Endings(const Endings&) = delete;
  Endings& operator=(const Endings&) = delete;

  void report(Ending& ending, ExitStatus status, const char* what) const
  {
    ending.status = int(status);
    ending.message = what;
    const int rank = rank_of(comm_);
    std::fflush(stdout);
    if (rank == 0) print_message(what);
    if (all_arrive(comm_, seconds_of_ending)) return;
    if (rank != 0) end_alone(int(status), what);
    MPI_Abort(MPI_COMM_WORLD, int(status));
  }

 private:
  static constexpr double seconds_of_ending = 60;

  MPI_Comm comm_ = MPI_COMM_NULL;
};

/// Status 1: something is wrong that is no run's.
int test_machine(const scene::CommandLine& command_line, const std::optional<Launched>& launched,
                 SelfTestLimit& limit)
{
  const SelfTestRequest request{command_line.output.value_or(std::filesystem::current_path()),
                                command_line.quiet, launched};
  return self_test(MPI_COMM_WORLD, request, limit) ? 0 : 1;
}

Ending run(const std::variant<scene::CommandLine, scene::Answer>& asked,
           const std::optional<Launched>& launched, std::optional<SelfTestLimit>& limit,
           const Endings& endings)
{
  Ending ending;
  try {
    if (const auto* answer = std::get_if<scene::Answer>(&asked)) {
      print_once(answer->text);
      return ending;
    }
    const auto& command_line = std::get<scene::CommandLine>(asked);
    if (command_line.self_test)
      ending.status = test_machine(command_line, launched, *limit);
    else
      read_and_run(command_line, ending);
  } catch (const InputError& error) {
    endings.report(ending, ExitStatus::bad_input, error.what());
  } catch (const NumericalError& error) {
    endings.report(ending, ExitStatus::numerical_failure, error.what());
  } catch (const Interruption& interruption) {
    endings.report(ending, ExitStatus::interrupted, interruption.what());
  } catch (const FileError& error) {
    endings.report(ending, ExitStatus::file_failure, error.what());
  } catch (const std::bad_alloc&) {
    end_alone(1, fmt::format("there is no memory left of {}. Give fewer grid.cells, or use more "
                             "machines (mpm_par --check says what a scene takes).",
                             memory_text(memory_limit())));
  } catch (const std::exception& error) {
    // Not foreseen, and perhaps on this rank only: the others must not wait for it.
    end_alone(1, error.what());
  }
  return ending;
}

bool leaves_report(const std::variant<scene::CommandLine, scene::Answer>& asked,
                   const Ending& ending)
{
  const auto* command_line = std::get_if<scene::CommandLine>(&asked);
  return command_line && command_line->report && !ending.results.empty() &&
         ending.status != int(ExitStatus::bad_input) &&
         ending.status != int(ExitStatus::file_failure);
}

}  // namespace

int main(int argc, char** argv)
{
  std::variant<scene::CommandLine, scene::Answer> asked;
  std::string wrong_usage;
  std::vector<std::string> petsc;
  std::optional<SelfTestLimit> limit;
  const std::optional<Launched> from = launched();
  try {
    asked = scene::parse_command_line({argv + 1, argv + argc}, version_text());
    if (const auto* command_line = std::get_if<scene::CommandLine>(&asked)) {
      petsc = command_line->petsc;
      if (command_line->self_test)
        limit.emplace(seconds_of_a_check, "start of MPI");
      else if (!command_line->check)
        watch_for_interruptions();
    }
  } catch (const InputError& error) {
    wrong_usage = error.what();
  }
  Ending ending;
  int rank = 0;
  {
    const Session session(argc, argv, petsc);
    rank = rank_of(MPI_COMM_WORLD);
    spdlog::set_formatter(warning_format());
    const Endings endings;
    if (wrong_usage.empty())
      ending = run(asked, from, limit, endings);
    else
      endings.report(ending, ExitStatus::bad_input, wrong_usage.c_str());
  }
  if (!leaves_report(asked, ending)) return ending.status;
  // A launcher ends all ranks once one of them ends with another status than 0, and rank 0 would
  // not come to the end of its report: the status is its to give.
  if (rank != 0) return int(ExitStatus::done);
  leave_report(ending.results, ending.message);
  return ending.status;
}
