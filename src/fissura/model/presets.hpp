#pragma once
// What a design code says about a concrete of which only the compressive strength is known.
#include <string>
#include <vector>

#include "fissura/model/case.hpp"

namespace fissura::model {

/// A value [SI] and the formula it follows from.
struct PresetValue {
  double value = 0;
  std::string formula;
};

/// f_cm is the mean strength, f_ck = f_cm - 8 MPa the characteristic one.
struct PresetValues {
  PresetValue E;   ///< Young's modulus [Pa]: the tangent E_ci of MC2010, the secant E_cm of EC2
  PresetValue f_t; ///< mean tensile strength [Pa]
  PresetValue G_f; ///< fracture energy, mode I [J/m2]; EC2 has none and takes that of MC2010
};

/// mean minus characteristic strength [Pa], both codes
inline constexpr double strength_margin = 8e6;

/// fib Model Code 2010, 5.1.5.1, 5.1.5.2 and 5.1.7.2 (quartzite aggregate); EN 1992-1-1:2004, Table 3.1.
/// @param f_c mean compressive strength [Pa]
PresetValues preset_values(ConcretePreset preset, double f_c);

/// The characteristic strengths that the code covers [Pa].
struct StrengthRange {
  double least, most;
};
StrengthRange preset_range(ConcretePreset preset);

std::string preset_name(ConcretePreset preset);

/// "C30: E = 33.55 GPa = 21.5 GPa (f_cm/10 MPa)^(1/3) (mc2010)", and what the deck says otherwise.
std::vector<std::string> preset_notes(ConcreteSpec const& concrete);

} // namespace fissura::model
