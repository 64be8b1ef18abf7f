#include <mpm/core/terminal.hpp>
#include <mpm/simulation/progress.hpp>

#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace mpm {

namespace {

constexpr double seconds_between_updates = 0.5;
constexpr double fraction_between_lines = 0.05;

std::string duration(double seconds)
{
  const long s = long(seconds + 0.5);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} h {:02} min", s / 3600, s % 3600 / 60);
}

}  // namespace

Progress::Progress() : terminal_(is_terminal(STDOUT_FILENO)) {}

std::string Progress::line(const ProgressState& state, double seconds) const
{
  std::string text = fmt::format("{:3.0f} %  step {}", 100 * state.fraction, state.step);
  if (state.loaded)
    text += fmt::format("  strain {:.2f} %  stress {:.1f} MPa", 100 * state.strain,
                        1e-6 * state.stress);
  else
    text += fmt::format("  t {:.4g} s", state.time);
  if (seconds > 0) {
    const double done = state.fraction - first_->fraction;
    text += fmt::format("  {:.1f} M particles/s",
                        1e-6 * double(state.particle_steps - first_->particle_steps) / seconds);
    if (done > 0.01 && state.fraction < 1)
      text += "  " + duration(seconds * (1 - state.fraction) / done) + " left";
  }
  return text;
}

void Progress::show(const ProgressState& state)
{
  const auto now = Clock::now();
  if (!first_) {
    first_ = state;
    start_ = last_ = now;
  }
  const double seconds = std::chrono::duration<double>(now - start_).count();
  if (terminal_) {
    if (std::chrono::duration<double>(now - last_).count() < seconds_between_updates &&
        state.fraction < 1)
      return;
    fmt::print("\r{:<79.79}", line(state, seconds));
    open_line_ = true;
  } else {
    if (state.fraction < next_fraction_ && state.fraction < 1) return;
    fmt::print("{}\n", line(state, seconds));
    while (next_fraction_ <= state.fraction) next_fraction_ += fraction_between_lines;
  }
  std::fflush(stdout);
  last_ = now;
}

void Progress::finish()
{
  if (open_line_) fmt::print("\n");
  open_line_ = false;
  std::fflush(stdout);
}

}  // namespace mpm
