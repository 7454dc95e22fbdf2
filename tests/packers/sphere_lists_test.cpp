// The lists of pairs of the sphere packer.
#include "packers/spheres/lists.hpp"

#include <gtest/gtest.h>

namespace packbed::spheres {
namespace {

/// Pairs (a, b) in the order of a, as a search lists them: the last sphere's end in lanes of no use.
List list_of(const Model& model, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs,
             std::uint32_t spheres) {
  List list;
  for (std::uint32_t i = 0; i < spheres; ++i) {
    list.first.push_back(list.filled);
    for (const auto& [a, b] : pairs)
      if (a == i) append(list, a, b, a);
  }
  list.first.push_back(static_cast<std::uint32_t>(list.lanes()));
  make_memory(model, list);
  return list;
}

Model with_friction() {
  Model model;
  model.turns = true;
  return model;
}

// The lanes that fill up the last block name the sphere of its first pair, and are numbered with the pairs of
// the last sphere: a hit sphere whose partner was looked up there went through it.
TEST(SphereLists, PaddingIsNoPair) {
  const List list = list_of(with_friction(), {{0, 7}, {3, 5}}, 8);
  EXPECT_EQ(list.lanes(), kLanes);
  for (std::uint32_t a = 0; a < 9; ++a)
    for (std::uint32_t b = 0; b < 8; ++b) {
      const bool listed = (a == 0 && b == 7) || (a == 3 && b == 5);
      EXPECT_EQ(a != b && find_pair(list, a, b), listed) << a << ' ' << b;
    }
}

TEST(SphereLists, APairIsTakenOverWithWhatItRemembers) {
  const Model model = with_friction();
  List from = list_of(model, {{0, 1}, {0, 2}, {1, 2}}, 3), to;
  from.slip[0].stretch[0] = {{1, 2, 3}};
  from.slip[0].stiffness = {{10, 20, 30}};
  from.dash[0].drag = {{5, 6, 7}};
  append(to, 2, 0, 2);
  make_memory(model, to);
  EXPECT_FALSE(take_over(from, 2, 0, 1.0, 2, to));
  EXPECT_TRUE(take_over(from, 0, 2, -1.0, 0, to));
  EXPECT_EQ(to.slip[0].stretch[0].value[0], -2);
  EXPECT_EQ(to.slip[0].stiffness.value[0], 20);
  EXPECT_EQ(to.dash[0].drag.value[0], 6);
  EXPECT_FALSE(find_pair(from, 0, 2));
  EXPECT_FALSE(take_over(from, 0, 2, -1.0, 0, to));
  EXPECT_TRUE(find_pair(from, 0, 1) && find_pair(from, 1, 2));
}

}  // namespace
}  // namespace packbed::spheres
