// The kernels for x86-64-v4: compiled with -march=x86-64-v4 (see src/fissura/CMakeLists.txt).
#include "fissura/motion/point_kernel.hpp"

namespace fissura::motion {

extern PointKernels const point_kernels_v4;
PointKernels const point_kernels_v4{&move};

} // namespace fissura::motion
