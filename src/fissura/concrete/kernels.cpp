#include "fissura/concrete/kernels.hpp"

#include <cstdlib>
#include <string>

#include "fissura/core/error.hpp"

namespace fissura::concrete {

extern KernelSet const kernels_scalar, kernels_v2, kernels_v3, kernels_v4;

namespace {

bool runs_v3() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
}
bool runs_v4() {
  return runs_v3() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
         __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
}

KernelSet const& choose() {
  if (char const* const wish = std::getenv("FISSURA_KERNELS"); wish && *wish) return kernels(wish);
  return runs_v4() ? kernels_v4 : runs_v3() ? kernels_v3 : kernels_v2;
}

} // namespace

KernelSet const& kernels(std::string_view name) {
  if (name == "scalar") return kernels_scalar;
  if (name == "v2") return kernels_v2;
  if (name == "v3" && runs_v3()) return kernels_v3;
  if (name == "v4" && runs_v4()) return kernels_v4;
  throw core::Error(core::Failure::input, "kernel set '" + std::string(name) +
                                              "' is unknown or not for this machine (scalar, v2, v3, v4)");
}

KernelSet const& kernels() {
  static KernelSet const& chosen = choose();
  return chosen;
}

} // namespace fissura::concrete
