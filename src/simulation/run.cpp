#include <mpm/core/error.hpp>
#include <mpm/core/interruption.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/simulation/checkpoints.hpp>
#include <mpm/simulation/failure_cause.hpp>
#include <mpm/simulation/kept_state.hpp>
#include <mpm/simulation/method.hpp>
#include <mpm/simulation/result_warnings.hpp>
#include <mpm/simulation/run.hpp>
#include <mpm/stepping/load_balance.hpp>
#include <mpm/stepping/time_step.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

namespace mpm {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

template <int Dim>
class Run {
 public:
  using State = typename Observer<Dim>::State;

  Run(const Preparation<Dim>& preparation, std::span<Observer<Dim>* const> observers,
      Continuation continuation)
      : Run(preparation, observers, std::move(continuation),
            Decomposition<Dim>(preparation.comm, preparation.partition.ownership))
  {
  }

  RunResult run()
  {
    // What a state that is refused would go on from stays as it is.
    const bool goes_on = continuation_.state != nullptr;
    if (goes_on) take_up();
    tell([&](Observer<Dim>& observer, const State&) { observer.start(history_.kind()); });
    if (goes_on)
      resume();
    else
      begin();
    schedule_.start(stepper_->steps(), state().strain, seconds_since(start_));
    counted_ = Clock::now();
    observed_ = result_.observer_seconds;
    while (!finished_at(stepper_->time(), stepper_->steps())) try {
        advance();
      } catch (const NumericalError& error) {
        go_back(error);
      }
    count_step_seconds();
    for (Observer<Dim>* observer : observers_) observer->finish();
    fill_result();
    return std::move(result_);
  }

 private:
  Run(const Preparation<Dim>& preparation, std::span<Observer<Dim>* const> observers,
      Continuation continuation, const Decomposition<Dim>& decomposition)
      : start_(Clock::now()),
        preparation_(preparation),
        comm_(preparation.comm),
        scene_(preparation.scene),
        layout_(preparation.layout),
        observers_(observers),
        continuation_(std::move(continuation)),
        checkpoints_(continuation_.results),
        schedule_(scene_.output.checkpoints),
        model_(make_model(scene_, preparation.specimen, layout_, decomposition)),
        time_step_(time_step_of(layout_)),
        stepper_(make_formulation(scene_, layout_, decomposition, std::move(model_))),
        balance_(partition_rules<Dim>(scene_), scene_.numerics.repartition_interval),
        history_(*stepper_, model_.apparatus, layout_.largest_speed),
        keeps_(retries() || std::ranges::any_of(observers_, [](const Observer<Dim>* observer) {
                 return observer->wants_last_sound_state();
               }))
  {
    result_.particles = stepper_->particles();
    sum_over_ranks(comm_, std::span(&result_.particles, 1));
  }

  /// Up to now, without what observers took.
  void count_step_seconds()
  {
    const double seconds = seconds_since(counted_) - (result_.observer_seconds - observed_);
    result_.step_seconds += seconds;
    result_.core_seconds += seconds * ranks_of(comm_);
    counted_ = Clock::now();
    observed_ = result_.observer_seconds;
  }
  void count_wall_seconds()
  {
    result_.wall_seconds += seconds_since(wall_counted_);
    wall_counted_ = Clock::now();
  }

  /// To the end, or until a NumericalError, which every rank meets at the same place.
  void advance()
  {
    const double line_interval = layout_.end_time / scene_.output.history_lines;
    const auto line_after = [&](double time) {
      return std::size_t(time / line_interval * (1 + 1e-12)) + 1;
    };
    std::size_t next_line = line_after(stepper_->time());
    double dt = step_share_ * time_step_.next(*stepper_);
    while (!finished_at(stepper_->time(), stepper_->steps())) {
      if (stepper_->steps() == 1 || stepper_->steps() % Formulation<Dim>::steps_between_checks == 0)
        dt = step_share_ * time_step_.next(*stepper_);
      const double last = std::min(dt, layout_.end_time - stepper_->time());
      const double after = stepper_->time() + last;
      const bool line_due = after >= double(next_line) * line_interval * (1 - 1e-12) ||
                            finished_at(after, stepper_->steps() + 1);
      if (line_due) history_.before_line();
      stepper_->step(last);
      balance_.look(*stepper_);
      history_.observe();
      if (line_due) {
        stepper_->check();
        record(last);
        next_line = line_after(stepper_->time());
      }
      look();
      if (stepper_->steps() % KeptState<Dim>::steps_between == 0 && history_.is_sound()) keep();
      if (stepper_->steps() % Formulation<Dim>::steps_between_checks == 0) leave_checkpoint();
    }
  }

