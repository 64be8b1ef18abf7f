#pragma once
/// Memory of the columns that passes stream through.

#include <cstddef>
#include <vector>

namespace mpm {

/// Memory on lane boundaries; large pieces on boundaries of large pages, of which the system is
/// asked for: particles lie in thousands of ordinary pages, and looking those up took 8 % of a
/// step. Where there are none (other systems, settings, limits), ordinary pages serve.
void* allocate_lanes(std::size_t bytes);
void free_lanes(void* memory, std::size_t bytes);

template <class T>
struct LaneAllocator {
  using value_type = T;
  LaneAllocator() = default;
  template <class U>
  LaneAllocator(const LaneAllocator<U>&)
  {
  }
  T* allocate(std::size_t n) { return static_cast<T*>(allocate_lanes(n * sizeof(T))); }
  void deallocate(T* p, std::size_t n) { free_lanes(p, n * sizeof(T)); }
  friend bool operator==(const LaneAllocator&, const LaneAllocator&) { return true; }
};

template <class T>
using LaneVector = std::vector<T, LaneAllocator<T>>;

}  // namespace mpm
