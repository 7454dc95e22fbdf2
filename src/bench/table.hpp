#pragma once
// Numbers of a bench in rows, as CSV and as HTML.
#include <fmt/format.h>

#include <string>
#include <type_traits>
#include <vector>

namespace packbed::bench {

struct Table {
  std::vector<std::string> columns;  // with their units: "force error, median [%]"
  std::vector<std::vector<std::string>> rows;

  /// One cell a column: text as it is, numbers to four digits.
  template <class... Cells>
  void add(const Cells&... cells) {
    rows.push_back({cell(cells)...});
  }

 private:
  template <class Cell>
  static std::string cell(const Cell& c) {
    if constexpr (std::is_floating_point_v<Cell>)
      return c == c ? fmt::format("{:.4g}", c) : "";
    else
      return fmt::format("{}", c);
  }
};

/// `heading`: lines of comment above the columns.
std::string to_csv(const Table& table, const std::vector<std::string>& heading);
std::string to_html(const Table& table);
std::string escaped(const std::string& text);  ///< for HTML and SVG

}  // namespace packbed::bench
