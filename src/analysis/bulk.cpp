#include "analysis/bulk.hpp"

#include <fmt/format.h>

#include <cmath>

namespace packbed {
namespace {

std::string mm(double metres) {
  return fmt::format("{:.4g} mm", 1e3 * metres);
}

std::string inside_of(const Container& container, double radius) {
  switch (container.kind) {
    case ContainerKind::tube:
      return fmt::format("the inside of the tube of {} diameter", mm(2 * container.radius));
    case ContainerKind::box:
      return fmt::format("the inside of the box of {} x {}", mm(container.width), mm(container.depth));
    case ContainerKind::mesh:
      return "the inside of the container mesh, measured in voxels";
    default:
      return radius > 0 ? fmt::format("the inside of a tube of {} diameter", mm(2 * radius))
                        : "the upright box round the pellets";
  }
}

}  // namespace

double density_of_section(const SliceCounts& counts, const Layout& layout) {
  std::int64_t solid = 0, space = 0;
  for (int z = layout.slice_begin; z < layout.slice_end; ++z) {
    solid += counts.solid[static_cast<std::size_t>(z)];
    space += counts.space[static_cast<std::size_t>(z)];
  }
  return static_cast<double>(solid) / static_cast<double>(space);
}

double sd_in_section(const std::vector<double>& values, const Layout& layout) {
  double sum = 0, n = 0, squares = 0;
  const auto each = [&](const auto& use) {
    const double tiny = 1e-6 * layout.frame.pitch;
    for (std::size_t k = 0; k < values.size(); ++k)
      if (layout.axial_edges[k] >= layout.section.from - tiny &&
          layout.axial_edges[k + 1] <= layout.section.to + tiny)
        use(values[k]);
  };
  each([&](double v) {
    sum += v;
    n += 1;
  });
  each([&](double v) { squares += (v - sum / n) * (v - sum / n); });
  return n > 1 ? std::sqrt(squares / (n - 1)) : 0;
}

std::string definition_of_density(const Layout& layout, const Container& container, bool voxels) {
  const Section& s = layout.section;
  std::string text = fmt::format(
      "Volume of pellets over volume of {}, between {} and {} above the floor ({:.4g} to {:.4g} pellet "
      "diameters of {})",
      inside_of(container, layout.radius), mm(s.from), mm(s.to), s.from / layout.diameter,
      s.to / layout.diameter, mm(layout.diameter));
  if (s.clipped)
    text += fmt::format(", a section cut short because the bed is only {:.4g} diameters high",
                        layout.top / layout.diameter);
  if (voxels)
    text += fmt::format("; voxels of {}, solid when their centre lies in a pellet", mm(layout.frame.pitch));
  else
    text += "; from the exact shapes, without voxels";
  return text +
         fmt::format("; axial spread over bins {} high.", mm(layout.axial_edges[1] - layout.axial_edges[0]));
}

}  // namespace packbed
