#pragma once
// What every packer gives: pellets at their final poses in a container, and where they came from.
#include <cstdint>
#include <string>
#include <vector>

#include "shape/container.hpp"
#include "shape/shape.hpp"

namespace packbed {

struct Pellet {
  std::uint32_t id = 0;     // in the order of feeding
  std::uint32_t shape = 0;  // index into PackedBed::shapes
  Pose pose;
  double scale = 1;              // of the shape [-]
  Vec3 velocity = Vec3::Zero();  // [m/s]
  Vec3 spin = Vec3::Zero();      // angular velocity, world axes [rad/s]
  bool fixed = false;
};

inline constexpr std::uint32_t kContainer =
    0xffffffff;  // stands for the container where a pellet id is expected

struct Contact {
  std::uint32_t a = 0, b = 0;  // pellet ids, a < b; b may be kContainer
  Vec3 point = Vec3::Zero();   // centre of pressure [m]
  Vec3 force = Vec3::Zero();   // on a [N]
  double overlap = 0;          // the solver's own measure [m]
};

struct Provenance {
  std::string case_text;  // the case as run, defaults filled in (TOML)
  std::string case_file;
  std::string version, method, kernel;
  std::uint64_t seed = 0;
};

struct PackedBed {
  std::vector<ShapePtr> shapes;
  std::vector<double> densities;  // one a shape [kg/m3]
  Container container;
  std::vector<Pellet> pellets;
  std::vector<Contact> contacts;  // at the end of the run; empty when the packer has none
  Provenance provenance;
};

/// Over ids, shapes and poses, bit for bit: sixteen hexadecimal digits.
std::string bed_hash(const PackedBed& bed);
/// Height of the highest point of any pellet above z = 0 [m]; 0 for an empty bed.
double bed_top(const PackedBed& bed);
/// The same of the pellets that touch something, where contacts are known: what still flies does not count.
double settled_top(const PackedBed& bed);

}  // namespace packbed
