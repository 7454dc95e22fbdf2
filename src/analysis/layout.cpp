#include "analysis/layout.hpp"

#include <algorithm>
#include <cmath>

namespace packbed {
namespace {

/// Heights between bins `step` slices high from the bottom of the grid to its top, the last one cut there.
std::vector<double> edges_along_z(const GridFrame& frame, int step) {
  std::vector<double> edges;
  for (int z = 0; z < frame.size[2]; z += step) edges.push_back(frame.origin.z() + z * frame.pitch);
  edges.push_back(frame.origin.z() + frame.size[2] * frame.pitch);
  return edges;
}

/// Distances from the wall between rings, the last one ending at the axis.
std::vector<double> edges_from_wall(double radius, double width) {
  std::vector<double> edges;
  for (int k = 0; k * width < radius * (1 - 1e-9); ++k) edges.push_back(k * width);
  edges.push_back(radius);
  return edges;
}

}  // namespace

Layout lay_out(const GridFrame& frame, double top, double diameter, double radius, const AnalysisWish& wish) {
  Layout layout;
  layout.frame = frame;
  layout.top = top;
  layout.diameter = diameter;
  layout.radius = radius;
  layout.section = middle_section(top, diameter, wish);
  const auto slice = [&](double z) {
    return static_cast<int>(
        std::clamp<double>(std::round((z - frame.origin.z()) / frame.pitch), 0, frame.size[2]));
  };
  layout.slice_begin = std::min(slice(layout.section.from), frame.size[2] - 1);
  layout.slice_end = std::max(slice(layout.section.to), layout.slice_begin + 1);
  layout.section.from = frame.origin.z() + layout.slice_begin * frame.pitch;
  layout.section.to = frame.origin.z() + layout.slice_end * frame.pitch;
  const int step = std::max(1, static_cast<int>(std::lround(diameter / 40 / frame.pitch)));
  layout.axial_edges = edges_along_z(frame, step);
  if (radius > 0) layout.ring_edges = edges_from_wall(radius, step * frame.pitch);
  return layout;
}

}  // namespace packbed
