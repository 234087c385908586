// The kernels for x86-64-v2: compiled with -march=x86-64-v2 (see src/fissura/CMakeLists.txt).
#include "fissura/motion/point_kernel.hpp"

namespace fissura::motion {

extern PointKernels const point_kernels_v2;
PointKernels const point_kernels_v2{&move};

} // namespace fissura::motion
