#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <vector>

#include "fissura/parallel/parallel.hpp"

namespace fissura::parallel {
namespace {

// Requirement: chunks cover every item once, in pieces that do not depend on the number of threads.
TEST(Chunks, cover_every_item_once) {
  for (int const threads : {1, 2, 3, 8}) {
    Threads const limit(threads);
    EXPECT_EQ(limit.count(), threads);
    for (std::size_t const n :
         {std::size_t{0}, std::size_t{1}, std::size_t{99}, std::size_t{100}, std::size_t{1001}}) {
      std::vector<std::atomic<int>> seen(n);
      for_chunks(n, 100, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
        EXPECT_EQ(begin, 100 * chunk);
        EXPECT_LE(end - begin, 100u);
        for (std::size_t i = begin; i < end; ++i) ++seen[i];
      });
      for (auto const& count : seen) ASSERT_EQ(count, 1);
    }
  }
  EXPECT_EQ(chunks(1001, 100), 11u);
  EXPECT_EQ(chunks(0, 100), 0u);
}

// Requirement: sums have the same bits on any number of threads.
TEST(Sums, have_the_same_bits_on_any_number_of_threads) {
  auto sum = [](int threads) {
    Threads const limit(threads);
    return sum_chunks<double>(100003, 512, [](std::size_t begin, std::size_t end) {
      double s = 0;
      for (std::size_t i = begin; i < end; ++i) s += std::sin(static_cast<double>(i)) * 1e10 + 1e-7;
      return s;
    });
  };
  double const one = sum(1);
  for (int const threads : {2, 3, 5, 8}) EXPECT_EQ(sum(threads), one) << threads;
}

// Requirement: 0 threads means all the machine offers, and the limit ends with the object.
TEST(Threads, zero_means_all) {
  Threads const all(0);
  EXPECT_GE(all.count(), 1);
  {
    Threads const one(1);
    EXPECT_EQ(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism), 1u);
  }
  EXPECT_EQ(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism),
            static_cast<std::size_t>(all.count()));
}

} // namespace
} // namespace fissura::parallel
