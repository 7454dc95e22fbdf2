#include "io/case_keys.hpp"

#include <array>

#include "io/case_feed_keys.hpp"
#include "io/case_ranges.hpp"
#include "io/case_shape_keys.hpp"
#include "io/case_size_keys.hpp"

namespace packbed {
namespace {

using D = Dimension;

/// exp(-2): see restitution_from_damping
constexpr double kRestitutionAtCritical = 0.1353352832366127;

void general_keys(Fields& f, CaseRecord& r) {
  f.text({.name = "extends", .meaning = "another case file that this one changes, key by key"}, r.extends);
  f.text({.name = "folder",
          .meaning = "folder that relative file names count from; default: the one of the case file"},
         r.folder);
  f.text({.name = "name", .meaning = "of the case; default: the file's name"}, r.name);
  f.choice({.name = "method",
            .meaning = "how to pack: mesh = rigid bodies with penalty contact; spheres = the same for "
                       "spheres only, faster; on a lattice of voxels, digipac = at "
                       "random, digicgp = guided by collisions, "
                       "digidem = by forces between voxels"},
           r.method, {"mesh", "spheres", "digipac", "digicgp", "digidem"});
  f.choice(
      {.name = "kernel", .meaning = "contact kernel; auto = the fastest exact one that the shapes allow"},
      r.kernel, {"auto", "sphere", "cylinder", "field"});
  f.seed({.name = "seed", .meaning = "of all random numbers; --seed overrules it"}, r.seed);
  f.vector({.name = "gravity",
            .meaning = "down (one quantity) or any way (three)",
            .dimension = D::acceleration,
            .range = between(-1e4, 1e4),
            .downwards = true},
           r.gravity);
  f.real({.name = "overlap_limit",
          .meaning = "largest overlap at rest that the audit lets pass, fraction of the smallest thickness",
          .range = above_zero_to(1)},
         r.overlap_limit);
  f.real({.name = "impact_limit",
          .meaning =
              "largest overlap during the run that the audit lets pass, fraction of the smallest thickness",
          .range = above_zero_to(1)},
         r.impact_limit);
}

void pellet_keys(Fields& f, PelletRecord& r) {
  f.text({.name = "name", .meaning = "of the kind of pellet; default: file or shape"}, r.name);
  f.path({.name = "file", .meaning = "CAD file: STEP, MSH, STL, OBJ or PLY"}, r.file);
  f.when(!r.file.empty(), "file = ...", [&] {
    f.choice({.name = "unit", .meaning = "of the lengths in an STL, OBJ, PLY or MSH file (STEP has its own)"},
             r.unit, {"m", "cm", "mm", "um", "in"});
    f.flag({.name = "recognise",
            .meaning = "take a mesh that is a sphere, a cylinder, a tube or a convex polyhedron for that"},
           r.recognise);
  });
  f.when(r.file.empty(), "no file", [&] { shape_keys(f, r); });
  chord_error_key(f, r);
  f.real({.name = "density",
          .meaning = "of the pellet's material, its volume times this is its mass",
          .dimension = D::density,
          .range = above_zero_to(1e6, "a pellet without mass cannot be moved by forces"),
          .required = true},
         r.density);
  f.real({.name = "share",
          .meaning = "of the pellets fed, by number, relative to the other kinds",
          .range = above_zero_to(1e9, "leave out a kind that is not fed")},
         r.share);
  f.section("sizes", "How the sizes of this kind are spread; docs/spheres.md.",
            [&] { size_keys(f, r.sizes_of_pellets); });
}

void container_keys(Fields& f, ContainerRecord& r) {
  f.text({.name = "name", .meaning = "of the container; default: file or shape"}, r.name);
  f.path({.name = "file", .meaning = "CAD file of the wall's material: STEP, MSH, STL, OBJ or PLY"}, r.file);
  f.when(!r.file.empty(), "file = ...", [&] {
    f.choice({.name = "unit", .meaning = "of the lengths in an STL, OBJ, PLY or MSH file (STEP has its own)"},
             r.unit, {"m", "cm", "mm", "um", "in"});
    f.flag(
        {.name = "recognise",
         .meaning = "take a mesh that is a round tube or an upright box on a flat floor for the exact one"},
        r.recognise);
  });
  f.when(r.file.empty(), "no file", [&] {
    f.choice({.name = "shape",
              .meaning = "instead of a file: tube = round, upright, on a flat floor, open above; box = the "
                         "same with four "
                         "flat sides; plane = a floor without "
                         "end; none = free space",
              .required = true},
             r.shape, {"tube", "box", "plane", "none"});
    f.when(r.shape == "tube", "shape = \"tube\"", [&] {
      f.real({.name = "inner_diameter",
              .meaning = "of the tube",
              .dimension = D::length,
              .range = kSize,
              .required = true},
             r.inner_diameter);
    });
    f.when(r.shape == "box", "shape = \"box\"", [&] {
      f.real({.name = "width",
              .meaning = "of the box inside, along x",
              .dimension = D::length,
              .range = kSize,
              .required = true},
             r.width);
      f.real({.name = "depth",
              .meaning = "of the box inside, along y",
              .dimension = D::length,
              .range = kSize,
              .required = true},
             r.depth);
    });
    f.when(r.shape == "tube" || r.shape == "box", "shape = \"tube\" or \"box\"", [&] {
      f.real({.name = "height",
              .meaning = "of the tube or box, floor to rim",
              .dimension = D::length,
              .range = kSize,
              .required = true},
             r.height);
    });
  });
}

void sphere_contact_keys(Fields& f, ContactRecord& r) {
  f.choice(
      {.name = "law",
       .meaning = "normal force between spheres: hooke = k delta; hertz = (4/3) E* sqrt(R* delta) delta"},
      r.law, {"hooke", "hertz"});
  f.real({.name = "youngs_modulus",
          .meaning = "of both bodies; instead of stiffness and allowed_overlap. hooke: k = (4/3) E* R*",
          .dimension = D::pressure,
          .range = above_zero_to(1e13)},
         r.youngs_modulus);
  f.when(r.youngs_modulus.has_value(), "youngs_modulus = ...", [&] {
    f.real({.name = "poisson_ratio", .meaning = "of both bodies", .range = between(0, 0.5)}, r.poisson_ratio);
    f.real({.name = "shear_modulus",
            .meaning = "of both bodies; default: E / 2(1 + nu)",
            .dimension = D::pressure,
            .range = above_zero_to(1e13)},
           r.shear_modulus);
  });
  f.real({.name = "dissipation",
          .meaning = "coefficient of the normal dashpot over the effective mass; instead of damping",
          .dimension = D::rate,
          .range = between(0, 1e9)},
         r.dissipation);
  f.when(r.dissipation.has_value(), "dissipation = ...", [&] {
    f.real({.name = "tangential_dissipation",
            .meaning = "of the tangential dashpot; default: as dissipation",
            .dimension = D::rate,
            .range = between(0, 1e9)},
           r.tangential_dissipation);
  });
  f.real({.name = "tangential_stiffness",
          .meaning = "over the normal one; default: Mindlin's with youngs_modulus, else 2/7",
          .range = above_zero_to(10)},
         r.tangential_stiffness);
}

void contact_keys(Fields& f, ContactRecord& r, bool spheres) {
  f.real({.name = "friction",
          .meaning = "Coulomb coefficient",
          .range = between(0, 10, "friction never pulls; 0 is frictionless")},
         r.friction);
  if (const auto given = f.one_of({"damping", "restitution", "dissipation"})) {
    const std::array<std::optional<double>*, 3> ways{&r.damping, &r.restitution, &r.dissipation};
    for (std::size_t k = 0; k < ways.size(); ++k)
      if (k != *given) ways[k]->reset();
  }
  f.real({.name = "damping",
          .meaning = "fraction of critical damping of an impact; instead of restitution",
          .range = between(0, 1, "more than critical damping makes an impact a creep")},
         r.damping);
  f.real({.name = "restitution",
          .meaning = "speed after over speed before a head-on impact; instead of damping",
          .range =
              between(kRestitutionAtCritical, 1, "exp(-2) = 0.1353 is the restitution of critical damping")},
         r.restitution);
  if (const auto given = f.one_of({"stiffness", "allowed_overlap", "youngs_modulus"})) {
    const std::array<std::optional<double>*, 3> ways{&r.stiffness, &r.allowed_overlap, &r.youngs_modulus};
    for (std::size_t k = 0; k < ways.size(); ++k)
      if (k != *given) ways[k]->reset();
  }
  f.real({.name = "stiffness",
          .meaning = "k of the contact energy k delta^2 / 2; instead of allowed_overlap",
          .dimension = D::stiffness,
          .range = above_zero_to(1e12)},
         r.stiffness);
  f.real(
      {.name = "allowed_overlap",
       .meaning = "at the hardest impact, fraction of the smallest thickness: the stiffness follows from it",
       .range = {.low = 1e-6, .high = 0.2, .why = "more would let pellets pass through each other"}},
      r.allowed_overlap);
  f.flag({.name = "torsion", .meaning = "a spring against spinning on a flat touch"}, r.torsion);
  f.real({.name = "rolling_friction",
          .meaning = "moment against rolling, over the normal force times the reduced radius",
          .range = between(0, 1)},
         r.rolling_friction);
  f.when(spheres, "method = \"spheres\"", [&] { sphere_contact_keys(f, r); });
}

void field_keys(Fields& f, FieldAccuracy& r) {
  f.real(
      {.name = "points",
       .meaning = "surface points across the diameter of the sphere of equal volume",
       .range = between(4, 60, "fewer leave gaps that edges fall into; more cost time and see nothing new")},
      r.points);
  f.real(
      {.name = "grid",
       .meaning = "cells of a mesh's depth field across the same diameter; at least 1/7 as many across its "
                  "thinnest wall",
       .range = between(16, 400, "fewer round the edges away; more are slow to make")},
      r.grid);
  f.real({.name = "memory_MB",
          .meaning = "largest depth field; a shape that needs more is refused",
          .range = between(1, 1e5)},
         r.memory_MB);
}

void stepping_keys(Fields& f, CaseRecord& record) {
  Stepping& r = record.stepping;
  f.when(record.method == "spheres", "method = \"spheres\"", [&] {
    f.choice({.name = "integrator",
              .meaning = "verlet = velocity Verlet; gear = Gear's predictor-corrector of sixth order"},
             record.integrator, {"verlet", "gear"});
  });
  f.real({.name = "step",
          .meaning = "of time",
          .dimension = D::time,
          .range = above_zero_to(1, "time has to go on"),
          .automatic = "contact time of the stiffest contact / steps_per_contact"},
         r.step);
  f.real({.name = "steps_per_contact",
          .meaning = "when step is auto",
          .range = between(5, 1e4, "fewer cannot follow an impact")},
         r.steps_per_contact);
  f.real({.name = "skin",
          .meaning = "of the neighbour list",
          .dimension = D::length,
          .range = kSize,
          .automatic = "from the pellet's size"},
         r.skin);
  f.flag({.name = "sleep", .meaning = "let settled pellets stand still until something moves them"}, r.sleep);
  f.real({.name = "sleep_displacement",
          .meaning = "drift below which a pellet may sleep, fraction of its size",
          .range = above_zero_to(0.1)},
         r.sleep_displacement);
  f.real({.name = "rest_speed",
          .meaning = "mean kinetic speed under which a bed may be at rest",
          .dimension = D::speed,
          .range = above_zero_to(10)},
         r.rest_speed);
  f.real({.name = "rest_force",
          .meaning = "mean unbalanced force under which a bed may be at rest, fraction of the weight",
          .range = above_zero_to(10)},
         r.rest_force);
  f.real({.name = "rest_drift",
          .meaning = "largest displacement over rest_window of a bed at rest, fraction of the pellet's size",
          .range = above_zero_to(1)},
         r.rest_drift);
  f.real({.name = "rest_rollers",
          .meaning = "share of the pellets that may roll on in a bed at rest",
          .range = between(0, 0.1)},
         r.rest_rollers);
  f.real({.name = "rest_window",
          .meaning = "time that rest_drift is watched over",
          .dimension = D::time,
          .range = above_zero_to(60)},
         r.rest_window);
  f.real({.name = "max_time",
          .meaning = "simulated time after which the run gives up waiting for rest",
          .dimension = D::time,
          .range = above_zero_to(1e6)},
         r.max_time);
  f.real({.name = "duration",
          .meaning = "run exactly so long, whatever happens",
          .dimension = D::time,
          .range = above_zero_to(1e6),
          .automatic = "until the bed is at rest"},
         r.duration);
}

void lattice_keys(Fields& f, CaseRecord& record) {
  LatticeRules& r = record.lattice;
  f.real({.name = "voxel",
          .meaning = "edge of a cell of the lattice",
          .dimension = D::length,
          .range = above_zero_to(1),
          .automatic = "analysis.voxel"},
         r.voxel);
  f.real({.name = "rebound",
          .meaning = "rebounding probability: 0 = never up, 1 = up as often as down",
          .range = between(0, 1, "it is a probability")},
         r.rebound);
  f.real({.name = "max_angle",
          .meaning = "largest angle of one rotation",
          .dimension = D::angle,
          .range = between(0, kPi, "half a turn is the most")},
         r.max_angle);
  f.real({.name = "max_sweep",
          .meaning = "digicgp: way of a pellet's farthest point in one rotation, at most, in voxels",
          .range = above_zero_to(1e3)},
         r.max_sweep);
  f.real({.name = "rotation_share",
          .meaning = "digipac: of a pellet's steps in which it tries to rotate",
          .range = between(0, 1, "it is a probability")},
         r.rotation_share);
  f.choice(
      {.name = "rotation",
       .meaning = "shape = cells are drawn anew from the shape; cells = the CT paper's own: the cells are "
                  "turned and their number is kept, so that pellets wear (digipac, digicgp)"},
      record.lattice_rotation, {"shape", "cells"});
  f.whole({.name = "interval",
           .meaning = "steps that stand for feed.interval; 0 = what a pellet needs to fall clear",
           .range = between(0, 1e6)},
          r.interval);
  f.whole(
      {.name = "rest_window", .meaning = "steps that rest_sinking is watched over", .range = between(1, 1e6)},
      r.rest_window);
  f.real({.name = "rest_sinking",
          .meaning = "mean sinking over rest_window under which a bed is at rest, in voxels",
          .range = above_zero_to(1e3)},
         r.rest_sinking);
  f.whole({.name = "max_steps",
           .meaning = "after which the run gives up waiting for rest",
           .range = between(1, 2e9)},
          r.max_steps);
  f.flag({.name = "thin", .meaning = "pack pellets whose walls are thinner than two voxels all the same"},
         r.thin);
  f.real(
      {.name = "memory_MB", .meaning = "largest lattice; a larger one is refused", .range = between(1, 1e6)},
      r.memory_MB);
}

void shaking_keys(Fields& f, CaseRecord& r) {
  f.choice({.name = "kind",
            .meaning = "taps = the bed gets an upward velocity and settles, again and again; vibration = the "
                       "container moves up and down as a sine; none"},
           r.shaking_kind, {"none", "taps", "vibration"});
  f.when(r.shaking_kind == "taps", "kind = \"taps\"", [&] {
    f.whole({.name = "taps", .meaning = "how many", .range = between(1, 1e5)}, r.shaking.taps);
    f.real({.name = "velocity",
            .meaning = "upward, that a tap adds to every pellet's",
            .dimension = D::speed,
            .range = above_zero_to(100)},
           r.shaking.velocity);
  });
  f.when(r.shaking_kind == "vibration", "kind = \"vibration\"", [&] {
    f.real({.name = "amplitude",
            .meaning = "of the container's way from its middle",
            .dimension = D::length,
            .range = above_zero_to(1)},
           r.shaking.amplitude);
    f.real(
        {.name = "period", .meaning = "of the vibration", .dimension = D::time, .range = above_zero_to(10)},
        r.shaking.period);
    f.real({.name = "duration",
            .meaning = "of the vibration; the bed settles after it",
            .dimension = D::time,
            .range = above_zero_to(3600)},
           r.shaking.duration);
  });
}

void analysis_keys(Fields& f, AnalysisWish& r) {
  f.real({.name = "voxel", .meaning = "pitch of the grid", .dimension = D::length, .range = above_zero_to(1)},
         r.voxel);
  f.real({.name = "diameter",
          .meaning = "dp of all scaled axes",
          .dimension = D::length,
          .range = kSize,
          .automatic = "diameter of the sphere of the pellet's volume"},
         r.diameter);
  f.real({.name = "from_diameters",
          .meaning = "lower end of the middle section, in dp above the floor",
          .range = between(0, 1e6)},
         r.from_diameters);
  f.real({.name = "to_diameters",
          .meaning = "upper end of the middle section, in dp above the floor",
          .range = above_zero_to(1e6)},
         r.to_diameters);
  f.flag({.name = "voxels", .meaning = "profiles from a voxel grid"}, r.voxels);
  f.flag({.name = "orientation", .meaning = "orientation of the pellets' axes"}, r.orientation);
  f.flag({.name = "exact", .meaning = "voxel-free profiles beside"}, r.exact);
  f.flag({.name = "core", .meaning = "porosity of the core"}, r.core);
  f.real({.name = "core_margin",
          .meaning = "of the core from walls, floor and top, in diameters of the largest pellet",
          .range = between(0, 1e3)},
         r.core_margin);
  f.real({.name = "cell",
          .meaning = "edge of the test cells of the core that points are shot at",
          .dimension = D::length,
          .range = above_zero_to(1),
          .automatic = "no cells"},
         r.cell);
  f.whole({.name = "shots",
           .meaning = "points along each edge of a test cell: 10 = 1000 in each",
           .range = between(1, 32)},
          r.shots);
}

void output_keys(Fields& f, OutputWish& r) {
  f.real({.name = "trajectory_interval",
          .meaning = "simulated time between two frames of the trajectory",
          .dimension = D::time,
          .range = above_zero_to(1e6),
          .automatic = "no trajectory"},
         r.trajectory_interval);
  f.real({.name = "checkpoint_interval",
          .meaning = "wall-clock time between two checkpoints; 0 = none",
          .dimension = D::time,
          .range = between(0, 1e6)},
         r.checkpoint_interval);
  f.flag({.name = "voxels", .meaning = "write the grid, voxels.h5"}, r.voxels);
  f.flag({.name = "vtk", .meaning = "write files for ParaView"}, r.vtk);
  f.flag({.name = "report", .meaning = "write report.html"}, r.report);
}

/// The law of the wall starts from the one of the pellets.
void both_contacts(Fields& f, CaseRecord& r) {
  f.section("contact", "Between two pellets, and with the container unless [contact.wall] says otherwise.",
            [&] {
              const bool spheres = r.method == "spheres";
              contact_keys(f, r.pellet_contact, spheres);
              if (f.reading()) r.wall_contact = r.pellet_contact;
              f.section("wall", "Between a pellet and the container. Default: as [contact].",
                        [&] { contact_keys(f, r.wall_contact, spheres); });
            });
}

}  // namespace

void visit_case(Fields& f, CaseRecord& r) {
  general_keys(f, r);
  f.list("pellet", "One kind of pellet, or several as [[pellet]].", r.pellets.size(), [&](std::size_t i) {
    if (i >= r.pellets.size()) r.pellets.resize(i + 1);
    pellet_keys(f, r.pellets[i]);
  });
  f.section("container", "What holds the bed: z up, floor at z = 0, axis through the origin.",
            [&] { container_keys(f, r.container); });
  both_contacts(f, r);
  f.section("field", "How finely the field kernel sees bodies; the other kernels are exact.",
            [&] { field_keys(f, r.field); });
  f.section("feed", "How pellets enter.", [&] { feed_keys(f, r); });
  f.section("stepping", "How the packer moves bodies, and when it calls the bed at rest.",
            [&] { stepping_keys(f, r); });
  f.section("lattice", "How the lattice packers move pellets; the mesh packer does without.",
            [&] { lattice_keys(f, r); });
  f.section("shaking", "What is done to the bed when it has come to rest (methods mesh and digidem).",
            [&] { shaking_keys(f, r); });
  f.section("analysis", "What is measured of the bed.", [&] { analysis_keys(f, r.analysis); });
  f.section("output", "What is written.", [&] { output_keys(f, r.output); });
}

}  // namespace packbed
