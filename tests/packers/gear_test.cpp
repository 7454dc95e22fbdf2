// Gear's scheme on a force that is known: an oscillator and a spin that decays.
#include <gtest/gtest.h>

#include <cmath>

#include "packers/spheres/step.hpp"

namespace packbed::spheres {
namespace {

struct Errors {
  double place = 0, spin = 0;
};

/// One sphere of unit mass and inertia on a spring of unit stiffness, its spin braked by its own size: errors
/// after one radian.
Errors after_a_radian(int steps) {
  Model model;
  model.gear = model.turns = true;
  model.step = 1.0 / steps;
  State state;
  Spheres& s = state.spheres;
  s.id = s.kind = {0};
  s.scale = {1};
  s.place = {{1, 0, 0, 1}};
  s.velocity = {{0, 0, 0, 1}};
  s.spin = {{0, 0, 1, 1}};
  s.listed_at = {{1, 0, 0, 100}};
  s.force = s.twist = {{}};
  state.slot_first = {0, 0};
  state.strayed = {0};
  begin_gear(model, state);
  // derivatives of cos t at 0: 0, -1, 0, 1, 0; of exp(-t): -1, 1, -1, 1
  const double h = model.step;
  state.gear.position[0][0].x = -h * h / 2;
  state.gear.position[2][0].x = h * h * h * h / 24;
  double scaled = 1;
  for (int k = 1; k <= 4; ++k) {
    scaled *= -h / k;
    state.gear.spin[static_cast<std::size_t>(k) - 1][0].z = scaled;
  }
  for (int i = 0; i < steps; ++i) {
    predict(model, state);
    s.force[0] = {-s.place[0].x, 0, 0, 0};
    s.twist[0] = {0, 0, state.gear.spin_ahead[0].z, 0};  // torque over minus the radius, 1
    correct(model, state);
  }
  return {std::abs(s.place[0].x - std::cos(1.0)), std::abs(s.spin[0].z - std::exp(-1.0))};
}

TEST(Gear, HasTheOrderOfItsValues) {
  const Errors coarse = after_a_radian(20), fine = after_a_radian(40);
  // six values of a second order equation: global order five at least; five of a first order one: four at
  // least
  EXPECT_LT(fine.place, coarse.place / 24);
  EXPECT_LT(fine.spin, coarse.spin / 12);
  EXPECT_LT(fine.place, 1e-8);
  EXPECT_LT(fine.spin, 1e-7);
}

TEST(Gear, FallsExactly) {
  Model model;
  model.gear = true;
  model.step = 0.01;
  model.gravity = {0, 0, -10};
  State state;
  Spheres& s = state.spheres;
  s.id = s.kind = {0};
  s.scale = {1};
  s.place = {{0, 0, 5, 1}};
  s.velocity = {{1, 0, 2, 1}};
  s.spin = {{0, 0, 0, 1}};
  s.listed_at = {{0, 0, 5, 100}};
  s.force = s.twist = {{}};
  state.slot_first = {0, 0};
  state.strayed = {0};
  begin_gear(model, state);
  for (int i = 0; i < 100; ++i) {
    predict(model, state);
    correct(model, state);
  }
  EXPECT_NEAR(s.place[0].z, 5 + 2 - 5, 1e-12);
  EXPECT_NEAR(s.velocity[0].z, 2 - 10, 1e-12);
  EXPECT_NEAR(s.place[0].x, 1, 1e-12);
}

}  // namespace
}  // namespace packbed::spheres
