// Phase feed: pellets that are due are laid on the lattice.
#include <fmt/format.h>

#include <algorithm>

#include "math/error.hpp"
#include "packers/lattice/step.hpp"

namespace packbed::lattice {
namespace {

/// So far may a pellet be moved at entry to find free cells. Exact poses of bodies that do not overlap share
/// no cell but by rounding; placed pellets may overlap a little.
constexpr int kNudge = 3;

/// Moves of up to kNudge cells, the shortest first, upwards before sideways before downwards.
std::vector<Cell> nudges() {
  std::vector<Cell> all;
  for (int z = -kNudge; z <= kNudge; ++z)
    for (int y = -kNudge; y <= kNudge; ++y)
      for (int x = -kNudge; x <= kNudge; ++x) all.push_back({x, y, z});
  const auto far = [](const Cell& c) { return c[0] * c[0] + c[1] * c[1] + c[2] * c[2]; };
  std::stable_sort(all.begin(), all.end(), [&](const Cell& a, const Cell& b) {
    return far(a) != far(b) ? far(a) < far(b) : a[2] > b[2];
  });
  return all;
}

bool lay(const Model& model, State& state, const Pellet& p, StampMaker& maker) {
  const auto [cell, phase] = spot_of(model, p.pose.position);
  Stamp stamp = maker.make(*model.kind(p.shape).shape, p.scale, p.pose.rotation, phase);
  static const std::vector<Cell> kNudges = nudges();
  for (const Cell& nudge : kNudges) {
    const Cell to{cell[0] + nudge[0], cell[1] + nudge[1], cell[2] + nudge[2]};
    if (state.lattice.hits(stamp, to)) continue;
    state.lattice.flip(stamp, to);
    state.id.push_back(p.id);
    state.kind.push_back(p.shape);
    state.scale.push_back(p.scale);
    state.fixed.push_back(p.fixed);
    state.rotation.push_back(p.pose.rotation);
    state.cell.push_back(to);
    state.phase.push_back(phase);
    state.stamp.push_back(std::move(stamp));
    state.guide.emplace_back();
    return true;
  }
  return false;
}

/// The highest point of any pellet that lies on something [m].
double surface(const Model& model, const State& state) {
  double top = 0;
  for (std::size_t i = 0; i < state.size(); ++i) {
    const double height =
        model.frame.centre(0, 0, state.cell[i][2] + state.stamp[i].low[2] + state.stamp[i].size[2]).z();
    if (height > top && state.lattice.hits_on_move(state.stamp[i], state.cell[i], 2, -1)) top = height;
  }
  return top;
}

}  // namespace

void feed(const Model& model, State& state, Feeder& feeder) {
  const double time = time_of(model, state);
  const bool due = !feeder.done() && time >= feeder.next_time() * (1 - 1e-12);
  if (!due && state.waiting.empty()) return;
  StampMaker maker(model.frame.pitch, model.largest);
  std::vector<Pellet> entering = std::move(state.waiting);
  state.waiting.clear();
  if (due) {
    const std::vector<Pellet> fed =
        feeder.enter(feeder.next_time(), pellets_of(model, state), surface(model, state));
    entering.insert(entering.end(), fed.begin(), fed.end());
  }
  for (const Pellet& p : entering) {
    if (lay(model, state, p, maker)) continue;
    if (model.scene->feed.kind == FeedKind::placed)
      throw InputError(fmt::format("placed pellet {}", p.id),
                       "cells that another pellet or the container has, and none free near by",
                       fmt::format("free cells within {} voxels", kNudge),
                       "a finer lattice.voxel, or move the pellet");
    state.waiting.push_back(p);
  }
  if (feeder.waiting() || !state.waiting.empty()) state.waited = 1;
}

}  // namespace packbed::lattice
