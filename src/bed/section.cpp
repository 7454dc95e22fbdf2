#include "bed/section.hpp"

#include <algorithm>
#include <cmath>

#include "bed/voxelise.hpp"
#include "lattice/count.hpp"

namespace packbed {

Section middle_section(double top, double diameter, const AnalysisWish& wish) {
  Section s{wish.from_diameters * diameter, wish.to_diameters * diameter, false};
  if (s.to <= top) return s;
  s.clipped = true;
  s.from = std::min(s.from, top / 4);
  s.to = top - 2 * diameter;
  if (s.to - s.from < diameter) s = {top / 4, 3 * top / 4, true};
  return s;
}

double pellet_diameter(const PackedBed& bed, const AnalysisWish& wish) {
  if (wish.diameter > 0) return wish.diameter;
  double volume = 0;
  for (const Pellet& p : bed.pellets) volume += bed.shapes[p.shape]->volume * p.scale * p.scale * p.scale;
  return bed.pellets.empty() ? 0 : std::cbrt(6 * volume / (kPi * static_cast<double>(bed.pellets.size())));
}

double middle_density(const PackedBed& bed, const AnalysisWish& wish) {
  if (bed.pellets.empty()) return 0;
  const GridFrame frame = frame_for(bed, wish.voxel);
  const double top = frame.origin.z() + frame.size[2] * frame.pitch;
  const Section section = middle_section(top, pellet_diameter(bed, wish), wish);
  const VoxelGrid space = container_space(bed.container, frame);
  const std::vector<std::int64_t> solid = slice_counts(voxelise(bed, frame), space),
                                  open = slice_counts(space);
  std::int64_t in = 0, of = 0;
  for (std::size_t z = 0; z < solid.size(); ++z) {
    const double height = frame.origin.z() + (static_cast<double>(z) + 0.5) * frame.pitch;
    if (height < section.from || height > section.to) continue;
    in += solid[z];
    of += open[open.size() == 1 ? 0 : z];
  }
  return of > 0 ? static_cast<double>(in) / static_cast<double>(of) : 0;
}

}  // namespace packbed
