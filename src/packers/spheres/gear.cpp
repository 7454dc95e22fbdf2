// Phases predict and correct: Gear's predictor-corrector with six values of position and five of spin, the
// scheme of Dziugys et al. (Powder Technol. 2022 and Granular Matter 3, 2001).
//
// Values are scaled derivatives, x_n = dt^n / n! d^n x / dt^n, so that predicting is adding up Pascal's
// triangle. Coefficients of the corrector: Gear, Numerical Initial Value Problems in Ordinary Differential
// Equations (1971); Allen & Tildesley, Computer Simulation of Liquids (1987), appendix E: second order
// equation with forces that depend on velocity, and first order equation.
#include <algorithm>
#include <array>

#include "math/threads.hpp"
#include "packers/spheres/chunks.hpp"
#include "packers/spheres/step.hpp"

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors are only passed between functions that are inlined
#endif

namespace packbed::spheres {
namespace {

constexpr std::array<double, 6> kPosition = {3.0 / 16, 251.0 / 360, 1, 11.0 / 18, 1.0 / 6, 1.0 / 60};
constexpr std::array<double, 5> kSpin = {251.0 / 720, 1, 11.0 / 12, 1.0 / 3, 1.0 / 24};

}  // namespace

void begin_gear(const Model& model, State& state) {
  const std::size_t n = state.spheres.size();
  for (std::size_t i = state.gear.position[0].size(); i < n; ++i) {
    const bool free = state.spheres.velocity[i].w > 0;
    const Vec3 bend = free ? Vec3(0.5 * model.step * model.step * model.gravity) : Vec3(Vec3::Zero());
    for (std::vector<Quad>& of : state.gear.position) of.push_back({});
    state.gear.position[0].back() = {bend.x(), bend.y(), bend.z(), 0};
    for (std::vector<Quad>& of : state.gear.spin) of.push_back({});
    state.gear.ahead.push_back({});
    state.gear.spin_ahead.push_back(state.spheres.spin[i]);
  }
}

void predict(const Model& model, State& state) {
  Spheres& s = state.spheres;
  Gear& g = state.gear;
  const double step = model.step;
  for_each_chunk(s.size(), [&](std::size_t c, std::size_t begin, std::size_t end) {
    bool strayed = false;
    for (std::size_t i = begin; i < end; ++i) {
      const Four x1 = step * without_w(s.velocity[i]);
      Four &x2 = four(g.position[0][i]), &x3 = four(g.position[1][i]), &x4 = four(g.position[2][i]);
      const Four x5 = four(g.position[3][i]);
      const Four mid = x1 + x2 + 0.75 * x3 + 0.5 * x4 + 0.3125 * x5;
      four(s.place[i]) += x1 + x2 + x3 + x4 + x5;
      four(g.ahead[i]) = (1.0 / step) * (x1 + 2.0 * x2 + 3.0 * x3 + 4.0 * x4 + 5.0 * x5);
      x2 += 3.0 * x3 + 6.0 * x4 + 10.0 * x5;
      x3 += 4.0 * x4 + 10.0 * x5;
      x4 += 5.0 * x5;
      four(s.velocity[i]) = (1.0 / step) * mid + only_w(s.velocity[i]);
      clear_forces(model, s, i);
      strayed |= has_strayed(s, i);
      if (!model.turns) continue;
      Four &w1 = four(g.spin[0][i]), &w2 = four(g.spin[1][i]), &w3 = four(g.spin[2][i]);
      const Four w0 = four(s.spin[i]), w4 = four(g.spin[3][i]);
      four(s.spin[i]) = w0 + 0.5 * w1 + 0.25 * w2 + 0.125 * w3 + 0.0625 * w4;
      four(g.spin_ahead[i]) = w0 + w1 + w2 + w3 + w4;
      w1 += 2.0 * w2 + 3.0 * w3 + 4.0 * w4;
      w2 += 3.0 * w3 + 6.0 * w4;
      w3 += 4.0 * w4;
    }
    state.strayed[c] = strayed;
  });
  end_of_drift(model, state);
}

void correct(const Model& model, State& state) {
  Spheres& s = state.spheres;
  Gear& g = state.gear;
  const double step = model.step;
  const Four gravity = four_of(model.gravity);
  for_each_chunk(s.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      gather_slots(state, i, s.force);
      if (model.turns) gather_slots(state, i, s.twist);
      const Four inverse_mass = spread_w(s.velocity[i]);
      const Four acceleration = inverse_mass * four(s.force[i]) + (inverse_mass > 0.0 ? gravity : Four{});
      const Four change = 0.5 * step * step * acceleration - four(g.position[0][i]);
      four(s.place[i]) += kPosition[0] * change;
      four(s.velocity[i]) = four(g.ahead[i]) + (kPosition[1] / step) * change + only_w(s.velocity[i]);
      for (std::size_t k = 0; k < 4; ++k) four(g.position[k][i]) += kPosition[k + 2] * change;
      if (!model.turns) continue;
      const Four turn = step * turn_of(s, i) - four(g.spin[0][i]);
      four(s.spin[i]) = four(g.spin_ahead[i]) + kSpin[0] * turn;
      for (std::size_t k = 0; k < 4; ++k) four(g.spin[k][i]) += kSpin[k + 1] * turn;
    }
  });
}

}  // namespace packbed::spheres
