#pragma once
// The kernels of one kind of pack. Included only by the files that are compiled per instruction set.
#include "fissura/concrete/batch_kernel.hpp"
#include "fissura/concrete/joint_kernel.hpp"
#include "fissura/concrete/kernels.hpp"
#include "fissura/concrete/tet_kernel.hpp"

namespace fissura::concrete {
inline namespace FISSURA_ISA {

template <class V> constexpr KernelSet kernel_set(std::string_view name) {
  return {name, &joint_forces<V>, &intact_joint_energy<V>, &act_batch<V>, &batch_energy<V>, &tet_forces<V>};
}

} // namespace FISSURA_ISA
} // namespace fissura::concrete
