// The kernels for x86-64-v2: compiled with -march=x86-64-v2 (see src/fissura/CMakeLists.txt).
#include "fissura/concrete/kernel_set.hpp"

namespace fissura::concrete {

extern KernelSet const kernels_v2;
constinit KernelSet const kernels_v2 = kernel_set<core::Pack>("x86-64-v2");

} // namespace fissura::concrete
