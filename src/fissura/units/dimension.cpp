#include "fissura/units/dimension.hpp"

#include <array>

namespace fissura::units {

DimensionInfo const& info(Dimension dimension) {
  static std::array<DimensionInfo, 15> const table{{
      {"a pure number", "0.2", "1", {{"", 0, 0}}, {}},
      {"a length", "250 mm", "m", {{"m", 0, 1}, {"mm", -3, 0}}, {"cm", "km", "in", "ft"}},
      {"an area", "4.52 cm2", "m2", {{"m2", 0, 0.1}, {"mm2", -6, 0}}, {"cm2", "mm^2", "cm^2", "m^2"}},
      {"a time", "0.5 s", "s", {{"s", 0, 1e-2}, {"ms", -3, 0}}, {"us", "min"}},
      {"a force", "64 kN", "N", {{"MN", 6, 1e6}, {"kN", 3, 1e3}, {"N", 0, 0}}, {"lbf", "kip"}},
      {"a pressure",
       "30 GPa",
       "Pa",
       {{"GPa", 9, 1e9}, {"MPa", 6, 1e5}, {"Pa", 0, 0}},
       {"kPa", "N/mm2", "N/mm^2", "N/m2", "kN/m2", "psi", "ksi"}},
      {"a density", "2500 kg/m3", "kg/m3", {{"kg/m3", 0, 0}}, {"kg/m^3", "t/m3", "g/cm3"}},
      {"an energy per area", "140 N/m", "J/m2", {{"N/m", 0, 0}}, {"J/m2", "J/m^2", "N/mm", "kN/m"}},
      {"a viscosity", "7 MPa s", "Pa s", {{"MPa s", 6, 1e6}, {"Pa s", 0, 0}}, {"kPa s", "N s/m2"}},
      {"an angle", "36 deg", "rad", {{"rad", 0, 0}}, {"deg", "degree"}},
      {"a velocity", "0.1 m/s", "m/s", {{"m/s", 0, 1e-2}, {"mm/s", -3, 0}}, {"cm/s", "km/h"}},
      {"an acceleration", "9.81 m/s2", "m/s2", {{"m/s2", 0, 0}}, {"g", "cm/s2", "m/s^2", "mm/s2"}},
      {"a rate", "274 1/s", "1/s", {{"1/s", 0, 0}}, {"Hz", "1/ms", "s-1"}},
      {"a mass", "250 kg", "kg", {{"kg", 0, 0}}, {"t", "g"}},
      {"an impulse", "1.2 kN s", "N s", {{"kN s", 3, 1e3}, {"N s", 0, 0}}, {"kg m/s"}},
  }};
  return table[static_cast<std::size_t>(dimension)];
}

} // namespace fissura::units
