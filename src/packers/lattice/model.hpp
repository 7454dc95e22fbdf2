#pragma once
// What the lattice packers know: the scene in cells, which never changes, and the state of a run.
#include <cstdint>
#include <vector>

#include "bed/packed_bed.hpp"
#include "bed/scene.hpp"
#include "lattice/occupancy.hpp"
#include "lattice/probes.hpp"

namespace packbed::lattice {

enum class Method { digipac, digicgp };

struct Model {
  const Scene* scene = nullptr;
  Method method = Method::digipac;
  LatticeRules rules;  // with nothing left automatic
  GridFrame frame;     // cells of the lattice; z as high as pellets enter
  VoxelGrid space;     // open cells of the container; above its rim as in `rim`
  int rim = 0;
  std::vector<Probes> probes;      // of each kind of pellet; digicgp, none where cells are turned
  double largest = 0;              // bounding radius of the largest pellet [m]
  double step_time = 0;            // that one step stands for in the feed [s]
  std::vector<std::string> notes;  // what the user should know of this scene on a lattice
  int slab = 0;  // height of the slabs that share no cell with the one after the next [cells]

  const PelletKind& kind(std::uint32_t k) const { return scene->pellets[k]; }
};

/// What a pellet of digicgp remembers of the collisions of its last step.
struct Guide {
  Vec3 chance = Vec3::Zero();  // of a move along x, y, z, with its direction: -1 to 1
  Vec3 torque = Vec3::Zero();  // axis of the next rotation; zero: none
  std::uint64_t free = 1;      // nothing stopped it
};

/// What a collision of digicgp does to one of the two pellets.
struct Push {
  std::uint32_t pellet = 0;
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
};

/// Moves tried and made since the start.
struct Tally {
  double moves = 0, moved = 0, rotations = 0, rotated = 0;
  void add(const Tally& t) {
    moves += t.moves;
    moved += t.moved;
    rotations += t.rotations;
    rotated += t.rotated;
  }
};

struct State {
  explicit State(const Model& model) : lattice(model.frame, model.space, model.rim) {}

  Occupancy lattice;
  // one entry a pellet on the lattice (n each)
  std::vector<std::uint32_t> id, kind;
  std::vector<double> scale;
  std::vector<std::uint8_t> fixed;
  std::vector<Quat> rotation;
  std::vector<Cell> cell;   // that the centre of mass is in
  std::vector<Vec3> phase;  // of the centre of mass from the centre of that cell [cells]
  std::vector<Stamp> stamp;
  std::vector<Guide> guide;  // digicgp
  // digicgp: pellets that may reach pellet i before the next search, near[near_from[i] .. near_from[i + 1])
  std::vector<std::uint32_t> near_from, near;
  std::vector<CellBox> box;         // digicgp: of each pellet on the lattice
  std::vector<std::uint8_t> probe;  // digicgp: probes that met something last; of no influence
  std::vector<Cell> near_since;     // cells of the pellets at the search
  std::vector<int> slab;            // of height, in this step
  std::vector<Pellet> waiting;      // fed, but there is no room for them yet

  std::int64_t steps = 0;
  double mean_height = 0;          // of the cells at the start of the rest window [cells]
  double sinking = 0;              // found over the last window [cells]
  std::int64_t window_since = -1;  // step; -1: no window is open
  std::uint8_t at_rest = 0, waited = 0;
  std::int64_t snapshots = 0;
  double wall_s = 0, cpu_s = 0;  // of the parts of the run before the last resume
  Tally tally;

  std::size_t size() const { return id.size(); }
};

/// Throws InputError for what cannot be packed at this voxel size, naming the one that would do.
Model make_model(const Scene& scene);

inline double time_of(const Model& model, const State& state) {
  return static_cast<double>(state.steps) * model.step_time;
}
/// The cell that a place is in, and where in it, from its centre [cells].
struct Spot {
  Cell cell{};
  Vec3 phase = Vec3::Zero();
};
Spot spot_of(const Model& model, const Vec3& position);
Pose pose_of(const Model& model, const State& state, std::size_t i);
/// Pellets as they are now, in the order of the state.
std::vector<Pellet> pellets_of(const Model& model, const State& state);

}  // namespace packbed::lattice
