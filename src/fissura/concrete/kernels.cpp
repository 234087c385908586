#include "fissura/concrete/kernels.hpp"

#include "fissura/core/instruction_set.hpp"

namespace fissura::concrete {

extern KernelSet const kernels_scalar, kernels_v2, kernels_v3, kernels_v4;

namespace {

KernelSet const& kernels_for(core::InstructionSet set) {
  KernelSet const* const all[] = {&kernels_scalar, &kernels_v2, &kernels_v3, &kernels_v4};
  return *all[static_cast<int>(set)];
}

} // namespace

KernelSet const& kernels(std::string_view name) {
  return kernels_for(core::instruction_set(name));
}

KernelSet const& kernels() {
  return kernels_for(core::instruction_set());
}

} // namespace fissura::concrete
