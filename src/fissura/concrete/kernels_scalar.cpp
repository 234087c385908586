// The same kernels one tet at a time: the oracle that the packs are tested against.
#include "fissura/concrete/batch_kernel.hpp"
#include "fissura/concrete/joint_kernel.hpp"
#include "fissura/concrete/tet_kernel.hpp"

namespace fissura::concrete {

extern KernelSet const kernels_scalar;
KernelSet const kernels_scalar{"scalar",           &joint_forces<double>, &intact_joint_energy<double>,
                               &act_batch<double>, &batch_energy<double>, &tet_forces<double>};

} // namespace fissura::concrete
