#pragma once
/// Columns of one block of particles to registers and back.

#include <mpm/core/lanes.hpp>
#include <mpm/particles/particle_store.hpp>

namespace mpm {

template <int N>
[[gnu::always_inline]] inline void load_all(const double* block, int column, Lanes (&values)[N])
{
  for (int k = 0; k < N; ++k) values[k] = load(block + (column + k) * lane_count);
}

template <int N>
[[gnu::always_inline]] inline void store_all(const Lanes (&values)[N], double* block, int column)
{
  for (int k = 0; k < N; ++k) store(values[k], block + (column + k) * lane_count);
}

/// Asks for the columns of a block that is worked on soon: the processor sees by itself that they
/// lie in order, but not early enough. (Inlined, because GCC drops calls that only ask.)
[[gnu::always_inline]] inline void fetch(ColumnGroup& group, LocalIndex block)
{
  constexpr int for_writing = 1;
  const double* columns = group.block(block);
  for (int c = 0; c < group.width(); ++c) __builtin_prefetch(columns + c * lane_count, for_writing);
}

}  // namespace mpm
