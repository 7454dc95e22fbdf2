#pragma once
// What a depth field on a grid lacks near sharp edges. Splines round an edge over a fraction of their
// spacing: four times finer ones, near the edges only, add what is missing. They fade out with the distance
// from the edge, so that the sum is C1.
#include <cstdint>
#include <functional>
#include <vector>

#include "contact/spline_block.hpp"
#include "mesh/triangle_tree.hpp"

namespace packbed {

inline constexpr std::int32_t kFiner = 4;  // fine spacings in one of the grid, fine blocks along a block
inline constexpr std::int32_t kFineOf = kFiner * kFiner * kFiner;  // fine blocks in a block

struct EdgeBlocks {
  std::vector<std::int32_t> first;  // of each block of the grid: its kFineOf entries in `block`, or -1
  std::vector<std::int32_t> block;  // which fine block, or -1
  std::vector<float> coefficient;   // kBlockSize for each fine block, and 4 more [m]
  double steepest = 0;              // bound of the slope that they add [-]
};

/// `first_node`: node 0 of each block of a grid of `spacing` [m]; `splines`: what the grid says of a place
/// near the surface [m].
EdgeBlocks make_edge_blocks(const TriangleMesh& mesh, const TriangleTree& tree, double spacing,
                            const std::vector<Vec3>& first_node,
                            const std::function<double(const Vec3&)>& splines);
/// Bytes that they take, estimated from the length of the sharp edges.
double estimate_edge_bytes(const TriangleMesh& mesh, double spacing);

}  // namespace packbed
