// The same kernels one tet at a time: the oracle that the packs are tested against.
#include "fissura/concrete/kernel_set.hpp"

namespace fissura::concrete {

extern KernelSet const kernels_scalar;
constinit KernelSet const kernels_scalar = kernel_set<double>("scalar");

} // namespace fissura::concrete