  void begin()
  {
    look();
    result_.first_time_step = time_step_.next(*stepper_);
    record(result_.first_time_step);
    keep();
  }

  void take_up()
  {
    Archive& state = *continuation_.state;
    // Of the same scene, or it would not have come here.
    const auto refuse = [](std::string_view difference) {
      throw InputError(fmt::format(
          "the checkpoint was written by another version of the program ({}). Go on with that one, "
          "or run the scene from its start with --overwrite.",
          difference));
    };
    try {
      archive(state);
    } catch (const InputError& error) {
      const std::string_view said = error.what();
      refuse(said.substr(0, said.find(". ")));  // what to do about it is said here
    }
    if (const std::vector<std::string> unread = state.unread(); !unread.empty())
      refuse(fmt::format("{} is unknown here", unread.front()));
    continuation_.state.reset();
  }

  void resume()
  {
    for (Observer<Dim>* observer : observers_) observer->resumed(history_.lines());
    keep();
  }

  void archive(Archive& archive)
  {
    archive_run(archive, *stepper_, balance_, history_);
    {
      const Archive::Section section(archive, "run");
      archive.value("step_share", step_share_);
      archive.value("first_time_step", result_.first_time_step);
      archive.value("repeated_steps", result_.repeated_steps);
      archive.value("step_seconds", result_.step_seconds, Over::largest);
      archive.value("core_seconds", result_.core_seconds, Over::largest);
      archive.value("wall_seconds", result_.wall_seconds, Over::largest);
      archive.value("observer_seconds", result_.observer_seconds, Over::largest);
      archive_goings_back(archive, result_.goings_back);
    }
    for (std::size_t k = 0; k < observers_.size(); ++k) {
      const Archive::Section section(archive, "observer" + std::to_string(k));
      observers_[k]->archive(archive);
    }
  }

  /// After a check, so that the one who goes on chooses the same step. Where one is due, or the run
  /// has to end.
  void leave_checkpoint()
  {
    const double seconds = seconds_since(start_);
    // Not all ranks get a signal, and none have the same clock.
    std::array<double, 3> asked{
        double(interruption_seen()),
        continuation_.time_limit && seconds > *continuation_.time_limit ? 1.0 : 0.0,
        schedule_.is_due_by_clock(seconds) ? 1.0 : 0.0};
    largest_over_ranks(comm_, asked);
    const bool ends = asked[0] > 0 || asked[1] > 0;
    const double strain = state().strain;
    if (finished_at(stepper_->time(), stepper_->steps())) return;
    const bool due = asked[2] > 0 || schedule_.is_due(stepper_->steps(), strain);
    if (!ends && !(due && history_.is_sound())) return;
    save();
    schedule_.start(stepper_->steps(), strain, seconds);
    if (!ends) return;
    for (Observer<Dim>* observer : observers_) observer->finish();
    throw Interruption(fmt::format(
        "Ended after step {}, {}: {}. Go on with --restart.", stepper_->steps(),
        model_.apparatus ? fmt::format("{:.2f} % strain", 100 * strain)
                         : fmt::format("t = {:.4g} s", stepper_->time()),
        asked[0] > 0 ? fmt::format("signal {}", int(asked[0])) : "the time limit was reached"));
  }

  void save()
  {
    count_step_seconds();
    count_wall_seconds();
    const auto start = Clock::now();
    MemoryArchive state;
    state.start_saving();
    archive(state);
    state.text(checkpoint_record, continuation_.record);
    checkpoints_.write(comm_, stepper_->steps(), state, schedule_.keep());
    result_.observer_seconds += seconds_since(start);
  }

  template <class What>
  void tell(const What& what)
  {
    const auto start = Clock::now();
    const State state = this->state();
    for (Observer<Dim>* observer : observers_) what(*observer, state);
    result_.observer_seconds += seconds_since(start);
  }
  void look()
  {
    tell([](Observer<Dim>& observer, const State& state) { observer.look(state); });
  }
  void record(double dt)
  {
    const HistoryLine& line = history_.record(dt);
    tell([&](Observer<Dim>& observer, const State& state) { observer.line(state, line); });
  }

  bool retries() const { return scene_.numerics.recovery == scene::Recovery::retry; }

  void keep()
  {
    if (!keeps_) return;
    kept_.save(*stepper_, balance_, history_);
    tell([](Observer<Dim>& observer, const State&) { observer.kept(); });
  }

