#pragma once
// Kernels exist once per instruction set; the program picks one at start.
#include <string_view>

namespace fissura::core {

/// What kernels are compiled for: packs of 2, 4 and 8 doubles, or one at a time (the oracle).
enum class InstructionSet { scalar, v2, v3, v4 };

/// The best one that this machine can run; the environment variable FISSURA_KERNELS=scalar|v2|v3|v4 overrides
/// it.
InstructionSet instruction_set();
/// By its name; throws core::Error when the machine cannot run it.
InstructionSet instruction_set(std::string_view name);

/// That one of four sets of kernels which was compiled for it.
template <class Kernels>
Kernels const& compiled_for(InstructionSet set, Kernels const& scalar, Kernels const& v2, Kernels const& v3,
                            Kernels const& v4) {
  Kernels const* const all[] = {&scalar, &v2, &v3, &v4};
  return *all[static_cast<int>(set)];
}

} // namespace fissura::core
