#pragma once
// The only place that knows threads. Work is cut into chunks whose size never depends on the number of
// threads, and sums are taken chunk by chunk in ascending order: the same bits on any number of threads.
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "fissura/parallel/team.hpp"

namespace fissura::parallel {

/// The threads that the process works with until the object goes away; 0 = all the machine offers. Without
/// one, everything is done by the caller. Several may live at a time and go in any order: the youngest one
/// left is at work, or the one called to it last.
class Threads {
 public:
  explicit Threads(int count);
  ~Threads();
  Threads(Threads const&) = delete;
  Threads& operator=(Threads const&) = delete;
  int count() const { return team_->size(); }
  /// Puts these threads to work.
  void use() const;

 private:
  std::unique_ptr<Team> team_;
};

/// The team at work, or nullptr.
Team* team();

inline std::size_t chunks(std::size_t n, std::size_t grain) {
  return (n + grain - 1) / grain;
}

/// Calls body(chunk, begin, end) for all chunks of `grain` items out of n.
template <class Body> void for_chunks(std::size_t n, std::size_t grain, Body const& body) {
  struct Job {
    Body const& body;
    std::size_t n, grain;
    void operator()(std::size_t c) const { body(c, c * grain, (c + 1) * grain < n ? (c + 1) * grain : n); }
  } const job{body, n, grain};
  std::size_t const count = chunks(n, grain);
  if (Team* const t = team(); t && count > 1) {
    t->run(
        count, [](void const* context, std::size_t c) { (*static_cast<Job const*>(context))(c); }, &job);
    return;
  }
  for (std::size_t c = 0; c < count; ++c) job(c);
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
