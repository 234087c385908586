#include "fissura/parallel/parallel.hpp"

#include <tbb/info.h>

namespace fissura::parallel {

Threads::Threads(int count)
    : count_(count > 0 ? count : tbb::info::default_concurrency()),
      control_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count_)) {}

} // namespace fissura::parallel
