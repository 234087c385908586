#pragma once
// The physical dimensions a deck can ask for, with the words and units used in messages and in the echo.
#include <string_view>
#include <vector>

namespace fissura::units {

enum class Dimension {
  none, ///< a pure number
  length,
  area,
  time,
  force,
  pressure,
  density,
  energy_per_area,
  viscosity,
  angle,
  velocity,
  acceleration,
  rate,
  mass,
  impulse,
};

/// A unit 10^exponent times the SI unit, used from `from` upwards when a value is written.
struct EchoUnit {
  std::string_view name;
  int exponent;
  double from; ///< smallest magnitude [SI] written in this unit
};

/// What the program knows about one dimension.
struct DimensionInfo {
  std::string_view noun;      ///< with article: "a pressure"
  std::string_view example;   ///< a value as one writes it: "30 GPa"
  std::string_view si;        ///< the SI unit as UDUNITS reads it
  std::vector<EchoUnit> echo; ///< largest first; the last one takes everything that is left, and zero
  std::vector<std::string_view> usual;  ///< further spellings, for "did you mean"
  double least_unit = 0, most_unit = 0; ///< smallest and largest unit [SI] that is no slip of the shift key
  double most = 0; ///< beyond this magnitude [SI] no value is physical, and what follows from it overflows
};

DimensionInfo const& info(Dimension dimension);

} // namespace fissura::units
