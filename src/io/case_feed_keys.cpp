#include "io/case_feed_keys.hpp"

#include "io/case_ranges.hpp"

namespace packbed {
namespace {

using D = Dimension;

void placed_keys(Fields& f, PlacedRecord& r) {
  int kind = static_cast<int>(r.pellet.kind);
  f.whole({.name = "kind", .meaning = "which [[pellet]], from 0", .range = between(0, 1000)}, kind);
  r.pellet.kind = static_cast<std::uint32_t>(kind);
  f.vector({.name = "position",
            .meaning = "of the centre of mass",
            .dimension = D::length,
            .range = between(-100, 100),
            .required = true},
           r.pellet.pose.position);
  f.real({.name = "turn", .meaning = "angle about turn_about; instead of rotation", .dimension = D::angle},
         r.turn);
  f.when(!r.turn, "no turn", [&] {
    f.rotation({.name = "rotation", .meaning = "from the shape's frame, quaternion [w, x, y, z]"},
               r.pellet.pose.rotation);
  });
  f.when(r.turn.has_value(), "turn = ...", [&] {
    f.vector({.name = "turn_about", .meaning = "direction of the axis that turn counts about"}, r.turn_about);
  });
  f.vector({.name = "velocity",
            .meaning = "of the centre of mass",
            .dimension = D::speed,
            .range = between(-1e4, 1e4)},
           r.pellet.velocity);
  f.vector({.name = "spin",
            .meaning = "angular velocity, world axes",
            .dimension = D::angular_velocity,
            .range = between(-1e6, 1e6)},
           r.pellet.spin);
  f.flag({.name = "fixed", .meaning = "held where it is"}, r.pellet.fixed);
  f.real({.name = "scale", .meaning = "of the shape", .range = above_zero_to(1e6)}, r.pellet.scale);
}

/// What all feeds have but placed.
void fed_keys(Fields& f, Feed& r) {
  f.whole({.name = "count", .meaning = "stop feeding at so many pellets", .range = between(1, 1e7)}, r.count);
  f.real({.name = "mass",
          .meaning = "stop feeding at this mass",
          .dimension = D::mass,
          .range = above_zero_to(1e6)},
         r.mass);
  f.real({.name = "drop_height",
          .meaning = "of the centres of the lowest pellets of a layer at entry",
          .dimension = D::length,
          .range = kSize,
          .required = true},
         r.drop_height);
  f.real({.name = "speed",
          .meaning =
              "at entry, in a random direction; of a lattice or a cloud, each component is random up to it; "
              "0 = at rest",
          .dimension = D::speed,
          .range = between(0, 1e3)},
         r.speed);
}

void poured_keys(Fields& f, Feed& r) {
  f.real({.name = "height",
          .meaning = "stop feeding when the bed's surface is so high",
          .dimension = D::length,
          .range = kSize},
         r.height);
  f.whole({.name = "per_layer",
           .meaning = "pellets that enter together, in one layer or one handful",
           .range = between(1, 1e6, "something has to enter")},
          r.per_layer);
  f.real({.name = "interval",
          .meaning = "between two layers or handfuls",
          .dimension = D::time,
          .range = above_zero_to(3600, "two layers cannot enter at the same instant")},
         r.interval);
  f.flag({.name = "above_bed", .meaning = "drop_height counts from the bed's surface instead of the floor"},
         r.above_bed);
  f.real({.name = "radius",
          .meaning = "of the circle that centres enter in",
          .dimension = D::length,
          .range = kSize,
          .automatic = "as wide as the container lets every rotation fit"},
         r.radius);
}

}  // namespace

void feed_keys(Fields& f, CaseRecord& r) {
  f.choice(
      {.name = "kind",
       .meaning =
           "layers = flat layers over the whole section; pour = handfuls from random points in a circle; "
           "lattice = all at the start on a cubic lattice; scatter = all at the start at random places; "
           "placed = where the case or a CSV file says"},
      r.feed_kind, {"layers", "pour", "lattice", "scatter", "placed"});
  const bool placed = r.feed_kind == "placed", lattice = r.feed_kind == "lattice",
             scatter = r.feed_kind == "scatter";
  f.when(!placed, "kind not \"placed\"", [&] { fed_keys(f, r.feed); });
  f.when(!placed && !lattice && !scatter, "kind = \"layers\" or \"pour\"", [&] { poured_keys(f, r.feed); });
  f.when(scatter, "kind = \"scatter\"", [&] {
    f.real({.name = "cloud_density",
            .meaning = "share of the cloud that the pellets' bounding spheres fill",
            .range = above_zero_to(0.5, "in a denser one not every pellet finds a place")},
           r.feed.cloud_density);
  });
  f.when(lattice, "kind = \"lattice\"", [&] {
    f.real({.name = "spacing",
            .meaning = "of the lattice's sites",
            .dimension = D::length,
            .range = kSize,
            .automatic = "across the largest pellet"},
           r.feed.spacing);
  });
  f.when(placed, "kind = \"placed\"", [&] {
    f.path({.name = "csv", .meaning = "table of placed pellets, a line each; instead of [[feed.placed]]"},
           r.feed_csv);
    f.list("placed", "One pellet, put where it is wanted.", r.placed.size(), [&](std::size_t i) {
      if (i >= r.placed.size()) r.placed.resize(i + 1);
      placed_keys(f, r.placed[i]);
    });
  });
}

}  // namespace packbed
