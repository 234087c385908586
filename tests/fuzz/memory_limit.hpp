#pragma once
// Counts what a reader allocates while it reads one input, through the hooks of the address sanitizer.
#include <cstddef>
#include <cstdio>
#include <cstdlib>

#include <sanitizer/allocator_interface.h>

namespace fissura::fuzz {

inline std::size_t held = 0, most_held = 0; ///< bytes, since the reader began
inline bool counts = false;

inline void on_allocation(void const volatile*, std::size_t size) {
  if (!counts) return;
  held += size;
  if (held > most_held) most_held = held;
}
inline void on_release(void const volatile* p) {
  if (!counts || p == nullptr) return;
  std::size_t const size = __sanitizer_get_allocated_size(const_cast<void const*>(p));
  held -= size < held ? size : held;
}

/// Requirement: a reader holds at most eight times the size of its input, and 64 MiB.
template <class Read> void read_within_limit(std::size_t input, Read const& read) {
  static int const installed = __sanitizer_install_malloc_and_free_hooks(on_allocation, on_release);
  if (installed == 0) std::abort();
  held = most_held = 0;
  counts = true;
  read();
  counts = false;
  if (most_held <= 8 * input + (std::size_t{64} << 20U)) return;
  std::fprintf(stderr, "an input of %zu bytes took %zu bytes of memory\n", input, most_held);
  std::abort();
}

} // namespace fissura::fuzz
