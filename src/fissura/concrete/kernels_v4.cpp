// The kernels for x86-64-v4: compiled with -march=x86-64-v4 (see src/fissura/CMakeLists.txt).
#include "fissura/concrete/kernel_set.hpp"

namespace fissura::concrete {

extern KernelSet const kernels_v4;
constinit KernelSet const kernels_v4 = kernel_set<core::Pack>("x86-64-v4");

} // namespace fissura::concrete
