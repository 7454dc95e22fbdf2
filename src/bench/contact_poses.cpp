#include "bench/contact_poses.hpp"

#include <cmath>

#include "math/random.hpp"

namespace packbed::bench {
namespace {

double depth_of(const ContactSubject& subject, const PosePair& pair) {
  if (subject.solid->convex) {
    const auto p = penetration(subject.at(pair.a), subject.at(pair.b));
    return p ? p->depth : 0;
  }
  return subject.kernels.back().law(pair.a, pair.b).depth;
}

/// Moves b along a direction until the depth is `wanted`.
void bring_together(const ContactSubject& subject, PosePair& pair, const Vec3& direction, double wanted) {
  double near = 0.3 * subject.size, far = 2.1 * subject.solid->shape->bounding_radius;
  while (far - near > 1e-6 * subject.size) {
    pair.b.position = 0.5 * (near + far) * direction;
    (depth_of(subject, pair) > wanted ? near : far) = 0.5 * (near + far);
  }
  pair.b.position = near * direction;
  pair.depth = depth_of(subject, pair);
}

/// Middle of what lies lowest along a direction: of a flat its centre, of an edge its middle.
Vec3 foremost(const Body& body, const Vec3& direction) {
  const Vec3 u = direction.unitOrthogonal(), v = direction.cross(u);
  Vec3 sum = Vec3::Zero();
  constexpr int kAround = 64;
  for (int i = 0; i < kAround; ++i) {
    const double phi = 2 * kPi * (i + 0.5) / kAround;
    sum += body.furthest(direction + 1e-4 * (std::cos(phi) * u + std::sin(phi) * v));
  }
  return sum / kAround;
}

}  // namespace

std::vector<PosePair> random_pairs(const ContactSubject& subject, int count) {
  std::vector<PosePair> pairs;
  for (std::uint32_t k = 0; static_cast<int>(pairs.size()) < count; ++k) {
    Random random(1, Stream::test, k);
    PosePair pair;
    pair.a.rotation = random.rotation();
    pair.b.rotation = random.rotation();
    const Vec3 direction = random.on_sphere();
    const double wanted = subject.size * std::exp(random.uniform(std::log(1e-3), std::log(5e-2)));
    bring_together(subject, pair, direction, wanted);
    if (!(pair.depth > 0.9 * wanted && pair.depth < 1.1 * wanted)) continue;  // a jump: not convex
    if (subject.solid->convex) {
      const Body a = subject.at(pair.a), b = subject.at(pair.b);
      if (const auto p = penetration(a, b)) pair.pressure = pressure_field(a, b, *p);
    }
    pairs.push_back(pair);
  }
  return pairs;
}

double stiffness_spread(const ContactSubject& subject, const TouchAt& touch) {
  const auto turn = [](double degrees, const Vec3& about) {
    return Quat(Eigen::AngleAxisd(degrees * kPi / 180, about.normalized()));
  };
  const Quat flat = Quat::Identity(), side = turn(90, Vec3::UnitX()), edge = turn(45, Vec3::UnitX()),
             corner = turn(54.7356, Vec3(1, -1, 0));
  const Quat across = turn(90, Vec3::UnitZ());
  const std::array<std::array<Quat, 2>, 6> kinds = {{{flat, flat},
                                                     {flat, side},
                                                     {flat, edge},
                                                     {flat, corner},
                                                     {side, across * side},
                                                     {edge, across * edge}}};
  const double depth = 0.005 * subject.size;
  double softest = 1e300, stiffest = 0;
  for (const auto& [below, above] : kinds) {
    Pose a{Vec3::Zero(), below}, b{Vec3::Zero(), above};
    b.position = foremost(subject.at(a), Vec3::UnitZ()) - foremost(subject.at(b), -Vec3::UnitZ()) -
                 depth * Vec3::UnitZ();
    const Touch t = touch(a, b);
    const double stiffness = t.delta * t.gradient.norm() / depth;
    softest = std::min(softest, stiffness);
    stiffest = std::max(stiffest, stiffness);
  }
  return stiffest / softest;
}

}  // namespace packbed::bench
