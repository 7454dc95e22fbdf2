#include "shape/shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "math/error.hpp"
#include "mesh/build.hpp"
#include "mesh/check.hpp"
#include "shape/recognise.hpp"

namespace packbed {
namespace {

constexpr double kEqualMoments = 1e-2;  // relative: moments closer than this belong to one axis of revolution
constexpr double kSameMoments = 1e-6;   // relative: no axis can be told from the others

void set_sphere(Shape& s, double radius) {
  s.kind = ShapeClass::sphere;
  s.radius = radius;
  s.volume = 4.0 / 3 * kPi * radius * radius * radius;
  s.area = 4 * kPi * radius * radius;
  s.inertia = Vec3::Constant(0.4 * s.volume * radius * radius);
  s.bounding_radius = radius;
  s.smallest_thickness = 2 * radius;
}

void set_cylinder(Shape& s, double radius, double half_height) {
  s.kind = ShapeClass::cylinder;
  s.radius = radius;
  s.half_height = half_height;
  s.volume = kPi * radius * radius * 2 * half_height;
  s.area = 2 * kPi * radius * (radius + 2 * half_height);
  const double across = s.volume * (radius * radius / 4 + half_height * half_height / 3);
  s.inertia = Vec3(across, across, s.volume * radius * radius / 2);
  s.bounding_radius = std::hypot(radius, half_height);
  s.smallest_thickness = 2 * std::min(radius, half_height);
}

void set_tube(Shape& s, double radius, double inner_radius, double half_height) {
  const double squares = radius * radius + inner_radius * inner_radius;
  s.kind = ShapeClass::tube;
  s.radius = radius;
  s.inner_radius = inner_radius;
  s.half_height = half_height;
  s.volume = kPi * (radius - inner_radius) * (radius + inner_radius) * 2 * half_height;
  s.area = 2 * kPi * (radius + inner_radius) * (2 * half_height + radius - inner_radius);
  const double across = s.volume * (squares / 4 + half_height * half_height / 3);
  s.inertia = Vec3(across, across, s.volume * squares / 2);
  s.bounding_radius = std::hypot(radius, half_height);
  s.smallest_thickness = std::min(radius - inner_radius, 2 * half_height);
}

// Stretches points about the origin so that a body of volume `from` gets volume `to`: cylinder and tube
// square to the axis.
void conserve(std::vector<Vec3>& points, ShapeClass kind, double from, double to) {
  const bool flat_ends = kind == ShapeClass::cylinder || kind == ShapeClass::tube;
  const double s = flat_ends ? std::sqrt(to / from) : std::cbrt(to / from);
  for (Vec3& p : points) p = Vec3(s * p.x(), s * p.y(), flat_ends ? p.z() : s * p.z());
}

double reach(const std::vector<Vec3>& points) {
  double largest = 0;
  for (const Vec3& p : points) largest = std::max(largest, p.norm());
  return largest;
}

// The surface of an exact primitive gets the primitive's volume.
void give_volume(Shape& s) {
  s.mesh_volume = mass_properties(s.surface).volume;
  conserve(s.surface.vertices, s.kind, s.mesh_volume, s.volume);
  s.bounding_radius = std::max(s.bounding_radius, reach(s.surface.vertices));
}

Vec3 to_own(const Pose& from_file, const Vec3& p) {
  return from_file.rotation * (p - from_file.position);
}

// Shortest rotation that takes a direction to z; the direction or its opposite, whichever is nearer.
Quat turn_to_z(Vec3 axis) {
  const double by_size = std::abs(axis.z()) > 1e-9   ? axis.z()
                         : std::abs(axis.x()) > 1e-9 ? axis.x()
                                                     : axis.y();
  if (by_size < 0) axis = -axis;
  return Quat::FromTwoVectors(axis, Vec3::UnitZ());
}

// File axes to principal axes, as little turned as can be. A body with two equal moments has the third as z.
Quat principal_frame(const Mat3& inertia) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(inertia);
  const Vec3 moment = solver.eigenvalues();
  const auto apart = [&](int i, int j) { return std::abs(moment[i] - moment[j]) / moment[2]; };
  if (apart(0, 2) < kSameMoments) return Quat::Identity();
  const bool low_pair = apart(0, 1) < kEqualMoments && apart(0, 1) < 0.5 * apart(1, 2);
  const bool high_pair = apart(1, 2) < kEqualMoments && apart(1, 2) < 0.5 * apart(0, 1);
  Vec3 column[3];
  for (int i = 0; i < 3; ++i) column[i] = solver.eigenvectors().col(i);
  int z = low_pair ? 2 : high_pair ? 0 : -1;
  if (z >= 0 && apart((z + 1) % 3, (z + 2) % 3) < kSameMoments) return turn_to_z(column[z]);
  if (z < 0)  // three axes: each keeps the file axis that it is nearest to, z choosing first
    for (int i = 0; i < 3; ++i)
      if (z < 0 || std::abs(column[i].z()) > std::abs(column[z].z())) z = i;
  int x = (z + 1) % 3;
  if (std::abs(column[(z + 2) % 3].x()) > std::abs(column[x].x())) x = (z + 2) % 3;
  const Vec3 ez = column[z].z() < 0 ? Vec3(-column[z]) : column[z];
  const Vec3 ex = column[x].x() < 0 ? Vec3(-column[x]) : column[x];
  Mat3 rows;
  rows << ex.transpose(), ez.cross(ex).transpose(), ez.transpose();
  return Quat(rows).normalized();
}

bool volume_agrees(double fitted, double true_volume) {
  return true_volume == 0 || std::abs(fitted / true_volume - 1) <= 3 * kRecogniseTolerance;
}

// Sets class, sizes and frame when the mesh is a primitive.
bool take_for_primitive(Shape& s, const TriangleMesh& mesh, double true_volume) {
  if (const auto ball = recognise_sphere(mesh)) {
    set_sphere(s, ball->radius);
    s.from_file = {ball->centre, Quat::Identity()};
  } else if (const auto cylinder = recognise_cylinder(mesh)) {
    if (cylinder->inner_radius > 0)
      set_tube(s, cylinder->radius, cylinder->inner_radius, cylinder->height / 2);
    else
      set_cylinder(s, cylinder->radius, cylinder->height / 2);
    s.from_file = {cylinder->centre, turn_to_z(cylinder->axis)};
  } else {
    return false;
  }
  return volume_agrees(s.volume, true_volume);
}

void move_in(Shape& s, const TriangleMesh& mesh) {
  s.surface = mesh;
  for (Vec3& p : s.surface.vertices) p = to_own(s.from_file, p);
}

}  // namespace

