#include "io/csv_table.hpp"

#include <fmt/format.h>

#include <cctype>
#include <fstream>

#include "math/error.hpp"
#include "math/quantity.hpp"

namespace packbed {
namespace {

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> out(1);
  for (const char c : line) {
    if (c == ',')
      out.emplace_back();
    else if (c != ' ' && c != '\t' && c != '\r')
      out.back() += c;
  }
  return out;
}

}  // namespace

CsvTable read_csv_table(const std::string& path, const std::string& what) {
  std::ifstream file(path);
  if (!file) throw InputError(path, "no readable file", "a CSV table of " + what);
  CsvTable table;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    const std::string where = fmt::format("{}:{}", path, ++number);
    if (line.empty() || line[0] == '#' || line == "\r") continue;
    const CsvLine read{where, cells_of(line)};
    if (table.header.cells.empty()) {
      table.header = read;
      continue;
    }
    if (read.cells.size() != table.header.cells.size())
      throw InputError(where, fmt::format("{} values", read.cells.size()),
                       fmt::format("{}, as in the header", table.header.cells.size()));
    table.lines.push_back(read);
  }
  if (table.lines.empty()) throw InputError(path, "no " + what, "a header line and a line for each");
  return table;
}

double csv_number(const std::string& cell, const std::string& where) {
  // a length in metres is read like a plain number
  if (cell.empty() || std::isalpha(static_cast<unsigned char>(cell.back())))
    throw InputError(where, "\"" + cell + "\"", "a finite number");
  return parse_quantity(cell + " m", Dimension::length, where);
}

}  // namespace packbed
