#pragma once
/// Particles go to the rank that owns the cell they are in.

#include <mpm/materials/law.hpp>
#include <mpm/parallel/decomposition.hpp>

#include <span>

namespace mpm {

template <int Dim>
class Migration {
 public:
  explicit Migration(const Decomposition<Dim>& decomposition) : decomposition_(decomposition) {}

  /// Particles of one body that may have left: blocks in which at least one is outside the cells
  /// that this rank owns. Only these are looked at.
  struct Leavers {
    Body<Dim>* body;
    std::span<const LocalIndex> blocks;
  };

  struct Outcome {
    GlobalIndex sent = 0;             ///< by this rank
    std::vector<LocalIndex> arrived;  ///< per entry of `leavers`, particles received (at the end)
    bool failed = false;              ///< some rank called with `failed`
  };

  /// Sends particles to any rank, near or far; arrivals stand at the end of the stores in the order
  /// of the sending ranks. All ranks learn whether any of them `failed`. Collective; `leavers` has
  /// the same bodies in the same order on every rank.
  ///
  /// Messages go to those that get particles only (nonblocking consensus; Hoefler, Siebert &
  /// Lumsdaine 2010, PPoPP): synchronous sends, probe and receive, and once one's own sends have
  /// arrived a nonblocking reduction, whose end means that nothing is under way any more.
  Outcome exchange(std::span<const Leavers> leavers, bool failed);

 private:
  const Decomposition<Dim>& decomposition_;
  // Alternates, so that a rank that is one exchange ahead is not mistaken for this one's sender.
  int round_ = 0;
};

}  // namespace mpm
