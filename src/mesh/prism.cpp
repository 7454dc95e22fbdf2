#include "mesh/prism.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <cmath>

namespace packbed {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertices = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>;
using Faces = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertices, Faces>>;

double signed_area(const Contour& c) {
  double twice = 0;
  for (std::size_t i = 0, j = c.size() - 1; i < c.size(); j = i++)
    twice += c[j].x() * c[i].y() - c[i].x() * c[j].y();
  return twice / 2;
}

// Even-odd rule.
bool inside(const std::vector<Contour>& contours, const Vec2& p) {
  bool in = false;
  for (const Contour& c : contours)
    for (std::size_t i = 0, j = c.size() - 1; i < c.size(); j = i++)
      if ((c[i].y() > p.y()) != (c[j].y() > p.y()) &&
          p.x() < c[i].x() + (p.y() - c[i].y()) / (c[j].y() - c[i].y()) * (c[j].x() - c[i].x()))
        in = !in;
  return in;
}

// Each contour with the material on its left: outlines counter-clockwise, holes clockwise.
std::vector<Contour> material_left(std::vector<Contour> contours) {
  for (std::size_t i = 0; i < contours.size(); ++i) {
    std::vector<Contour> others = contours;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    if (inside(others, contours[i][0]) == (signed_area(contours[i]) > 0))
      std::reverse(contours[i].begin(), contours[i].end());
  }
  return contours;
}

// Triangles of the region between the contours, counter-clockwise, by the points' numbers in their order.
std::vector<std::array<std::int32_t, 3>> triangles_between(const std::vector<Contour>& contours) {
  Triangulation triangulation;
  std::int32_t number = 0;
  std::vector<Vec2> points;
  for (const Contour& c : contours) {
    std::vector<Triangulation::Vertex_handle> handles;
    for (const Vec2& p : c) {
      handles.push_back(triangulation.insert({p.x(), p.y()}));
      handles.back()->info() = number++;
      points.push_back(p);
    }
    for (std::size_t i = 0; i < handles.size(); ++i)
      triangulation.insert_constraint(handles[i], handles[(i + 1) % handles.size()]);
  }
  std::vector<std::array<std::int32_t, 3>> out;
  for (const auto& face : triangulation.finite_face_handles()) {
    const std::array<std::int32_t, 3> t{face->vertex(0)->info(), face->vertex(1)->info(),
                                        face->vertex(2)->info()};
    const auto at = [&](std::size_t k) { return points[static_cast<std::size_t>(t[k])]; };
    if (inside(contours, (at(0) + at(1) + at(2)) / 3)) out.push_back(t);
  }
  std::sort(out.begin(), out.end());  // whatever order the triangulation keeps them in
  return out;
}

}  // namespace

double area_of(const Contour& contour) {
  return std::abs(signed_area(contour));
}

Contour circle_contour(const Vec2& centre, double radius, int sides) {
  const double angle = 2 * kPi / sides, r = radius * std::sqrt(angle / std::sin(angle));
  Contour out;
  for (int k = 0; k < sides; ++k)
    out.emplace_back(centre.x() + r * std::cos(k * angle), centre.y() + r * std::sin(k * angle));
  return out;
}

TriangleMesh prism_mesh(const Section& section, double low, double high) {
  const std::vector<Contour> contours = material_left(section.contours);
  TriangleMesh mesh;
  for (const double z : {low, high})
    for (const Contour& c : contours)
      for (const Vec2& p : c) mesh.vertices.emplace_back(p.x(), p.y(), z);
  const auto up = static_cast<std::int32_t>(mesh.vertices.size() / 2);
  for (const auto& [a, b, c] : triangles_between(contours)) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({a + up, b + up, c + up});
  }
  std::int32_t first = 0;
  for (const Contour& c : contours) {
    const auto n = static_cast<std::int32_t>(c.size());
    for (std::int32_t i = 0; i < n; ++i) {
      const std::int32_t a = first + i, b = first + (i + 1) % n;
      mesh.triangles.push_back({a, b, b + up});
      mesh.triangles.push_back({a, b + up, a + up});
    }
    first += n;
  }
  return mesh;
}

}  // namespace packbed
