// Impacts of spheres by Hertz's law, and the dashpots in both of their forms: the benchmark tests 1 to 5 of
// Chung & Ooi (Granular Matter 13, 2011).
#include <gtest/gtest.h>

#include <functional>

#include "laws/law.hpp"

namespace packbed {
namespace {

using namespace law;

Scene elastic_scene(ContainerKind container, double radius, double density, double young, double nu) {
  Scene s = scene(container, make_sphere("ball", radius));
  s.method = "spheres";
  s.pellets[0].density = density;
  set_contact(s, 0, 0);
  for (ContactLaw* law : {&s.pellet_contact, &s.wall_contact}) {
    law->hertz = true;
    law->stiffness = 0;
    law->youngs_modulus = young;
    law->poisson_ratio = nu;
  }
  s.stepping.steps_per_contact = 400;
  return s;
}

struct Blow {
  double deepest = 0, force = 0, duration = 0;  // [m], [N], [s]
};
/// What the frames of every step say of pellet 0 in one impact along `axis`; `gap` between its surface and
/// the other when it stands at 0.
Blow blow_of(const Course& r, int axis, double mass, const std::function<double(const Frame&)>& overlap) {
  Blow out;
  for (std::size_t f = 1; f < r.frames.size(); ++f) {
    const double dt = r.frames[f].time - r.frames[f - 1].time;
    const double change = r.frames[f].pellets[0].velocity[axis] - r.frames[f - 1].pellets[0].velocity[axis];
    out.deepest = std::max(out.deepest, overlap(r.frames[f]));
    out.force = std::max(out.force, mass * std::abs(change) / dt);
    if (overlap(r.frames[f]) > 0) out.duration += dt;
  }
  return out;
}

/// Hertz's impact of a reduced mass against curvature 1 / R and modulus E*: greatest overlap and force,
/// duration.
Blow hertz(double mass, double radius, double modulus, double speed) {
  Blow out;
  out.deepest = std::pow(15 * mass * speed * speed / (16 * modulus * std::sqrt(radius)), 0.4);
  out.force = 1.25 * mass * speed * speed / out.deepest;
  out.duration = 2.9432750 * out.deepest / speed;
  return out;
}

struct Material {
  const char* name;
  double young, nu, density;
};
void PrintTo(const Material& m, std::ostream* out) {
  *out << m.name;
}

class ChungOoi1 : public testing::TestWithParam<Material> {};

TEST_P(ChungOoi1, TwoSpheresMeetAsHertzSays) {
  const auto [name, young, nu, density] = GetParam();
  const double r = 10e-3, speed = 10;
  Scene s = elastic_scene(ContainerKind::none, r, density, young, nu);
  place(s, {-r - 1e-5, 0, 0}).velocity = {speed, 0, 0};
  place(s, {r + 1e-5, 0, 0}).velocity = {-speed, 0, 0};
  const Course course = run(s, 1.2e-4, 1e-9);
  const double m = mass(s, course.end());
  const Blow got = blow_of(course, 0, m, [&](const Frame& f) {
    return 2 * r - (f.pellets[1].pose.position - f.pellets[0].pose.position).norm();
  });
  const Blow want = hertz(m / 2, r / 2, young / (2 * (1 - nu * nu)), 2 * speed);
  EXPECT_NEAR(got.deepest / want.deepest, 1, 0.01);
  EXPECT_NEAR(got.force / want.force, 1, 0.01);
  EXPECT_NEAR(got.duration / want.duration, 1, 0.01);
  EXPECT_NEAR(course.end().velocity.x() / -speed, 1, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Of, ChungOoi1,
                         testing::Values(Material{"glass", 48e9, 0.2, 2800},
                                         Material{"limestone", 20e9, 0.25, 2500}),
                         testing::PrintToStringParamName());

class ChungOoi2 : public testing::TestWithParam<Material> {};

TEST_P(ChungOoi2, ASphereMeetsARigidPlaneAsHertzSays) {
  const auto [name, young, nu, density] = GetParam();
  const double r = 0.1, speed = 0.2;
  // a rigid plane gives nothing: as stiff a pair as two bodies of twice the modulus
  Scene s = elastic_scene(ContainerKind::plane, r, density, 2 * young, nu);
  place(s, {0, 0, r + 1e-6}).velocity = {0, 0, -speed};
  const Course course = run(s, 1e-3, 1e-7);
  const double m = mass(s, course.end());
  const Blow got = blow_of(course, 2, m, [&](const Frame& f) { return r - f.pellets[0].pose.position.z(); });
  const Blow want = hertz(m, r, young / (1 - nu * nu), speed);
  EXPECT_NEAR(got.deepest / want.deepest, 1, 0.01);
  EXPECT_NEAR(got.force / want.force, 1, 0.01);
  EXPECT_NEAR(got.duration / want.duration, 1, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Of, ChungOoi2,
                         testing::Values(Material{"aluminium", 70e9, 0.3, 2699},
                                         Material{"magnesium", 40e9, 0.35, 1800}),
                         testing::PrintToStringParamName());

Scene ball_on_plane(const Material& m, double speed, double angle, double friction) {
  Scene s = elastic_scene(ContainerKind::plane, 2.5e-3, m.density, 2 * m.young, m.nu);
  s.wall_contact.friction = s.pellet_contact.friction = friction;
  s.stepping.steps_per_contact = 100;
  place(s, {0, 0, 2.5e-3 + 1e-6}).velocity = speed * Vec3(std::sin(angle), 0, -std::cos(angle));
  return s;
}
constexpr Material kAlumina{"alumina", 380e9, 0.23, 4000}, kIron{"iron", 100e9, 0.25, 7000},
    kSteel{"steel", 208e9, 0.3, 7850};

TEST(ChungOoi3, RestitutionComesOutAsItWentIn) {
  for (const Material& m : {kAlumina, kIron})
    for (const double e : {0.2, 0.4, 0.6, 0.8, 1.0}) {
      Scene s = ball_on_plane(m, 3.9, 0, 0);
      s.wall_contact.damping_ratio = e > 0.31 ? (e < 1 ? damping(e) : 0) : 0.7;
      const double want = e > 0.31 ? e : restitution(0.7);
      EXPECT_NEAR(run(s, 1e-4).end().velocity.z() / 3.9 / want, 1, 0.01) << m.name << ' ' << e;
    }
}

class ChungOoi4 : public testing::TestWithParam<int> {};

TEST_P(ChungOoi4, SlidingAllThroughAnImpactFollowsCoulomb) {
  const double theta = GetParam() * kPi / 180, speed = 3.9, mu = 0.092, e = 0.98, r = 2.5e-3;
  Scene s = ball_on_plane(kAlumina, speed, theta, mu);
  s.wall_contact.damping_ratio = damping(e);
  const Pellet after = run(s, 1e-4).end();
  const double omega = 2.5 * mu * (1 + e) * speed * std::cos(theta) / r;
  EXPECT_NEAR(after.spin.y() / omega, 1, 0.01);
  EXPECT_NEAR(after.velocity.x() / (speed * std::sin(theta)) / (1 - mu * (1 + e) / std::tan(theta)), 1, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Degrees, ChungOoi4, testing::Values(40, 50, 60, 70, 80),
                         [](const auto& of) { return std::to_string(of.param); });

// Normalised: x = v_s / (mu v_n) of the surface before, s of the contact point after, w = r omega / (mu v_n)
// after.
TEST(ChungOoi5, SurfaceSpeedsAfterObliqueImpactsAreThoseOfCoulomb) {
  const double mu = 0.3, normal = 5, r = 2.5e-3;
  for (const double x : {8.0, 10.0, 13.0}) {
    const double along = x * mu * normal;
    Scene s = ball_on_plane(kSteel, std::hypot(along, normal), std::atan2(along, normal), mu);
    const Pellet after = run(s, 1e-4).end();
    const double spin = r * after.spin.y() / (mu * normal),
                 surface = after.velocity.x() / (mu * normal) - spin;
    EXPECT_NEAR(spin, 5, 0.05) << x;
    EXPECT_NEAR(surface, x - 7, 0.01 * x) << x;
  }
}

/// Restitution of m x'' = -k x^n - c x' from speed v until the force ends, by Runge and Kutta's method.
double integrated(double k, double n, double c, double m, double v) {
  double x = 0, u = v;
  const double step = 1e-4 * std::pow(m * v * v / k, 1 / (n + 1)) / v;
  const auto push = [&](double at, double speed) { return k * std::pow(std::max(0.0, at), n) + c * speed; };
  const auto a = [&](double at, double speed) { return -push(at, speed) / m; };
  for (;;) {
    const double x1 = u, u1 = a(x, u), x2 = u + step / 2 * u1, u2 = a(x + step / 2 * x1, x2);
    const double x3 = u + step / 2 * u2, u3 = a(x + step / 2 * x2, x3), x4 = u + step * u3,
                 u4 = a(x + step * x3, x4);
    x += step / 6 * (x1 + 2 * x2 + 2 * x3 + x4);
    u += step / 6 * (u1 + 2 * u2 + 2 * u3 + u4);
    if (u < 0 && push(x, u) <= 0) return -u / v;
  }
}

// The dissipation of the sphere paper: dashpots of gamma times the effective mass.
TEST(Dissipation, GivesTheRestitutionOfItsDashpot) {
  for (const bool hertz_law : {false, true})
    for (const double gamma : {100.0, 2000.0}) {
      const double r = 9.12e-3, speed = 1, modulus = 4.0 / 3 * 1e8 / (2 * (1 - 0.04));
      Scene s = elastic_scene(ContainerKind::plane, r, 500, 1e8, 0.2);
      s.wall_contact.hertz = hertz_law;
      s.wall_contact.dissipation = gamma;
      s.stepping.steps_per_contact = 100;
      place(s, {0, 0, r + 1e-5}).velocity = {0, 0, -speed};
      const Course course = run(s, 2e-3);
      const double m = mass(s, course.end());
      const double want = hertz_law ? integrated(modulus * std::sqrt(r), 1.5, gamma * m, m, speed)
                                    : restitution(gamma / (2 * std::sqrt(modulus * r / m)));
      EXPECT_NEAR(course.end().velocity.z() / speed, want, 0.002) << hertz_law << ' ' << gamma;
      if (!hertz_law) {
        EXPECT_NEAR(want, integrated(modulus * r, 1, gamma * m, m, speed), 1e-4);
      }
    }
}

}  // namespace
}  // namespace packbed
