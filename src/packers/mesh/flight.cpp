#include "packers/mesh/flight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "packers/mesh/kernels.hpp"

namespace packbed::mesh {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Earliest time from now at which two spheres in free flight meet: their relative motion is straight.
double meeting(const Bodies& b, std::size_t i, std::size_t j) {
  const Vec3 apart = b.position[i] - b.position[j], speed = b.velocity[i] - b.velocity[j];
  const double reach = b.bounding_radius[i] + b.bounding_radius[j];
  const double room = apart.squaredNorm() - reach * reach;
  if (room <= 0) return 0;
  const double closing = apart.dot(speed), root = closing * closing - speed.squaredNorm() * room;
  if (closing >= 0 || root < 0) return kNever;
  return room / (-closing + std::sqrt(root));
}

/// Earliest time from now at which a flying body can reach the wall of the container.
double meeting_wall(const Model& model, const Bodies& b, std::size_t i) {
  const Vec3 &x = b.position[i], &v = b.velocity[i];
  if (model.container.kind == ContainerKind::box) {
    double first = kNever;
    for (std::uint32_t side = 0; side < 4; ++side) {
      const BoxSide s = side_of(model.container, side);
      const double room = s.distance(x) - b.bounding_radius[i], closing = -s.inwards.dot(v);
      if (closing > 0) first = std::min(first, std::max(0.0, room) / closing);
    }
    return first;
  }
  if (model.container.kind != ContainerKind::tube) return kNever;
  const double room = model.container.radius - b.bounding_radius[i] - std::hypot(x.x(), x.y());
  const double speed = std::hypot(v.x(), v.y());
  if (room < -1e-9 * model.container.radius) return 0;
  return speed > 0 ? std::max(0.0, room) / speed : kNever;
}

}  // namespace

void begin_flight(const Model& model, State& state, std::size_t i) {
  const Bodies& b = state.bodies;
  double end = meeting_wall(model, b, i);
  for (std::size_t j = 0; j < i; ++j) {
    if (b.motion[j] != Motion::airborne) continue;
    const double t = meeting(b, i, j);
    end = std::min(end, t);
    state.flight_end[j] = std::min(state.flight_end[j], state.time + t);
  }
  state.flight_end[i] = state.time + end;
}

void catch_up(const Model& model, State& state) {
  Bodies& b = state.bodies;
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (b.motion[i] == Motion::airborne && state.flight_from[i] < state.time)
      leap(b, i, model.gravity, state.time - state.flight_from[i]);
    state.flight_from[i] = state.time;
  }
}

void land(const Model& model, State& state, double horizon) {
  Bodies& b = state.bodies;
  const auto height = [&](std::size_t i) { return model.up.dot(b.position[i]); };
  double ceiling = 0;  // nothing that is not in flight reaches above it before the next search
  for (std::size_t i = 0; i < b.size(); ++i)
    if (b.motion[i] != Motion::airborne)
      ceiling = std::max(ceiling, height(i) + b.bounding_radius[i] + state.margin[i]);
  for (bool changed = true; changed;) {  // who lands raises the ceiling for those above
    changed = false;
    for (std::size_t i = 0; i < b.size(); ++i) {
      if (b.motion[i] != Motion::airborne) continue;
      if (height(i) - b.bounding_radius[i] > ceiling && state.flight_end[i] > state.time + horizon) continue;
      b.motion[i] = Motion::awake;
      b.force[i].setZero();
      b.torque[i].setZero();
      state.margin[i] = model.skin + b.velocity[i].norm() * horizon;
      ceiling = std::max(ceiling, height(i) + b.bounding_radius[i] + state.margin[i]);
      changed = true;
    }
  }
  state.next_landing = kNever;
  const double g = model.gravity.norm();
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (b.motion[i] != Motion::airborne) continue;
    const double room = height(i) - b.bounding_radius[i] - ceiling, sink = -model.up.dot(b.velocity[i]);
    const double fall = (-sink + std::sqrt(sink * sink + 2.0 * g * room)) / g;
    state.next_landing = std::min({state.next_landing, state.time + fall, state.flight_end[i]});
  }
}

}  // namespace packbed::mesh
