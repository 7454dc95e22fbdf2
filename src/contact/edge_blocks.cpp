#include "contact/edge_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

/// Half the diagonal of a block whose cells are so wide.
double half_diagonal(double spacing) {
  return 0.5 * std::sqrt(3.0) * kBlock * spacing;
}

class Filler {
 public:
  Filler(const TriangleMesh& mesh, const TriangleTree& tree, double spacing,
         const std::function<double(const Vec3&)>& splines)
      : edges_(sharp_edges(mesh)),
        tree_(tree),
        splines_(splines),
        spacing_(spacing),
        fine_(spacing / kFiner),
        reach_(kGone * spacing + 2 * fine_) {}

  FineBlocks fill(const Vec3& node) const {
    FineBlocks out;
    const std::vector<Segment> near = within(edges_, node + Vec3::Constant(0.5 * (kBlock - 1) * spacing_),
                                             reach_ + half_diagonal(spacing_));
    for (std::int32_t sub = 0; sub < kFineOf && !near.empty(); ++sub) {
      const Vec3 index(sub % kFiner, sub / kFiner % kFiner, sub / (kFiner * kFiner));
      const Vec3 corner = node - Vec3::Constant(0.5 * spacing_) + kBlock * fine_ * index;
      const std::vector<float> block = coefficients(corner, near);
      if (std::all_of(block.begin(), block.end(), [](float c) { return !(std::abs(c) > 0); })) continue;
      if (out.block.empty()) out.block.assign(kFineOf, -1);
      out.block[static_cast<std::size_t>(sub)] =
          static_cast<std::int32_t>(out.coefficient.size() / kBlockSize);
      out.coefficient.insert(out.coefficient.end(), block.begin(), block.end());
    }
    return out;
  }

 private:
  /// Of the fine block at `corner`; none when no edge is near.
  std::vector<float> coefficients(const Vec3& corner, const std::vector<Segment>& edges) const {
    const std::vector<Segment> near =
        within(edges, corner + Vec3::Constant(0.5 * kBlock * fine_), reach_ + half_diagonal(fine_));
    if (near.empty()) return {};
    std::vector<float> block(kBlockSize);
    fill_block(block.data(), [&](std::int32_t i, std::int32_t j, std::int32_t k) {
      return missing(corner + fine_ * Vec3(i + 0.5, j + 0.5, k + 0.5), near);
    });
    const auto nothing = static_cast<float>(kNothing * spacing_);
    for (float& c : block) c = std::copysign(std::max(0.0F, std::abs(c) - nothing), c);
    return block;
  }
  /// What the splines of the grid lack at x [m].
  double missing(const Vec3& x, const std::vector<Segment>& edges) const {
    const double away = distance(edges, x), weight = fade(away / spacing_);
    if (!(weight > 0)) return 0;
    return weight * (-tree_.nearest(x, away * (1 + 1e-9) + 1e-9 * spacing_).distance - splines_(x));
  }

  std::vector<Segment> edges_;
  const TriangleTree& tree_;
  const std::function<double(const Vec3&)>& splines_;
  double spacing_, fine_;
  double reach_;  // of an edge, and of the rule that makes coefficients
};

}  // namespace

EdgeBlocks make_edge_blocks(const TriangleMesh& mesh, const TriangleTree& tree, double spacing,
                            const std::vector<Vec3>& first_node,
                            const std::function<double(const Vec3&)>& splines) {
  const Filler filler(mesh, tree, spacing, splines);
  std::vector<FineBlocks> found(first_node.size());
  parallel_for(found.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) found[i] = filler.fill(first_node[i]);
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
    out.steepest = std::max(out.steepest, steepest_of(&out.coefficient[at]) / (spacing / kFiner));
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
