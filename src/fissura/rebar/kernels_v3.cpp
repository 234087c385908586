// The kernels for x86-64-v3: compiled with -march=x86-64-v3 (see src/fissura/CMakeLists.txt).
#include "fissura/rebar/bar_kernel.hpp"

namespace fissura::rebar {

extern BarKernels const bar_kernels_v3;
BarKernels const bar_kernels_v3{&stretch_elements<core::Pack>, &move_joints<core::Pack>};

} // namespace fissura::rebar
