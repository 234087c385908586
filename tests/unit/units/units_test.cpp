#include "fissura/units/units.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <thread>

#include "fissura/core/error.hpp"
#include "fissura/units/decimal.hpp"
#include "support/refusal.hpp"

namespace {
using namespace fissura;
using units::Dimension;
using units::from_si;
using units::to_si;

std::string refusal(std::string_view text, Dimension dimension) {
  return support::refusal(core::Failure::input, [&] { to_si(text, dimension); });
}

double random_double(std::mt19937_64& random) {
  for (;;) {
    std::uint64_t const bits = random();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    if (std::isfinite(value)) return value;
  }
}

// A quantity written in a decimal unit is the double nearest to what was written, not a rounded product.
TEST(Units, DecimalUnitsAreExact) {
  EXPECT_EQ(to_si("29.73 GPa", Dimension::pressure), 29.73e9);
  EXPECT_EQ(to_si("30 GPa", Dimension::pressure), 30e9);
  EXPECT_EQ(to_si("12 mm", Dimension::length), 0.012);
  EXPECT_EQ(to_si("33.85 mm", Dimension::length), 33.85e-3);
  EXPECT_EQ(to_si("4.52 cm2", Dimension::area), 4.52e-4);
  EXPECT_EQ(to_si("3.15 N/mm2", Dimension::pressure), 3.15e6);
  EXPECT_EQ(to_si("2500 kg/m^3", Dimension::density), 2500);
  EXPECT_EQ(to_si("-1.25e-4m/s", Dimension::velocity), -1.25e-4);
  EXPECT_EQ(to_si("+0.142 N/mm", Dimension::energy_per_area), 142);
  EXPECT_EQ(to_si("7e6 Pa s", Dimension::viscosity), 7e6);
  EXPECT_EQ(to_si("  274 1/s ", Dimension::rate), 274);
}

// Units that are no power of ten of SI are converted with the factor of their definition.
TEST(Units, OtherUnitsUseTheirDefinition) {
  EXPECT_DOUBLE_EQ(to_si("36 deg", Dimension::angle), 0.6283185307179586);
  EXPECT_DOUBLE_EQ(to_si("1 ft", Dimension::length), 0.3048);
  EXPECT_DOUBLE_EQ(to_si("2 min", Dimension::time), 120);
  EXPECT_NEAR(to_si("1 ksi", Dimension::pressure), 6.894757293168e6, 1e-3);
}

// A unit of another dimension is refused with its name, the dimension wanted and an example.
TEST(Units, WrongDimension) {
  EXPECT_EQ(refusal("30 N", Dimension::pressure), "N is not a pressure; expected e.g. \"30 GPa\"");
  EXPECT_EQ(refusal("142 J", Dimension::energy_per_area),
            "J is not an energy per area; expected e.g. \"140 N/m\"");
  EXPECT_EQ(refusal("5 KN", Dimension::force), "unknown unit `KN`; did you mean `kN`?");
  EXPECT_EQ(refusal("36 %", Dimension::angle), "% is not an angle; expected e.g. \"36 deg\"");
}

// A slip of the shift key is named, also where the slip happens to be a unit of the right dimension.
TEST(Units, CapitalsAreHinted) {
  EXPECT_EQ(refusal("30 Mpa", Dimension::pressure), "unknown unit `Mpa`; did you mean `MPa`?");
  EXPECT_EQ(refusal("30 GPA", Dimension::pressure), "unknown unit `GPA`; did you mean `GPa`?");
  EXPECT_EQ(refusal("30 mPa", Dimension::pressure),
            "`mPa` is 0.001 Pa, no unit for a structure; did you mean `MPa`?");
  EXPECT_EQ(refusal("30 Mm", Dimension::length),
            "`Mm` is 1e+06 m, no unit for a structure; did you mean `mm`?");
  EXPECT_EQ(refusal("5 mN", Dimension::force),
            "`mN` is 0.001 N, no unit for a structure; did you mean `MN`?");
  EXPECT_EQ(refusal("5 Ms", Dimension::time), "`Ms` is 1e+06 s, no unit for a structure; did you mean `ms`?");
  EXPECT_EQ(refusal("7 mPa s", Dimension::viscosity),
            "`mPa s` is 0.001 Pa s, no unit for a structure; did you mean `MPa s`?");
}

// What the units library reads otherwise than a person would is refused: numbers inside a unit are factors to
// it, and what follows a stroke behind a blank multiplies.
TEST(Units, TextsWithTwoReadings) {
  auto const begins = [](std::string const& text, std::string const& with) {
    EXPECT_EQ(text.substr(0, with.size()), with);
  };
  begins(refusal("3 ft 2", Dimension::length), "`ft 2` has a number inside the unit");              // 6 ft
  begins(refusal("140 N/m 2", Dimension::energy_per_area), "`N/m 2` has a number inside the unit"); // 280 N/m
  begins(refusal("5 m/1000", Dimension::length), "`m/1000` has a number inside the unit");
  begins(refusal("30 N/mm 2", Dimension::pressure), "`N/mm 2` has a number inside the unit");
  begins(refusal("5 m/s s", Dimension::length), "`m/s s` can be read in two ways"); // a length
  begins(refusal("12 ton", Dimension::mass), "`ton` is 907 kg in one country");
  for (auto const* same : {"30 N/mm2", "30 N/mm^2", "30 N/mm²", "30 N mm-2", "30 N/mm/mm", "30 MN/m**2"})
    EXPECT_EQ(to_si(same, Dimension::pressure), 30e6) << same;
  EXPECT_EQ(to_si("7 N s/m2", Dimension::viscosity), 7);
  EXPECT_EQ(to_si("5 kg m/s", Dimension::impulse), 5);
  EXPECT_EQ(to_si("274 1/s", Dimension::rate), 274);
  EXPECT_EQ(to_si("2.5e-9 t/mm3", Dimension::density), 2500);
}

// A missing unit, a missing number and a number with a thousands separator are refused, each with its own
// words.
TEST(Units, Incomplete) {
  EXPECT_EQ(refusal("30e9", Dimension::pressure),
            "`30e9` has no unit; a pressure is expected, e.g. \"30 GPa\"");
  EXPECT_EQ(refusal("0", Dimension::length), "`0` has no unit; a length is expected, e.g. \"250 mm\"");
  EXPECT_EQ(refusal("mm", Dimension::length),
            "`mm` is not a length: it has no number; expected e.g. \"250 mm\"");
  EXPECT_EQ(refusal("", Dimension::time), "`` is not a time: it has no number; expected e.g. \"0.5 s\"");
  EXPECT_EQ(
      refusal("1 000 mm", Dimension::length),
      "`000 mm` has a number inside the unit, which would multiply it; an exponent touches its unit, `m2` "
      "or `m^2`; expected e.g. \"250 mm\"");
  EXPECT_EQ(refusal("29,73 GPa", Dimension::pressure),
            "`,73 GPa` does not follow a number: write a decimal point, and no marks between thousands; "
            "expected e.g. \"30 GPa\"");
  EXPECT_EQ(refusal("1e999 m", Dimension::length), "`1e999 m` is too large");
  EXPECT_EQ(refusal("nan m", Dimension::length).substr(0, 9), "`nan m` i");
  EXPECT_NE(refusal("inf m", Dimension::length), "accepted");
}

// Units with an offset, a logarithm or a date are not proportional to SI and are refused.
TEST(Units, OffsetUnitsAreRefused) {
  EXPECT_NE(refusal("1 m @ 5", Dimension::length).find("not a plain unit"), std::string::npos);
  EXPECT_NE(refusal("20 degC", Dimension::pressure), "accepted");
  EXPECT_NE(refusal("1 days since 1900-1-1", Dimension::time), "accepted");
  EXPECT_NE(refusal("1 lg(re 1 m)", Dimension::length), "accepted");
}

// The echo reads well for the values of a structural deck.
TEST(Units, EchoReadsWell) {
  EXPECT_EQ(from_si(29.73e9, Dimension::pressure), "29.73 GPa");
  EXPECT_EQ(from_si(3.15e6, Dimension::pressure), "3.15 MPa");
  EXPECT_EQ(from_si(0.012, Dimension::length), "12 mm");
  EXPECT_EQ(from_si(-4.5, Dimension::length), "-4.5 m");
  EXPECT_EQ(from_si(0, Dimension::length), "0 mm");
  EXPECT_EQ(from_si(142, Dimension::energy_per_area), "142 N/m");
  EXPECT_EQ(from_si(0.6283185307179586, Dimension::angle), "36 deg");
  EXPECT_EQ(from_si(4.52e-4, Dimension::area), "452 mm2");
  EXPECT_EQ(from_si(0.25, Dimension::none), "0.25");
}

// to_si(from_si(x)) gives back every finite double bit for bit, in every dimension.
TEST(Units, EchoRoundTripsToTheSameBits) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> exponent(-9, 12);
  for (int d = 0; d <= static_cast<int>(Dimension::rate); ++d)
    for (int i = 0; i < 400; ++i) {
      auto const dimension = static_cast<Dimension>(d);
      double const usual = std::pow(10.0, exponent(random)) * (i % 2 ? 1 : -1);
      for (double const x : {usual, random_double(random)})
        ASSERT_EQ(to_si(from_si(x, dimension), dimension), x) << from_si(x, dimension);
    }
}

