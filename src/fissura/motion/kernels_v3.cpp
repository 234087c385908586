// The kernels for x86-64-v3: compiled with -march=x86-64-v3 (see src/fissura/CMakeLists.txt).
#include "fissura/motion/point_kernel.hpp"

namespace fissura::motion {

extern PointKernels const point_kernels_v3;
PointKernels const point_kernels_v3{&move};

} // namespace fissura::motion
