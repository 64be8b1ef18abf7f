#pragma once
/// What is kept of a list, without a branch for each item.

#include <array>
#include <cstddef>
#include <vector>

namespace mpm {

/// Appends to `kept`, which holds all of it at the latest when the sieve ends. Where nobody
/// foresees what is kept, a processor that guesses wrong loses more time than an item that is
/// written in vain costs:
///
///     Sieve sieve(kept);
///     for (...) {
///       sieve.item() = ...;
///       sieve.keep(whether);
///     }
template <class Item>
class Sieve {
 public:
  explicit Sieve(std::vector<Item>& kept) : kept_(kept) {}
  ~Sieve() { give(); }
  Sieve(const Sieve&) = delete;
  Sieve& operator=(const Sieve&) = delete;

  /// The next one, to be written; what stands there means nothing.
  Item& item() { return some_[count_]; }
  void keep(bool whether)
  {
    count_ += std::size_t(whether);
    if (count_ == some_.size()) give();
  }

 private:
  void give()
  {
    kept_.insert(kept_.end(), some_.begin(), some_.begin() + std::ptrdiff_t(count_));
    count_ = 0;
  }

  std::vector<Item>& kept_;
  std::array<Item, 64> some_;
  std::size_t count_ = 0;
};

}  // namespace mpm
