// A restart that does not get far.
#include <gtest/gtest.h>

#include <filesystem>

#include "fissura/core/error.hpp"
#include "fissura/deck/deck.hpp"
#include "fissura/sim/run.hpp"
#include "unit/output/temporary_folder.hpp"

namespace fissura {
namespace {

namespace fs = std::filesystem;

// Requirement: a run that ends while it cuts its folder back to a checkpoint leaves no list that names a
// frame which is gone: the lists are cut before the frames. (A folder in the place of a frame stands in for
// the kill.)
TEST(KilledRestart, leaves_no_list_of_missing_frames) {
  output::testing::TemporaryFolder const folder;
  auto c = deck::read_case(fs::path(FISSURA_TEST_DATA) / "../../regression/decks/smashed_beam.toml",
                           {"output.frames=60"});
  sim::RunOptions o;
  o.out = folder / "run", o.deck_echo = "x", o.version = "1", o.quiet = true, o.threads = 1;
  c.output.checkpoint_steps = 200, c.run.max_steps = 400;
  sim::run_case(c, o);
  fs::remove(folder / "run/checkpoints/checkpoint_00002.bin");
  fs::create_directories(folder / "run/frames/fields_99999.vtu/in_use");
  o.restart = folder / "run";
  EXPECT_THROW(sim::run_case(c, o), core::Error);
  for (char const* list : {"fields", "cracks", "bars", "rigid"}) {
    std::string const text = output::testing::read_bytes(folder / "run/" + (std::string(list) + ".pvd"));
    int named = 0;
    for (std::size_t at = text.find("file=\""); at != std::string::npos;
         at = text.find("file=\"", at + 1), ++named) {
      std::string const frame = text.substr(at + 6, text.find('"', at + 6) - at - 6);
      EXPECT_TRUE(fs::exists(fs::path(folder / "run") / frame)) << frame;
      EXPECT_LE(frame, "frames/" + std::string(list) + "_00003.vtu"); // step 200 of 4444, 60 frames
    }
    EXPECT_GT(named, 0) << list;
  }
}

} // namespace
} // namespace fissura
