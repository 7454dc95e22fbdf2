// Whose cells those are that stop a pellet of digicgp, against cells one by one.
#include "packers/lattice/collisions.hpp"

#include <gtest/gtest.h>

#include "../shapes.hpp"
#include "lattice/surroundings.hpp"

namespace packbed::lattice {
namespace {

constexpr double kVoxel = 0.25e-3;

/// A flat cylinder above three balls along x, a row of y further each.
struct Table {
  Table() {
    scene.method = "digicgp";
    scene.pellets = {{test::cylinder(8e-3, 3e-3), 1000, 0.5}, {test::sphere(1e-3), 1000, 0.5}};
    scene.container = make_tube("tube", 20e-3, 40e-3);
    scene.feed.kind = FeedKind::pour;
    scene.lattice.voxel = kVoxel;
    model = make_model(scene);
    state = std::make_unique<State>(model);
    maker = std::make_unique<StampMaker>(model.frame.pitch, model.largest);
    add(0, {40, 40, 40});
    for (int k = -1; k <= 1; ++k) add(1, {40 + 10 * k, 40 + k, 30});
    for (std::uint32_t i = 1; i < state->size(); ++i) state->near.push_back(i);
    state->near_from.assign(state->size() + 1, static_cast<std::uint32_t>(state->near.size()));
    state->near_from[0] = 0;
  }
  void add(std::uint32_t kind, const Cell& cell) {
    State& s = *state;
    s.id.push_back(static_cast<std::uint32_t>(s.size()));
    s.kind.push_back(kind);
    s.scale.push_back(1);
    s.rotation.push_back(Quat::Identity());
    s.cell.push_back(cell);
    s.phase.push_back(Vec3(0.1, -0.2, 0.05));
    s.stamp.push_back(maker->make(*model.kind(kind).shape, 1, Quat::Identity(), s.phase.back()));
    s.box.push_back(box_of(s.stamp.back(), cell));
    s.slab.push_back(0);
    s.lattice.flip(s.stamp.back(), cell);
  }
  Scene scene;
  Model model;
  std::unique_ptr<State> state;
  std::unique_ptr<StampMaker> maker;
};

TEST(Collisions, EveryPelletFeelsAllOfItsCells) {
  const Table table;
  const State& s = *table.state;
  const Stamp& stamp = s.stamp[0];
  Surroundings around;
  around.look(s.lattice, stamp, s.cell[0], 24);
  int met = 0;
  for (int down = 1; down <= 4; ++down) {  // the deeper, the more rows go through all three
    const Cell by{0, 0, -down};
    Hits hits;
    if (!around.list_hits(stamp, by, hits)) continue;
    ++met;
    std::vector<Push> pushes;
    Collisions().push(s, 0, {stamp, s.phase[0], by, hits.rows(), Vec3::UnitZ()}, pushes);
    ASSERT_EQ(pushes.size(), 4u);
    for (const Push& p : pushes) {
      Vec3 force = Vec3::Zero(), arms = Vec3::Zero();
      int count = 0;
      for_each_cell(stamp, [&](int x, int y, int z) {
        const Cell at{x + by[0], y + by[1], z + by[2]};  // from the cylinder's cell
        Cell its = at;
        bool solid = false;
        for (std::uint32_t j = 1; j < s.size() && !solid; ++j) {
          for (std::size_t d = 0; d < 3; ++d) its[d] = at[d] + s.cell[0][d] - s.cell[j][d];
          solid = has_cell(s.stamp[j], its) && (p.pellet == 0 || p.pellet == j);
        }
        if (!solid) return;
        if (p.pellet == 0) its = at;
        const Vec3 arm = Vec3(its[0], its[1], its[2]) - s.phase[p.pellet];
        force -= arm.normalized();
        arms += arm;
        ++count;
      });
      EXPECT_GT(count, 0);
      EXPECT_LT((p.force - force).norm(), 1e-4 * count);
      const Vec3 torque = arms.cross(p.pellet == 0 ? Vec3(Vec3::UnitZ()) : Vec3(-Vec3::UnitZ()));
      EXPECT_LT((p.torque - torque).norm(), 1e-4 * count);
    }
  }
  EXPECT_GT(met, 1);
}

}  // namespace
}  // namespace packbed::lattice
