// The kernels for x86-64-v3: compiled with -march=x86-64-v3 (see src/fissura/CMakeLists.txt).
#include "fissura/concrete/batch_kernel.hpp"
#include "fissura/concrete/joint_kernel.hpp"
#include "fissura/concrete/tet_kernel.hpp"

namespace fissura::concrete {

extern KernelSet const kernels_v3;
KernelSet const kernels_v3{"x86-64-v3",
                           &joint_forces<core::Pack>,
                           &intact_joint_energy<core::Pack>,
                           &act_batch<core::Pack>,
                           &batch_energy<core::Pack>,
                           &tet_forces<core::Pack>};

} // namespace fissura::concrete
