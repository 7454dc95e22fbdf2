#include "shape/recognise.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/topology.hpp"
#include "shape/shape.hpp"

namespace packbed {
namespace {

using Triangle = std::array<std::int32_t, 3>;

constexpr double kFlat = 1 - 1e-4;       // cosine (0.8 degrees): facets that belong to one plane
constexpr std::size_t kPlanesToTry = 4;  // directions of the largest plane faces that may be ends

Vec3 unit_normal(const TriangleMesh& mesh, const Triangle& t) {
  return triangle_area_vector(mesh, t).normalized();
}

// The round figure (2: circle, 3: sphere) nearest to the points, least squares in the squared distance: exact
// for points that lie on one (Kasa, IEEE Trans. Instrum. Meas. 25 (1976) 8).
template <int N>
struct Round {
  Eigen::Matrix<double, N, 1> centre;
  double radius = 0;
};
template <int N>
std::optional<Round<N>> fit_round(const std::vector<Eigen::Matrix<double, N, 1>>& points) {
  using Vec = Eigen::Matrix<double, N, 1>;
  if (points.size() <= N) return {};
  Vec middle = Vec::Zero();
  for (const Vec& p : points) middle += p;
  middle /= static_cast<double>(points.size());
  Eigen::Matrix<double, N, N> a = Eigen::Matrix<double, N, N>::Zero();
  Vec b = Vec::Zero();
  double square = 0;
  for (const Vec& p : points) {
    const Vec d = p - middle;
    a += d * d.transpose();
    b += 0.5 * d.squaredNorm() * d;
    square += d.squaredNorm();
  }
  const auto solver = a.ldlt();
  if (!(solver.rcond() > 1e-6)) return {};
  const Vec offset = solver.solve(b);
  double radius = 0;
  for (const Vec& p : points) radius += (p - middle - offset).norm();
  return Round<N>{middle + offset, radius / static_cast<double>(points.size())};
}

// Middles of a triangle's sides and its centre: where it lies deepest under a curved surface.
std::array<Vec3, 4> deepest(const TriangleMesh& mesh, const Triangle& t) {
  const Vec3 a = corner(mesh, t, 0), b = corner(mesh, t, 1), c = corner(mesh, t, 2);
  return {(a + b) / 2, (b + c) / 2, (c + a) / 2, (a + b + c) / 3};
}

// Directions in which a cylinder's axis may lie: the principal axes, and square to the largest plane faces (a
// cylinder of height sqrt(3) R has no principal axis of its own).
std::vector<Vec3> axis_candidates(const TriangleMesh& mesh) {
  std::vector<Vec3> out;
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(mass_properties(mesh).inertia);
  std::vector<std::pair<double, Vec3>> planes;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 square = triangle_area_vector(mesh, t);
    const double area = square.norm();
    if (area == 0) continue;
    const auto same = std::find_if(planes.begin(), planes.end(), [&](const auto& p) {
      return std::abs(p.second.dot(square)) > kFlat * area;
    });
    if (same != planes.end())
      same->first += area;
    else if (planes.size() < 256)
      planes.emplace_back(area, square / area);
  }
  std::stable_sort(planes.begin(), planes.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  for (std::size_t i = 0; i < std::min(kPlanesToTry, planes.size()); ++i) out.push_back(planes[i].second);
  for (int i = 0; i < 3; ++i) out.push_back(solver.eigenvectors().col(i));
  return out;
}

// The direction square to the ends, when the candidate is nearly so.
std::optional<Vec3> square_to_ends(const TriangleMesh& mesh, const Vec3& candidate) {
  Vec3 sum = Vec3::Zero();
  for (const Triangle& t : mesh.triangles) {
    const Vec3 square = triangle_area_vector(mesh, t);
    const double along = square.dot(candidate);
    if (std::abs(along) > 0.99 * square.norm()) sum += along > 0 ? square : -square;
  }
  if (sum.norm() == 0) return {};
  return sum.normalized();
}

// Where facets and vertices lie, in the frame of an axis.
struct AxisView {
  const TriangleMesh& mesh;
  Vec3 axis, u, v;

