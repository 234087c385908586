#include "fissura/rebar/kernels.hpp"

#include "fissura/core/instruction_set.hpp"

namespace fissura::rebar {

extern BarKernels const bar_kernels_scalar, bar_kernels_v2, bar_kernels_v3, bar_kernels_v4;

namespace {

BarKernels const& kernels_for(core::InstructionSet set) {
  BarKernels const* const all[] = {&bar_kernels_scalar, &bar_kernels_v2, &bar_kernels_v3, &bar_kernels_v4};
  return *all[static_cast<int>(set)];
}

} // namespace

BarKernels const& bar_kernels(std::string_view name) {
  return kernels_for(core::instruction_set(name));
}

BarKernels const& bar_kernels() {
  return kernels_for(core::instruction_set());
}

} // namespace fissura::rebar
