#include "packers/mesh/step.hpp"

#include <atomic>
#include <chrono>

#include "math/threads.hpp"

namespace packbed::mesh {

void step(const Model& model, State& state, Feeder& feeder, PhaseTimes& times) {
  auto last = std::chrono::steady_clock::now();
  const auto done = [&](Phase phase) {
    const auto now = std::chrono::steady_clock::now();
    times[phase] += std::chrono::duration<double>(now - last).count();
    last = now;
  };
  feed(model, state, feeder), done(kFeed);
  find_pairs(model, state), done(kFindPairs);
  kick_drift(model, state), done(kKickDrift);
  touch(model, state), done(kTouch);
  gather_kick(model, state), done(kGatherKick);
  sleep(model, state), done(kSleep);
  rest(model, state, feeder), done(kRest);
}

void begin(const Model& model, State& state, Feeder& feeder) {
  feed(model, state, feeder);
  find_pairs(model, state);
  touch(model, state);
  for (const std::uint32_t i : state.awake) gather(state, i, state.bodies.force[i], state.bodies.torque[i]);
  for (const PairRecord& r : state.pairs.record) state.ledger.input += r.elastic;
}

namespace {

/// What bodies feel beside their contacts at a time, in the frame of the container [m/s2].
Vec3 pull_at(const Model& model, const State& state, double time) {
  return model.gravity + shaking_acceleration(model.shaking, model.up, state.shake, time);
}

}  // namespace

void kick_drift(const Model& model, State& state) {
  Bodies& bodies = state.bodies;
  const Vec3 pull = pull_at(model, state, state.time);
  std::atomic<bool> left_margin{false};
  parallel_for(state.awake.size(), 128, [&](std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < to; ++k) {
      const std::size_t i = state.awake[k];
      kick(bodies, i, pull, 0.5 * model.step);
      drift(bodies, i, model.step);
      look_ahead(bodies, i, pull, 0.5 * model.step);
      const double margin = state.margin[i];
      if ((bodies.position[i] - state.listed_at[i]).squaredNorm() > margin * margin)
        left_margin.store(true, std::memory_order_relaxed);
    }
  });
  if (vibrates(state.shake, state.time)) {  // work of the shaking container
    const Vec3 mean = 0.5 * (pull + pull_at(model, state, state.time + model.step)) - model.gravity;
    for (const std::uint32_t i : state.awake)
      state.ledger.input += bodies.mass[i] * model.step * mean.dot(bodies.velocity[i]);
  }
  ++state.steps;
  state.ledger.awake += static_cast<double>(state.awake.size());
  state.time += model.step;
  if (left_margin) state.search_due = 1;
}

void gather(const State& state, std::size_t i, Vec3& force, Vec3& torque) {
  force.setZero();
  torque.setZero();
  const Pairs& pairs = state.pairs;
  for (std::uint32_t e = pairs.first[i]; e < pairs.first[i + 1]; ++e) {
    const Load& r = pairs.load[pairs.entry[e] >> 1];
    if (!(r.delta > 0)) continue;
    if (pairs.entry[e] & 1U) {
      force -= r.force;
      torque += r.torque_b;
    } else {
      force += r.force;
      torque += r.torque_a;
    }
  }
}

void gather_kick(const Model& model, State& state) {
  Bodies& bodies = state.bodies;
  const Vec3 pull = pull_at(model, state, state.time);
  parallel_for(state.awake.size(), 128, [&](std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < to; ++k) {
      const std::size_t i = state.awake[k];
      gather(state, i, bodies.force[i], bodies.torque[i]);
      kick(bodies, i, pull, 0.5 * model.step);
    }
  });
}

}  // namespace packbed::mesh
