// The same kernel for any x86-64: what the others are tested against.
#include "fissura/motion/point_kernel.hpp"

namespace fissura::motion {

extern PointKernels const point_kernels_scalar;
PointKernels const point_kernels_scalar{&move};

} // namespace fissura::motion
