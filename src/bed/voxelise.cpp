#include "bed/voxelise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bed/pellet_box.hpp"
#include "lattice/rasterise.hpp"
#include "math/error.hpp"
#include "math/threads.hpp"

namespace packbed {
namespace {

constexpr int kSlab = 64;  // slices drawn together: they stay in the cache, and threads share slabs
constexpr double kMostVoxels = 0x1p37;  // 16 GiB of bits

/// Whole voxels that cover a length; a length that is a whole number of them but for rounding needs no extra
/// one.
double voxels_over(double length, double pitch) {
  return std::ceil(length / pitch * (1 - 1e-12) - 1e-9);
}

GridFrame checked(const Vec3& origin, double pitch, const Vec3& count) {
  if (!(count.minCoeff() >= 1) || !(count.prod() <= kMostVoxels))
    throw InputError(
        "pitch",
        fmt::format("{:g} m, which makes {:g} x {:g} x {:g} voxels", pitch, count.x(), count.y(), count.z()),
        "1 to 2^37 voxels", "choose a pitch between a tenth and a hundredth of a pellet's diameter");
  GridFrame frame;
  frame.origin = origin;
  frame.pitch = pitch;
  for (int d = 0; d < 3; ++d) frame.size[static_cast<std::size_t>(d)] = static_cast<int>(count[d]);
  return frame;
}

void check_pitch(double pitch) {
  if (!(pitch > 0) || !std::isfinite(pitch))
    throw InputError("pitch", fmt::format("{:g} m", pitch), "a positive length", "for example \"0.1 mm\"");
}

/// Slices that each pellet may touch, so that a slab looks only at its own.
std::vector<std::vector<std::uint32_t>> pellets_by_slab(const PackedBed& bed, const GridFrame& frame) {
  std::vector<std::vector<std::uint32_t>> slabs(
      static_cast<std::size_t>((frame.size[2] + kSlab - 1) / kSlab));
  for (std::size_t i = 0; i < bed.pellets.size(); ++i) {
    const Pellet& p = bed.pellets[i];
    const Shape& shape = *bed.shapes[p.shape];
    const double low = -reach(shape, p, -Vec3::UnitZ()), high = reach(shape, p, Vec3::UnitZ());
    const auto slab = [&](double z) { return std::floor((z - frame.origin.z()) / frame.pitch / kSlab); };
    const double first = std::max(0.0, slab(low - frame.pitch)),
                 last = std::min(static_cast<double>(slabs.size()) - 1, slab(high + frame.pitch));
    for (double s = first; s <= last; ++s)
      slabs[static_cast<std::size_t>(s)].push_back(static_cast<std::uint32_t>(i));
  }
  return slabs;
}

}  // namespace

GridFrame frame_for(const Container& container, double pitch, double top) {
  check_pitch(pitch);
  Vec3 size(0, 0, top);
  double margin = 0;
  if (container.kind == ContainerKind::tube) {
    size.x() = size.y() = 2 * container.radius;
  } else if (container.kind == ContainerKind::box) {
    size.x() = container.width;
    size.y() = container.depth;
  } else if (container.kind == ContainerKind::mesh) {
    for (const Vec3& v : container.surface.vertices) {
      size.x() = std::max(size.x(), 2 * std::abs(v.x()));
      size.y() = std::max(size.y(), 2 * std::abs(v.y()));
    }
    margin = 2;
  } else {
    throw InputError("container", std::string(to_string(container.kind)),
                     "a container with sides (tube, box or mesh)", "take the frame from the bed");
  }
  const Vec3 count(voxels_over(size.x(), pitch) + margin, voxels_over(size.y(), pitch) + margin,
                   std::max(1.0, voxels_over(top, pitch)));
  return checked({-0.5 * count.x() * pitch, -0.5 * count.y() * pitch, 0}, pitch, count);
}

GridFrame frame_for(const PackedBed& bed, double pitch) {
  check_pitch(pitch);
  if (has_sides(bed.container.kind)) return frame_for(bed.container, pitch, bed_top(bed));
  Box3 box = bounding_box(bed);
  if (box.isEmpty()) box = Box3(Vec3::Zero(), Vec3::Constant(pitch));
  if (bed.container.kind == ContainerKind::plane) box.min().z() = std::min(0.0, box.max().z());
  Vec3 count;
  for (int d = 0; d < 3; ++d) count[d] = std::max(1.0, voxels_over(box.sizes()[d], pitch));
  return checked(box.min(), pitch, count);
}

VoxelGrid voxelise(const PackedBed& bed, const GridFrame& frame, bool labels) {
  VoxelGrid grid(frame);
  if (labels)
    grid.labels.resize(static_cast<std::size_t>(frame.size[0]) * static_cast<std::size_t>(frame.size[1]) *
                       static_cast<std::size_t>(frame.size[2]));
  const auto slabs = pellets_by_slab(bed, frame);
  std::vector<std::int64_t> doubled(slabs.size(), 0);
  parallel_for(slabs.size(), 1, [&](std::size_t begin, std::size_t end) {
    Rasteriser rasteriser(frame);
    for (std::size_t s = begin; s < end; ++s) {
      const int z = static_cast<int>(s) * kSlab;
      for (const std::uint32_t i : slabs[s]) {
        const Pellet& p = bed.pellets[i];
        const BitBlock& block =
            rasteriser.body(*bed.shapes[p.shape], p.pose, p.scale, z, std::min(z + kSlab, frame.size[2]));
        doubled[s] += merge(block, grid, static_cast<std::int32_t>(p.id) + 1);
      }
    }
  });
  for (const std::int64_t d : doubled) grid.doubled += d;
  return grid;
}

std::vector<float> partial_volume(const PackedBed& bed, const GridFrame& frame, int k) {
  if (k < 1 || k > kMostPoints)
    throw InputError("points along a voxel's edge", std::to_string(k), fmt::format("1 to {}", kMostPoints));
  const std::size_t nx = static_cast<std::size_t>(frame.size[0]),
                    ny = static_cast<std::size_t>(frame.size[1]);
  std::vector<float> fraction(nx * ny * static_cast<std::size_t>(frame.size[2]), 0.0F);
  const float weight = 1.0F / static_cast<float>(k * k * k);
  const int most = std::max(1, 64 / k);  // coarse slices at a time: memory stays near that of one coarse grid
  for (int z = 0; z < frame.size[2]; z += most) {
    GridFrame fine;
    fine.pitch = frame.pitch / k;
    fine.origin = frame.origin + Vec3(0, 0, z * frame.pitch);
    fine.size = {frame.size[0] * k, frame.size[1] * k, std::min(most, frame.size[2] - z) * k};
    const VoxelGrid points = voxelise(bed, fine);
    parallel_for(static_cast<std::size_t>(fine.size[2] / k), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t zz = begin; zz < end; ++zz)
        for (int c = 0; c < k; ++c)
          for (std::size_t y = 0; y < ny * static_cast<std::size_t>(k); ++y) {
            float* out = fraction.data() +
                         ((static_cast<std::size_t>(z) + zz) * ny + y / static_cast<std::size_t>(k)) * nx;
            const std::uint64_t* row =
                points.words.data() + points.row(static_cast<int>(y), static_cast<int>(zz) * k + c);
            for (std::size_t x = 0; x < nx * static_cast<std::size_t>(k); ++x)
              if ((row[x / 64] >> (x % 64)) & 1U) out[x / static_cast<std::size_t>(k)] += 1.0F;
          }
    });
  }
  for (float& f : fraction) f *= weight;  // whole numbers until now: exact
  return fraction;
}

}  // namespace packbed
