#include "analysis/penetration.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace packbed {
namespace {

constexpr int kMostFaces =
    4000;  // curved pairs need some 100; this only stops what rounding keeps from ending
constexpr double kTolerance = 1e-9;

/// A point of the difference body and where it comes from, relative to a's centre.
struct Corner {
  Vec3 of_a, of_b, point;
};

struct Face {
  std::array<int, 3> corner;
  Vec3 normal;      // unit, outward
  double distance;  // of the origin under the face [m]; negative when it is outside
};

class GrowingPolytope {
 public:
  GrowingPolytope(const Body& a, const Body& b)
      : a_(a),
        b_(b),
        size_(a.bounding_radius() + b.bounding_radius()),
        tolerance_(kTolerance * std::min(a.thickness(), b.thickness())) {}

  std::optional<Penetration> run() {
    if (!first_tetrahedron()) return std::nullopt;
    Penetration best;
    best.depth = size_ * 4;
    while (faces_.size() < kMostFaces) {
      const Face face = *std::min_element(
          faces_.begin(), faces_.end(), [](const Face& f, const Face& g) { return f.distance < g.distance; });
      const Corner far = furthest(face.normal);
      const double reach = face.normal.dot(far.point);
      if (reach <= 0) return std::nullopt;
      if (reach < best.depth) {
        best.depth = reach;
        best.normal = face.normal;
      }
      best.uncertainty = best.depth - face.distance;
      if (reach - face.distance <= tolerance_ || best.uncertainty <= tolerance_ || !grow(far)) {
        best.point = touch_point(face);
        return best;
      }
    }
    return best;
  }

 private:
  Corner furthest(const Vec3& n) const {
    Corner c;
    c.of_a = a_.furthest(n) - a_.centre();
    c.of_b = b_.furthest(-n) - a_.centre();
    c.point = c.of_a - c.of_b;
    return c;
  }
  void add_face(int i, int j, int k) {
    const Vec3 &p = at(i), &q = at(j), &r = at(k);
    const Vec3 area = (q - p).cross(r - p);
    const double twice = area.norm();
    if (twice <= 1e-24 * size_ * size_) {  // nothing to push out
      faces_.push_back({{i, j, k}, Vec3::Zero(), size_ * 4});
      return;
    }
    const Vec3 n = area / twice;
    faces_.push_back({{i, j, k}, n, n.dot(p)});
  }
  const Vec3& at(int i) const { return corners_[static_cast<std::size_t>(i)].point; }

  /// Four far corners, none in the plane of the others; false when the bodies are apart along one of the
  /// directions.
  bool first_tetrahedron() {
    Vec3 n = b_.centre() - a_.centre();
    n = n.norm() > 1e-12 * size_ ? n.normalized() : Vec3::UnitX();
    const auto take = [&](const Vec3& direction) {
      corners_.push_back(furthest(direction));
      return direction.dot(corners_.back().point) > 0;
    };
    if (!take(n) || !take(-n)) return false;
    const Vec3 line = at(1) - at(0), t = line.unitOrthogonal(), u = line.normalized().cross(t);
    if (!take_furthest({t, -t, u, -u}, [&](const Vec3& p) { return line.cross(p - at(0)).norm(); }))
      return false;
    const Vec3 up = line.cross(at(2) - at(0)).normalized();
    if (!take_furthest({up, -up}, [&](const Vec3& p) { return std::abs(up.dot(p - at(0))); })) return false;
    const bool turned = up.dot(at(3) - at(0)) > 0;  // then 0 1 2 seen from corner 3 runs counter-clockwise
    const int b = turned ? 2 : 1, c = turned ? 1 : 2;
    add_face(0, b, c);
    add_face(0, c, 3);
    add_face(c, b, 3);
    add_face(b, 0, 3);
    return true;
  }
  template <class Measure>
  bool take_furthest(std::initializer_list<Vec3> directions, const Measure& measure) {
    Corner best;
    double most = -1;
    for (const Vec3& d : directions) {
      const Corner c = furthest(d);
      if (d.dot(c.point) <= 0) return false;
      if (const double m = measure(c.point); m > most) {
        most = m;
        best = c;
      }
    }
    corners_.push_back(best);
    return true;
  }

