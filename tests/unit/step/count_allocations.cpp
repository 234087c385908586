// Counts heap allocations; in a file of its own so that the compiler does not pair an inlined delete with its
// own new.
#include "count_allocations.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<long> count{0};
}

void* operator new(std::size_t size) {
  ++count;
  if (void* const p = std::malloc(size ? size : 1)) return p;
  throw std::bad_alloc();
}
void* operator new(std::size_t size,
                   std::nothrow_t const&) noexcept { // as the sorts of the library ask for room
  ++count;
  return std::malloc(size ? size : 1);
}
void operator delete(void* p) noexcept {
  std::free(p);
}
void operator delete(void* p, std::size_t) noexcept {
  std::free(p);
}

long fissura::support::allocations() {
  return count;
}
