#pragma once
// Text with a unit to SI and back. The unit grammar and the prefixes are those of UDUNITS-2.
#include <string>
#include <string_view>

#include "fissura/units/dimension.hpp"

namespace fissura::units {

/// "29.73 GPa" -> 29.73e9: a number, then a unit of the wanted dimension. The decimal point is shifted, so
/// the result is the double nearest to what was written wherever the unit is a power of ten of the SI unit.
/// Throws core::Error (Failure::input) with what is wrong and an example of what is expected; the caller adds
/// the place.
double to_si(std::string_view text, Dimension dimension);

/// number x factor, number being a plain decimal number (units/decimal.hpp): the double nearest to it where
/// the factor is a power of ten. Throws core::Error where it overflows.
double times(std::string_view number, double factor);

/// The value in a unit that reads well; to_si(from_si(x, d), d) == x to the last bit for finite x.
std::string from_si(double value, Dimension dimension);

} // namespace fissura::units