std::string_view to_string(ShapeClass kind) {
  switch (kind) {
    case ShapeClass::sphere:
      return "sphere";
    case ShapeClass::cylinder:
      return "cylinder";
    case ShapeClass::mesh:
      return "mesh";
    case ShapeClass::tube:
      return "tube";
    case ShapeClass::convex:
      return "convex";
  }
  return "";
}

double Shape::equivalent_diameter() const {
  return kind == ShapeClass::sphere ? 2 * radius : std::cbrt(6 * volume / kPi);
}

ShapePtr make_sphere(const std::string& name, double radius, int facets) {
  auto s = std::make_shared<Shape>();
  s->name = name;
  s->source = fmt::format("sphere of diameter {:.6g} mm", 2e3 * radius);
  set_sphere(*s, radius);
  std::vector<std::pair<double, double>> profile{{0, -radius}};
  const int steps = std::max(2, facets / 2);
  for (int i = 1; i < steps; ++i)
    profile.emplace_back(radius * std::sin(kPi * i / steps), -radius * std::cos(kPi * i / steps));
  profile.emplace_back(0, radius);
  s->surface = revolved(profile, facets);
  give_volume(*s);
  return s;
}

ShapePtr make_cylinder(const std::string& name, double diameter, double height, int facets) {
  auto s = std::make_shared<Shape>();
  s->name = name;
  s->source =
      fmt::format("cylinder of diameter {:.6g} mm and height {:.6g} mm", 1e3 * diameter, 1e3 * height);
  const double r = diameter / 2, h = height / 2;
  set_cylinder(*s, r, h);
  s->surface = revolved({{0, -h}, {r, -h}, {r, h}, {0, h}}, facets);
  give_volume(*s);
  return s;
}

ShapePtr make_ring(const std::string& name, double diameter, double inner_diameter, double height,
                   int facets) {
  if (!(inner_diameter < diameter))
    throw InputError("inner_diameter", fmt::format("{:.6g} mm", 1e3 * inner_diameter),
                     fmt::format("less than the diameter, {:.6g} mm", 1e3 * diameter));
  auto s = std::make_shared<Shape>();
  s->name = name;
  s->source = fmt::format("ring of diameters {:.6g} and {:.6g} mm and height {:.6g} mm", 1e3 * diameter,
                          1e3 * inner_diameter, 1e3 * height);
  const double r = diameter / 2, inner = inner_diameter / 2, h = height / 2;
  set_tube(*s, r, inner, h);
  s->surface = revolved({{inner, -h}, {r, -h}, {r, h}, {inner, h}}, facets);
  give_volume(*s);
  return s;
}

ShapePtr make_shape(const std::string& name, const std::string& source, const TriangleMesh& mesh,
                    bool recognise, double true_volume) {
  const MassProperties m = mass_properties(mesh);
  if (!(m.volume > 0))
    throw InputError(source, fmt::format("a mesh of volume {:.3g} mm3", 1e9 * m.volume),
                     "a closed mesh that is seen counter-clockwise from outside");
  auto s = std::make_shared<Shape>();
  s->name = name;
  s->source = source;
  s->mesh_volume = m.volume;
  if (recognise && take_for_primitive(*s, mesh, true_volume)) {
    move_in(*s, mesh);
    give_volume(*s);
    return s;
  }
  s->kind = ShapeClass::mesh;
  s->radius = s->inner_radius = s->half_height = 0;
  s->from_file = {m.centre, principal_frame(m.inertia)};
  move_in(*s, mesh);
  if (true_volume > 0) conserve(s->surface.vertices, s->kind, m.volume, true_volume);
  const MassProperties own = mass_properties(s->surface);
  s->volume = own.volume;
  s->area = own.area;
  s->inertia = own.inertia.diagonal();
  s->bounding_radius = reach(s->surface.vertices);
  s->smallest_thickness = thinnest_wall(s->surface).value;
  if (recognise && find_planes(*s)) s->kind = ShapeClass::convex;
  return s;
}

bool find_planes(Shape& shape) {
  std::vector<Plane> planes = convex_planes(shape.surface);
  if (planes.empty() || planes.size() > kMostPlanes) return false;
  shape.corners = polyhedron_corners(shape.surface, planes);
  shape.planes = std::move(planes);
  return true;
}

ShapePtr with_tets(const Shape& shape, const TetMesh& tets) {
  auto out = std::make_shared<Shape>(shape);
  out->tets = tets;
  for (Vec3& p : out->tets->vertices) p = to_own(shape.from_file, p);
  const double volume = mass_properties(*out->tets).volume;
  if (volume > 0) conserve(out->tets->vertices, shape.kind, volume, shape.volume);
  return out;
}

}  // namespace packbed
