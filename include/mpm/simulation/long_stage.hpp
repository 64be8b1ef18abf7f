#pragma once
/// What a program is at before it runs, for people, where that takes long.

#include <chrono>
#include <string>
#include <thread>

namespace mpm {

/// Says so on a line of its own if it has not ended after `patience`. Used on one rank.
class LongStage {
 public:
  /// `what`: such as "reading the picture".
  explicit LongStage(std::string what,
                     std::chrono::duration<double> patience = std::chrono::seconds(5));

 private:
  std::jthread watch_;  ///< no call of MPI
};

}  // namespace mpm
