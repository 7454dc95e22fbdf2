// Broken CAD files: whatever a file holds, packbed answers with a body or with an InputError, soon, and in
// bounded memory. The mutations are those that happen (a file cut short, bytes damaged) and those that harm
// (numbers in headers that lie).
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>

#include "io/cad.hpp"
#include "io/cad_files.hpp"
#include "math/error.hpp"
#include "math/random.hpp"
#include "mesh/build.hpp"

namespace packbed {
namespace {

using namespace test;

struct Seed {
  std::string ending, content;
};

std::vector<Seed> seeds() {
  const TriangleMesh mesh = revolved({{0, 0}, {1.71, 0}, {1.71, 3.46}, {0, 3.46}}, 12);
  return {{".stl", as_text_stl(mesh)},
          {".stl", as_binary_stl(mesh)},
          {".obj", as_obj(mesh)},
          {".ply", as_ply(mesh)},
          {".msh", content_of(mesh_file("a38.msh"))},
          {".msh", content_of(mesh_file("a38_22.msh"))},
          {".step", content_of(mesh_file("a38.step"))}};
}

std::size_t below(Random& random, std::size_t n) {
  return std::min(n - 1, static_cast<std::size_t>(random.uniform() * static_cast<double>(n)));
}

// Replaces one number of a text file by one that lies.
void lie(std::string& s, Random& random) {
  const char* lies[] = {"4000000000", "-1", "nan", "1e308", "0", "99999999999999999999", "", "inf"};
  const std::size_t from = s.find_first_of("0123456789", below(random, s.size()));
  if (from == std::string::npos) return;
  const std::size_t to = std::min(s.find_first_not_of("0123456789.", from), s.size());
  s.replace(from, to - from, lies[below(random, 8)]);
}

std::string mutated(std::string s, std::uint32_t which) {
  Random random(20260101, Stream::test, which, 77);
  switch (which % 6) {
    case 0:
      s.resize(below(random, s.size()));
      break;
    case 1:
      for (int k = 0; k < 4; ++k) s[below(random, s.size())] ^= static_cast<char>(1 + below(random, 255));
      break;
    case 2:
      for (int k = 0; k < 3; ++k) lie(s, random);
      break;
    case 3:
      s.erase(below(random, s.size()), 1 + below(random, 200));
      break;
    case 4: {
      const std::size_t from = below(random, s.size());
      s.insert(below(random, s.size()), s.substr(from, 1 + below(random, 200)));
      break;
    }
    default:  // a header that lies
      if (s.size() > 84) {
        std::string head = s.substr(0, 200);
        lie(head, random);
        s = head + s.substr(std::min<std::size_t>(200, s.size()));
        for (std::size_t k = 80; k < 84 && k < s.size(); ++k) s[k] = static_cast<char>(below(random, 256));
      }
  }
  return s;
}

struct Tally {
  int good = 0, refused = 0;
  double slowest = 0;  // [s]
};

void feed(const Seed& seed, std::uint32_t which, double seconds, const TemporaryFolder& folder,
          Tally& tally) {
  CadOptions options;
  options.limits.seconds = seconds;
  if (seed.ending != ".step") options.unit = "mm";
  const std::string path = folder.write("f" + seed.ending, mutated(seed.content, which));
  const auto start = std::chrono::steady_clock::now();
  try {
    const ShapePtr s = load_shape("p", path, options);
    EXPECT_TRUE(std::isfinite(s->volume) && s->volume > 0 && s->bounding_radius > 0) << which;
    ++tally.good;
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find(path), std::string::npos) << e.what();
    ++tally.refused;
  }  // anything else fails the test
  tally.slowest = std::max(tally.slowest,
                           std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

void fuzz(std::uint32_t first, std::uint32_t rounds) {
  constexpr double kSeconds =
      2.5;  // packbed's own limit is 20: hung readers would make the test last for ever
  const TemporaryFolder folder;
  Tally tally;
  const std::vector<Seed> all = seeds();
  for (std::uint32_t r = first; r < first + rounds; ++r)
    for (std::size_t k = 0; k < all.size(); ++k)
      feed(all[k], r * static_cast<std::uint32_t>(all.size()) + static_cast<std::uint32_t>(k), kSeconds,
           folder, tally);
  const int files = tally.good + tally.refused;
  EXPECT_EQ(files, static_cast<int>(rounds * all.size()));
  EXPECT_GT(tally.refused, files / 3);  // the mutations do harm
  EXPECT_LT(tally.slowest, 20);
  rusage children{}, self{};
  getrusage(RUSAGE_CHILDREN, &children);
  getrusage(RUSAGE_SELF, &self);
  EXPECT_LT(children.ru_maxrss, 2l << 20);  // [kB]: 2 GB
  EXPECT_LT(self.ru_maxrss, 2l << 20);
  ::testing::Test::RecordProperty("good", tally.good);
  fmt::print("{} files: {} used, {} refused; slowest {:.1f} s; largest reader {} MB\n", files, tally.good,
             tally.refused, tally.slowest, children.ru_maxrss / 1024);
}

TEST(CadFuzz, FewBrokenFilesAreAnswered) {
  fuzz(0, 3);
}
TEST(LongCadFuzz, HundredsOfBrokenFilesAreAnswered) {
  fuzz(3, 48);
}  // 336 files

}  // namespace
}  // namespace packbed