  AxisView(const TriangleMesh& m, const Vec3& a) : mesh(m), axis(a), u(a.unitOrthogonal()), v(a.cross(u)) {}
  double along(const Vec3& p) const { return p.dot(axis); }
  Eigen::Vector2d across(const Vec3& p) const { return {p.dot(u), p.dot(v)}; }
};

bool side_facet(const AxisView& view, const Triangle& t) {
  return std::abs(unit_normal(view.mesh, t).dot(view.axis)) < 0.5;
}

bool facet_follows_circle(const AxisView& view, const Triangle& t, const Round<2>& circle) {
  for (int k = 0; k < 3; ++k)
    if (std::abs((view.across(corner(view.mesh, t, k)) - circle.centre).norm() - circle.radius) >
        kRecogniseTolerance * circle.radius)
      return false;
  for (const Vec3& p : deepest(view.mesh, t))
    if ((view.across(p) - circle.centre).norm() < (1 - kRecogniseSag) * circle.radius) return false;
  return true;
}

// Side facets of a body about an axis through `middle`: those that look away from it, or towards it.
std::vector<Triangle> side(const AxisView& view, const Eigen::Vector2d& middle, bool outward) {
  std::vector<Triangle> out;
  for (const Triangle& t : view.mesh.triangles) {
    if (!side_facet(view, t)) continue;
    const Eigen::Vector2d away = view.across(triangle_centre(view.mesh, t)) - middle;
    if ((view.across(triangle_area_vector(view.mesh, t)).dot(away) > 0) == outward) out.push_back(t);
  }
  return out;
}

// The circle that all of these facets follow.
std::optional<Round<2>> circle_of(const AxisView& view, const std::vector<Triangle>& facets) {
  std::vector<Eigen::Vector2d> points;
  for (const Triangle& t : facets)
    for (int k = 0; k < 3; ++k) points.push_back(view.across(corner(view.mesh, t, k)));
  const auto circle = fit_round<2>(points);
  if (!circle) return {};
  for (const Triangle& t : facets)
    if (!facet_follows_circle(view, t, *circle)) return {};
  return circle;
}

// Facets that are no side lie in one of two ends, within the outer circle.
bool ends_are_flat(const AxisView& view, double low, double high, const Round<2>& circle) {
  const double step = kRecogniseTolerance * (high - low), size = (1 + kRecogniseTolerance) * circle.radius;
  for (const Triangle& t : view.mesh.triangles) {
    if (side_facet(view, t)) continue;
    const bool up = unit_normal(view.mesh, t).dot(view.axis) > 0;
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = corner(view.mesh, t, k);
      if (std::abs(view.along(p) - (up ? high : low)) > step) return false;
      if ((view.across(p) - circle.centre).norm() > size) return false;
    }
  }
  return true;
}

std::optional<CylinderFit> cylinder_along(const TriangleMesh& mesh, const Vec3& axis, const Vec3& middle) {
  const AxisView view(mesh, axis);
  double low = INFINITY, high = -INFINITY;
  for (const Vec3& p : mesh.vertices) {
    low = std::min(low, view.along(p));
    high = std::max(high, view.along(p));
  }
  const auto circle = circle_of(view, side(view, view.across(middle), true));
  if (!circle || !ends_are_flat(view, low, high, *circle)) return {};
  const Eigen::Vector2d c = circle->centre;
  CylinderFit fit{c.x() * view.u + c.y() * view.v + 0.5 * (low + high) * axis, axis, circle->radius,
                  high - low, 0};
  const std::vector<Triangle> hole = side(view, view.across(middle), false);
  if (hole.empty()) return fit;
  const auto inner = circle_of(view, hole);
  if (!inner || (inner->centre - c).norm() > kRecogniseTolerance * circle->radius) return {};
  fit.inner_radius = inner->radius;
  return fit;
}

// Plane patches that face straight up, lowest first; those too small to be a floor are left out.
std::vector<std::pair<double, std::vector<std::size_t>>> levels(const TriangleMesh& mesh) {
  const Vec3 size = bounding_box(mesh).sizes();
  std::vector<std::pair<double, std::size_t>> up;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (unit_normal(mesh, mesh.triangles[t]).z() > kFlat)
      up.emplace_back(triangle_centre(mesh, mesh.triangles[t]).z(), t);
  std::sort(up.begin(), up.end());
  std::vector<std::pair<double, std::vector<std::size_t>>> out;
  for (std::size_t i = 0, j = 0; i < up.size(); i = j) {
    double area = 0;
    std::vector<std::size_t> patch;
    for (j = i; j < up.size() && up[j].first - up[i].first <= 1e-6 * size.z(); ++j) {
      patch.push_back(up[j].second);
      area += triangle_area_vector(mesh, mesh.triangles[up[j].second]).norm();
    }
    if (area > 0.01 * size.x() * size.y()) out.emplace_back(up[i].first, std::move(patch));
  }
  return out;
}

// The corners of the floor's rim lie on a circle; the facets that rise from it form the inner wall.
std::optional<Round<2>> rim_circle(const TriangleMesh& mesh, const std::vector<std::size_t>& floor) {
  TriangleMesh patch;
  patch.vertices = mesh.vertices;
  for (const std::size_t t : floor) patch.triangles.push_back(mesh.triangles[t]);
  const std::vector<EdgeUse> uses = edge_uses(patch);
  std::vector<Eigen::Vector2d> rim;
  for (std::size_t i = 0, j = 0; i < uses.size(); i = j) {
    for (j = i; j < uses.size() && uses[j].low == uses[i].low && uses[j].high == uses[i].high;) ++j;
    if (j - i == 1)
      for (const std::int32_t v : {uses[i].low, uses[i].high})
        rim.push_back(mesh.vertices[static_cast<std::size_t>(v)].head<2>());
  }
  const auto circle = fit_round<2>(rim);
  if (!circle) return {};
  for (std::size_t i = 0; i < rim.size(); ++i) {
    if (std::abs((rim[i] - circle->centre).norm() - circle->radius) > kRecogniseTolerance * circle->radius)
      return {};
    if (i % 2 == 1 &&
        ((rim[i] + rim[i - 1]) / 2 - circle->centre).norm() < (1 - kRecogniseSag) * circle->radius)
      return {};
  }
  return circle;
}

std::optional<TubeFit> tube_on(const TriangleMesh& mesh, double floor, const Round<2>& circle) {
  const AxisView view(mesh, Vec3::UnitZ());
  // u and v of the view are not x and y: the circle in its terms
  const Round<2> round{view.across(Vec3(circle.centre.x(), circle.centre.y(), 0)), circle.radius};
  const double slack = kRecogniseTolerance * circle.radius;
  double rim = floor, area = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 square = triangle_area_vector(mesh, t);
    const Vec3 middle = triangle_centre(mesh, t);
    const Vec3 inward(circle.centre.x() - middle.x(), circle.centre.y() - middle.y(), 0);
    if (!side_facet(view, t) || square.dot(inward) <= 0 || !facet_follows_circle(view, t, round)) continue;
    area += square.norm();
    for (int k = 0; k < 3; ++k) rim = std::max(rim, corner(mesh, t, k).z());
  }
  const double whole = 2 * kPi * circle.radius * (rim - floor);
  if (rim - floor <= slack || std::abs(area - whole) > kRecogniseSag * whole) return {};
  for (const Triangle& t : mesh.triangles)  // nothing else inside
    for (const Vec3& p : {corner(mesh, t, 0), corner(mesh, t, 1), corner(mesh, t, 2)})
      if (p.z() > floor + slack && (p.head<2>() - circle.centre).norm() < circle.radius - slack) return {};
  return TubeFit{Vec3(circle.centre.x(), circle.centre.y(), floor), circle.radius, rim - floor};
}

}  // namespace

