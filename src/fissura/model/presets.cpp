#include "fissura/model/presets.hpp"

#include <cmath>

#include <fmt/core.h>

namespace fissura::model {

namespace {

constexpr double MPa = 1e6;

/// Both codes: MC2010 Eqs. 5.1-3a and b, EC2 Table 3.1.
PresetValue tensile_strength(double f_cm, double f_ck) {
  if (f_ck <= 50) return {0.3 * std::pow(f_ck, 2.0 / 3) * MPa, "0.3 f_ck^(2/3), in MPa"};
  return {2.12 * std::log(1 + f_cm / 10) * MPa, "2.12 ln(1 + f_cm/10), in MPa"};
}

} // namespace

PresetValues preset_values(ConcretePreset preset, double f_c) {
  double const f_cm = f_c / MPa, f_ck = (f_c - strength_margin) / MPa;
  PresetValues v;
  v.f_t = tensile_strength(f_cm, f_ck);
  v.G_f = {73 * std::pow(f_cm, 0.18), "73 f_cm^0.18 N/m, f_cm in MPa"};
  if (preset == ConcretePreset::ec2)
    v.E = {22e9 * std::pow(f_cm / 10, 0.3), "22 GPa (f_cm/10 MPa)^0.3"};
  else
    v.E = {21.5e9 * std::cbrt(f_cm / 10), "21.5 GPa (f_cm/10 MPa)^(1/3)"};
  return v;
}

StrengthRange preset_range(ConcretePreset preset) {
  return preset == ConcretePreset::ec2 ? StrengthRange{12 * MPa, 90 * MPa}
                                       : StrengthRange{12 * MPa, 120 * MPa};
}

std::string preset_name(ConcretePreset preset) {
  switch (preset) {
  case ConcretePreset::mc2010:
    return "mc2010";
  case ConcretePreset::ec2:
    return "ec2";
  case ConcretePreset::none:
    break;
  }
  return "none";
}

std::vector<std::string> preset_notes(ConcreteSpec const& c) {
  if (c.preset == ConcretePreset::none) return {};
  auto const v = preset_values(c.preset, c.f_c);
  auto const code = preset_name(c.preset);
  auto const note = [&](char const* key, double used, PresetValue const& p, double unit, char const* name) {
    if (used == p.value)
      return fmt::format("{}: {} = {:.4g} {} = {} ({})", c.name, key, used / unit, name, p.formula, code);
    return fmt::format("{}: {} = {:.4g} {} as given; {} says {:.4g} {} = {}", c.name, key, used / unit, name,
                       code, p.value / unit, name, p.formula);
  };
  return {fmt::format("{}: f_c = f_cm = {:.4g} MPa, f_ck = f_cm - 8 MPa = {:.4g} MPa ({})", c.name,
                      c.f_c / MPa, (c.f_c - strength_margin) / MPa, code),
          note("E", c.E, v.E, 1e9, "GPa"), note("f_t", c.f_t, v.f_t, MPa, "MPa"),
          note("G_f", c.G_f, v.G_f, 1, "N/m")};
}

} // namespace fissura::model
