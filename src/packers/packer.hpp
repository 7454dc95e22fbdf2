#pragma once
// What every packing method takes and gives, and how a running one is watched.
#include <atomic>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bed/packed_bed.hpp"
#include "bed/run_record.hpp"
#include "bed/scene.hpp"
#include "lattice/voxel_grid.hpp"

namespace packbed {

struct Progress {
  double fraction = 0;  // of the whole run, estimated, 0 to 1
  double simulated_s = 0;
  std::int64_t steps = 0;
  int fed = 0, asked = 0;
  std::string phase;  // "feeding", "settling", "waiting for room"
};

/// Energies of one pellet at one instant [J].
struct PelletEnergy {
  double translation = 0, rotation = 0, height = 0;
};

struct Snapshot {
  double time = 0;  // simulated [s]
  const std::vector<Pellet>* pellets = nullptr;
  std::vector<PelletEnergy> energies;
  double elastic = 0;  // stored in all contacts [J]
};

/// How the world outside sees a running packer. All calls come from the thread that runs it; empty ones are
/// skipped.
struct Watch {
  std::function<void()> accepted;                              // the scene can be packed; the run begins
  std::function<void(const Progress&)> progress;               // a few times a second
  std::function<void(std::span<const std::byte>)> checkpoint;  // the whole state of the run
  std::function<void(const Snapshot&)> snapshot;               // every output.trajectory_interval
  const std::atomic<bool>* stop = nullptr;                     // set: write a checkpoint and return
};

struct PackResult {
  PackedBed bed;
  VoxelGrid
      grid;  // of the packer, where it has one, in the frame that frame_for(bed, its pitch) gives; else empty
  RunRecord record;
  bool stopped = false;  // by Watch::stop; the last checkpoint continues it
};

/// By the scene's method.
PackResult pack(const Scene& scene, const Watch& watch, std::span<const std::byte> state = {});

/// Rigid bodies with penalty contact. `state` continues from a checkpoint of the same scene, bit for bit.
/// Throws InputError for a scene that cannot be packed as given.
PackResult pack_mesh(const Scene& scene, const Watch& watch, std::span<const std::byte> state = {});

/// Spheres only, of any sizes: the same physics with what spheres make simpler. `state` as above.
PackResult pack_spheres(const Scene& scene, const Watch& watch, std::span<const std::byte> state = {});
/// What it would take; throws as it does.
struct SphereNumbers {
  double step = 0;       // [s]
  double stiffness = 0;  // of two of the smallest spheres; with Hertz's law at the deepest overlap of the
                         // hardest impact [N/m]
};
SphereNumbers sphere_numbers(const Scene& scene);

/// Pellets and container in cells of a lattice: methods digipac, digicgp and digidem. `state` as above.
/// Throws InputError also for pellets too thin, containers that close and lattices too large at this voxel
/// size.
PackResult pack_lattice(const Scene& scene, const Watch& watch, std::span<const std::byte> state = {});
/// Whether a method packs on a lattice.
bool packs_on_lattice(const std::string& method);

}  // namespace packbed
