#include "fissura/core/instruction_set.hpp"

#include <cstdlib>
#include <string>

#include "fissura/core/error.hpp"

namespace fissura::core {

namespace {

bool runs_v3() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
}
bool runs_v4() {
  return runs_v3() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
         __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
}

InstructionSet choose() {
  if (char const* const wish = std::getenv("FISSURA_KERNELS"); wish && *wish) return instruction_set(wish);
  return runs_v4() ? InstructionSet::v4 : runs_v3() ? InstructionSet::v3 : InstructionSet::v2;
}

} // namespace

InstructionSet instruction_set(std::string_view name) {
  if (name == "scalar") return InstructionSet::scalar;
  if (name == "v2") return InstructionSet::v2;
  if (name == "v3" && runs_v3()) return InstructionSet::v3;
  if (name == "v4" && runs_v4()) return InstructionSet::v4;
  throw Error(Failure::input, "kernel set '" + std::string(name) +
                                  "' is unknown or not for this machine (scalar, v2, v3, v4)");
}

InstructionSet instruction_set() {
  static InstructionSet const chosen = choose();
  return chosen;
}

} // namespace fissura::core
