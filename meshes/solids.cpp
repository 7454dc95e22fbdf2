#include "solids.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>

#include "math/types.hpp"

namespace packbed::meshes {
namespace {

namespace occ = gmsh::model::occ;
using gmsh::vectorpair;

// The sizes of a body by name.
class Sizes {
 public:
  explicit Sizes(const toml::table& body) : body_(body) {}
  double operator[](const char* key) const {
    if (const auto value = body_[key].value<double>()) return *value;
    throw std::runtime_error(fmt::format("{} is missing", key));
  }
  double operator()(const char* key, std::size_t i) const {
    const toml::array* list = body_[key].as_array();
    if (list == nullptr || i >= list->size()) throw std::runtime_error(fmt::format("{} is missing", key));
    return (*list)[i].value_or(0.0);
  }

 private:
  const toml::table& body_;
};

// A closed line of points and arcs in the plane z, for sections.
class Outline {
 public:
  explicit Outline(double z) : z_(z) {}
  int point(double x, double y) { return occ::addPoint(x, y, z_); }
  void line(int from, int to) { curves_.push_back(occ::addLine(from, to)); }
  void arc(int from, int centre, int to) { curves_.push_back(occ::addCircleArc(from, centre, to)); }
  vectorpair extruded(double height) const {
    vectorpair made, solids;
    occ::extrude({{2, occ::addPlaneSurface({occ::addCurveLoop(curves_)})}}, 0, 0, height, made);
    for (const auto& entity : made)
      if (entity.first == 3) solids.push_back(entity);
    return solids;
  }

 private:
  double z_;
  std::vector<int> curves_;
};

vectorpair without(const vectorpair& body, const vectorpair& tools) {
  vectorpair out;
  std::vector<vectorpair> map;
  occ::cut(body, tools, out, map);
  return out;
}

vectorpair cylinder(double radius, double z, double height, double x = 0, double y = 0) {
  return {{3, occ::addCylinder(x, y, z, 0, 0, height, radius)}};
}

// The profile in the xz plane, turned once round z.
void revolved(const Profile& profile) {
  std::vector<int> points, lines;
  for (const auto& [r, z] : profile) points.push_back(occ::addPoint(r, 0, z));
  for (std::size_t i = 0; i < points.size(); ++i)
    lines.push_back(occ::addLine(points[i], points[(i + 1) % points.size()]));
  const int face = occ::addPlaneSurface({occ::addCurveLoop(lines)});
  vectorpair made;
  occ::revolve({{2, face}}, 0, 0, 0, 0, 0, 1, 2 * kPi, made);
  vectorpair left{{2, face}};
  for (const int line : lines) left.emplace_back(1, line);
  occ::remove(left);
}

void ring(const Sizes& s) {
  const double h = s["height"];
  without(cylinder(s["diameter"] / 2, -h / 2, h), cylinder(s["inner_diameter"] / 2, -h / 2, h));
}

void holed(const Sizes& s) {
  const double h = s["height"], away = s["hole_circle"] / 2;
  const int n = static_cast<int>(s["holes"]);
  vectorpair holes;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * kPi * k / n;
    holes.push_back(
        cylinder(s["hole_diameter"] / 2, -h / 2, h, away * std::cos(angle), away * std::sin(angle))[0]);
  }
  without(cylinder(s["diameter"] / 2, -h / 2, h), holes);
}

void dished(const Sizes& s) {
  const double h = s["height"], rim = s["dish_diameter"] / 2, depth = s["dish_depth"];
  const double ball = (rim * rim + depth * depth) / (2 * depth), middle = h / 2 - depth + ball;
  without(cylinder(s["diameter"] / 2, -h / 2, h),
          {{3, occ::addSphere(0, 0, middle, ball)}, {3, occ::addSphere(0, 0, -middle, ball)}});
}

void star(const Sizes& s) {
  const double h = s["height"];
  const int n = static_cast<int>(s["points"]);
  Outline outline(-h / 2);
  std::vector<int> corners;
  for (int k = 0; k < 2 * n; ++k) {
    const double r = s[k % 2 == 0 ? "diameter" : "inner_diameter"] / 2, angle = kPi * k / n;
    corners.push_back(outline.point(r * std::cos(angle), r * std::sin(angle)));
  }
  for (std::size_t k = 0; k < corners.size(); ++k)
    outline.line(corners[k], corners[(k + 1) % corners.size()]);
  outline.extruded(h);
}

// Each lobe in two arcs, from cusp to tip to cusp: an arc may not pass half a turn.
void lobed(const Sizes& s) {
  const double h = s["height"], lobe = s["lobe_diameter"] / 2, away = s["diameter"] / 2 - lobe;
  const int n = static_cast<int>(s["lobes"]);
  const double half = kPi / n,
               cusp = away * std::cos(half) + std::sqrt(lobe * lobe - std::pow(away * std::sin(half), 2));
  Outline outline(-h / 2);
  const auto at = [&](double r, double angle) {
    return outline.point(r * std::cos(angle), r * std::sin(angle));
  };
  std::vector<int> cusps;
  for (int k = 0; k < n; ++k) cusps.push_back(at(cusp, (2 * k - 1) * half));
  for (int k = 0; k < n; ++k) {
    const int centre = at(away, 2 * k * half), tip = at(away + lobe, 2 * k * half);
    outline.arc(cusps[static_cast<std::size_t>(k)], centre, tip);
    outline.arc(tip, centre, cusps[static_cast<std::size_t>((k + 1) % n)]);
  }
  outline.extruded(h);
}

void box(const Sizes& s) {
  const double x = s("size", 0), y = s("size", 1), z = s("size", 2);
  occ::addBox(-x / 2, -y / 2, -z / 2, x, y, z);
}

void ellipsoid(const Sizes& s) {
  occ::dilate({{3, occ::addSphere(0, 0, 0, 1)}}, 0, 0, 0, s("size", 0) / 2, s("size", 1) / 2,
              s("size", 2) / 2);
}

// On a face, its centre of mass at the origin.
void tetrahedron(const Sizes& s) {
  const double a = s["edge"], r = a / std::sqrt(3.0), h = a * std::sqrt(2.0 / 3);
  std::vector<int> p{occ::addPoint(0, 0, 0.75 * h)};
  for (int k = 0; k < 3; ++k)
    p.push_back(occ::addPoint(r * std::cos(2 * kPi * k / 3), r * std::sin(2 * kPi * k / 3), -0.25 * h));
  int edge[4][4] = {};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) edge[i][j] = edge[j][i] = occ::addLine(p[i], p[j]);
  std::vector<int> faces;
  for (const auto& [i, j, k] : {std::array{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}})
    faces.push_back(occ::addPlaneSurface({occ::addCurveLoop({edge[i][j], edge[j][k], edge[k][i]})}));
  occ::addVolume({occ::addSurfaceLoop(faces)});
}

