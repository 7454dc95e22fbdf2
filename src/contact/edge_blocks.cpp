#include "contact/edge_blocks.hpp"

#include "math/threads.hpp"
#include "mesh/topology.hpp"

namespace packbed {
namespace {

// What is missing is added whole up to kWhole from an edge, and nothing from kGone on, in spacings of the
// grid, whose splines are there as far as one spacing outside.
constexpr double kWhole = 0.5, kGone = 1;
// Coefficients lose this much, in spacings, and fine blocks that have nothing left are left out: leaving them
// out as they are would be a jump at their sides.
constexpr double kNothing = 1e-3;

struct Segment {
  Vec3 a, b;
  double distance(const Vec3& x) const {
    const Vec3 along = b - a;
    const double share = std::clamp((x - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (x - a - share * along).norm();
  }
};

std::vector<Segment> sharp_edges(const TriangleMesh& mesh) {
  std::vector<Segment> segments;
  for (const MeshEdge& e : mesh_edges(mesh))
    if (std::abs(e.angle) >= kSharpAngle)
      segments.push_back(
          {mesh.vertices[static_cast<std::size_t>(e.low)], mesh.vertices[static_cast<std::size_t>(e.high)]});
  return segments;
}

std::vector<Segment> within(const std::vector<Segment>& segments, const Vec3& centre, double reach) {
  std::vector<Segment> near;
  for (const Segment& s : segments)
    if (s.distance(centre) <= reach) near.push_back(s);
  return near;
}

double distance(const std::vector<Segment>& segments, const Vec3& x) {
  double least = std::numeric_limits<double>::infinity();
  for (const Segment& s : segments) least = std::min(least, s.distance(x));
  return least;
}

/// 1 to 0 between kWhole and kGone, C1.
double fade(double spacings) {
  const double t = std::clamp((spacings - kWhole) / (kGone - kWhole), 0.0, 1.0);
  return 1 - t * t * (3 - 2 * t);
}

/// The fine blocks of one block of the grid.
struct FineBlocks {
  std::vector<std::int32_t> block;  // kFineOf, or none
  std::vector<float> coefficient;
};

}  // namespace

EdgeBlocks make_edge_blocks(const TriangleMesh& mesh, const TriangleTree& tree, double spacing,
                            const std::vector<Vec3>& first_node,
                            const std::function<double(const Vec3&)>& splines) {
  const std::vector<Segment> edges = sharp_edges(mesh);
  const double fine = spacing / kFiner;
  const double reach = kGone * spacing + 2 * fine, half = 0.5 * std::sqrt(3.0);  // of a cube's diagonal
  const auto nothing = static_cast<float>(kNothing * spacing);
  const auto fill = [&](const Vec3& node, FineBlocks& out) {
    const std::vector<Segment> near =
        within(edges, node + Vec3::Constant(0.5 * (kBlock - 1) * spacing), reach + half * kBlock * spacing);
    for (std::int32_t sub = 0; sub < kFineOf && !near.empty(); ++sub) {
      const Vec3 index(sub % kFiner, sub / kFiner % kFiner, sub / (kFiner * kFiner));
      const Vec3 corner = node - Vec3::Constant(0.5 * spacing) + kBlock * fine * index;
      const std::vector<Segment> nearer =
          within(near, corner + Vec3::Constant(0.5 * kBlock * fine), reach + half * kBlock * fine);
      if (nearer.empty()) continue;
      std::vector<float> block(kBlockSize);
      fill_block(block.data(), [&](std::int32_t i, std::int32_t j, std::int32_t k) {
        const Vec3 x = corner + fine * Vec3(i + 0.5, j + 0.5, k + 0.5);
        const double away = distance(nearer, x), weight = fade(away / spacing);
        if (!(weight > 0)) return 0.0;
        return weight * (-tree.nearest(x, away * (1 + 1e-9) + 1e-9 * spacing).distance - splines(x));
      });
      for (float& c : block) c = std::copysign(std::max(0.0F, std::abs(c) - nothing), c);
      if (std::all_of(block.begin(), block.end(), [](float c) { return !(std::abs(c) > 0); })) continue;
      if (out.block.empty()) out.block.assign(kFineOf, -1);
      out.block[static_cast<std::size_t>(sub)] =
          static_cast<std::int32_t>(out.coefficient.size() / kBlockSize);
      out.coefficient.insert(out.coefficient.end(), block.begin(), block.end());
    }
  };
  std::vector<FineBlocks> found(first_node.size());
  parallel_for(found.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) fill(first_node[i], found[i]);
  });

  EdgeBlocks out;
  out.first.assign(found.size(), -1);
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i].block.empty()) continue;
    out.first[i] = static_cast<std::int32_t>(out.block.size());
    const auto before = static_cast<std::int32_t>(out.coefficient.size() / kBlockSize);
    for (const std::int32_t b : found[i].block) out.block.push_back(b < 0 ? b : before + b);
    out.coefficient.insert(out.coefficient.end(), found[i].coefficient.begin(), found[i].coefficient.end());
  }
  for (std::size_t at = 0; at < out.coefficient.size(); at += kBlockSize)
    out.steepest = std::max(out.steepest, steepest_of(&out.coefficient[at]) / fine);
  out.coefficient.resize(out.coefficient.size() + 4, 0.0F);  // a row is read four at a time
  return out;
}

double estimate_edge_bytes(const TriangleMesh& mesh, double spacing) {
  double length = 0;
  for (const Segment& s : sharp_edges(mesh)) length += (s.b - s.a).norm();
  const double side = kBlock * spacing / kFiner, across = 2 * kGone * spacing / side + 1;
  return length / side * across * across * static_cast<double>(kBlockSize * sizeof(float));
}

}  // namespace packbed
