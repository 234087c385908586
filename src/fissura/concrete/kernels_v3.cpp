// The kernels for x86-64-v3: compiled with -march=x86-64-v3 (see src/fissura/CMakeLists.txt).
#include "fissura/concrete/kernel_set.hpp"

namespace fissura::concrete {

extern KernelSet const kernels_v3;
constinit KernelSet const kernels_v3 = kernel_set<core::Pack>("x86-64-v3");

} // namespace fissura::concrete
