#pragma once
// The only place that knows threads. Work is cut into chunks whose size never depends on the number of
// threads, and sums are taken chunk by chunk in ascending order: the same bits on any number of threads.
#include <array>
#include <cstddef>
#include <vector>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

namespace fissura::parallel {

/// Number of threads the process may use until the object goes away; 0 = all the machine offers.
class Threads {
 public:
  explicit Threads(int count);
  int count() const { return count_; }

 private:
  int count_;
  tbb::global_control control_;
};

inline std::size_t chunks(std::size_t n, std::size_t grain) {
  return (n + grain - 1) / grain;
}

/// Calls body(chunk, begin, end) for all chunks of `grain` items out of n.
template <class Body> void for_chunks(std::size_t n, std::size_t grain, Body const& body) {
  std::size_t const count = chunks(n, grain);
  auto one = [&](std::size_t c) { body(c, c * grain, (c + 1) * grain < n ? (c + 1) * grain : n); };
  if (count <= 1 || tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism) == 1) {
    for (std::size_t c = 0; c < count; ++c) one(c);
    return;
  }
  tbb::parallel_for(std::size_t{0}, count, one, tbb::static_partitioner{});
}

/// Sum of body(begin, end) over the chunks, added in ascending order.
template <class Value, class Body> Value sum_chunks(std::size_t n, std::size_t grain, Body const& body) {
  if (n <= grain) return n > 0 ? body(std::size_t{0}, n) : Value{};
  std::size_t const count = chunks(n, grain);
  std::array<Value, 256> few; // no allocation for what is summed in every step
  std::vector<Value> many(count > few.size() ? count : 0);
  Value* const part = many.empty() ? few.data() : many.data();
  for_chunks(n, grain,
             [&](std::size_t c, std::size_t begin, std::size_t end) { part[c] = body(begin, end); });
  Value total{};
  for (std::size_t c = 0; c < count; ++c) total += part[c];
  return total;
}

} // namespace fissura::parallel