  /// Replaces all faces that the new corner sees by a fan from it to their rim. False when it sees none.
  bool grow(const Corner& far) {
    const double see = 1e-14 * size_;
    rim_.clear();
    std::size_t kept = 0;
    for (const Face& f : faces_) {
      if (f.normal.dot(far.point) <= f.distance + see) {
        faces_[kept++] = f;
        continue;
      }
      for (std::size_t e = 0; e < 3; ++e) toggle_edge(f.corner[e], f.corner[(e + 1) % 3]);
    }
    if (rim_.empty()) return false;
    faces_.resize(kept);
    corners_.push_back(far);
    const int tip = static_cast<int>(corners_.size()) - 1;
    for (const auto& [from, to] : rim_) add_face(from, to, tip);
    return true;
  }
  void toggle_edge(int from, int to) {  // a side that two seen faces share is inside
    for (std::size_t i = 0; i < rim_.size(); ++i)
      if (rim_[i].first == to && rim_[i].second == from) {
        rim_[i] = rim_.back();
        rim_.pop_back();
        return;
      }
    rim_.emplace_back(from, to);
  }

  /// The nearest point of a face, carried back to both bodies.
  Vec3 touch_point(const Face& f) const {
    const Vec3 foot = f.distance * f.normal, &p = at(f.corner[0]), &q = at(f.corner[1]), &r = at(f.corner[2]);
    const Vec3 area = (q - p).cross(r - p);
    const double whole = area.squaredNorm();
    Vec3 w(1, 1, 1);
    if (whole > 0)
      w = Vec3((r - q).cross(foot - q).dot(area), (p - r).cross(foot - r).dot(area),
               (q - p).cross(foot - p).dot(area)) /
          whole;
    w = w.cwiseMax(0);
    w /= w.sum();
    Vec3 middle = Vec3::Zero();
    for (int i = 0; i < 3; ++i) {
      const Corner& c = corners_[static_cast<std::size_t>(f.corner[static_cast<std::size_t>(i)])];
      middle += w[i] * (c.of_a + c.of_b) / 2;
    }
    return a_.centre() + middle;
  }

  const Body &a_, &b_;
  double size_, tolerance_;
  std::vector<Corner> corners_;
  std::vector<Face> faces_;
  std::vector<std::pair<int, int>> rim_;
};

/// Two spheres in closed form; the general search works too, but a bed of spheres has many such pairs.
std::optional<Penetration> between_spheres(const Body& a, const Body& b) {
  const Vec3 apart = b.centre() - a.centre();
  // the bounding radius holds the facets too
  const double ra = 0.5 * a.thickness(), rb = 0.5 * b.thickness(), distance = apart.norm();
  if (distance >= ra + rb) return std::nullopt;
  Penetration p;
  p.depth = ra + rb - distance;
  p.normal = distance > 0 ? Vec3(apart / distance) : Vec3::UnitZ();
  p.point = a.centre() + p.normal * (distance + ra - rb) / 2;
  return p;
}

bool is_sphere(const Body& b) {
  return b.solid().shape->kind == ShapeClass::sphere;
}

}  // namespace

std::optional<Penetration> penetration(const Body& a, const Body& b) {
  if (is_sphere(a) && is_sphere(b)) return between_spheres(a, b);
  return GrowingPolytope(a, b).run();
}

double shared_volume(const Body& a, const Body& b, const Penetration& p) {
  constexpr int kRays = 16;
  // Gauss-Legendre on [0, 1], four nodes (Abramowitz & Stegun, 1964, table 25.4)
  constexpr std::array<double, 4> node{0.0694318442029737, 0.3300094782075719, 0.6699905217924281,
                                       0.9305681557970263};
  constexpr std::array<double, 4> weight{0.1739274225687269, 0.3260725774312731, 0.3260725774312731,
                                         0.1739274225687269};
  const Vec3 t = p.normal.unitOrthogonal(), u = p.normal.cross(t);
  const auto shared_length = [&](const Vec3& at) {
    const auto [from_a, to_a] = a.chord(at, p.normal);
    if (from_a >= to_a) return 0.0;
    const auto [from_b, to_b] = b.chord(at, p.normal);
    return from_b >= to_b ? 0.0 : std::max(0.0, std::min(to_a, to_b) - std::max(from_a, from_b));
  };
  const double most = std::min(a.bounding_radius(), b.bounding_radius()) * 2;
  double volume = 0;
  for (int i = 0; i < kRays; ++i) {
    const double angle = 2 * kPi * i / kRays;
    const Vec3 ray = std::cos(angle) * t + std::sin(angle) * u;
    double in = 0, out = std::min(most, 1e-3 * most);  // the overlap is convex: it ends once along a ray
    while (out < most && shared_length(p.point + out * ray) > 0) {
      in = out;
      out = 2 * out;
    }
    for (int k = 0; k < 8; ++k)
      (shared_length(p.point + (in + out) / 2 * ray) > 0 ? in : out) = (in + out) / 2;
    for (std::size_t k = 0; k < node.size(); ++k) {
      const double r = in * node[k];
      volume += 2 * kPi / kRays * in * weight[k] * r * shared_length(p.point + r * ray);
    }
  }
  return volume;
}

}  // namespace packbed