/*  A piece of the Pall ring's rows: the wall from its window's edge A round to the next window D-E, and the
   tongue, the sheet that was the window, turned inward about that edge (O: axis):

        D  A          O: axis, to the left along A-B
        E..B|         A, B: outer and inner side of the wall's end
         F ||         F: where the tongue leaves the wall's inner side
           GH         G, H: the tongue's tip                          */
vectorpair pall_piece(const Sizes& s, double hinge, double z) {
  const double outer = s["diameter"] / 2, t = s["wall"], inner = outer - t;
  const double window = s["window_angle"] * kPi / 180, rest = 2 * kPi / s["windows"] - window;
  // as large as the window was: from a base on the inner side of the wall, under half of sqrt(inner^2 - y^2)
  const double base = (t * std::sqrt(inner * inner - t * t) + inner * inner * std::asin(t / inner)) / 2;
  const double tip = (base - window / 2 * (outer * outer - inner * inner)) / t;
  Outline o(z);
  const Eigen::Vector2d out(std::cos(hinge), std::sin(hinge)), side(-out.y(), out.x());
  const auto point = [&](double radial, double aside) {
    const Eigen::Vector2d p = radial * out + aside * side;
    return o.point(p.x(), p.y());
  };
  const auto on_wall = [&](double radius, double angle) {
    return point(radius * std::cos(angle), radius * std::sin(angle));
  };
  const int axis = point(0, 0), a = point(outer, 0), d = on_wall(outer, rest), e = on_wall(inner, rest);
  const int f = on_wall(inner, std::asin(t / inner)), g = point(tip, t), h = point(tip, 0);
  o.arc(a, axis, d);
  o.line(d, e);
  o.arc(e, axis, f);
  o.line(f, g);
  o.line(g, h);
  o.line(h, a);
  return o.extruded(s["window_height"]);
}

void pall(const Sizes& s) {
  const double outer = s["diameter"] / 2, inner = outer - s["wall"], half = s["height"] / 2;
  const double row = s["window_height"], bridge = s["bridge"], pitch = 2 * kPi / s["windows"],
               window = s["window_angle"] * kPi / 180;
  vectorpair parts;
  for (int k = 0; k < static_cast<int>(s["windows"]); ++k)
    parts.push_back(pall_piece(s, k * pitch + window / 2, -bridge / 2 - row)[0]);
  // the other row is this one turned over, so that its tongues bend the opposite way, and staggered
  vectorpair other;
  occ::copy(parts, other);
  occ::rotate(other, 0, 0, 0, 1, 0, 0, kPi);
  occ::rotate(other, 0, 0, 0, 0, 0, 1, pitch / 2);
  parts.insert(parts.end(), other.begin(), other.end());
  const auto band = [&](double z, double height) {
    const vectorpair made = without(cylinder(outer, z, height), cylinder(inner, z, height));
    // the seam of a round face goes where both rows have windows: OpenCASCADE 7.6 fails on an arc across it
    occ::rotate(made, 0, 0, 0, 0, 0, 1, pitch / 4);
    parts.insert(parts.end(), made.begin(), made.end());
  };
  band(-half, half - row - bridge / 2);
  band(-bridge / 2, bridge);
  band(bridge / 2 + row, half - row - bridge / 2);
  vectorpair out;
  std::vector<vectorpair> map;
  occ::fuse({parts[0]}, vectorpair(parts.begin() + 1, parts.end()), out, map);
}

const std::map<std::string, std::function<void(const Sizes&)>> kShapes{
    {"sphere", [](const Sizes& s) { occ::addSphere(0, 0, 0, s["diameter"] / 2); }},
    {"ring", ring},
    {"holed", holed},
    {"dished", dished},
    {"star", star},
    {"lobed", lobed},
    {"box", box},
    {"tetrahedron", tetrahedron},
    {"ellipsoid", ellipsoid},
    {"pall", pall}};

}  // namespace

Profile profile_of(const toml::table& body) {
  Profile out;
  if (const toml::array* points = body["profile"].as_array())
    for (const auto& point : *points)
      out.emplace_back((*point.as_array())[0].value_or(0.0), (*point.as_array())[1].value_or(0.0));
  return out;
}

void build_solid(const toml::table& body) {
  const Profile profile = profile_of(body);
  const std::string shape = body["shape"].value_or(std::string());
  if (!profile.empty())
    revolved(profile);
  else if (const auto found = kShapes.find(shape); found != kShapes.end())
    found->second(Sizes(body));
  else
    throw std::runtime_error(fmt::format("no profile, and \"{}\" is no shape", shape));
  occ::synchronize();
}

}  // namespace packbed::meshes
