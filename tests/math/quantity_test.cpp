#include "math/quantity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "math/error.hpp"
#include "math/random.hpp"
#include "math/types.hpp"

namespace packbed {
namespace {

std::string refusal(const std::string& text, Dimension d) {
  try {
    parse_quantity(text, d, "key");
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(Quantity, EveryUnitIsItsDefinition) {
  const auto read = [](const char* text, Dimension d) { return parse_quantity(text, d); };
  EXPECT_EQ(read("3.42 mm", Dimension::length), 0.00342);
  EXPECT_EQ(read("1 cm", Dimension::length), 0.01);
  EXPECT_EQ(read("7 um", Dimension::length), 7e-6);
  EXPECT_EQ(read("7 \xc2\xb5m", Dimension::length), 7e-6);
  EXPECT_EQ(read("2 nm", Dimension::length), 2e-9);
  EXPECT_DOUBLE_EQ(read("1 in", Dimension::length), 0.0254);
  EXPECT_EQ(read("2 mm2", Dimension::area), 2e-6);
  EXPECT_EQ(read("31.78 mm3", Dimension::volume), 31.78e-9);
  EXPECT_EQ(read("50 ml", Dimension::volume), 50e-6);
  EXPECT_EQ(read("78 mg", Dimension::mass), 78e-6);
  EXPECT_EQ(read("2.41 g/cm3", Dimension::density), 2410);
  EXPECT_EQ(read("2.41 g/cm^3", Dimension::density), 2410);
  EXPECT_EQ(read("5 us", Dimension::time), 5e-6);
  EXPECT_EQ(read("1.5 min", Dimension::time), 90);
  EXPECT_EQ(read("2 h", Dimension::time), 7200);
  EXPECT_EQ(read("40 mm/s", Dimension::speed), 0.04);
  EXPECT_EQ(read("9.80665 m/s2", Dimension::acceleration), 9.80665);
  EXPECT_DOUBLE_EQ(read("180 deg", Dimension::angle), kPi);
  EXPECT_DOUBLE_EQ(read("60 rpm", Dimension::angular_velocity), 2 * kPi);
  EXPECT_DOUBLE_EQ(read("360 deg/s", Dimension::angular_velocity), 2 * kPi);
  EXPECT_EQ(read("3 mN", Dimension::force), 0.003);
  EXPECT_EQ(read("10 kN/m", Dimension::stiffness), 1e4);
  EXPECT_EQ(read("10 N/mm", Dimension::stiffness), 1e4);
  EXPECT_EQ(read("10 mN/mm", Dimension::stiffness), 10);
  EXPECT_EQ(read("2 mJ", Dimension::energy), 0.002);
}

TEST(Quantity, SpaceSignAndExponentAreOptional) {
  for (const char* text :
       {"3.42 mm", "3.42mm", "  3.42   mm ", "+3.42 mm", "342e-2 mm", "0.342E+1 mm", "3.420 mm"})
    EXPECT_EQ(parse_quantity(text, Dimension::length), 0.00342) << text;
  EXPECT_EQ(parse_quantity("-.5 m/s", Dimension::speed), -0.5);
}

TEST(Quantity, BareNumberIsRefusedWithTheUnits) {
  const std::string message = refusal("3.42", Dimension::length);
  EXPECT_NE(message.find("key: found \"3.42\""), std::string::npos) << message;
  EXPECT_NE(message.find("m, cm, mm, um, nm, in"), std::string::npos) << message;
  EXPECT_NE(message.find("\"3.42 m\""), std::string::npos) << message;
}

TEST(Quantity, UnitOfAnotherDimensionIsRefused) {
  const std::string message = refusal("3 kg", Dimension::length);
  EXPECT_NE(message.find("\"kg\" is not a unit of length"), std::string::npos) << message;
}

TEST(Quantity, AnythingButOneDecimalNumberAndOneUnitIsRefused) {
  for (const char* text : {"",         " ",       "mm",         "nan mm",
                           "inf mm",   "-inf mm", "NaN m",      "0x10 mm",
                           "1e mm",    "1e999 m", "3,42 mm",    "3.42 mm x",
                           "3.42 m m", "3..4 mm", "--3 mm",     "1e99999999999999999999 m",
                           "1 MM",     ". mm",    "3.42 mm; 4", "1 2 mm",
                           "- mm",     "e3 mm"})
    EXPECT_FALSE(refusal(text, Dimension::length).empty()) << text;
}

TEST(Quantity, FormatPicksTheUnitThatReadsWell) {
  EXPECT_EQ(format_quantity(0.00342, Dimension::length), "3.42 mm");
  EXPECT_EQ(format_quantity(0.0445, Dimension::length), "44.5 mm");
  EXPECT_EQ(format_quantity(0, Dimension::length), "0 m");
  EXPECT_EQ(format_quantity(5e-6, Dimension::time), "5 us");
  EXPECT_EQ(format_quantity(90, Dimension::time), "90 s");
  EXPECT_EQ(format_quantity(-0.5, Dimension::speed), "-500 mm/s");
  EXPECT_EQ(format_quantity(12345678, Dimension::length), "1.235e+07 m");
}

TEST(Quantity, ExactFormatReadsBackToTheSameBits) {
  Random random(1, Stream::test, 0);
  for (int d = 0; d <= static_cast<int>(Dimension::energy); ++d) {
    const Dimension dimension = static_cast<Dimension>(d);
    for (int i = 0; i < 300; ++i) {
      const double value = random.normal() * std::pow(10.0, random.uniform(-12, 12));
      EXPECT_EQ(parse_quantity(format_quantity_exactly(value, dimension), dimension), value);
    }
    EXPECT_EQ(parse_quantity(format_quantity_exactly(0, dimension), dimension), 0);
    const double tiny = std::numeric_limits<double>::denorm_min(), huge = 1e300;
    EXPECT_EQ(parse_quantity(format_quantity_exactly(tiny, dimension), dimension), tiny);
    EXPECT_EQ(parse_quantity(format_quantity_exactly(huge, dimension), dimension), huge);
  }
}

TEST(Quantity, ExactFormatIsAsShortAsPeopleWrite) {
  EXPECT_EQ(format_quantity_exactly(0.00342, Dimension::length), "3.42 mm");
  EXPECT_EQ(format_quantity_exactly(2410, Dimension::density), "2.41 g/cm3");
  EXPECT_EQ(format_quantity_exactly(0.2 * kPi / 180, Dimension::angle), "0.2 deg");
  EXPECT_EQ(format_quantity_exactly(0.0445, Dimension::length), "44.5 mm");
  EXPECT_EQ(format_quantity_exactly(0.135, Dimension::length), "135 mm");
  EXPECT_EQ(format_quantity_exactly(0.15, Dimension::length), "150 mm");
  EXPECT_EQ(format_quantity_exactly(0, Dimension::time), "0 s");
  EXPECT_EQ(format_quantity_exactly(0.0254, Dimension::length), "25.4 mm");
  EXPECT_EQ(format_quantity_exactly(1e4, Dimension::stiffness), "10 N/mm");
}

}  // namespace
}  // namespace packbed
