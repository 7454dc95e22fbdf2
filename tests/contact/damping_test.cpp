#include "contact/damping.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "math/types.hpp"

namespace packbed {
namespace {

struct Impact {
  double restitution, duration, peak;
};

/// Unit mass, stiffness and speed, by Runge-Kutta: the same law by another way.
Impact integrated(double zeta) {
  const auto force = [&](double x, double v) { return x + 2 * zeta * v; };
  double x = 0, v = 1, t = 0, peak = 0;
  const double h = 1e-4;
  while (true) {
    const double k1x = v, k1v = -force(x, v);
    const double k2x = v + h / 2 * k1v, k2v = -force(x + h / 2 * k1x, v + h / 2 * k1v);
    const double k3x = v + h / 2 * k2v, k3v = -force(x + h / 2 * k2x, v + h / 2 * k2v);
    const double k4x = v + h * k3v, k4v = -force(x + h * k3x, v + h * k3v);
    const double nx = x + h / 6 * (k1x + 2 * k2x + 2 * k3x + k4x);
    const double nv = v + h / 6 * (k1v + 2 * k2v + 2 * k3v + k4v);
    if (force(nx, nv) <= 0) {
      const double part = force(x, v) / (force(x, v) - force(nx, nv));
      return {-(v + part * (nv - v)), t + part * h, peak};
    }
    x = nx, v = nv, t += h, peak = std::max(peak, x);
  }
}

TEST(Damping, ImpactWithoutTensileForceHasTheRestitutionDurationAndOverlapOfTheLaw) {
  // Closed forms for zeta below 1/sqrt(2), evaluated here independently of the library
  for (const double zeta : {0.05, 0.1, 0.2, 0.3, 0.5}) {
    const double s = std::sqrt(1 - zeta * zeta);
    const double bracket = kPi - std::atan(2 * zeta * s / (s * s - zeta * zeta));
    EXPECT_NEAR(restitution_from_damping(zeta), std::exp(-zeta / s * bracket), 1e-14);
    EXPECT_NEAR(contact_time_factor(zeta), bracket / s, 1e-13);
    EXPECT_NEAR(peak_overlap_factor(zeta), std::exp(-zeta / s * std::atan(s / zeta)), 1e-14);
  }
}

TEST(Damping, PublishedTableOfTheLaw) {
  const double table[][4] = {{0.05, 0.858758, 3.04536, 0.92669},
                             {0.1, 0.744079, 2.95608, 0.86260},
                             {0.2, 0.571740, 2.79535, 0.75613},
                             {0.3, 0.450975, 2.65447, 0.67155},
                             {0.5, 0.298436, 2.41840, 0.54629}};
  for (const auto& row : table) {
    EXPECT_NEAR(restitution_from_damping(row[0]), row[1], 6e-7);
    EXPECT_NEAR(contact_time_factor(row[0]), row[2], 6e-6);
    EXPECT_NEAR(peak_overlap_factor(row[0]), row[3], 6e-6);
  }
}

TEST(Damping, DocumentedTable) {
  std::ifstream docs(PACKBED_SOURCE_DIR "/docs/case.md");
  int rows = 0;
  for (std::string line; std::getline(docs, line);) {
    if (line.rfind("| damping zeta", 0) == 0) rows = 1;
    if (rows == 0 || line.find_first_of("0123456789") != 2) continue;
    std::istringstream cells(line);
    char bar;
    double zeta, restitution, duration, peak;
    ASSERT_TRUE(cells >> bar >> zeta >> bar >> restitution >> bar >> duration >> bar >> peak) << line;
    EXPECT_NEAR(restitution_from_damping(zeta), restitution, 5.1e-5);
    EXPECT_NEAR(contact_time_factor(zeta), duration, 5.1e-5);
    EXPECT_NEAR(peak_overlap_factor(zeta), peak, 5.1e-5);
    if (++rows == 11) break;
  }
  EXPECT_EQ(rows, 11);
}

TEST(Damping, ClosedFormsAgreeWithIntegrationAlsoPastCriticalDamping) {
  for (const double zeta :
       {0.0, 0.1, 0.4, 0.6, 0.70710678, 0.75, 0.95, 0.9999999, 1.0, 1.0000001, 1.3, 3.0}) {
    const Impact impact = integrated(zeta);
    EXPECT_NEAR(restitution_from_damping(zeta), impact.restitution, 2e-6) << zeta;
    EXPECT_NEAR(contact_time_factor(zeta), impact.duration, 2e-6) << zeta;
    EXPECT_NEAR(peak_overlap_factor(zeta), impact.peak, 2e-6) << zeta;
  }
}

TEST(Damping, InverseGivesBackTheDampingRatio) {
  for (double zeta = 0; zeta < 3; zeta += 0.01)
    EXPECT_NEAR(damping_from_restitution(restitution_from_damping(zeta)), zeta, 1e-9 * (1 + zeta)) << zeta;
}

TEST(Damping, RestitutionFallsWithDampingWithoutJumps) {
  double before = restitution_from_damping(0);
  EXPECT_DOUBLE_EQ(before, 1);
  for (int i = 1; i <= 20000; ++i) {
    const double now = restitution_from_damping(i * 1e-4);
    EXPECT_LT(now, before);
    EXPECT_LT(before - now, 3e-4 * 1.2);  // |de/dzeta| is largest at 0, where it is pi
    before = now;
  }
}

}  // namespace
}  // namespace packbed