std::optional<SphereFit> recognise_sphere(const TriangleMesh& mesh) {
  const auto fit = fit_round<3>(mesh.vertices);
  if (!fit) return {};
  for (const Vec3& p : mesh.vertices)
    if (std::abs((p - fit->centre).norm() - fit->radius) > kRecogniseTolerance * fit->radius) return {};
  for (const Triangle& t : mesh.triangles)
    for (const Vec3& p : deepest(mesh, t))
      if ((p - fit->centre).norm() < (1 - kRecogniseSag) * fit->radius) return {};
  return SphereFit{fit->centre, fit->radius};
}

std::optional<CylinderFit> recognise_cylinder(const TriangleMesh& mesh) {
  const Vec3 middle = mass_properties(mesh).centre;
  for (const Vec3& candidate : axis_candidates(mesh))
    if (const auto axis = square_to_ends(mesh, candidate))
      if (const auto fit = cylinder_along(mesh, *axis, middle)) return fit;
  return {};
}

std::optional<TubeFit> recognise_tube(const TriangleMesh& mesh) {
  for (const auto& [z, floor] : levels(mesh))
    if (const auto circle = rim_circle(mesh, floor))
      if (const auto fit = tube_on(mesh, z, *circle)) return fit;
  return {};
}

std::optional<BoxFit> recognise_box(const TriangleMesh& mesh) {
  const Box3 outside = bounding_box(mesh);
  const double tolerance = kRecogniseTolerance * outside.sizes().maxCoeff();
  // every facet lies in a plane across an axis; those of the outside are known, the rest is the inside
  Box3 inside(Vec3::Constant(-INFINITY), Vec3::Constant(INFINITY));
  for (const auto& t : mesh.triangles) {
    const Vec3 area = triangle_area_vector(mesh, t);
    int axis = 0;
    area.cwiseAbs().maxCoeff(&axis);
    const double at = corner(mesh, t, 0)[axis], sign = area[axis] > 0 ? 1.0 : -1.0;
    for (int k = 1; k < 3; ++k)
      if (std::abs(corner(mesh, t, k)[axis] - at) > tolerance) return std::nullopt;
    const double hull = sign > 0 ? outside.max()[axis] : outside.min()[axis];
    if (std::abs(at - hull) <= tolerance) continue;
    double& side = sign > 0 ? inside.min()[axis] : inside.max()[axis];
    if (std::isfinite(side) && std::abs(side - at) > tolerance) return std::nullopt;
    side = at;
  }
  if (std::isfinite(inside.max().z())) return std::nullopt;  // a lid
  inside.max().z() = outside.max().z();
  if (!inside.min().allFinite() || !inside.max().allFinite() || inside.isEmpty()) return std::nullopt;
  // what is missing from the block is the inside and nothing else
  const double hollow = outside.volume() - mass_properties(mesh).volume;
  if (std::abs(hollow - inside.volume()) > 3 * kRecogniseTolerance * outside.volume()) return std::nullopt;
  const Vec3 size = inside.sizes(), middle = inside.center();
  return BoxFit{Vec3(middle.x(), middle.y(), inside.min().z()), size.x(), size.y(), size.z()};
}

}  // namespace packbed
