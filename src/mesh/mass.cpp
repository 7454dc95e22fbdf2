#include <algorithm>
#include <cmath>

#include "mesh/mesh.hpp"
#include "mesh/topology.hpp"

namespace packbed {
namespace {

// A sum that keeps what is rounded away (Neumaier, ZAMM 54 (1974) 39).
struct Sum {
  double total = 0, lost = 0;
  void operator+=(double x) {
    const double t = total + x;
    lost += std::abs(total) >= std::abs(x) ? (total - t) + x : (x - t) + total;
    total = t;
  }
  double value() const { return total + lost; }
};

// Volume, first and second moments of signed tetrahedra, about one point near them.
struct Moments {
  Sum volume;
  std::array<Sum, 3> first;
  std::array<Sum, 6> second;  // xx yy zz xy xz yz

  void add(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const double v = (b - a).dot((c - a).cross(d - a)) / 6;
    const Vec3 s = a + b + c + d;
    volume += v;
    for (int i = 0; i < 3; ++i) first[static_cast<std::size_t>(i)] += v / 4 * s[i];
    const Mat3 m =
        v / 20 *
        (a * a.transpose() + b * b.transpose() + c * c.transpose() + d * d.transpose() + s * s.transpose());
    const double parts[6] = {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2)};
    for (std::size_t i = 0; i < 6; ++i) second[i] += parts[i];
  }

  MassProperties about_centre(const Vec3& reference, double area) const {
    MassProperties out;
    out.area = area;
    out.volume = volume.value();
    out.centre = reference;
    if (out.volume == 0) return out;
    const Vec3 offset = Vec3(first[0].value(), first[1].value(), first[2].value()) / out.volume;
    Mat3 m;
    m << second[0].value(), second[3].value(), second[4].value(),  //
        second[3].value(), second[1].value(), second[5].value(),   //
        second[4].value(), second[5].value(), second[2].value();
    m -= out.volume * offset * offset.transpose();
    if (out.volume < 0) m = -m;
    out.centre = reference + offset;
    out.inertia = m.trace() * Mat3::Identity() - m;
    return out;
  }
};

double area_of(const TriangleMesh& mesh) {
  Sum area;
  for (const auto& t : mesh.triangles) area += triangle_area_vector(mesh, t).norm();
  return area.value();
}

Box3 box_of(const std::vector<Vec3>& points) {
  Box3 box;
  for (const Vec3& p : points) box.extend(p);
  return box;
}

}  // namespace

MassProperties mass_properties(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return {};
  const Vec3 reference = box_of(mesh.vertices).center();
  Moments moments;
  for (const auto& t : mesh.triangles)
    moments.add(Vec3::Zero(), corner(mesh, t, 0) - reference, corner(mesh, t, 1) - reference,
                corner(mesh, t, 2) - reference);
  return moments.about_centre(reference, area_of(mesh));
}

MassProperties mass_properties(const TetMesh& mesh) {
  if (mesh.tets.empty()) return {};
  const Vec3 reference = box_of(mesh.vertices).center();
  const auto at = [&](std::int32_t i) -> Vec3 {
    return mesh.vertices[static_cast<std::size_t>(i)] - reference;
  };
  Moments moments;
  for (const auto& t : mesh.tets) moments.add(at(t[0]), at(t[1]), at(t[2]), at(t[3]));
  return moments.about_centre(reference, area_of(boundary(mesh)));
}

Box3 bounding_box(const TriangleMesh& mesh) {
  return box_of(mesh.vertices);
}

TriangleMesh transformed(const TriangleMesh& mesh, double scale, const Quat& rotation,
                         const Vec3& translation) {
  TriangleMesh out = mesh;
  for (Vec3& v : out.vertices) v = rotation * (scale * v) + translation;
  return out;
}

}  // namespace packbed
