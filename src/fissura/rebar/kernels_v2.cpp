// The kernels for x86-64-v2: compiled with -march=x86-64-v2 (see src/fissura/CMakeLists.txt).
#include "fissura/rebar/bar_kernel.hpp"

namespace fissura::rebar {

extern BarKernels const bar_kernels_v2;
BarKernels const bar_kernels_v2{&stretch_elements<core::Pack>, &move_joints<core::Pack>};

} // namespace fissura::rebar
