#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <sys/resource.h>
#include <thread>
#include <vector>

#include "fissura/core/error.hpp"
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
    EXPECT_EQ(team()->size(), 1);
  }
  EXPECT_EQ(team()->size(), all.count());
}

// Requirement: threads work at the same time: two chunks that wait for each other both come to an end.
TEST(Threads, work_at_the_same_time) {
  Threads const two(2);
  std::atomic<int> arrived{0};
  bool met[2] = {false, false};
  for_chunks(2, 1, [&](std::size_t chunk, std::size_t, std::size_t) {
    ++arrived;
    auto const deadline = std::chrono::steady_clock::now() + std::chrono::seconds(200);
    while (arrived < 2 && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
    met[chunk] = arrived == 2;
  });
  EXPECT_TRUE(met[0]);
  EXPECT_TRUE(met[1]);
}

// Requirement: several teams may end in any order; the one at work is always alive.
TEST(Threads, end_in_any_order) {
  auto first = std::make_unique<Threads>(2);
  auto second = std::make_unique<Threads>(3);
  EXPECT_EQ(team()->size(), 3);
  first->use();
  EXPECT_EQ(team()->size(), 2);
  first.reset();
  EXPECT_EQ(team()->size(), 3) << "the one that is left";
  second.reset();
  EXPECT_EQ(team(), nullptr);
}

// Requirement: an error in one chunk reaches the caller, and the threads can work again afterwards.
TEST(Threads, pass_errors_on) {
  Threads const four(4);
  for (int i = 0; i < 100; ++i) {
    EXPECT_THROW(for_chunks(1000, 10,
                            [](std::size_t chunk, std::size_t, std::size_t) {
                              if (chunk == 37) throw std::runtime_error("chunk 37");
                            }),
                 std::runtime_error);
    std::atomic<int> done{0};
    for_chunks(1000, 10, [&](std::size_t, std::size_t, std::size_t) { ++done; });
    ASSERT_EQ(done, 100);
  }
}

// Requirement: work started within work, and by several callers at once, is done once and completely.
TEST(Threads, nest_and_share) {
  Threads const three(3);
  auto const both = [] {
    std::atomic<int> done{0};
    for_chunks(50, 1, [&](std::size_t, std::size_t, std::size_t) {
      for_chunks(20, 1, [&](std::size_t, std::size_t, std::size_t) { ++done; });
    });
    return done.load();
  };
  int elsewhere = 0;
  std::jthread other([&] {
    for (int i = 0; i < 200; ++i) elsewhere += both();
  });
  int here = 0;
  for (int i = 0; i < 200; ++i) here += both();
  other.join();
  EXPECT_EQ(here, 200'000);
  EXPECT_EQ(elsewhere, 200'000);
}

// Requirement: ten thousand short passes in a row, with pauses in which threads fall asleep, lose nothing.
TEST(Threads, wake_for_every_pass) {
  Threads const four(4);
  long sum = 0;
  for (int i = 0; i < 10'000; ++i) {
    if (i % 1000 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    sum += sum_chunks<long>(
        64, 4, [](std::size_t begin, std::size_t end) { return static_cast<long>(end - begin); });
  }
  EXPECT_EQ(sum, 640'000);
}

// Sanitizers need all addresses for themselves.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define FISSURA_TEST_IS_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define FISSURA_TEST_IS_SANITIZED
#endif
#endif

#ifndef FISSURA_TEST_IS_SANITIZED
// Requirement: threads that the system does not grant are an error in words; those that had begun are let go.
TEST(Threads, that_are_not_granted_are_an_error) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_AS, &before), 0);
  rlimit const little{std::min<rlim_t>(before.rlim_cur, 512UL << 20), before.rlim_max}; // some stacks' worth
  ASSERT_EQ(::setrlimit(RLIMIT_AS, &little), 0);
  std::string text;
  try {
    Threads const many(1000);
  } catch (core::Error const& e) {
    text = e.what();
  }
  ASSERT_EQ(::setrlimit(RLIMIT_AS, &before), 0);
  EXPECT_EQ(text.find("the system grants "), 0U) << text;
  EXPECT_NE(text.find(" of 1000 threads ("), std::string::npos) << text;
  EXPECT_NE(text.find("): ask for fewer"), std::string::npos) << text;
  Threads const two(2);
  EXPECT_EQ(two.count(), 2);
}
#endif

} // namespace
} // namespace fissura::parallel
