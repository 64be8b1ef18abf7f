#include <mpm/core/lane_vector.hpp>
#include <mpm/core/lanes.hpp>

#include <new>

#include <sys/mman.h>

namespace mpm {

namespace {

constexpr std::size_t large_page = std::size_t(2) << 20;

std::align_val_t alignment_of(std::size_t bytes)
{
  return std::align_val_t{bytes >= large_page ? large_page : lane_alignment};
}

}  // namespace

void* allocate_lanes(std::size_t bytes)
{
  void* memory = ::operator new (bytes, alignment_of(bytes));
#ifdef MADV_HUGEPAGE
  // A wish: whether it is granted changes the speed only. The last, partial page stays ordinary.
  if (bytes >= large_page)
    static_cast<void>(::madvise(memory, bytes / large_page * large_page, MADV_HUGEPAGE));
#endif
  return memory;
}

void free_lanes(void* memory, std::size_t bytes)
{
  ::operator delete (memory, alignment_of(bytes));
}

}  // namespace mpm
