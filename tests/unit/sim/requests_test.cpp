// What may ask a run to stop.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include "fissura/sim/requests.hpp"
#include "unit/output/temporary_folder.hpp"

namespace fissura::sim {
namespace {

using output::testing::TemporaryFolder;

// Requirement: nothing stops a run that nobody asks, with or without a folder.
TEST(Requests, are_silent_unless_asked) {
  TemporaryFolder const folder;
  Requests alone({}, {}), watching([] { return 0; }, 1000);
  watching.watch(folder.name());
  EXPECT_FALSE(alone.to_stop());
  EXPECT_FALSE(watching.to_stop());
  EXPECT_FALSE(watching.for_output());
}

// Requirement: a signal is heard at once and named.
TEST(Requests, hear_signals) {
  int signal = 0;
  Requests requests([&] { return signal; }, {});
  EXPECT_FALSE(requests.to_stop());
  signal = SIGINT;
  EXPECT_EQ(requests.to_stop().value_or(""), "stopped by SIGINT (Ctrl-C)");
  signal = SIGTERM;
  EXPECT_EQ(requests.to_stop().value_or(""), "stopped by SIGTERM");
  signal = SIGHUP;
  EXPECT_EQ(requests.to_stop().value_or(""), "stopped by SIGHUP");
  signal = SIGUSR1;
  EXPECT_EQ(requests.to_stop().value_or(""), "stopped by SIGUSR1");
  signal = SIGWINCH;
  EXPECT_NE(requests.to_stop().value_or("").find("signal"), std::string::npos);
}

// Requirement: a signal that comes while a model is built ends the building and is named.
TEST(Requests, hear_signals_before_the_first_step) {
  int signal = 0;
  Requests const requests([&] { return signal; }, {});
  EXPECT_NO_THROW(requests.check_signal());
  signal = SIGTERM;
  try {
    requests.check_signal();
    FAIL() << "no error";
  } catch (Interrupted const& e) {
    EXPECT_STREQ(e.what(), "stopped by SIGTERM before the first step");
  }
}

// Requirement: a wall time of nothing is used up at once.
TEST(Requests, know_no_time_at_all) {
  EXPECT_EQ(Requests({}, 0.0).to_stop().value_or(""), "wall time used up");
}

// Requirement: the wall time counts from the start.
TEST(Requests, know_the_wall_time) {
  EXPECT_FALSE(Requests({}, 1e6).to_stop()); // no limit that a busy machine could pass
  Requests requests({}, 0.02);
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
  EXPECT_EQ(requests.to_stop().value_or(""), "wall time used up");
}

// Requirement: files are found within some 10 ms, answered once and removed.
TEST(Requests, find_files) {
  TemporaryFolder const folder;
  Requests requests({}, {});
  requests.watch(folder.name());
  std::ofstream(folder / "output_now") << "";
  std::this_thread::sleep_for(std::chrono::milliseconds(15));
  EXPECT_FALSE(requests.to_stop());
  EXPECT_TRUE(requests.for_output());
  EXPECT_FALSE(requests.for_output());
  EXPECT_FALSE(std::filesystem::exists(folder / "output_now"));
  std::ofstream(folder / "stop") << "";
  std::this_thread::sleep_for(std::chrono::milliseconds(15));
  EXPECT_EQ(requests.to_stop().value_or(""), "a file `stop` was found in the run folder");
  EXPECT_FALSE(std::filesystem::exists(folder / "stop"));
}

} // namespace
} // namespace fissura::sim
