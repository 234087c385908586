// The kernels for x86-64-v4: compiled with -march=x86-64-v4 (see src/fissura/CMakeLists.txt).
#include "fissura/concrete/batch_kernel.hpp"
#include "fissura/concrete/joint_kernel.hpp"
#include "fissura/concrete/tet_kernel.hpp"

namespace fissura::concrete {

extern KernelSet const kernels_v4;
KernelSet const kernels_v4{"x86-64-v4",
                           &joint_forces<core::Pack>,
                           &intact_joint_energy<core::Pack>,
                           &act_batch<core::Pack>,
                           &batch_energy<core::Pack>,
                           &tet_forces<core::Pack>};

} // namespace fissura::concrete
