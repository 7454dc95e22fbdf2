// Bulk packing densities measured elsewhere, as a table with a comment that names its source.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "io/atomic_file.hpp"
#include "io/report.hpp"
#include "io/report/assets.hpp"
#include "math/error.hpp"

namespace packbed {
namespace {

constexpr std::string_view kBuiltIn = "the built-in table of references";

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  if (line.ends_with(',')) cells.emplace_back();
  return cells;
}

std::string lower(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
  return word;
}

struct Table {
  std::string name, source;
  std::vector<std::map<std::string, std::string>> rows;
};

Table parse(const std::string& name, const std::string& text) {
  Table table{name, "", {}};
  std::vector<std::string> columns;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    constexpr std::string_view mark = "# source: ";
    if (line.starts_with(mark)) table.source = line.substr(mark.size());
    if (line.empty() || line.starts_with('#')) continue;
    const std::vector<std::string> cells = cells_of(line);
    if (columns.empty()) {
      columns = cells;
      continue;
    }
    if (cells.size() != columns.size())
      throw InputError(name, fmt::format("a line of {} cells: {}", cells.size(), line),
                       fmt::format("{} cells as in the first line", columns.size()));
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (i == 0) table.rows.emplace_back();
      table.rows.back()[columns[i]] = cells[i];
    }
  }
  for (const char* column : {"pellet", "container", "state", "n_ct", "ct_mean", "ct_sd"})
    if (std::find(columns.begin(), columns.end(), column) == columns.end())
      throw InputError(name, fmt::format("no column {}", column), "a table like cases/reference/ct_beds.csv");
  return table;
}

double number_in(const Table& table, const std::string& cell) {
  std::size_t used = 0;
  double value = 0;
  try {
    value = std::stod(cell, &used);
  } catch (const std::exception&) {
    used = std::string::npos;
  }
  if (used != cell.size()) throw InputError(table.name, "\"" + cell + "\"", "a number");
  return value;
}

}  // namespace

std::vector<ReferenceDensity> find_references(const std::string& table_file, const std::string& pellet,
                                              const std::string& container, const std::string& state) {
  const Table table = table_file.empty() ? parse(std::string(kBuiltIn), std::string(report::references()))
                                         : parse(table_file, read_file(table_file));
  std::vector<ReferenceDensity> found;
  for (auto row : table.rows) {
    if (row["pellet"] != lower(pellet) || row["container"] != lower(container) ||
        row["state"] != lower(state))
      continue;
    if (row["ct_mean"].empty()) continue;  // this bed was not scanned
    found.push_back(
        {fmt::format("CT, {}, {} bed{}", row["state"], row["n_ct"], row["n_ct"] == "1" ? "" : "s"),
         number_in(table, row["ct_mean"]), number_in(table, row["ct_sd"]), table.source});
  }
  return found;
}

}  // namespace packbed
