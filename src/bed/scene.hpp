#pragma once
// What a case file says, checked and in SI: one scene for every method. Made by io/case, never changed in a
// run.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bed/sizes.hpp"
#include "shape/container.hpp"
#include "shape/shape.hpp"

namespace packbed {

struct PelletKind {
  ShapePtr shape;
  double density = 0;  // [kg/m3]
  double share = 1;    // of the pellets fed, by number; the shares of a scene add up to 1
  /// What is fed of each size; empty: every pellet has scale 1. When one kind of a scene has sizes, all have,
  /// and their counts add up to Feed::count.
  std::vector<SizeClass> sizes = {};
  SizeDistribution asked = {};  // what sizes stands for
};

/// Penalty contact between two pellets, or between a pellet and the container.
struct ContactLaw {
  double stiffness =
      0;  // of the energy k delta^2 / 2 [N/m]; 0: found from the allowed overlap at the expected speed
  double allowed_overlap =
      0;  // at the hardest impact, fraction of the smallest thickness; used when stiffness is 0
  double damping_ratio = 0;     // fraction of critical [-] (see damping_from_restitution)
  double friction = 0;          // Coulomb coefficient [-]
  bool torsion = true;          // a spring against spinning on a flat touch
  double rolling_friction = 0;  // moment against rolling over R* times the normal force [-]
  // spheres only (contact/sphere_law.hpp)
  bool hertz = false;
  double youngs_modulus = 0,
         poisson_ratio = 0;  // of both bodies [Pa]; 0: stiffness or allowed_overlap instead
  double shear_modulus = 0;  // [Pa]; 0: of an isotropic body
  double dissipation = 0, tangential_dissipation = 0;  // dashpots over the effective mass [1/s]
  double tangential_stiffness = 0;  // over the normal one; 0: Mindlin's with youngs_modulus, else 2/7
};

/// How finely the field kernel sees bodies (docs/kernels.md: what finer costs and gives).
struct FieldAccuracy {
  double points = 14;  // surface points across the diameter of the sphere of equal volume
  double grid = 56;  // cells of a mesh's depth field across the same, or 1/7 as many across its thinnest wall
  double memory_MB = 256;  // largest depth field
};

enum class FeedKind { layers, pour, placed, lattice, scatter };

/// A pellet that the case puts where it wants it.
struct PlacedPellet {
  std::uint32_t kind = 0;  // index into Scene::pellets
  Pose pose;
  Vec3 velocity = Vec3::Zero();  // [m/s]
  Vec3 spin = Vec3::Zero();      // [rad/s]
  bool fixed = false;
  double scale = 1;  // of the shape [-]
};

struct Feed {
  FeedKind kind = FeedKind::layers;
  // the end of feeding: whichever of these is given and reached first
  std::optional<int> count;      // pellets
  std::optional<double> height;  // of the bed's surface [m]
  std::optional<double> mass;    // fed [kg]
  int per_layer = 49;            // pellets entering together (layers), or in one handful (pour)
  double interval = 0.04;        // between two layers or handfuls [s]
  double drop_height = 0;        // of the centres of the lowest pellets of a layer at entry [m]
  bool above_bed = false;        // drop_height counts from the bed's surface instead of the floor
  double radius =
      0;  // of the circle that centres enter in [m]; 0: as wide as the container lets every rotation fit
  double speed =
      0;  // of a uniformly random direction at entry [m/s]; lattice, scatter: largest of each component
  double spacing = 0;                // lattice: between neighbouring sites [m]; 0: across the largest pellet
  double cloud_density = 0.2;        // scatter: share of the cloud that bounding spheres fill
  std::vector<PlacedPellet> placed;  // FeedKind::placed only
};

/// How the mesh packer moves bodies.
struct Stepping {
  double step = 0;  // [s]; 0: contact time of the stiffest contact / steps_per_contact
  double steps_per_contact = 20;
  double skin = 0;    // of the neighbour list [m]; 0: found from the pellet size
  bool gear = false;  // spheres: Gear's predictor-corrector of sixth order instead of velocity Verlet
  bool sleep = true;  // let settled pellets stand still until something moves them
  double sleep_displacement =
      1e-3;                  // drift over the watch time below which a pellet may sleep, fraction of its size
  double rest_speed = 1e-3;  // mean kinetic speed under which a bed may be called at rest [m/s]
  double rest_force = 5e-2;  // largest mean unbalanced force, fraction of the weight
  double rest_drift = 4e-3;  // largest displacement over rest_window, fraction of the pellet size
  double rest_rollers =
      1e-3;  // share of the pellets that a bed at rest is not asked about: those that drift most
  double rest_window = 0.02;  // [s]
  double max_time = 60;       // simulated time after which the run gives up waiting for rest [s]
  double duration = 0;        // run exactly so long, whatever happens [s]; 0: until at rest
};

/// How the lattice packers move pellets (methods digipac, digicgp, digidem; docs/lattice_packers.md).
struct LatticeRules {
  double voxel = 0;                   // edge of a cell [m]; 0: AnalysisWish::voxel
  double rebound = 0.5;               // rebounding probability: 0 never up, 1 up as often as down
  double max_angle = 10 * kPi / 180;  // of one rotation [rad]
  double max_sweep = 3;               // digicgp: way of the farthest point in one rotation, at most [cells]
  double rotation_share = 0.15;       // digipac: of a pellet's steps in which it also tries to rotate
  bool turn_cells = false;    // rotations turn the cells themselves instead of the shape: pellets wear
  int interval = 0;           // steps that stand for Feed::interval; 0: what a pellet needs to fall clear
  int rest_window = 200;      // steps
  double rest_sinking = 0.5;  // mean sinking over rest_window under which a bed is at rest [cells]
  int max_steps = 200000;     // after which the run gives up waiting for rest
  bool thin = false;          // pellets thinner than two cells are packed all the same
  double memory_MB = 1024;    // largest lattice
};

enum class ShakingKind { none, taps, vibration };

/// What is done to a bed that has come to rest (packers/shaking.hpp).
struct Shaking {
  ShakingKind kind = ShakingKind::none;
  int taps = 10;
  double velocity = 0.3;    // upward, that each tap gives the bed [m/s]
  double amplitude = 5e-4;  // of a vertical vibration [m]
  double period = 0.03;     // [s]
  double duration = 1;      // [s]
};

struct AnalysisWish {
  double voxel = 1e-4;        // pitch of the grid [m]
  double from_diameters = 3;  // middle section for the bulk density: from this height ...
  double to_diameters = 17;   // ... to this height above the floor, in pellet diameters (see diameter)
  double diameter = 0;        // dp of all scaled axes [m]; 0: diameter of the sphere of equal volume
  double core_margin = 3;     // of the core from walls, floor and top, in diameters of the largest pellet
  double cell = 0;            // edge of the test cells that are shot at [m]; 0: none
  int shots = 10;             // points along each edge of a cell
  bool voxels = true, orientation = true, exact = true, overlap = true, core = true;
};

struct OutputWish {
  double trajectory_interval = 0;   // [s]; 0: none
  double checkpoint_interval = 30;  // wall-clock [s]; 0: none
  bool voxels = false;              // write voxels.h5
  bool vtk = true;                  // ParaView files beside
  bool report = true;
};

struct Scene {
  std::string name;
  std::string case_file;        // as given on the command line
  std::string case_text;        // TOML with all defaults filled in
  std::string method = "mesh";  // mesh | spheres | digipac | digicgp | digidem
  std::string kernel = "auto";  // auto | sphere | cylinder | field
  std::uint64_t seed = 1;
  std::vector<PelletKind> pellets;
  Container container;
  Vec3 gravity{0, 0, -9.80665};  // [m/s2]
  ContactLaw pellet_contact, wall_contact;
  FieldAccuracy field;
  Feed feed;
  Stepping stepping;
  LatticeRules lattice;
  Shaking shaking;
  AnalysisWish analysis;
  OutputWish output;
  // largest overlaps that the audit lets pass, at rest and during the run, fractions of the smallest
  // thickness
  double overlap_limit = 0.005, impact_limit = 0.1;
};

}  // namespace packbed
