// The loops over pairs of spheres and walls for every width of the machine's vectors: the same bytes.
#include "contact/sphere_pairs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "math/random.hpp"

namespace packbed {
namespace {

constexpr std::size_t kSpheres = 40, kSlots = 8, kBlocks = 12;
constexpr double kStep = 1e-5;

struct Form {
  const char* name;
  bool hertz;
  double friction, rolling_friction;
};

/// A crowd of spheres that overlap by some per cent and move, with random pairs of them.
struct Crowd {
  SphereLaw law;
  std::vector<Quad> place, velocity, spin, force, twist;
  std::vector<PairBlock> blocks;
  std::vector<SpringBlock> slip, roll;
  std::vector<DashBlock> dash;
  std::vector<SphereWall> walls{{0, 0, 1, 0}, {1, 0, 0, -0.02}, {0, 0, 0, 0.03}, kNoWall};
  std::vector<PairBlock> wall_blocks;
  std::vector<Quad> sides;
  SphereTally tally;
  std::vector<SphereContact> contacts;

  explicit Crowd(const Form& form) {
    law.hertz = form.hertz;
    law.modulus = form.hertz ? 1e7 : 1e6;
    law.damping_ratio = 0.2;
    law.tangential_damping = 0.5;
    law.dissipation = 50;
    law.tangential_share = 0.8;
    law.friction = form.friction;
    law.rolling_friction = form.rolling_friction;
    Random random(1, Stream::test, 0);
    const auto number = [&](double low, double high) { return random.uniform(low, high); };
    for (std::size_t i = 0; i < kSpheres; ++i) {
      const double radius = number(1e-3, 5e-3);
      place.push_back({number(-0.02, 0.02), number(-0.02, 0.02), number(0, 0.02), radius});
      velocity.push_back({number(-1, 1), number(-1, 1), number(-1, 1), 1e-3 / (radius * radius * radius)});
      spin.push_back({number(-99, 99), number(-99, 99), number(-99, 99), 1});
    }
    force.resize(kSpheres + kSlots), twist.resize(kSpheres + kSlots);
    const auto any_of = [&](std::size_t n) {
      return std::min(static_cast<std::uint32_t>(number(0, static_cast<double>(n))),
                      static_cast<std::uint32_t>(n - 1));
    };
    for (std::size_t k = 0; k < kBlocks; ++k) {
      PairBlock pairs, with_wall;
      for (std::size_t l = 0; l < kLanes; ++l) {
        pairs.a[l] = any_of(kSpheres), pairs.b[l] = any_of(kSpheres);  // some with themselves: of no use
        pairs.to[l] = number(0, 1) < 0.7 ? pairs.b[l] : static_cast<std::uint32_t>(kSpheres) + any_of(kSlots);
        with_wall.a[l] = any_of(kSpheres), with_wall.b[l] = any_of(walls.size());
        sides.push_back({0.6, 0, 0.8, number(0, 5e-3)});
      }
      blocks.push_back(pairs), wall_blocks.push_back(with_wall);
    }
    slip.resize(2 * kBlocks), roll.resize(2 * kBlocks), dash.resize(2 * kBlocks);
    contacts.resize(2 * kLanes * kBlocks);
  }

  SphereMemory memory(std::size_t from) {
    return {law.friction > 0 ? slip.data() + from : nullptr,
            law.rolling_friction > 0 ? roll.data() + from : nullptr, dash.data() + from};
  }
  void advance(const SphereLoops& loops) {
    const SphereView view{place.data(), velocity.data(), spin.data(), force.data(), twist.data()};
    loops.touch_spheres({law, view, kStep, blocks, memory(0), tally});
    loops.touch_walls({law, view, kStep, wall_blocks, memory(kBlocks), tally}, walls);
    loops.touch_given_walls({law, view, kStep, wall_blocks, memory(kBlocks), tally}, sides);
    loops.touch_spheres({law, view, kStep, blocks, memory(0), tally, contacts.data()});
    loops.touch_walls(
        {law, view, kStep, wall_blocks, memory(kBlocks), tally, contacts.data() + kLanes * kBlocks}, walls);
    for (std::size_t i = 0; i < kSpheres; ++i) {
      four(velocity[i]) += 1e-5 * four(force[i]) * Four{1, 1, 1, 0};
      four(place[i]) += kStep * four(velocity[i]) * Four{1, 1, 1, 0};
    }
  }
};

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

constexpr Form kForms[] = {
    {"hooke", false, 0, 0}, {"hooke, friction", false, 0.4, 0}, {"hooke, rolling", false, 0.4, 0.1},
    {"hertz", true, 0, 0},  {"hertz, friction", true, 0.4, 0},  {"hertz, rolling", true, 0.4, 0.1}};

Crowd moved(const Form& form, const SphereLoops& loops) {
  Crowd crowd(form);
  for (int step = 0; step < 200; ++step) crowd.advance(loops);
  return crowd;
}

TEST(SphereLoops, CrowdsTouchAndLoseEnergyInEveryForm) {
  for (const SphereLoops& loops : sphere_loops())
    for (const Form& form : kForms) {
      SCOPED_TRACE(std::string(form.name) + ", " + loops.name);
      const Crowd crowd = moved(form, loops);
      EXPECT_GT(total(crowd.tally.touches), 200.0 * kBlocks);
      EXPECT_GT(total(crowd.tally.deep), 0);
      EXPECT_GT(std::ranges::max(crowd.tally.deepest.value), 0.1);
      EXPECT_GT(total(crowd.tally.damped), 0);
      if (form.friction > 0) {
        EXPECT_GT(total(crowd.tally.rubbed), 0);
      }
    }
}

TEST(SphereLoops, EveryWidthGivesTheSameBytes) {
  if (sphere_loops().size() == 1) GTEST_SKIP() << "one width only: no AVX-512, or a build with sanitizers";
  for (const Form& form : kForms) {
    const Crowd narrow = moved(form, sphere_loops().front());
    for (const SphereLoops& loops : sphere_loops().subspan(1)) {
      SCOPED_TRACE(std::string(form.name) + ", " + loops.name);
      const Crowd wide = moved(form, loops);
      EXPECT_TRUE(same_bytes(narrow.place, wide.place));
      EXPECT_TRUE(same_bytes(narrow.force, wide.force));
      EXPECT_TRUE(same_bytes(narrow.twist, wide.twist));
      EXPECT_TRUE(same_bytes(narrow.slip, wide.slip));
      EXPECT_TRUE(same_bytes(narrow.roll, wide.roll));
      EXPECT_TRUE(same_bytes(narrow.dash, wide.dash));
      EXPECT_EQ(std::memcmp(&narrow.tally, &wide.tally, sizeof(SphereTally)), 0);
      for (std::size_t k = 0; k < narrow.contacts.size(); ++k) {
        EXPECT_EQ(std::memcmp(&narrow.contacts[k].force, &wide.contacts[k].force, sizeof(Quad)), 0) << k;
        EXPECT_EQ(narrow.contacts[k].elastic, wide.contacts[k].elastic) << k;
      }
    }
  }
}

}  // namespace
}  // namespace packbed
