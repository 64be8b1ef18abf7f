#include <mpm/core/error.hpp>
#include <mpm/parallel/launcher.hpp>
#include <mpm/parallel/session.hpp>
#include <mpm/simulation/kept_state.hpp>
#include <mpm/simulation/method.hpp>
#include <mpm/simulation/snapshots.hpp>
#include <mpm/simulation/step_measurement.hpp>
#include <mpm/stepping/load_balance.hpp>
#include <mpm/stepping/time_step.hpp>

#include <algorithm>
#include <array>
#include <chrono>

namespace mpm {

namespace {

using Clock = std::chrono::steady_clock;

/// What sorting and messages take beside the columns is left to the other half.
template <int Dim>
bool fits_in_memory(const Preparation<Dim>& preparation)
{
  return share_of_memory(preparation) < 0.5;
}

double bytes_of(const MemoryArchive& state)
{
  double bytes = 0;
  state.visit([&](const std::string&, const MemoryArchive::Value& value) {
    std::visit([&](const auto& list) { bytes += double(list.size() * sizeof list[0]); }, value);
  });
  return bytes;
}

double bytes_of(const output::Snapshot& snapshot)
{
  double bytes = double(snapshot.position.size() * sizeof(double));
  for (const output::ParticleField& field : snapshot.fields)
    std::visit([&](const auto& list) { bytes += double(list.size() * sizeof list[0]); },
               field.values);
  return bytes;
}

/// The scene as a run steps it, without anyone who looks on.
template <int Dim>
class MeasuredRun {
 public:
  explicit MeasuredRun(const Preparation<Dim>& preparation)
      : MeasuredRun(preparation,
                    Decomposition<Dim>(preparation.comm, preparation.partition.ownership))
  {
  }

  /// One step finds memory for what it makes, and counts only where there are no others.
  void measure(double seconds, StepMeasurement& found)
  {
    double spent = seconds_of(1), counted = 0;
    found.steps = 1;
    found.seconds = spent;
    for (GlobalIndex steps = 0; spent < seconds && stepper_->time() < layout_.end_time;) {
      const double expected = (seconds - spent) / found.seconds;
      const auto batch =
          GlobalIndex(std::clamp(expected, 1.0, double(Formulation<Dim>::steps_between_checks)));
      const double took = seconds_of(batch);
      spent += took;
      counted += took;
      found.steps = steps += batch;
      found.seconds = counted / double(steps);
    }
  }

  double checkpoint_bytes()
  {
    MemoryArchive state;
    state.start_saving();
    archive_run(state, *stepper_, balance_, history_);
    return bytes_of(state);
  }
  double snapshot_bytes() { return bytes_of(snapshot_of(preparation_, *stepper_, 0.0)); }

 private:
  MeasuredRun(const Preparation<Dim>& preparation, const Decomposition<Dim>& decomposition)
      : preparation_(preparation),
        layout_(preparation.layout),
        model_(make_model(preparation.scene, preparation.specimen, layout_, decomposition)),
        time_step_(time_step_of(layout_)),
        stepper_(make_formulation(preparation.scene, layout_, decomposition, std::move(model_))),
        balance_(partition_rules<Dim>(preparation.scene),
                 preparation.scene.numerics.repartition_interval),
        history_(*stepper_, model_.apparatus, layout_.largest_speed)
  {
  }

  /// Of the slowest rank, so that all go on alike.
  double seconds_of(GlobalIndex steps)
  {
    const auto start = Clock::now();
    for (; steps > 0; --steps) {
      if (stepper_->steps() % Formulation<Dim>::steps_between_checks == 0)
        dt_ = time_step_.next(*stepper_);
      stepper_->step(dt_);
      balance_.look(*stepper_);
      history_.observe();
    }
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    return largest_over_ranks(preparation_.comm, seconds);
  }

  const Preparation<Dim>& preparation_;
  const Layout<Dim>& layout_;
  Model<Dim> model_;
  TimeStep time_step_;
  std::unique_ptr<Formulation<Dim>> stepper_;
  LoadBalance<Dim> balance_;
  History<Dim> history_;
  double dt_ = 0;
};

}  // namespace

template <int Dim>
StepMeasurement measure_steps(const Preparation<Dim>& preparation, double seconds)
{
  StepMeasurement found;
  if (!fits_in_memory(preparation)) {
    found.why_none = "more than half of this machine's memory";
    return found;
  }
  MeasuredRun<Dim> run(preparation);
  std::array<double, 2> bytes{run.snapshot_bytes(), run.checkpoint_bytes()};
  sum_over_ranks(preparation.comm, bytes);
  found.snapshot_bytes = bytes[0];
  found.checkpoint_bytes = bytes[1];
  try {
    run.measure(seconds, found);
  } catch (const NumericalError&) {
    // What was measured until then holds; how it breaks is the run's to say.
    if (found.steps == 0) found.why_none = "the scene breaks in its first step";
  }
  return found;
}

template StepMeasurement measure_steps(const Preparation<2>&, double);
template StepMeasurement measure_steps(const Preparation<3>&, double);

}  // namespace mpm
