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

}  // namespace

void watch_for_interruptions()
{
  struct sigaction action {};
  action.sa_handler = take_down;
  action.sa_flags = int(SA_RESETHAND) | SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int signal : watched) sigaction(signal, &action, nullptr);
}

int interruption_seen()
{
  return last_signal;
}

}  // namespace mpm
