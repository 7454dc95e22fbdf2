#include "io/curves.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "io/atomic_file.hpp"

namespace packbed {
namespace {

/// A number, or nothing where there is none.
std::string field(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "";
}
std::string field(const std::vector<double>& values, std::size_t i) {
  return i < values.size() ? field(values[i]) : "";
}

void write_profile(const std::string& path, const std::string& what, const Profile& profile) {
  std::string out = fmt::format("{0}_m,{0}_dp,packing_density,packing_density_exact,porosity\n", what);
  for (std::size_t i = 0; i < profile.x_m.size(); ++i) {
    const std::vector<double>& best = profile.density.empty() ? profile.exact : profile.density;
    fmt::format_to(std::back_inserter(out), "{},{},{},{},{}\n", field(profile.x_m, i), field(profile.x_dp, i),
                   field(profile.density, i), field(profile.exact, i),
                   i < best.size() ? field(1 - best[i]) : "");
  }
  write_atomically(path, out);
}

void write_planar(const std::string& path, const PlanarMap& map) {
  std::string out = "x_m,y_m,packing_density\n";
  for (int y = 0; y < map.size[1]; ++y)
    for (int x = 0; x < map.size[0]; ++x) {
      const float value = map.density[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.size[0]) +
                                      static_cast<std::size_t>(x)];
      if (!std::isfinite(value)) continue;  // outside the container
      fmt::format_to(std::back_inserter(out), "{:.9g},{:.9g},{}\n", map.origin.x() + (x + 0.5) * map.pitch,
                     map.origin.y() + (y + 0.5) * map.pitch, value);
    }
  write_atomically(path, out);
}

void write_orientation(const std::string& path, const Orientation& o) {
  std::string out = "from_deg,to_deg,count,fraction,isotropic\n";
  for (std::size_t i = 0; i < o.count.size(); ++i)
    fmt::format_to(std::back_inserter(out), "{},{},{},{},{}\n", o.from_deg[i], o.to_deg[i], o.count[i],
                   o.fraction[i], o.isotropic[i]);
  write_atomically(path, out);
}

/// One line a pellet with an axis; the projection holds only those, in the same order.
void write_angles(const std::string& path, const Orientation& o) {
  std::string out = "pellet,angle_deg,lambert_x,lambert_y\n";
  std::size_t with_axis = 0;
  for (std::size_t i = 0; i < o.angle_deg.size(); ++i) {
    if (!std::isfinite(o.angle_deg[i])) continue;
    const bool projected = with_axis < o.lambert.size();
    fmt::format_to(std::back_inserter(out), "{},{},{},{}\n", i, o.angle_deg[i],
                   projected ? field(o.lambert[with_axis][0]) : "",
                   projected ? field(o.lambert[with_axis][1]) : "");
    ++with_axis;
  }
  write_atomically(path, out);
}

void write_sizes(const std::string& path, const AnalysisResult& a) {
  std::string out =
      "shape,from_m,to_m,diameter_m,count,number,volume,asked_number,asked_volume,coordination\n";
  for (std::size_t i = 0; i < a.sizes.size(); ++i) {
    const SizeRow& r = a.sizes[i];
    fmt::format_to(std::back_inserter(out), "{},{},{},{},{},{},{},{},{},{}\n", r.shape, r.from_m, r.to_m,
                   r.diameter_m, r.count, r.number, r.volume, field(r.asked_number), field(r.asked_volume),
                   a.coordination ? field(a.coordination->by_size, i) : "");
  }
  write_atomically(path, out);
}

void write_coordination(const std::string& path, const Coordination& c) {
  std::string out = "touching_pellets,count\n";
  for (std::size_t n = 0; n < c.histogram.size(); ++n)
    fmt::format_to(std::back_inserter(out), "{},{}\n", n, c.histogram[n]);
  write_atomically(path, out);
}

}  // namespace

void write_curves(const ResultFolder& folder, const AnalysisResult& analysis) {
  if (!analysis.axial.x_m.empty()) write_profile(folder.file(result_file::kAxial), "height", analysis.axial);
  if (!analysis.radial.x_m.empty())
    write_profile(folder.file(result_file::kRadial), "wall_distance", analysis.radial);
  if (analysis.planar) write_planar(folder.file(result_file::kPlanar), *analysis.planar);
  if (!analysis.sizes.empty()) write_sizes(folder.file(result_file::kSizes), analysis);
  if (analysis.coordination)
    write_coordination(folder.file(result_file::kCoordination), *analysis.coordination);
  if (!analysis.orientation) return;
  write_orientation(folder.file(result_file::kOrientation), *analysis.orientation);
  write_angles(folder.file(result_file::kAngles), *analysis.orientation);
}

}  // namespace packbed
