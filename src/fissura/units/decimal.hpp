#pragma once
// Numbers as decimal text. Shifting the decimal point is exact where multiplying by 1000 is not: "29.73 GPa"
// becomes the double nearest to 29.73e9, and the echo of any double reads back to the same bits.
#include <optional>
#include <string>
#include <string_view>

namespace fissura::units {

/// The longest plain decimal number at the start of text (sign, digits, point, exponent); empty if there is
/// none.
std::string_view leading_number(std::string_view text);

/// The double nearest to number x 10^exponent, number being what leading_number accepts; nothing where it
/// overflows.
std::optional<double> shifted_value(std::string_view number, int exponent);

/// Shortest text whose shifted_value(text, exponent) is exactly value; value must be finite.
std::string shifted_text(double value, int exponent);

} // namespace fissura::units
