#include "math/quantity.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <span>

#include "math/error.hpp"
#include "math/types.hpp"

namespace packbed {
namespace {

struct Unit {
  std::string_view name;
  int power;          // SI value = number * factor * 10^power
  double factor = 1;  // other than 1: not a power of ten
};

constexpr Unit kLength[] = {{"m", 0}, {"cm", -2}, {"mm", -3}, {"um", -6}, {"nm", -9}, {"in", -4, 254}};
constexpr Unit kArea[] = {{"m2", 0}, {"cm2", -4}, {"mm2", -6}, {"um2", -12}};
constexpr Unit kVolume[] = {{"m3", 0}, {"l", -3}, {"ml", -6}, {"cm3", -6}, {"mm3", -9}, {"um3", -18}};
constexpr Unit kMass[] = {{"kg", 0}, {"g", -3}, {"mg", -6}};
constexpr Unit kDensity[] = {{"kg/m3", 0}, {"g/cm3", 3}};
constexpr Unit kTime[] = {{"s", 0}, {"ms", -3}, {"us", -6}, {"min", 0, 60}, {"h", 0, 3600}};
constexpr Unit kSpeed[] = {{"m/s", 0}, {"cm/s", -2}, {"mm/s", -3}};
constexpr Unit kAcceleration[] = {{"m/s2", 0}, {"mm/s2", -3}};
constexpr Unit kAngle[] = {{"rad", 0}, {"deg", 0, kPi / 180}};
constexpr Unit kAngularVelocity[] = {{"rad/s", 0}, {"deg/s", 0, kPi / 180}, {"rpm", 0, kPi / 30}};
constexpr Unit kForce[] = {{"N", 0}, {"kN", 3}, {"mN", -3}, {"uN", -6}};
constexpr Unit kStiffness[] = {{"N/m", 0}, {"N/mm", 3}, {"kN/m", 3}, {"mN/mm", 0}};
constexpr Unit kEnergy[] = {{"J", 0}, {"mJ", -3}, {"uJ", -6}, {"nJ", -9}};

constexpr Unit kPressure[] = {{"Pa", 0}, {"kPa", 3}, {"MPa", 6}, {"GPa", 9}};
constexpr Unit kRate[] = {{"1/s", 0}, {"1/ms", 3}};

std::span<const Unit> units(Dimension d) {
  switch (d) {
    case Dimension::length:
      return kLength;
    case Dimension::area:
      return kArea;
    case Dimension::volume:
      return kVolume;
    case Dimension::mass:
      return kMass;
    case Dimension::density:
      return kDensity;
    case Dimension::time:
      return kTime;
    case Dimension::speed:
      return kSpeed;
    case Dimension::acceleration:
      return kAcceleration;
    case Dimension::angle:
      return kAngle;
    case Dimension::angular_velocity:
      return kAngularVelocity;
    case Dimension::force:
      return kForce;
    case Dimension::stiffness:
      return kStiffness;
    case Dimension::energy:
      return kEnergy;
    case Dimension::pressure:
      return kPressure;
    case Dimension::rate:
      return kRate;
  }
  return {};
}

bool is_space(char c) {
  return c == ' ' || c == '\t';
}

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && is_space(s.front())) s.remove_prefix(1);
  while (!s.empty() && is_space(s.back())) s.remove_suffix(1);
  return s;
}

/// Length of the decimal number that s starts with: [+-] digits [. digits] [e [+-] digits]; 0 for none.
/// `mantissa` is its length without the exponent.
std::size_t number_length(std::string_view s, std::size_t& mantissa) {
  auto digits = [&](std::size_t i) {
    while (i < s.size() && s[i] >= '0' && s[i] <= '9') ++i;
    return i;
  };
  std::size_t begin = !s.empty() && (s[0] == '+' || s[0] == '-') ? 1 : 0;
  std::size_t end = digits(begin);
  std::size_t count = end - begin;
  if (end < s.size() && s[end] == '.') {
    const std::size_t after = digits(end + 1);
    count += after - end - 1;
    end = after;
  }
  mantissa = end;
  if (count == 0) return 0;
  if (end < s.size() && (s[end] == 'e' || s[end] == 'E')) {
    std::size_t sign = end + 1;
    if (sign < s.size() && (s[sign] == '+' || s[sign] == '-')) ++sign;
    if (const std::size_t after = digits(sign); after > sign) end = after;
  }
  return end;
}

