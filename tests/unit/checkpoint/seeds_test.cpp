// The seeds that the fuzz target of the checkpoints begins with: contents<k> behind a 1, file<k> behind a 0.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "fissura/checkpoint/file.hpp"
#include "fissura/checkpoint/validate.hpp"
#include "unit/checkpoint/state_at_random.hpp"
#include "unit/output/temporary_folder.hpp"

namespace fissura::checkpoint {
namespace {

namespace fs = std::filesystem;
using output::testing::read_bytes;

fs::path const corpus = fs::path(FISSURA_TEST_DATA) / "../../fuzz/corpus/checkpoint";
constexpr unsigned seeds = 4;

void write_seed(std::string const& name, char kind, std::string const& bytes) {
  std::ofstream(corpus / name, std::ios::binary) << kind << bytes;
}

/// Makes the seeds anew, after a change of the format: FISSURA_WRITE_SEEDS=1.
void write_seeds() {
  output::testing::TemporaryFolder const folder;
  for (unsigned k = 0; k < seeds; ++k) {
    write_file(folder / "file", [&](Saver& save) { save(testing::sound_state_at_random(k)); });
    write_seed("file" + std::to_string(k), 0, read_bytes(folder / "file"));
    write_seed("contents" + std::to_string(k), 1, read_file(folder / "file"));
  }
}

void expect_sound(std::string_view contents, std::string const& name) {
  auto state = testing::state_at_random(0);
  Loader load(contents, name);
  load(state);
  load.finish();
  validate(testing::model_of_states(), state, load);
}

// Requirement: the seeds are of the present format and fit their model, or the fuzzer would begin outside.
TEST(CheckpointSeeds, are_of_the_present_format) {
  if (std::getenv("FISSURA_WRITE_SEEDS")) write_seeds();
  for (unsigned k = 0; k < seeds; ++k) {
    auto const number = std::to_string(k);
    auto const contents = read_bytes((corpus / ("contents" + number)).string());
    auto const file = read_bytes((corpus / ("file" + number)).string());
    ASSERT_NO_THROW(expect_sound(std::string_view(contents).substr(1), "contents" + number));
    ASSERT_NO_THROW(expect_sound(contents_of(std::string_view(file).substr(1), "file"), "file" + number));
  }
}

} // namespace
} // namespace fissura::checkpoint
