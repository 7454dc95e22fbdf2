#pragma once
// A picture of a bench: lines and points on two axes, as SVG text that needs nothing else.
#include <string>
#include <vector>

namespace packbed::bench {

struct Axis {
  std::string title;  // with its unit
  bool log = false;   // values that are not positive are left out
};

struct Series {
  std::string name;
  std::vector<double> x, y;
  std::vector<double> error;       // half length of a bar; empty: none
  std::vector<std::string> label;  // beside the points; empty: none
  bool joined = true;
};

struct Picture {
  std::string name;  // of its file, without .svg
  std::string title;
  Axis x, y;
  std::vector<Series> series;
};

std::string to_svg(const Picture& picture);

}  // namespace packbed::bench
