#pragma once
// Quadratic B-splines on a regular grid, in blocks of 8^3 cells round nodes, each with the 10^3 coefficients
// that it needs: the cheapest C1 field on a grid, of 3x3x3 coefficients a place (tricubic: 64).
//
// Coefficients come from samples by f - (laplacian of f) / 8, a local rule that reproduces every quadratic
// without cubic cross terms.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "math/types.hpp"

namespace packbed {

inline constexpr std::int32_t kBlock = 8;           // cells along the side of a block
inline constexpr std::int32_t kRow = kBlock + 2;    // coefficients: one more on each side
inline constexpr std::int32_t kNodes = kBlock + 4;  // samples: one more again, for the rule
inline constexpr std::size_t kBlockSize = static_cast<std::size_t>(kRow) * kRow * kRow;

typedef double SplineFour __attribute__((vector_size(32)));
typedef float SplineRow __attribute__((vector_size(16)));

/// Value and derivatives along x, y and z, per spacing.
struct SplineValue {
  double value = 0, x = 0, y = 0, z = 0;
};
inline __attribute__((always_inline)) SplineValue operator+(const SplineValue& a, const SplineValue& b) {
  return {a.value + b.value, a.x + b.x, a.y + b.y, a.z + b.z};
}

/// At (u, v, w) in [-1/2, 1/2]^3 from the node whose first coefficient, one node back along each axis, is at
/// `first`. Reads one float beyond each row of three.
inline __attribute__((always_inline)) SplineValue spline_at(const float* first, double u, double v,
                                                            double w) {
  const auto weights = [](double t) {
    return std::array<double, 3>{0.5 * (0.5 - t) * (0.5 - t), 0.75 - t * t, 0.5 * (0.5 + t) * (0.5 + t)};
  };
  const auto slopes = [](double t) { return std::array<double, 3>{t - 0.5, -2 * t, t + 0.5}; };
  const std::array<double, 3> wx = weights(u), wy = weights(v), wz = weights(w);
  const std::array<double, 3> dx = slopes(u), dy = slopes(v), dz = slopes(w);
  SplineFour value{}, by_y{}, by_z{};
  for (std::size_t c = 0; c < 3; ++c) {
    SplineFour plane{}, plane_y{};
    for (std::size_t b = 0; b < 3; ++b) {
      SplineRow narrow;
      std::memcpy(&narrow, first + (c * kRow + b) * kRow, sizeof narrow);
      const SplineFour four = __builtin_convertvector(narrow, SplineFour);
      plane += wy[b] * four;
      plane_y += dy[b] * four;
    }
    value += wz[c] * plane;
    by_y += wz[c] * plane_y;
    by_z += dz[c] * plane;
  }
  const auto along_x = [](const std::array<double, 3>& weight, const SplineFour& by) {
    return weight[0] * by[0] + weight[1] * by[1] + weight[2] * by[2];
  };
  return {along_x(wx, value), along_x(dx, value), along_x(wx, by_y), along_x(wx, by_z)};
}

/// Where the coefficients of the cell (i, j, k) of a block begin.
inline __attribute__((always_inline)) std::size_t cell_of_block(std::int32_t i, std::int32_t j,
                                                                std::int32_t k) {
  return static_cast<std::size_t>((k * kRow + j) * kRow + i);
}

/// Fills a block with the coefficients of what `sample` says of its nodes: sample(i, j, k), each from -2 to
/// kBlock + 1, node 0 being that of the first cell.
template <class Sample>
void fill_block(float* out, const Sample& sample) {
  std::vector<double> samples(static_cast<std::size_t>(kNodes * kNodes * kNodes));
  const auto at = [](std::int32_t k, std::int32_t j, std::int32_t i) {
    return static_cast<std::size_t>((k * kNodes + j) * kNodes + i);
  };
  for (std::int32_t k = 0; k < kNodes; ++k)
    for (std::int32_t j = 0; j < kNodes; ++j)
      for (std::int32_t i = 0; i < kNodes; ++i) samples[at(k, j, i)] = sample(i - 2, j - 2, k - 2);
  for (std::int32_t k = 1; k <= kRow; ++k)
    for (std::int32_t j = 1; j <= kRow; ++j)
      for (std::int32_t i = 1; i <= kRow; ++i) {
        const double f = samples[at(k, j, i)];
        const double laplacian = samples[at(k, j, i - 1)] + samples[at(k, j, i + 1)] +
                                 samples[at(k, j - 1, i)] + samples[at(k, j + 1, i)] +
                                 samples[at(k - 1, j, i)] + samples[at(k + 1, j, i)] - 6 * f;
        *out++ = static_cast<float>(f - 0.125 * laplacian);
      }
}

/// Bound of the slope of the splines of a block, per spacing: along each axis it is a mean of the differences
/// of the coefficients around.
inline double steepest_of(const float* block) {
  constexpr std::size_t kAlong[3] = {1, kRow, kRow * kRow};
  double steepest2 = 0;
  for (std::int32_t k = 0; k < kBlock; ++k)
    for (std::int32_t j = 0; j < kBlock; ++j)
      for (std::int32_t i = 0; i < kBlock; ++i) {
        double slope2 = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          float most = 0;
          for (std::int32_t c = 0; c < 27; ++c) {
            const std::array<std::int32_t, 3> at{c % 3, c / 3 % 3, c / 9};
            if (at[axis] == 2) continue;
            const float* p = block + cell_of_block(i + at[0], j + at[1], k + at[2]);
            most = std::max(most, std::abs(p[kAlong[axis]] - p[0]));
          }
          slope2 += static_cast<double>(most) * static_cast<double>(most);
        }
        steepest2 = std::max(steepest2, slope2);
      }
  return std::sqrt(steepest2);
}

}  // namespace packbed
