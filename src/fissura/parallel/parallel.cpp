#include "fissura/parallel/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>

namespace fissura::parallel {

namespace {

std::atomic<Team*> at_work{nullptr};
std::mutex living_mutex;
std::vector<Team*> living; ///< by age

int all_of_the_machine() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

} // namespace

Threads::Threads(int count) : team_(std::make_unique<Team>(count > 0 ? count : all_of_the_machine())) {
  std::lock_guard const lock(living_mutex);
  living.push_back(team_.get());
  at_work = team_.get();
}

Threads::~Threads() {
  std::lock_guard const lock(living_mutex);
  living.erase(std::find(living.begin(), living.end(), team_.get()));
  if (at_work == team_.get()) at_work = living.empty() ? nullptr : living.back();
}

void Threads::use() const {
  at_work = team_.get();
}

Team* team() {
  return at_work.load(std::memory_order_relaxed);
}

} // namespace fissura::parallel
