#pragma once
// Numbers with units, as people write them: "3.42 mm", "2.41 g/cm3", "0.2 deg".
#include <string>
#include <string_view>

namespace packbed {

enum class Dimension {
  length,            // m
  area,              // m2
  volume,            // m3
  mass,              // kg
  density,           // kg/m3
  time,              // s
  speed,             // m/s
  acceleration,      // m/s2
  angle,             // rad
  angular_velocity,  // rad/s
  force,             // N
  stiffness,         // N/m
  energy,            // J
  pressure,          // Pa
  rate               // 1/s
};

std::string_view to_string(Dimension);

/// "3.42 mm" -> 0.00342: one decimal number, then one unit of the dimension; in SI. Units that are powers of
/// ten of the SI unit are read as one decimal number, so that "3.42 mm" is exactly the double 0.00342. Throws
/// InputError, with `where` in front, for anything else (no unit, unknown unit, nan, inf, hexadecimal,
/// trailing text).
double parse_quantity(std::string_view text, Dimension, const std::string& where = "quantity");

/// "m, cm, mm, um, nm, in": what parse_quantity accepts, SI unit first.
std::string accepted_units(Dimension);

/// For messages: rounded to `digits` significant digits, in the unit that gives a number from 1 to 1000 if
/// one does.
std::string format_quantity(double si, Dimension, int digits = 4);

/// For files: parse_quantity gives back the same double.
std::string format_quantity_exactly(double si, Dimension);

}  // namespace packbed
