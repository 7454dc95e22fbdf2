// Motion: what free bodies keep, and what impacts of rigid bodies do.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/scenes.hpp"
#include "bench/stability.hpp"
#include "bench/statistics.hpp"
#include "contact/damping.hpp"
#include "dynamics/bodies.hpp"
#include "math/error.hpp"
#include "math/random.hpp"
#include "shape/library.hpp"

namespace packbed::bench {
namespace {

constexpr double kDiameter = 3.42e-3, kLength = 3.46e-3;

ShapePtr a38() {
  return make_cylinder("A38", kDiameter, kLength);
}

double mass(const Scene& s) {
  return s.pellets.front().density * s.pellets.front().shape->volume;
}
Vec3 spin_momentum(const Scene& s, const Pellet& p) {
  const Vec3 inertia = s.pellets.front().density * s.pellets.front().shape->inertia;
  return p.pose.rotation * inertia.cwiseProduct(p.pose.rotation.conjugate() * p.spin);
}

/// Root mean square change of energy of pairs that hit each other once, without loss.
double change_of_energy(const ShapePtr& shape, int impacts, double steps_per_contact) {
  Scene s = plain_scene(ContainerKind::none, shape);
  s.stepping.steps_per_contact = steps_per_contact;
  const double reach = shape->bounding_radius;
  for (int i = 0; i < impacts; ++i) {
    Random random(7, Stream::test, static_cast<std::uint32_t>(i));
    const Vec3 middle(20 * reach * (i % 32), 20 * reach * (i / 32), 0);
    const double speed = random.uniform(0.3, 1.0);
    const Vec3 along = random.on_sphere(), aside = random.on_sphere().cross(along);
    place(s, middle + 1.01 * reach * along + 0.5 * reach * aside, random.rotation()).velocity =
        -0.5 * speed * along;
    place(s, middle - 1.01 * reach * along, random.rotation()).velocity = 0.5 * speed * along;
  }
  const double duration = 0.02;
  const Course course = run_scene(s, duration, duration);
  const Frame &begin = course.frames.front(), &end = course.frames.back();
  std::vector<double> changes;
  for (std::size_t i = 0; i < end.pellets.size(); i += 2) {
    if ((end.pellets[i].velocity - begin.pellets[i].velocity).norm() < 1e-6) continue;
    const double before = begin.energies[i].sum() + begin.energies[i + 1].sum();
    changes.push_back((end.energies[i].sum() + end.energies[i + 1].sum()) / before - 1);
  }
  return changes.empty() ? 1 : root_mean_square(changes);
}

}  // namespace

Verdict top_keeps_turning(long long steps) {
  Bodies bodies;
  NewBody body;
  body.mass = 1;
  body.inertia = {1, 2, 3};
  body.bounding_radius = 1;
  body.spin = {0.3, 2 * kPi, 0.2};
  add_body(bodies, body);
  const double before = kinetic_rotation(bodies, 0);
  double energy = 0, unit = 0;
  for (long long i = 0; i < steps; ++i) {
    drift(bodies, 0, 1e-3);
    energy = std::max(energy, std::abs(kinetic_rotation(bodies, 0) / before - 1));
    unit = std::max(unit, std::abs(bodies.rotation[0].norm() - 1));
  }
  // the splitting's energy swings by the square of the step, 1e-3 of a turn; it must not drift
  return {fmt::format("torque-free top, {:g} steps of a thousandth of a turn", static_cast<double>(steps)),
          "energy within 1e-5 throughout, unit quaternion within 1e-14",
          fmt::format("energy {:.2g}, quaternion {:.2g}", energy, unit), energy < 1e-5 && unit < 1e-14};
}

Verdict cloud_keeps_momentum(int steps) {
  Scene s = plain_scene(ContainerKind::none, a38());
  set_contact(s, 0.5, 0.2);
  for (int i = 0; i < 100; ++i) {
    Random random(3, Stream::test, static_cast<std::uint32_t>(i));
    const Vec3 at = 5.2e-3 * (Vec3(i % 5, i / 5 % 5, i / 25) - Vec3(2, 2, 1.5));
    PlacedPellet& p = place(s, at, random.rotation());
    p.velocity = -20 * at + 0.3 * random.on_sphere();
    p.spin = 100 * random.on_sphere();
  }
  s.stepping.step = 1e-5;
  const double duration = steps * s.stepping.step;
  const Course course = run_scene(s, duration, duration);
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
  double size = 0, spin_size = 0;
  for (const double sign : {-1.0, 1.0}) {
    const Frame& f = sign < 0 ? course.frames.front() : course.frames.back();
    for (const Pellet& p : f.pellets) {
      const Vec3 momentum = mass(s) * p.velocity,
                 turn = p.pose.position.cross(momentum) + spin_momentum(s, p);
      linear += sign * momentum;
      angular += sign * turn;
      if (sign < 0) size += momentum.norm();
      spin_size += 0.5 * turn.norm();
    }
  }
  const double a = linear.norm() / size, b = angular.norm() / spin_size;
  return {fmt::format("isolated cloud of 100, friction and damping, {} steps", steps),
          "momentum within 1e-12, angular momentum within 1e-10", fmt::format("{:.2g}, {:.2g}", a, b),
          a < 1e-12 && b < 1e-10};
}

Verdict impacts_keep_energy(const std::string& pellet, int impacts) {
  LibrarySizes cube;
  cube.size = Vec3::Constant(3.2e-3);
  const ShapePtr shape = pellet == "sphere" ? make_sphere("sphere", 1.9e-3)
                         : pellet == "cube" ? make_box("cube", cube)
                         : pellet == "ring" ? make_ring("ring", 4.6e-3, 2.5e-3, 5e-3)
                                            : a38();
  const double at20 = change_of_energy(shape, impacts, 20), at40 = change_of_energy(shape, impacts, 40);
  return {fmt::format("elastic impacts of {} pairs in random poses: {}", impacts, pellet),
          "rms change of energy 1 % at 20 steps a contact, 0.3 % at 40, second order",
          fmt::format("{:.2g} %, {:.2g} %", 100 * at20, 100 * at40),
          at20 < 0.01 && at40 < 0.003 && at40 < 0.5 * at20};
}

Verdict oblique_rim_impact(double degrees, double friction) {
  // The lowest point, at (x, -z) from the centre, slides along +x throughout: impulses are P up and mu P
  // back. The impact ends when that point leaves as fast as it came.
  const double tilt = degrees * kPi / 180, down = 0.2, along = 2.0;
  Scene s = plain_scene(ContainerKind::plane, a38());
  set_contact(s, friction, 0);
  s.wall_contact.stiffness = 1e6;  // so short that the body does not turn meanwhile
  s.stepping.steps_per_contact = 100;
  const double r = kDiameter / 2, h = kLength / 2;
  const double z = h * std::cos(tilt) + r * std::sin(tilt), x = r * std::cos(tilt) - h * std::sin(tilt);
  place(s, {0, 0, z + 2e-6}, Quat(Eigen::AngleAxisd(tilt, Vec3::UnitY()))).velocity = {along, 0, -down};
  const Course course = run_scene(s, 1e-4, 1e-4);
  const Pellet& after = course.frames.back().pellets.front();
  const double m = mass(s), inertia = kDensity * s.pellets.front().shape->inertia.x();
  const double spin_by_impulse = (z * friction - x) / inertia, lift = 1 / m - x * spin_by_impulse;
  const double impulse = 2 * down / lift;
  const double error = std::max({std::abs(after.velocity.z() + down - impulse / m) / down,
                                 std::abs(after.velocity.x() - along + friction * impulse / m) / down,
                                 std::abs(after.spin.y() - spin_by_impulse * impulse) * kDiameter / down});
  return {fmt::format("cylinder tilted by {:g} degrees strikes a plane, sliding, friction {:g}", degrees,
                      friction),
          "velocity and spin of the rigid-body impact within 3 % of the speed of impact",
          fmt::format("{:.2g} %", 100 * error), error < 0.03};
}

Verdict pyramid_stands_or_falls(double pellet_friction, double floor_friction) {
  const double needed = std::tan(15 * kPi / 180);
  const bool should_stand = pellet_friction > needed && floor_friction > needed / 3;
  Scene s = plain_scene(ContainerKind::plane, a38());
  s.gravity = {0, 0, -kGravity};
  set_contact(s, pellet_friction, 0.3);
  s.wall_contact.friction = floor_friction;
  const Quat lying(Eigen::AngleAxisd(kPi / 2, Vec3::UnitX()));
  const double r = kDiameter / 2;
  place(s, {-r, 0, r}, lying);
  place(s, {r, 0, r}, lying);
  place(s, {0, 0, r + std::sqrt(3.0) * r}, lying);
  const Course course = run_scene(s, 0.5, 0.1);
  const double sunk = 1 - course.frames.back().pellets[2].pose.position.z() / (r + std::sqrt(3.0) * r);
  const bool stands = sunk < 0.02;
  return {fmt::format("pyramid of three cylinders, friction {:g} between them, {:g} on the floor",
                      pellet_friction, floor_friction),
          should_stand ? "stands (needs 0.268 and 0.089)" : "falls (needs 0.268 and 0.089)",
          fmt::format("the upper one sank by {:.2g} % in half a second", 100 * sunk), stands == should_stand};
}

Verdict deep_start_is_gentle() {
  Scene s = plain_scene(ContainerKind::plane, a38());
  s.gravity = {0, 0, -kGravity};
  set_contact(s, 0.5, 0.3);
  s.pellet_contact.stiffness = s.wall_contact.stiffness = 0;  // found from the overlap, as a case would
  constexpr int kPellets = 5;
  for (int i = 0; i < kPellets; ++i) place(s, {0.9 * kDiameter * i, 0, kLength / 2});
  const double limit = 2 * std::sqrt(2 * kGravity * kPellets * kLength);
  Verdict v{"five pellets placed 10 % of the diameter inside one another",
            fmt::format("refused, or no faster than {:.2f} m/s", limit), "", true};
  try {
    const Course course = run_scene(s, 0.05, 1e-4);
    double fastest = 0;
    for (const Frame& f : course.frames)
      for (const Pellet& p : f.pellets) fastest = std::max(fastest, p.velocity.norm());
    v.found = fmt::format("{:.2f} m/s", fastest);
    v.passed = fastest < limit;
  } catch (const InputError& error) {
    v.found = error.what();
  }
  return v;
}

Verdict rings_bounce_off(int pairs) {
  const ShapePtr ring = make_ring("ring", 4.6e-3, 3.2e-3, 5e-3);
  Scene s = plain_scene(ContainerKind::none, ring);
  set_contact(s, 0.3, 0.2);
  s.pellet_contact.stiffness = 0;
  s.pellet_contact.allowed_overlap = 0.2;
  const double speed = 5, mass_of_one = mass(s), thickness = ring->smallest_thickness;
  s.pellet_contact.stiffness = 0.5 * mass_of_one * speed * speed / (0.04 * thickness * thickness);
  const double reach = ring->bounding_radius;
  for (int i = 0; i < pairs; ++i) {
    Random random(13, Stream::test, static_cast<std::uint32_t>(i));
    const Vec3 middle(30 * reach * (i % 64), 30 * reach * (i / 64), 0),
        aside(random.uniform(-1, 1) * reach, random.uniform(-1, 1) * reach, 0);
    place(s, middle + 1.05 * reach * Vec3::UnitZ() + aside, random.rotation()).velocity = {0, 0,
                                                                                           -0.5 * speed};
    place(s, middle - 1.05 * reach * Vec3::UnitZ(), random.rotation()).velocity = {0, 0, 0.5 * speed};
  }
  const double duration = 4 * reach / speed;
  const Course course = run_scene(s, duration, duration);
  const double peak = course.result.record.overlap.peak;
  return {fmt::format("{} pairs of rings with walls of 0.7 mm, edge on edge at 5 m/s", pairs),
          "no overlap of half a wall, beyond which they would pass",
          fmt::format("peak {:.2g} of the wall", peak), peak < 0.5};
}

}  // namespace packbed::bench
