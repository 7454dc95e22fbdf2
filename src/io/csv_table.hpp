#pragma once
// CSV files that a case names: a header line, lines of as many cells. Lines that start with # are comments.
#include <string>
#include <vector>

namespace packbed {

struct CsvLine {
  std::string where;  // "table.csv:7"
  std::vector<std::string> cells;
};

struct CsvTable {
  CsvLine header;
  std::vector<CsvLine> lines;  // one at least
};

/// Blanks round cells are dropped. Throws InputError for a file that is not there or has no line under its
/// header, and for a line of another length; `what` is what the file should hold.
CsvTable read_csv_table(const std::string& path, const std::string& what);

/// Throws InputError for what is not one finite number.
double csv_number(const std::string& cell, const std::string& where);

}  // namespace packbed
