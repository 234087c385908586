#include "fissura/motion/kernels.hpp"

#include "fissura/core/instruction_set.hpp"

namespace fissura::motion {

extern PointKernels const point_kernels_scalar, point_kernels_v2, point_kernels_v3, point_kernels_v4;

PointKernels const& point_kernels() {
  return core::compiled_for(core::instruction_set(), point_kernels_scalar, point_kernels_v2, point_kernels_v3,
                            point_kernels_v4);
}

} // namespace fissura::motion
