#include "analysis/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/container_overlap.hpp"
#include "analysis/penetration.hpp"
#include "bed/pellet_box.hpp"
#include "geometry/sphere_volume.hpp"
#include "math/threads.hpp"

namespace packbed {
namespace {

constexpr double kTouching = 1e-9;  // fraction of the thickness; shallower is rounding

using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// Pairs whose bounding spheres meet: sorted by their lowest point and swept upwards.
std::vector<Pair> near_pairs(const std::vector<Body>& bodies) {
  const auto low = [&](std::uint32_t i) { return bodies[i].centre().z() - bodies[i].bounding_radius(); };
  std::vector<std::uint32_t> order(bodies.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t i, std::uint32_t j) { return std::pair(low(i), i) < std::pair(low(j), j); });
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Body& a = bodies[order[i]];
    const double top = a.centre().z() + a.bounding_radius();
    for (std::size_t j = i + 1; j < order.size() && low(order[j]) < top; ++j) {
      const Body& b = bodies[order[j]];
      const double reach = a.bounding_radius() + b.bounding_radius();
      if ((a.centre() - b.centre()).squaredNorm() < reach * reach)
        pairs.push_back(std::minmax(order[i], order[j]));
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// The deepest point of `from` inside `into`.
void deepest_point(const Body& from, const Body& into, Overlap& overlap) {
  const double far = into.bounding_radius() * into.bounding_radius();
  for (const Vec3& own : from.solid().points) {
    const Vec3 p = from.to_world(own);
    if ((p - into.centre()).squaredNorm() >= far) continue;
    if (const double d = into.depth(p); d > overlap.depth) {
      overlap.depth = d;
      overlap.point = p;
    }
  }
}

bool sphere(const Body& body) {
  return body.solid().shape->kind == ShapeClass::sphere;
}

/// Two spheres share a lens.
void between_spheres(const Body& a, const Body& b, Overlap& overlap) {
  const double r = 0.5 * a.thickness(), s = 0.5 * b.thickness();  // the bounding radius holds the facets too
  const Vec3 apart = a.centre() - b.centre();
  const double d = apart.norm(), depth = r + s - d;
  if (!(depth > 0)) return;
  overlap.depth = depth;
  overlap.volume = sphere_in_sphere(r, s, d);
  overlap.point = d <= std::abs(r - s) ? (r < s ? a : b).centre()  // one inside the other
                                       : Vec3(b.centre() + (s - 0.5 * depth) / d * apart);
}

Overlap between(const Body& a, const Body& b, const Pair& pair) {
  Overlap overlap{pair.first, pair.second, 0, 0, 0, Vec3::Zero()};
  if (sphere(a) && sphere(b)) {
    between_spheres(a, b, overlap);
  } else if (a.solid().convex && b.solid().convex) {
    if (const auto p = penetration(a, b)) {
      overlap.depth = p->depth;
      overlap.point = p->point;
      overlap.volume = shared_volume(a, b, *p);
    }
  } else {
    deepest_point(a, b, overlap);
    deepest_point(b, a, overlap);
  }
  overlap.fraction = overlap.depth / std::min(a.thickness(), b.thickness());
  return overlap;
}

}  // namespace

std::vector<Overlap> find_overlaps(const PackedBed& bed) {
  std::vector<SolidShape> solids;
  for (const ShapePtr& shape : bed.shapes) solids.emplace_back(shape);
  std::vector<Body> bodies;
  for (const Pellet& p : bed.pellets) bodies.emplace_back(solids[p.shape], p);
  const std::vector<Pair> pairs = near_pairs(bodies);
  std::vector<Overlap> all(pairs.size());
  parallel_for(pairs.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      all[i] = between(bodies[pairs[i].first], bodies[pairs[i].second], pairs[i]);
  });
  for (const Overlap& o : container_overlaps(bed, bodies)) all.push_back(o);
  std::erase_if(all, [](const Overlap& o) { return !(o.fraction > kTouching); });
  std::stable_sort(all.begin(), all.end(), [](const Overlap& p, const Overlap& q) {
    return std::pair(p.a, p.b) < std::pair(q.a, q.b);
  });
  return all;
}

OverlapAudit audit_overlaps(const PackedBed& bed, const std::vector<Overlap>& overlaps) {
  OverlapAudit audit;
  audit.pellet.assign(bed.pellets.size(), 0.0);
  for (const Overlap& o : overlaps) {
    audit.mean += o.fraction;
    audit.max = std::max(audit.max, o.fraction);
    audit.volume += o.volume;
    audit.pellet[o.a] = std::max(audit.pellet[o.a], o.fraction);
    if (o.b != kContainer) audit.pellet[o.b] = std::max(audit.pellet[o.b], o.fraction);
  }
  audit.pairs = static_cast<int>(overlaps.size());
  if (audit.pairs) audit.mean /= audit.pairs;
  return audit;
}

}  // namespace packbed
