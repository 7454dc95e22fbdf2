#pragma once
// Plain pages with charts: SVG, no scripts, open offline.
#include <string>
#include <vector>

namespace packbed {

struct Series {
  std::vector<double> x, y;  // what is not finite is left out
  std::string ink;           // a colour of CSS
  bool dots = false;         // each by itself; else a line
  std::string name = {};     // in the legend; empty: not there
};

/// A heading and a frame with the series in it; x from 0 to the largest, y from `from` (or the least, where
/// that is lower) to the largest. Empty when there is nothing to draw.
std::string chart(const std::string& title, const std::string& x_label, const std::vector<Series>& series,
                  double from = 0);

/// Colours that can be told apart, again and again from the first.
const char* chart_ink(std::size_t n);

/// Text that stays text.
std::string html_text(const std::string& text);
/// A whole page round a body of HTML.
std::string page_of(const std::string& title, const std::string& body);

}  // namespace packbed