  /// To the last sound state: for another attempt with a shorter step, or to show it and stop.
  void go_back(const NumericalError& error)
  {
    if (!keeps_) stop(error);
    const GlobalIndex failed_step = stepper_->steps();
    const double failed_time = stepper_->time();
    kept_.load(*stepper_, balance_, history_);
    if (!retries() || int(result_.goings_back.size()) >= most_attempts) stop(error);
    step_share_ *= share_of_step;
    schedule_.go_back(stepper_->steps(), state().strain);
    result_.repeated_steps += failed_step - stepper_->steps();
    result_.goings_back.push_back({failed_step, failed_time, error.what(), stepper_->steps(),
                                   stepper_->time(), history_.lines().size(), step_share_});
    tell([&](Observer<Dim>& observer, const State&) {
      observer.went_back(result_.goings_back.back());
    });
  }

  [[noreturn]] void stop(const NumericalError& error)
  {
    std::string text = error.what() + likely_cause(preparation_, error.particle());
    if (const std::size_t attempts = result_.goings_back.size(); attempts > 0)
      text +=
          fmt::format(" This was attempt {}, with {:.4g} of the step.", attempts + 1, step_share_);
    tell([&](Observer<Dim>& observer, const State& state) { text += observer.failed(state); });
    throw NumericalError(text, error.particle());
  }

  State state()
  {
    const double by_steps = scene_.steps ? double(stepper_->steps()) / double(*scene_.steps) : 0.0;
    return {*stepper_, model_.apparatus ? model_.apparatus->strain(stepper_->time()) : 0.0,
            std::max(stepper_->time() / layout_.end_time, by_steps)};
  }

  bool finished_at(double time, GlobalIndex steps) const
  {
    return time >= layout_.end_time * (1 - 1e-12) || (scene_.steps && steps >= *scene_.steps);
  }

  /// Collective.
  void fill_result()
  {
    result_.lines = history_.lines();
    result_.steps = stepper_->steps();
    result_.end_time = stepper_->time();
    result_.largest_rank_bytes = GlobalIndex(largest_over_ranks(comm_, double(stepper_->bytes())));
    result_.active_nodes = stepper_->active_nodes();
    sum_over_ranks(comm_, std::span(&result_.active_nodes, 1));
    result_.deepest_behind_piston = history_.deepest_behind_piston();
    for (const HistoryLine& line : result_.lines)
      result_.largest_energy_error =
          std::max(result_.largest_energy_error, judged_energy_error(line, bool(model_.apparatus)));
    result_.warnings = warnings_of_result(scene_, layout_.wave_speed, result_);
    result_.cooperation = cooperation_of(*stepper_, balance_);
    if (model_.apparatus) result_.properties = properties();
    count_wall_seconds();
  }

  analysis::CompressionProperties properties() const
  {
    std::vector<double> strain, stress;
    for (const HistoryLine& line : result_.lines) {
      strain.push_back(line.strain);
      stress.push_back(line.stress());
    }
    // Before the first wave has come back the specimen is not loaded as a whole.
    const double length = model_.apparatus->length;
    analysis::CurveOptions options;
    options.discard_strain = layout_.piston.displacement(2 * length / layout_.wave_speed) / length;
    return analysis::compression_properties(analysis::middle_strains(strain), stress, options);
  }

  /// Goings back in a run, and what is left of the step after each.
  static constexpr int most_attempts = 4;
  static constexpr double share_of_step = 0.5;

  Clock::time_point start_;
  const Preparation<Dim>& preparation_;
  MPI_Comm comm_;
  const scene::Scene& scene_;
  const Layout<Dim>& layout_;
  std::span<Observer<Dim>* const> observers_;
  Continuation continuation_;
  CheckpointFolder checkpoints_;
  CheckpointSchedule schedule_;
  Model<Dim> model_;
  TimeStep time_step_;
  std::unique_ptr<Formulation<Dim>> stepper_;
  LoadBalance<Dim> balance_;
  History<Dim> history_;
  bool keeps_;
  KeptState<Dim> kept_;
  double step_share_ = 1;
  Clock::time_point counted_;                ///< up to when the seconds of steps are
  double observed_ = 0;                      ///< s, of observers until then
  Clock::time_point wall_counted_ = start_;  ///< up to when those of all are
  RunResult result_;
};

}  // namespace

template <int Dim>
RunResult run(const Preparation<Dim>& preparation, std::span<Observer<Dim>* const> observers,
              Continuation continuation)
{
  return Run<Dim>(preparation, observers, std::move(continuation)).run();
}

template RunResult run(const Preparation<2>&, std::span<Observer<2>* const>, Continuation);
template RunResult run(const Preparation<3>&, std::span<Observer<3>* const>, Continuation);

}  // namespace mpm
