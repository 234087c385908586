#include "fissura/rebar/kernels.hpp"

#include "fissura/core/instruction_set.hpp"

namespace fissura::rebar {

extern BarKernels const bar_kernels_scalar, bar_kernels_v2, bar_kernels_v3, bar_kernels_v4;

BarKernels const& bar_kernels(std::string_view name) {
  return core::compiled_for(core::instruction_set(name), bar_kernels_scalar, bar_kernels_v2, bar_kernels_v3,
                            bar_kernels_v4);
}

BarKernels const& bar_kernels() {
  return core::compiled_for(core::instruction_set(), bar_kernels_scalar, bar_kernels_v2, bar_kernels_v3,
                            bar_kernels_v4);
}

} // namespace fissura::rebar
