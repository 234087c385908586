// The same kernels one bar element or joint at a time: the oracle that the packs are tested against.
#include "fissura/rebar/bar_kernel.hpp"

namespace fissura::rebar {

extern BarKernels const bar_kernels_scalar;
BarKernels const bar_kernels_scalar{&stretch_elements<double>, &move_joints<double>};

} // namespace fissura::rebar
