// Checkpoints whose contents were altered and whose checksum is right all the same: a file from a stranger.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <random>

#include "fissura/checkpoint/file.hpp"
#include "fissura/checkpoint/store.hpp"
#include "fissura/core/error.hpp"
#include "fissura/deck/deck.hpp"
#include "fissura/sim/run.hpp"
#include "unit/output/temporary_folder.hpp"

namespace fissura {
namespace {

namespace fs = std::filesystem;

/// The smashed beam: bars, contact, a hammer, a floor, strengths that follow the strain rate.
model::Case smashed_beam(long last_step) {
  auto c = deck::read_case(fs::path(FISSURA_TEST_DATA) / "../../regression/decks/smashed_beam.toml",
                           {"output.frames=1", "output.history_points=10"});
  c.run.max_steps = last_step;
  return c;
}
sim::RunOptions options_for(std::string const& out) {
  sim::RunOptions o;
  o.out = out, o.deck_echo = "x", o.version = "1", o.quiet = true, o.threads = 1, o.force = true;
  return o;
}

/// How many of `n` altered checkpoints were refused, and how many were gone on with.
struct Count {
  int refused = 0, ran = 0;
};

class Altered : public testing::Test {
 protected:
  void SetUp() override {
    sim::run_case(smashed_beam(steps_), options_for(folder_ / "run"));
    path_ = checkpoint::find(folder_ / "run");
    contents_ = checkpoint::read_file(path_);
  }
  /// Goes on for ten steps from the given contents, in a copy of the run.
  Count go_on_from(std::string const& contents) {
    fs::remove_all(folder_ / "copy");
    fs::copy(folder_ / "run", folder_ / "copy", fs::copy_options::recursive);
    auto o = options_for(folder_ / "copy");
    o.restart = checkpoint::find(folder_ / "copy");
    checkpoint::write_file(o.restart, [&](checkpoint::Saver& save) { save.bytes(contents); });
    try {
      auto const result = sim::run_case(smashed_beam(steps_ + 10), o);
      EXPECT_TRUE(result.status == "stopped" || result.status == "failed" || result.status == "complete");
      return {0, 1};
    } catch (core::InputError const& e) {
      EXPECT_NE(std::string(e.what()).find("checkpoint"), std::string::npos) << e.what();
      return {1, 0};
    }
  }
  template <class Change> Count alter(int times, Change const& change) {
    Count all;
    std::mt19937 random(11);
    for (int i = 0; i < times; ++i) {
      std::string contents = contents_;
      change(contents, random);
      Count const one = go_on_from(contents);
      all.refused += one.refused, all.ran += one.ran;
    }
    return all;
  }

  long const steps_ = 700;
  output::testing::TemporaryFolder const folder_;
  std::string path_, contents_;
};

int times() {
  char const* const wanted = std::getenv("FISSURA_ALTERED");
  return wanted ? std::atoi(wanted) : 15;
}

// Requirement: bytes changed at random anywhere end in an error of input or in a run that ends in order;
// never in a crash, a hang or an endless file. FISSURA_ALTERED asks for more of them.
TEST_F(Altered, bytes_never_crash_the_run) {
  auto const count = alter(times(), [](std::string& bytes, std::mt19937& random) {
    for (unsigned k = 0, n = 1 + random() % 20; k < n; ++k)
      bytes[random() % bytes.size()] = static_cast<char>(random());
  });
  EXPECT_EQ(count.refused + count.ran, times());
  RecordProperty("refused", count.refused);
}

// Requirement: the same for numbers that are infinite, huge, negative or none, at the beginning, where the
// counts and settings are, and everywhere else.
TEST_F(Altered, numbers_never_crash_the_run) {
  auto const change = [](std::size_t within) {
    return [within](std::string& bytes, std::mt19937& random) {
      double const reals[] = {NAN, INFINITY, -INFINITY, 1e308, -1e300, 0, 1e-300, -1};
      std::int64_t const wholes[] = {-1, INT64_MAX, INT64_MIN, 1L << 40, INT32_MAX, 0, 7, 100000};
      std::size_t const range = std::min(bytes.size(), within) - 8;
      for (int k = 0; k < 4; ++k) {
        char* const at = bytes.data() + random() % range;
        unsigned const which = random() % 8;
        if (random() % 2 == 0)
          std::memcpy(at, &reals[which], 8);
        else
          std::memcpy(at, &wholes[which], 8);
      }
    };
  };
  alter(times(), change(std::string::npos));
  std::size_t const begins = contents_.find("title") + 4000;
  auto const tail = [&](std::string& bytes, std::mt19937& random) {
    std::size_t const from = bytes.size() - std::min<std::size_t>(bytes.size() - 8, 4000);
    for (int k = 0; k < 2; ++k) {
      double const value = std::ldexp(1.0 - 2.0 * (random() % 2), static_cast<int>(random() % 2000) - 1000);
      std::memcpy(bytes.data() + from + random() % (bytes.size() - from - 8), &value, 8);
    }
  };
  alter(times(), change(begins));
  alter(times(), tail);
}

} // namespace
} // namespace fissura
