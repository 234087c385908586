#include "fissura/parallel/team.hpp"

#include <fmt/core.h>
#include <immintrin.h>
#include <sched.h>
#include <system_error>

#include "fissura/core/error.hpp"

namespace fissura::parallel {

namespace {

constexpr int spins = 400;  // some 10 us: longer than what lies between two passes of a step
constexpr int yields = 200; // then some 0.1 ms, or as long as others need the processor

/// Set in threads that work on a chunk: what they start themselves they do alone.
thread_local bool is_inside = false;

/// Returns false once waiting has lasted long enough to go to sleep.
bool wait_a_little(int round) {
  if (round < spins)
    _mm_pause();
  else
    ::sched_yield();
  return round < spins + yields;
}

} // namespace

Team::Team(int threads) : shares_(static_cast<std::size_t>(threads)) {
  try {
    for (std::size_t i = 1; i < shares_.size(); ++i) threads_.emplace_back([this, i] { serve(i); });
  } catch (std::system_error const& e) {
    dismiss(); // those that have begun: no destructor runs for an object that was never built
    throw core::Error(core::Failure::run,
                      fmt::format("the system grants {} of {} threads ({}): ask for fewer",
                                  threads_.size() + 1, threads, e.what()));
  }
}

Team::~Team() {
  dismiss();
}

void Team::dismiss() {
  stop_ = true;
  state_.fetch_add(one_generation);
  state_.notify_all();
}

void Team::run(std::size_t count, Work work, void const* context) {
  std::unique_lock lock(busy_, std::defer_lock);
  if (shares_.size() == 1 || count < 2 || is_inside || !lock.try_lock()) {
    for (std::size_t c = 0; c < count; ++c) work(context, c);
    return;
  }
  work_ = work;
  context_ = context;
  for (std::size_t i = 0; i < shares_.size(); ++i) {
    shares_[i].next.store(i * count / shares_.size(), std::memory_order_relaxed);
    shares_[i].end = (i + 1) * count / shares_.size();
  }
  state_.store((state_.load() + one_generation) | open);
  state_.notify_all();
  work_through(0);
  state_.fetch_and(~open);
  for (int round = 0; (state_.load() & at_work) != 0; ++round) wait_a_little(round);
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void Team::serve(std::size_t me) {
  std::uint64_t seen = 0;
  while (!stop_) {
    if (!join(seen)) continue;
    work_through(me);
    state_.fetch_sub(1);
  }
}

/// Waits for work of a generation not yet seen and registers for it; false where it came too late.
bool Team::join(std::uint64_t& seen) {
  std::uint64_t now = state_.load();
  for (int round = 0; now / one_generation == seen; now = state_.load()) {
    if (wait_a_little(round))
      ++round;
    else
      state_.wait(now);
  }
  seen = now / one_generation;
  while ((now & open) != 0 && now / one_generation == seen)
    if (state_.compare_exchange_weak(now, now + 1)) return true;
  return false;
}

void Team::work_through(std::size_t me) {
  is_inside = true;
  try {
    for (std::size_t i = 0; i < shares_.size(); ++i) {
      auto& share = shares_[(me + i) % shares_.size()];
      for (;;) {
        if (share.next.load(std::memory_order_relaxed) >= share.end) break;
        std::size_t const chunk = share.next.fetch_add(1, std::memory_order_relaxed);
        if (chunk >= share.end) break;
        work_(context_, chunk);
      }
    }
  } catch (...) {
    std::lock_guard const lock(failing_);
    if (!failure_) failure_ = std::current_exception();
  }
  is_inside = false;
}

} // namespace fissura::parallel