// Any bytes are answered with a value or a refusal, from several threads at once, without abort.
TEST(Units, HostileTextIsSafe) {
  auto const attack = [](unsigned seed) {
    std::mt19937 random(seed);
    std::string const alphabet = "0123456789.eE+-^*/()@%mPaGNks \x01\xc2\xb5\xff\0";
    for (int i = 0; i < 2000; ++i) {
      std::string text;
      for (unsigned n = random() % 12; n > 0; --n) text += alphabet[random() % alphabet.size()];
      try {
        double const value = to_si(text, static_cast<Dimension>(random() % 13));
        ASSERT_TRUE(std::isfinite(value)) << text;
      } catch (core::Error const& e) {
        ASSERT_EQ(e.failure, core::Failure::input);
      }
    }
  };
  std::thread other(attack, 1U);
  attack(2);
  other.join();
  EXPECT_NE(refusal("1 " + std::string(100000, '('), Dimension::length), "accepted");
}

// The decimal shift is exact at the ends of the range: underflow gives zero, overflow gives nothing.
TEST(Units, NumbersThatAreNoneAreNotWritten) {
  EXPECT_THROW(from_si(NAN, Dimension::length), core::Error);
  EXPECT_THROW(from_si(INFINITY, Dimension::none), core::Error);
}

TEST(Decimal, EndsOfTheRange) {
  EXPECT_EQ(units::shifted_value("1e-400", 0), 0.0);
  EXPECT_EQ(units::shifted_value("1e99999999999999999999", 0), std::nullopt);
  EXPECT_EQ(units::shifted_value("-2.5", 3), -2500.0);
  EXPECT_EQ(units::leading_number("3e m"), "3");
  EXPECT_EQ(units::leading_number("."), "");
}

} // namespace
