#include "io/placed_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "io/csv_table.hpp"
#include "math/error.hpp"
#include "math/quantity.hpp"

namespace packbed {
namespace {

struct Column {
  std::string name, unit;  // "x", "mm"
};

constexpr const char* kColumns =
    "kind, x, y, z, qw, qx, qy, qz, vx, vy, vz, wx, wy, wz, fixed, scale (x, y, z needed; units as in x_mm, "
    "vx_m/s, "
    "wx_rad/s)";

std::optional<Dimension> dimension_of(const std::string& name) {
  if (name == "x" || name == "y" || name == "z") return Dimension::length;
  if (name == "vx" || name == "vy" || name == "vz") return Dimension::speed;
  if (name == "wx" || name == "wy" || name == "wz") return Dimension::angular_velocity;
  return {};
}

std::vector<Column> columns_of(const CsvLine& header) {
  const std::string& where = header.where;
  static const std::vector<std::string> plain = {"id", "kind", "shape", "qw",   "qx",
                                                 "qy", "qz",   "fixed", "scale"};
  std::vector<Column> columns;
  for (const std::string& cell : header.cells) {
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

int whole_value(const std::string& text, int high, const std::string& where) {
  const double value = csv_number(text, where);
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
    p.scale = csv_number(text, where);
    if (!(p.scale > 0)) throw InputError(where, text, "greater than 0");
  } else if (c.name == "qw") {
    p.pose.rotation.w() = csv_number(text, where);
  } else if (c.name[0] == 'q') {
    p.pose.rotation.vec()[axis] = csv_number(text, where);
  }
}

}  // namespace

std::vector<PlacedPellet> read_placed_csv(const std::string& path) {
  const CsvTable table = read_csv_table(path, "pellets");
  const std::vector<Column> columns = columns_of(table.header);
  std::vector<PlacedPellet> pellets;
  for (const CsvLine& line : table.lines) {
    PlacedPellet pellet;
    for (std::size_t i = 0; i < columns.size(); ++i)
      set(pellet, columns[i], line.cells[i], line.where + ": " + columns[i].name);
    Quat& q = pellet.pose.rotation;
    if (!(q.norm() > 1e-9 && q.norm() < 1e9))
      throw InputError(line.where, "a quaternion of no length", "w, x, y, z not all zero");
    if (std::abs(q.squaredNorm() - 1) > 1e-15) q.normalize();
    pellets.push_back(pellet);
  }
  return pellets;
}

}  // namespace packbed
