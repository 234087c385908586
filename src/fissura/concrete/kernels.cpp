#include "fissura/concrete/kernels.hpp"

#include "fissura/core/instruction_set.hpp"

namespace fissura::concrete {

extern KernelSet const kernels_scalar, kernels_v2, kernels_v3, kernels_v4;

KernelSet const& kernels(std::string_view name) {
  return core::compiled_for(core::instruction_set(name), kernels_scalar, kernels_v2, kernels_v3, kernels_v4);
}

KernelSet const& kernels() {
  return core::compiled_for(core::instruction_set(), kernels_scalar, kernels_v2, kernels_v3, kernels_v4);
}

} // namespace fissura::concrete
