#include <mpm/simulation/long_stage.hpp>

#include <condition_variable>
#include <cstdio>
#include <mutex>

#include <fmt/format.h>

namespace mpm {

LongStage::LongStage(std::string what, std::chrono::duration<double> patience)
    : watch_([what = std::move(what), patience](const std::stop_token& ended) {
        std::mutex mutex;
        std::unique_lock lock(mutex);
        std::condition_variable_any never;
        never.wait_for(lock, ended, patience, [] { return false; });
        if (ended.stop_requested()) return;
        fmt::print("{} ...\n", what);
        std::fflush(stdout);
      })
{
}

}  // namespace mpm
