#include "io/placed_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>

#include "math/error.hpp"
#include "math/quantity.hpp"

namespace packbed {
namespace {

struct Column {
  std::string name, unit;  // "x", "mm"
};

constexpr const char* kColumns =
    "kind, x, y, z, qw, qx, qy, qz, vx, vy, vz, wx, wy, wz, fixed (x, y, z needed; units as in x_mm, vx_m/s, "
    "wx_rad/s)";

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> out(1);
  for (const char c : line) {
    if (c == ',')
      out.emplace_back();
    else if (c != ' ' && c != '\t' && c != '\r')
      out.back() += c;
  }
  return out;
}

std::optional<Dimension> dimension_of(const std::string& name) {
  if (name == "x" || name == "y" || name == "z") return Dimension::length;
  if (name == "vx" || name == "vy" || name == "vz") return Dimension::speed;
  if (name == "wx" || name == "wy" || name == "wz") return Dimension::angular_velocity;
  return {};
}

std::vector<Column> read_header(const std::string& line, const std::string& where) {
  static const std::vector<std::string> plain = {"id", "kind", "shape", "qw",   "qx",
                                                 "qy", "qz",   "fixed", "scale"};
  std::vector<Column> columns;
  for (const std::string& cell : cells(line)) {
    const std::size_t bar = cell.find('_');
    Column column{cell.substr(0, bar), bar == std::string::npos ? "" : cell.substr(bar + 1)};
    if (const auto dimension = dimension_of(column.name)) {
      if (column.unit.empty())
        throw InputError(
            where, "column \"" + cell + "\" without a unit",
            "a unit of " + std::string(to_string(*dimension)) + ": " + accepted_units(*dimension),
            fmt::format("name it {}_{}", cell,
                        accepted_units(*dimension).substr(0, accepted_units(*dimension).find(','))));
      parse_quantity("1 " + column.unit, *dimension, where + ": column " + cell);
    } else if (!column.unit.empty() || std::find(plain.begin(), plain.end(), column.name) == plain.end()) {
      throw InputError(where, "column \"" + cell + "\"", kColumns);
    }
    for (const Column& other : columns)
      if (other.name == column.name) throw InputError(where, "two columns \"" + column.name + "\"", kColumns);
    columns.push_back(column);
  }
  for (const char* name : {"x", "y", "z"})
    if (std::none_of(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; }))
      throw InputError(where, fmt::format("no column \"{}\"", name), kColumns);
  return columns;
}

double plain_value(const std::string& text, const std::string& where) {
  // a length in metres is read like a plain number
  if (text.empty() || std::isalpha(static_cast<unsigned char>(text.back())))
    throw InputError(where, "\"" + text + "\"", "a finite number");
  return parse_quantity(text + " m", Dimension::length, where);
}

int whole_value(const std::string& text, int high, const std::string& where) {
  const double value = plain_value(text, where);
  if (!(value >= 0 && value <= high) || value != std::floor(value))
    throw InputError(where, "\"" + text + "\"", fmt::format("a whole number from 0 to {}", high));
  return static_cast<int>(value);
}

void set(PlacedPellet& p, const Column& c, const std::string& text, const std::string& where) {
  const auto dimension = dimension_of(c.name);
  const Eigen::Index axis = c.name.back() - 'x';
  if (dimension) {
    const double value = parse_quantity(text + " " + c.unit, *dimension, where);
    (c.name.size() == 1 ? p.pose.position : c.name[0] == 'v' ? p.velocity : p.spin)[axis] = value;
  } else if (c.name == "kind" || c.name == "shape") {
    p.kind = static_cast<std::uint32_t>(whole_value(text, 1000000, where));
  } else if (c.name == "fixed") {
    p.fixed = whole_value(text, 1, where) == 1;
  } else if (c.name == "scale") {
    if (plain_value(text, where) != 1) throw InputError(where, text, "1: a case has no scaled pellets");
  } else if (c.name == "qw") {
    p.pose.rotation.w() = plain_value(text, where);
  } else if (c.name[0] == 'q') {
    p.pose.rotation.vec()[axis] = plain_value(text, where);
  }
}

}  // namespace

std::vector<PlacedPellet> read_placed_csv(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw InputError(path, "no readable file", "a CSV table of placed pellets");
  std::vector<Column> columns;
  std::vector<PlacedPellet> pellets;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    const std::string where = fmt::format("{}:{}", path, number);
    if (line.empty() || line[0] == '#' || line == "\r") continue;
    if (columns.empty()) {
      columns = read_header(line, where);
      continue;
    }
    const std::vector<std::string> row = cells(line);
    if (row.size() != columns.size())
      throw InputError(where, fmt::format("{} values", row.size()),
                       fmt::format("{}, as in the header", columns.size()));
    PlacedPellet pellet;
    for (std::size_t i = 0; i < row.size(); ++i)
      set(pellet, columns[i], row[i], where + ": " + columns[i].name);
    Quat& q = pellet.pose.rotation;
    if (!(q.norm() > 1e-9 && q.norm() < 1e9))
      throw InputError(where, "a quaternion of no length", "w, x, y, z not all zero");
    if (std::abs(q.squaredNorm() - 1) > 1e-15) q.normalize();
    pellets.push_back(pellet);
  }
  if (pellets.empty()) throw InputError(path, "no pellets", "a header line and a line for each pellet");
  return pellets;
}

}  // namespace packbed
