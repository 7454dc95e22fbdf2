#include "bench/table.hpp"

namespace packbed::bench {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::string out;
  for (const std::string& c : cells) {
    if (&c != &cells.front()) out += ',';
    out += quoted(c);
  }
  return out + '\n';
}

std::string html_line(const std::vector<std::string>& cells, const char* tag) {
  std::string out = "<tr>";
  for (const std::string& c : cells) out += fmt::format("<{0}>{1}</{0}>", tag, escaped(c));
  return out + "</tr>\n";
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else
      out += c;
  }
  return out;
}

std::string to_csv(const Table& table, const std::vector<std::string>& heading) {
  std::string out;
  for (const std::string& line : heading) out += "# " + line + '\n';
  out += csv_line(table.columns);
  for (const auto& row : table.rows) out += csv_line(row);
  return out;
}

std::string to_html(const Table& table) {
  std::string out = "<div class='table'><table>\n" + html_line(table.columns, "th");
  for (const auto& row : table.rows) out += html_line(row, "td");
  return out + "</table></div>\n";
}

}  // namespace packbed::bench
