// Phase feed of digidem, and how stamps follow their pellets.
#include <algorithm>
#include <cmath>

#include "packers/lattice/dem.hpp"

namespace packbed::lattice {
namespace {

constexpr double kSurfaceSpeed = 0.2;  // what moves faster is not part of the bed's surface [m/s]

void enter(const DemModel& model, DemState& state, const Pellet& p, StampMaker& maker) {
  NewBody body;
  const Shape& shape = *model.base.kind(p.shape).shape;
  body.kind = p.shape;
  body.mass = model.mass[p.shape] * std::pow(p.scale, 3);
  body.inertia = shape.inertia * (model.base.kind(p.shape).density * std::pow(p.scale, 5));
  body.bounding_radius = shape.bounding_radius * p.scale;
  body.pose = p.pose;
  body.velocity = p.velocity;
  body.spin = p.spin;
  body.fixed = p.fixed;
  body.scale = p.scale;
  add_body(state.bodies, body);
  state.drawn.push_back(p.pose.rotation);
  state.cell.push_back({0, 0, 0});
  state.offset.push_back(Vec3::Zero());
  state.turn.push_back(Vec3::Zero());
  state.stamp.emplace_back();
  state.phase.push_back(Vec3::Zero());
  state.version.push_back(0);
  state.listed_at.push_back(p.pose.position);
  begin_watch(state.doze.emplace_back(), state.bodies, state.size() - 1);
  redraw(model, state, state.size() - 1, maker);
}

}  // namespace

void dem_feed(const DemModel& model, DemState& state, Feeder& feeder) {
  if (feeder.done() || state.time < feeder.next_time()) return;
  double surface = 0;
  const Bodies& b = state.bodies;
  for (std::size_t i = 0; i < state.size(); ++i)
    if (b.velocity[i].norm() < kSurfaceSpeed)
      surface = std::max(surface, b.position[i].z() + b.bounding_radius[i]);
  const std::vector<Pellet> entering = feeder.enter(state.time, pellets_of(state), surface);
  StampMaker maker(model.base.frame.pitch, model.base.largest);
  for (const Pellet& p : entering) enter(model, state, p, maker);
  if (!entering.empty()) state.search_due = 1;
  if (feeder.waiting()) state.waited = 1;
}

void redraw(const DemModel& model, DemState& state, std::size_t i, StampMaker& maker) {
  const Shape& shape = *model.base.kind(state.bodies.kind[i]).shape;
  state.drawn[i] = state.bodies.rotation[i];
  state.turn[i] = Vec3::Zero();
  state.phase[i] = spot_of(model.base, state.bodies.position[i]).phase;
  state.stamp[i] = maker.make(shape, state.bodies.scale[i], state.drawn[i], state.phase[i]);
  relay(model, state, i);
}

void relay(const DemModel& model, DemState& state, std::size_t i) {
  const double pitch = model.base.frame.pitch;
  const Vec3 at = (state.bodies.position[i] - model.base.frame.origin) / pitch - state.phase[i];
  for (int d = 0; d < 3; ++d)
    state.cell[i][static_cast<std::size_t>(d)] = static_cast<int>(std::floor(at[d]));
  const Cell& c = state.cell[i];
  state.offset[i] =
      state.bodies.position[i] - model.base.frame.centre(c[0], c[1], c[2]) - pitch * state.phase[i];
  ++state.version[i];
}

std::vector<Pellet> pellets_of(const DemState& state) {
  std::vector<Pellet> pellets(state.size());
  const Bodies& b = state.bodies;
  for (std::size_t i = 0; i < pellets.size(); ++i) {
    pellets[i].id = static_cast<std::uint32_t>(i);
    pellets[i].shape = b.kind[i];
    pellets[i].pose = {b.position[i], b.rotation[i]};
    pellets[i].scale = state.bodies.scale[i];
    pellets[i].velocity = b.velocity[i];
    pellets[i].spin = b.spin[i];
    pellets[i].fixed = b.motion[i] == Motion::fixed;
  }
  return pellets;
}

}  // namespace packbed::lattice
