#include "fissura/parallel/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <thread>

namespace fissura::parallel {

namespace {

std::atomic<Team*> at_work{nullptr};

int all_of_the_machine() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

} // namespace

Threads::Threads(int count)
    : team_(std::make_unique<Team>(count > 0 ? count : all_of_the_machine())), before_(at_work.load()) {
  at_work = team_.get();
}

Threads::~Threads() {
  at_work = before_;
}

Team* team() {
  return at_work.load(std::memory_order_relaxed);
}

} // namespace fissura::parallel
