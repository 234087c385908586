// Requirement: whatever bytes a record holds, reading it ends in a motion or in a core::Error. The first two
// bytes choose which columns are asked for and what is done with them.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "fissura/core/error.hpp"
#include "fissura/model/record.hpp"
#include "memory_limit.hpp"

namespace {
fissura::model::RecordSpec spec_of(unsigned columns, unsigned work) {
  using Baseline = fissura::model::RecordSpec::Baseline;
  fissura::model::RecordSpec s;
  s.time_column = static_cast<int>(columns % 4);
  s.acceleration_column = static_cast<int>(columns / 4 % 4);
  if (s.time_column > 0 && s.acceleration_column == 0) s.acceleration_column = 1;
  s.time_step = 0.01;
  s.unit = 9.81;
  s.pga = work % 2 == 0 ? 0 : 3;
  s.baseline = static_cast<Baseline>(work / 2 % 4);
  return s;
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  if (size < 2) return 0;
  auto const spec = spec_of(data[0], data[1]);
  std::string_view const text(reinterpret_cast<char const*>(data) + 2, size - 2);
  fissura::fuzz::read_within_limit(size, [&] {
    try {
      auto record = fissura::model::parse_record(text, "fuzz.txt", spec);
      fissura::model::correct_and_integrate(record, spec);
    } catch (fissura::core::Error const&) {
    }
  });
  return 0;
}