/// The number times 10^power, rounded once; nothing when it is not finite.
std::optional<double> shifted(std::string_view number, std::size_t mantissa, int power) {
  int exponent = 0;
  if (mantissa < number.size()) {
    const char* from = number.data() + mantissa + 1;
    if (*from == '+') ++from;
    if (std::from_chars(from, number.data() + number.size(), exponent).ec != std::errc()) return {};
    if (std::abs(exponent) > 100000) return {};
  }
  if (number.front() == '+') {
    number.remove_prefix(1);
    --mantissa;
  }
  const std::string text = fmt::format("{}e{}", number.substr(0, mantissa), exponent + power);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

/// "m/s^2", "µm": other spellings of the same unit.
std::string plain_unit(std::string_view unit) {
  std::string plain;
  for (std::size_t i = 0; i < unit.size(); ++i) {
    const std::string_view rest = unit.substr(i);
    if (rest.starts_with("\xc2\xb5") || rest.starts_with("\xce\xbc")) {  // micro sign, Greek mu
      plain += 'u';
      ++i;
    } else if (unit[i] != '^') {
      plain += unit[i];
    }
  }
  return plain;
}

/// Engineers write millimetres and seconds, not centimetres, inches and hours.
bool usual(const Unit& u) {
  return u.factor == 1 && u.power != -2;
}

std::string allowed_text(Dimension d) {
  return fmt::format("a number and a unit of {}: {}", to_string(d), accepted_units(d));
}

const Unit* find_unit(std::string_view name, Dimension d) {
  const std::string plain = plain_unit(name);
  for (const Unit& u : units(d))
    if (u.name == plain) return &u;
  return nullptr;
}

/// The shortest decimal x for which parse_quantity("x unit") is `si`, bit for bit; empty when there is none.
std::string exact_number(double si, const Unit& u, Dimension d) {
  for (int precision = 0; precision <= 17; ++precision) {
    // so many digits, with the decimal point moved by the unit's power of ten
    const std::string scientific = fmt::format("{:.{}e}", si / u.factor, precision);
    const std::size_t e = scientific.find('e');
    const int exponent = std::stoi(scientific.substr(e + 1)) - u.power;
    const std::string moved = fmt::format("{}e{}", scientific.substr(0, e), exponent);
    const double in_unit = std::strtod(moved.c_str(), nullptr);
    if (!std::isfinite(in_unit)) return "";
    std::string number = fmt::format("{}", in_unit);
    if (parse_quantity(fmt::format("{} {}", number, u.name), d) == si) return number;
  }
  return "";
}

}  // namespace

std::string_view to_string(Dimension d) {
  switch (d) {
    case Dimension::length:
      return "length";
    case Dimension::area:
      return "area";
    case Dimension::volume:
      return "volume";
    case Dimension::mass:
      return "mass";
    case Dimension::density:
      return "density";
    case Dimension::time:
      return "time";
    case Dimension::speed:
      return "speed";
    case Dimension::acceleration:
      return "acceleration";
    case Dimension::angle:
      return "angle";
    case Dimension::angular_velocity:
      return "angular velocity";
    case Dimension::force:
      return "force";
    case Dimension::stiffness:
      return "stiffness";
    case Dimension::energy:
      return "energy";
    case Dimension::pressure:
      return "pressure";
    case Dimension::rate:
      return "rate";
  }
  return "";
}

double parse_quantity(std::string_view text, Dimension d, const std::string& where) {
  const std::string_view all = trimmed(text);
  const auto refuse = [&](const std::string& fix) {
    throw InputError(where, fmt::format("\"{}\"", text), allowed_text(d), fix);
  };
  std::size_t mantissa = 0;
  const std::size_t length = number_length(all, mantissa);
  if (length == 0) refuse(fmt::format("start with a decimal number, for example \"1 {}\"", units(d)[0].name));
  const std::string_view number = all.substr(0, length), unit = trimmed(all.substr(length));
  if (unit.empty()) refuse(fmt::format("add the unit, for example \"{} {}\"", number, units(d)[0].name));
  const Unit* u = find_unit(unit, d);
  if (!u) refuse(fmt::format("\"{}\" is not a unit of {}", unit, to_string(d)));
  const std::optional<double> value = shifted(number, mantissa, u->power);
  if (!value || !std::isfinite(*value * u->factor)) refuse("the number is too large");
  return *value * u->factor;
}

std::string accepted_units(Dimension d) {
  std::string list;
  for (const Unit& u : units(d)) list += (list.empty() ? "" : ", ") + std::string(u.name);
  return list;
}

std::string format_quantity(double si, Dimension d, int digits) {
  const Unit* best = &units(d)[0];
  double best_badness = 1e300;
  for (const Unit& u : units(d)) {
    if (!usual(u) && d != Dimension::angle) continue;
    const double number = std::abs(si) / (u.factor * std::pow(10.0, u.power));
    const double badness = si == 0                       ? 0
                           : number < 1                  ? 3 - std::log10(number)
                           : number < 1000 * (1 - 1e-12) ? 0
                                                         : std::log10(number);
    if (badness < best_badness) {
      best = &u;
      best_badness = badness;
    }
  }
  return fmt::format("{:.{}g} {}", si / (best->factor * std::pow(10.0, best->power)), digits, best->name);
}

std::string format_quantity_exactly(double si, Dimension d) {
  std::string best;
  std::size_t best_length = 0;
  int best_power = 0;
  for (const Unit& u : units(d)) {
    const std::string number = exact_number(si, u, d);
    if (number.empty() || u.power == -2) continue;
    if (si == 0) return fmt::format("{} {}", number, u.name);
    // the shortest number, best from 1 to 1000; of two alike the later (smaller) unit: 44.5 mm, not 4.45 cm.
    // Inches, minutes and degrees only where they save much.
    const double size = std::abs(std::strtod(number.c_str(), nullptr));
    const std::size_t length =
        number.size() + (u.factor != 1 ? 5 : 0) + (size != 0 && (size < 1 || size >= 1000) ? 1 : 0);
    if (best.empty() || length < best_length || (length == best_length && u.power != best_power)) {
      best = fmt::format("{} {}", number, u.name);
      best_length = length;
      best_power = u.power;
    }
  }
  return best;
}

}  // namespace packbed
