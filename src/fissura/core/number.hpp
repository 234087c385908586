#pragma once
// Numbers as other programs write them into their files: one syntax for all readers.
#include <optional>
#include <string>
#include <string_view>

namespace fissura::core {

/// The text of a plain decimal number ("+1.5", ".5", "5.", "-3e-1", Fortran's "1.5D-03") without a leading +
/// and with an E for the exponent; nothing for anything else, be it "inf", "0x1p3" or a number with a unit.
std::optional<std::string> decimal_text(std::string_view word);

/// Its value; nothing where it is no number or too large for a double. Below the smallest double it is zero.
std::optional<double> read_decimal(std::string_view word);

} // namespace fissura::core
