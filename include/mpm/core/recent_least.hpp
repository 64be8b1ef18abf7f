#pragma once
/// The least of the last few values.

#include <algorithm>
#include <array>
#include <cstddef>

namespace mpm {

/// What a measured time would be if nothing disturbed the machine: disturbances only ever add.
class RecentLeast {
 public:
  void add(double value) { values_[count_++ % values_.size()] = value; }
  void clear() { count_ = 0; }
  /// 0 without values.
  double value() const
  {
    if (count_ == 0) return 0;
    return *std::min_element(values_.begin(), values_.begin() + std::min(count_, values_.size()));
  }

 private:
  std::array<double, 32> values_{};
  std::size_t count_ = 0;
};

}  // namespace mpm
