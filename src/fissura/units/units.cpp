#include "fissura/units/units.hpp"

#include <fmt/core.h>
#include <udunits2.h>

#include <cctype>
#include <cmath>
#include <memory>
#include <mutex>
#include <numbers>
#include <optional>

#include "fissura/core/error.hpp"
#include "fissura/units/decimal.hpp"

namespace fissura::units {
namespace {

struct FreeSystem {
  void operator()(ut_system* s) const { ut_free_system(s); }
};
struct FreeUnit {
  void operator()(ut_unit* u) const { ut_free(u); }
};
struct FreeConverter {
  void operator()(cv_converter* c) const { cv_free(c); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;

// UDUNITS keeps its parser and its status in globals, so one thread at a time; its default handler prints to
// stderr.
std::mutex& udunits_mutex() {
  static std::mutex mutex;
  return mutex;
}

ut_system* unit_system() {
  static std::unique_ptr<ut_system, FreeSystem> const system = [] {
    ut_set_error_message_handler(ut_ignore);
    return std::unique_ptr<ut_system, FreeSystem>(ut_read_xml(nullptr));
  }();
  if (!system)
    throw core::Error(core::Failure::io, "cannot read the unit database of UDUNITS-2 (udunits2.xml)");
  return system.get();
}

[[noreturn]] void refuse(std::string const& message) {
  throw core::Error(core::Failure::input, message);
}

std::string_view trim(std::string_view text) {
  auto const first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

/// A unit of the dimension that is spelt the same but for capitals: MPa for Mpa, kN for KN.
std::string_view same_but_for_case(std::string_view unit, Dimension dimension) {
  std::string const wanted = lower(unit);
  for (auto const& u : info(dimension).echo)
    if (lower(u.name) == wanted && u.name != unit) return u.name;
  for (auto const& name : info(dimension).usual)
    if (lower(name) == wanted && name != unit) return name;
  return {};
}

std::string expected(Dimension dimension) {
  return fmt::format("expected e.g. \"{}\"", info(dimension).example);
}

// UDUNITS has no "deg"; everybody who writes an angle has. Its "g" is a gram; among accelerations it is
// gravity.
std::string spelling_for_udunits(std::string_view unit, Dimension dimension) {
  if (unit == "deg") return "degree";
  if (unit == "g" && dimension == Dimension::acceleration) return "standard_free_fall";
  return std::string(unit);
}

bool may_start_unit(std::string_view unit) {
  auto const c = static_cast<unsigned char>(unit.front());
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '%' || c >= 0x80 || unit.starts_with("1/");
}

Unit parse(std::string_view unit, Dimension dimension) {
  constexpr std::size_t longest = 64;
  if (unit.size() > longest || !may_start_unit(unit)) return nullptr;
  return Unit(ut_parse(unit_system(), spelling_for_udunits(unit, dimension).c_str(), UT_UTF8));
}

/// SI units per given unit. Refuses what is not proportional to SI: offsets (degC), logarithms, dates.
std::optional<double> proportional_factor(ut_unit* unit, ut_unit* si) {
  std::unique_ptr<cv_converter, FreeConverter> const converter(ut_get_converter(unit, si));
  if (!converter) return std::nullopt;
  double const at_0 = cv_convert_double(converter.get(), 0.0);
  double const at_1 = cv_convert_double(converter.get(), 1.0);
  double const at_2 = cv_convert_double(converter.get(), 2.0);
  if (at_0 != 0 || !std::isfinite(at_1) || at_1 <= 0 || std::abs(at_2 - 2 * at_1) > 1e-12 * at_1)
    return std::nullopt;
  return at_1;
}

/// What UDUNITS reads, but a person reads otherwise: a number inside the unit is a factor to it ("3 ft 2" are
/// 6 ft, "140 N/m 2" 280 N/m), and a blank after a stroke multiplies ("m/s s" is a metre).
void refuse_ambiguous(std::string_view unit, Dimension dimension) {
  if (unit.front() == ',' || unit.front() == '\'' || unit.front() == '_')
    refuse(fmt::format(
        "`{}` does not follow a number: write a decimal point, and no marks between thousands; {}", unit,
        expected(dimension)));
  for (std::string_view const offset : {"@", "since", "(re"}) // said to be no plain unit, below
    if (unit.find(offset) != std::string_view::npos) return;
  auto const digit = [](char c) { return c >= '0' && c <= '9'; };
  for (std::size_t i = 0; i < unit.size(); ++i) {
    if (!digit(unit[i]) || (i > 0 && digit(unit[i - 1]))) continue;
    bool const reciprocal = i == 0 && unit.starts_with("1/");
    bool const signed_one = i > 1 && (unit[i - 1] == '-' || unit[i - 1] == '+');
    char const before = i == 0 ? ' ' : unit[i - (signed_one ? 2 : 1)];
    bool const exponent = std::isalpha(static_cast<unsigned char>(before)) != 0 || before == '^' ||
                          before == '*' || before == ')';
    if (!reciprocal && !exponent)
      refuse(
          fmt::format("`{}` has a number inside the unit, which would multiply it; an exponent touches its "
                      "unit, `m2` or `m^2`; {}",
                      unit, expected(dimension)));
  }
  auto const stroke = unit.find('/');
  if (stroke != std::string_view::npos && !unit.starts_with("1/") &&
      unit.find('(') == std::string_view::npos &&
      trim(unit.substr(stroke + 1)).find_first_of(" \t.*") != std::string_view::npos &&
      unit.find("**") == std::string_view::npos)
    refuse(fmt::format(
        "`{}` can be read in two ways: what follows the stroke would multiply; write e.g. `m/s^2`, "
        "`N s/m^2`; {}",
        unit, expected(dimension)));
  if (unit == "ton" || unit == "tons")
    refuse("`ton` is 907 kg in one country and 1000 kg or 1016 kg in others; write `t` for 1000 kg, or `lb`");
}

/// SI units per `unit`, after all checks of its spelling and dimension.
double factor_of(std::string_view unit, Dimension dimension) {
  refuse_ambiguous(unit, dimension);
  std::scoped_lock const lock(udunits_mutex());
  auto const hint = same_but_for_case(unit, dimension);
  std::string const cure = hint.empty() ? expected(dimension) : fmt::format("did you mean `{}`?", hint);
  Unit const parsed = parse(unit, dimension);
  if (!parsed) refuse(fmt::format("unknown unit `{}`; {}", unit, cure));
  Unit const si(ut_parse(unit_system(), std::string(info(dimension).si).c_str(), UT_UTF8));
  bool const percent_as_angle = dimension == Dimension::angle && unit == "%";
  if (!ut_are_convertible(parsed.get(), si.get()) || percent_as_angle)
    refuse(fmt::format("{} is not {}; {}", unit, info(dimension).noun, cure));
  auto const factor = proportional_factor(parsed.get(), si.get());
  if (!factor)
    refuse(fmt::format("`{}` is not a plain unit (it has an offset or a logarithm); {}", unit,
                       expected(dimension)));
  // A millipascal or a megametre in a structural deck is a slip of the shift key, a factor of 1e9.
  if (*factor < info(dimension).least_unit * (1 - 1e-9) || *factor > info(dimension).most_unit * (1 + 1e-9))
    refuse(fmt::format("`{}` is {:.3g} {}, no unit for a structure; {}", unit, *factor, info(dimension).si,
                       cure));
  return *factor;
}

/// k if factor is 10^k.
std::optional<int> power_of_ten(double factor) {
  int const k = static_cast<int>(std::lround(std::log10(factor)));
  double const exact = shifted_value("1", k).value_or(0);
  if (std::abs(factor - exact) > 1e-14 * exact) return std::nullopt;
  return k;
}

double scaled(std::string_view number, double factor, std::string_view text) {
  auto const exponent = power_of_ten(factor);
  auto const value = shifted_value(number, exponent.value_or(0));
  double const result = value ? (exponent ? *value : *value * factor) : HUGE_VAL;
  if (!std::isfinite(result)) refuse(fmt::format("`{}` is too large", text));
  return result;
}

/// Degrees if they name the angle exactly, as "36 deg" does for the double nearest to pi/5.
std::optional<std::string> in_degrees(double value) {
  std::string const number =
      shifted_text(std::strtod(fmt::format("{:.12g}", value * 180 / std::numbers::pi).c_str(), nullptr), 0);
  std::string const text = number + " deg";
  if (to_si(text, Dimension::angle) == value) return text;
  return std::nullopt;
}

} // namespace

double times(std::string_view number, double factor) {
  return scaled(number, factor, number);
}

double to_si(std::string_view text, Dimension dimension) {
  text = trim(text);
  auto const number = leading_number(text);
  auto const unit = trim(text.substr(number.size()));
  if (number.empty())
    refuse(
        fmt::format("`{}` is not {}: it has no number; {}", text, info(dimension).noun, expected(dimension)));
  if (unit.empty()) {
    if (dimension == Dimension::none) return scaled(number, 1, text);
    refuse(fmt::format("`{}` has no unit; {} is expected, e.g. \"{}\"", text, info(dimension).noun,
                       info(dimension).example));
  }
  return scaled(number, factor_of(unit, dimension), text);
}

std::string from_si(double value, Dimension dimension) {
  if (!std::isfinite(value)) refuse(fmt::format("{} is not a finite value", value));
  if (dimension == Dimension::angle && value != 0)
    if (auto degrees = in_degrees(value)) return *degrees;
  auto const& units = info(dimension).echo;
  auto unit = units.begin();
  while (unit + 1 != units.end() && std::abs(value) < unit->from) ++unit;
  std::string const number = shifted_text(value, unit->exponent);
  return unit->name.empty() ? number : fmt::format("{} {}", number, unit->name);
}

} // namespace fissura::units
