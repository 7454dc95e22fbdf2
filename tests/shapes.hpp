#pragma once
// Bodies for tests, built without the code that reads and recognises meshes.
#include <cmath>
#include <memory>

#include "shape/container.hpp"
#include "shape/shape.hpp"

namespace packbed::test {

/// A prism of `facets` sides whose volume is that of the cylinder, with `rings` levels along its height.
inline TriangleMesh prism(double radius, double half_height, int facets, int rings = 1) {
  const double angle = 2 * kPi / facets;
  const double r = radius * std::sqrt(angle / std::sin(angle));
  TriangleMesh mesh;
  for (int k = 0; k <= rings; ++k)
    for (int i = 0; i < facets; ++i)
      mesh.vertices.emplace_back(r * std::cos(angle * i), r * std::sin(angle * i),
                                 half_height * (2.0 * k / rings - 1));
  const auto at = [&](int k, int i) { return k * facets + i % facets; };
  for (int k = 0; k < rings; ++k)
    for (int i = 0; i < facets; ++i) {
      mesh.triangles.push_back({at(k, i), at(k, i + 1), at(k + 1, i + 1)});
      mesh.triangles.push_back({at(k, i), at(k + 1, i + 1), at(k + 1, i)});
    }
  const int bottom = static_cast<int>(mesh.vertices.size()), top = bottom + 1;
  mesh.vertices.emplace_back(0, 0, -half_height);
  mesh.vertices.emplace_back(0, 0, half_height);
  for (int i = 0; i < facets; ++i) {
    mesh.triangles.push_back({bottom, at(0, i + 1), at(0, i)});
    mesh.triangles.push_back({top, at(rings, i), at(rings, i + 1)});
  }
  return mesh;
}

inline std::shared_ptr<Shape> cylinder(double diameter, double height, int facets = 48) {
  auto s = std::make_shared<Shape>();
  const double r = diameter / 2, h = height / 2;
  s->name = "cylinder";
  s->kind = ShapeClass::cylinder;
  s->radius = r;
  s->half_height = h;
  s->volume = s->mesh_volume = kPi * r * r * height;
  s->area = 2 * kPi * r * (r + height);
  const double across = s->volume * (3 * r * r + height * height) / 12;
  s->inertia = Vec3(across, across, s->volume * r * r / 2);
  s->bounding_radius = std::hypot(r, h);
  s->smallest_thickness = std::min(diameter, height);
  s->surface = prism(r, h, facets);
  return s;
}

/// The seeds' pellet: 3.42 x 3.46 mm.
inline std::shared_ptr<Shape> a38() {
  return cylinder(3.42e-3, 3.46e-3);
}

inline std::shared_ptr<Shape> sphere(double radius) {
  auto s = std::make_shared<Shape>();
  s->name = "sphere";
  s->kind = ShapeClass::sphere;
  s->radius = s->bounding_radius = radius;
  s->volume = s->mesh_volume = 4 * kPi / 3 * radius * radius * radius;
  s->area = 4 * kPi * radius * radius;
  s->inertia = Vec3::Constant(0.4 * s->volume * radius * radius);
  s->smallest_thickness = 2 * radius;
  return s;
}

/// The body whose surface is `mesh`, centred and principal as the mesh is given.
inline std::shared_ptr<Shape> mesh_body(const TriangleMesh& mesh, double volume, double thickness) {
  auto s = std::make_shared<Shape>();
  s->name = "mesh";
  s->kind = ShapeClass::mesh;
  s->surface = mesh;
  s->volume = s->mesh_volume = volume;
  s->inertia = Vec3::Constant(volume * thickness * thickness / 10);
  s->smallest_thickness = thickness;
  for (const Vec3& v : mesh.vertices) s->bounding_radius = std::max(s->bounding_radius, v.norm());
  for (const auto& t : mesh.triangles) {
    const Vec3& a = mesh.vertices[static_cast<std::size_t>(t[0])];
    s->area += 0.5 * (mesh.vertices[static_cast<std::size_t>(t[1])] - a)
                         .cross(mesh.vertices[static_cast<std::size_t>(t[2])] - a)
                         .norm();
  }
  return s;
}

inline TriangleMesh box(const Vec3& half) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.emplace_back(i & 1 ? half.x() : -half.x(), i & 2 ? half.y() : -half.y(),
                               i & 4 ? half.z() : -half.z());
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// A square cup as a wall solid: inside 2 `half` wide and `height` high from the floor at z = 0, walls and
/// floor `wall` thick, open above.
inline TriangleMesh square_cup(double half, double height, double wall) {
  TriangleMesh mesh;
  const auto ring = [&](double h, double z) {
    for (const auto& [x, y] : {std::pair{-h, -h}, {h, -h}, {h, h}, {-h, h}})
      mesh.vertices.emplace_back(x, y, z);
  };
  ring(half + wall, -wall);   // 0..3
  ring(half + wall, height);  // 4..7
  ring(half, height);         // 8..11
  ring(half, 0);              // 12..15
  const auto band = [&](int low, int high) {
    for (int i = 0; i < 4; ++i) {
      const int j = (i + 1) % 4;
      mesh.triangles.push_back({low + i, low + j, high + j});
      mesh.triangles.push_back({low + i, high + j, high + i});
    }
  };
  band(0, 4);
  band(4, 8);
  band(8, 12);
  mesh.triangles.push_back({0, 2, 1});
  mesh.triangles.push_back({0, 3, 2});
  mesh.triangles.push_back({12, 13, 14});
  mesh.triangles.push_back({12, 14, 15});
  return mesh;
}

}  // namespace packbed::test
