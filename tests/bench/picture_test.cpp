#include "bench/picture.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bench/bench.hpp"
#include "math/error.hpp"

namespace packbed::bench {
namespace {

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

TEST(Picture, DrawsWhatItsAxesCanShowAndNamesEverySeries) {
  Picture p{"p", "a < b", {"x", true}, {"y", true}, {}};
  p.series.push_back({"first", {1, 10, 100}, {1e-3, 0, 1e-5}, {}, {"one", "none", "three"}});
  p.series.push_back({"second", {5}, {std::nan("")}, {}, {}});
  const std::string svg = to_svg(p);
  EXPECT_EQ(count(svg, "r='3.6'"), 2U);  // zero and nan have no place on a logarithmic axis
  EXPECT_EQ(count(svg, ">none<"), 0U);
  EXPECT_NE(svg.find(">second<"), std::string::npos);
  EXPECT_NE(svg.find("a &lt; b"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(Table, KeepsItsCellsApart) {
  Table t;
  t.columns = {"what", "value [%]"};
  t.add("a, b", 1.0 / 3);
  t.add("quote \" here", std::nan(""));
  EXPECT_EQ(to_csv(t, {"heading"}), "# heading\nwhat,value [%]\n\"a, b\",0.3333\n\"quote \"\" here\",\n");
}

TEST(Benches, AreFoundByNameOrTheNamesAreTold) {
  for (const Bench& b : benches()) EXPECT_EQ(&find_bench(b.name), &b);
  try {
    find_bench("contct");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("contact"), std::string::npos);
  }
}

}  // namespace
}  // namespace packbed::bench
