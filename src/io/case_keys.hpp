#pragma once
// What a case file says, before any CAD file is opened: one record, and one list of all its keys.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bed/scene.hpp"
#include "io/case_fields.hpp"
#include "shape/library.hpp"

namespace packbed {

/// [pellet.sizes]
struct SizesRecord {
  std::string law = "one", by = "volume", csv;
  std::vector<double> diameters, fractions, amounts;  // table: [m], [-], [-]
  double modulus = 0, exponent = 0, deviation = 0;    // [m], [-], [-]
  std::optional<double> smallest, largest;            // [m]
};

struct PelletRecord {
  std::string name, file, unit, shape;
  bool recognise = true;
  LibrarySizes sizes;
  double density = 0;  // [kg/m3]
  double share = 1;
  SizesRecord sizes_of_pellets;
};

struct ContainerRecord {
  std::string name, file, unit, shape;
  bool recognise = true;
  double inner_diameter = 0, width = 0, depth = 0, height = 0;  // [m]
};

struct ContactRecord {
  double friction = 0.6;
  std::optional<double> damping = 0.4, restitution = {};          // one of them
  std::optional<double> stiffness = {}, allowed_overlap = 0.045;  // one of them
  bool torsion = true;
  double rolling_friction = 0.01;
  std::string law = "hooke";  // this and what follows: of spheres
  std::optional<double> youngs_modulus = {}, shear_modulus = {}, dissipation = {},
                        tangential_dissipation = {}, tangential_stiffness = {};
  double poisson_ratio = 0.3;
};

struct PlacedRecord {
  PlacedPellet pellet;
  std::optional<double> turn;  // instead of a quaternion: about turn_about [rad]
  Vec3 turn_about = Vec3::UnitZ();
};

struct CaseRecord {
  std::string extends;  // always empty: what it named has been read
  std::string folder, name, method = "mesh", kernel = "auto";
  std::uint64_t seed = 1;
  Vec3 gravity{0, 0, -9.80665};  // [m/s2]
  double overlap_limit = 0.005, impact_limit = 0.1;
  std::vector<PelletRecord> pellets = std::vector<PelletRecord>(1);
  ContainerRecord container;
  ContactRecord pellet_contact, wall_contact;
  FieldAccuracy field;
  Feed feed;
  std::string feed_kind = "layers", feed_csv;
  std::vector<PlacedRecord> placed;
  Stepping stepping;
  std::string integrator = "verlet";
  LatticeRules lattice;
  std::string lattice_rotation = "shape";
  Shaking shaking;
  std::string shaking_kind = "none";
  AnalysisWish analysis;
  OutputWish output;
};

/// Every key of a case, in the order in which a case is written.
void visit_case(Fields& fields, CaseRecord& record);

}  // namespace packbed
