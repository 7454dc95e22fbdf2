// The bed as tables for people and other programs. fmt prints the shortest text that gives back the same
// double.
#include <fmt/format.h>

#include <iterator>

#include "io/atomic_file.hpp"
#include "io/bed.hpp"

namespace packbed {

void write_poses_csv(const std::string& path, const PackedBed& bed) {
  std::string out = "id,shape,x_m,y_m,z_m,qw,qx,qy,qz,scale\n";
  for (const Pellet& p : bed.pellets) {
    const Vec3& x = p.pose.position;
    const Quat& q = p.pose.rotation;
    fmt::format_to(std::back_inserter(out), "{},{},{},{},{},{},{},{},{},{}\n", p.id, p.shape, x.x(), x.y(),
                   x.z(), q.w(), q.x(), q.y(), q.z(), p.scale);
  }
  write_atomically(path, out);
}

void write_contacts_csv(const std::string& path, const PackedBed& bed) {
  std::string out = "a,b,x_m,y_m,z_m,fx_N,fy_N,fz_N,overlap_m\n";
  for (const Contact& c : bed.contacts)
    fmt::format_to(std::back_inserter(out), "{},{},{},{},{},{},{},{},{}\n", c.a,
                   c.b == kContainer ? -1 : static_cast<std::int64_t>(c.b), c.point.x(), c.point.y(),
                   c.point.z(), c.force.x(), c.force.y(), c.force.z(), c.overlap);
  write_atomically(path, out);
}

}  // namespace packbed
