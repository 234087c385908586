// Requirement: whatever bytes a checkpoint holds, reading it ends in a state that fits the model or in a
// core::Error. The first byte chooses whether the bytes are a file, or the contents of one whose checksum is
// right.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "fissura/checkpoint/file.hpp"
#include "fissura/checkpoint/validate.hpp"
#include "fissura/core/error.hpp"
#include "memory_limit.hpp"
#include "unit/checkpoint/state_at_random.hpp"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  static auto const model = fissura::checkpoint::testing::model_of_states();
  if (size < 1) return 0;
  std::string_view bytes(reinterpret_cast<char const*>(data) + 1, size - 1);
  auto state = fissura::checkpoint::testing::state_at_random(0);
  fissura::fuzz::read_within_limit(size, [&] {
    try {
      if (data[0] % 2 == 0) bytes = fissura::checkpoint::contents_of(bytes, "fuzz.bin");
      fissura::checkpoint::Loader load(bytes, "fuzz.bin");
      load(state);
      load.finish();
      fissura::checkpoint::validate(model, state, load);
    } catch (fissura::core::Error const&) {
    }
  });
  return 0;
}
