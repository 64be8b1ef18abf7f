#pragma once
#include <ctime>

namespace mpm {

/// Processor time of this thread between start and stop, summed up: other programs on the same core
/// do not count.
class Stopwatch {
 public:
  void start() { seconds_ -= now(); }
  void stop() { seconds_ += now(); }
  double seconds() const { return seconds_; }
  void clear() { seconds_ = 0; }

 private:
  static double now()
  {
    std::timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
  }
  double seconds_ = 0;
};

}  // namespace mpm
