#include <mpm/core/interruption.hpp>

#include <csignal>

namespace mpm {

namespace {

constexpr int watched[] = {SIGINT, SIGTERM, SIGUSR1};

volatile std::sig_atomic_t last_signal = 0;

void take_down(int signal)
{
  last_signal = signal;
}

void set_all(void (*handler)(int), int flags)
{
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  sigemptyset(&action.sa_mask);
  for (const int signal : watched) sigaction(signal, &action, nullptr);
}

}  // namespace

InterruptionSignals::InterruptionSignals()
{
  last_signal = 0;
  set_all(take_down, int(SA_RESETHAND) | SA_RESTART);
}

InterruptionSignals::~InterruptionSignals()
{
  set_all(SIG_DFL, 0);
}

int InterruptionSignals::seen()
{
  return last_signal;
}

}  // namespace mpm
