#include "io/case_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "contact/damping.hpp"
#include "io/cad.hpp"
#include "io/case_sizes.hpp"
#include "io/placed_csv.hpp"
#include "math/error.hpp"
#include "packers/packer.hpp"

namespace packbed {
namespace {

namespace fs = std::filesystem;

std::string length_text(double metres) {
  return format_quantity(metres, Dimension::length);
}

/// Gathers refusals of one case.
class Problems {
 public:
  Problems(const std::string& case_file, std::vector<std::string>& list)
      : case_file_(case_file), list_(list) {}
  void add(const std::string& key, const std::string& found, const std::string& allowed,
           const std::string& fix = "") {
    list_.push_back(InputError(case_file_ + ": " + key, found, allowed, fix).what());
  }
  /// Runs what may throw; the message gets the key in front.
  template <class Run>
  void guard(const std::string& key, const Run& run) {
    try {
      run();
    } catch (const InputError& e) {
      list_.push_back(fmt::format("{}: {}: {}", case_file_, key, e.what()));
    }
  }

 private:
  const std::string& case_file_;
  std::vector<std::string>& list_;
};

std::string pellet_key(const CaseRecord& record, std::size_t i) {
  return record.pellets.size() == 1 ? "pellet" : fmt::format("pellet[{}]", i);
}

void check_unit(Problems& problems, const std::string& key, const std::string& file,
                const std::string& unit) {
  problems.guard(key + ".file", [&] {
    const bool own = cad_format(file) == CadFormat::step;
    if (own && !unit.empty())
      problems.add(key + ".unit", fmt::format("\"{}\" for {}", unit, file),
                   "nothing: STEP files carry their own unit", "remove unit");
    if (!own && unit.empty())
      problems.add(key + ".unit", fmt::format("nothing, and {} carries no unit", file), "m, cm, mm, um, in",
                   "say in which unit the file was written, for example unit = \"mm\"");
  });
}

ContactLaw contact_law(const ContactRecord& r) {
  ContactLaw law;
  law.friction = r.friction;
  law.damping_ratio = r.restitution ? damping_from_restitution(*r.restitution) : r.damping.value_or(0);
  law.stiffness = r.stiffness.value_or(0);
  law.allowed_overlap = r.allowed_overlap.value_or(0);
  law.torsion = r.torsion;
  law.rolling_friction = r.rolling_friction;
  law.hertz = r.law == "hertz";
  law.youngs_modulus = r.youngs_modulus.value_or(0);
  law.poisson_ratio = r.poisson_ratio;
  law.shear_modulus = r.shear_modulus.value_or(0);
  law.dissipation = r.dissipation.value_or(0);
  law.tangential_dissipation = r.tangential_dissipation.value_or(law.dissipation);
  law.tangential_stiffness = r.tangential_stiffness.value_or(0);
  return law;
}

std::string name_of(const std::string& name, const std::string& file, const std::string& shape) {
  if (!name.empty()) return name;
  return file.empty() ? shape : fs::path(file).stem().string();
}

CadOptions cad_options(const std::string& unit, bool recognise) {
  CadOptions options;
  options.unit = unit;
  options.recognise = recognise;
  return options;
}

ShapePtr make_pellet(const CaseRecord& record, const PelletRecord& r) {
  const std::string name = name_of(r.name, r.file, r.shape);
  if (r.file.empty()) return make_library_shape(name, r.shape, r.sizes);
  CadOptions options = cad_options(r.unit, r.recognise);
  options.chord_error = r.sizes.chord_error;
  return load_shape(name, (fs::path(record.folder) / r.file).string(), options);
}

Container make_container_of(const CaseRecord& record) {
  const ContainerRecord& r = record.container;
  const std::string name = name_of(r.name, r.file, r.shape);
  if (!r.file.empty())
    return load_container(name, (fs::path(record.folder) / r.file).string(),
                          cad_options(r.unit, r.recognise));
  if (r.shape == "tube") return make_tube(name, r.inner_diameter, r.height);
  if (r.shape == "box") return make_box(name, r.width, r.depth, r.height);
  Container container;
  container.kind = r.shape == "plane" ? ContainerKind::plane : ContainerKind::none;
  container.name = name;
  return container;
}

Feed make_feed(const CaseRecord& record, Problems& problems) {
  Feed feed = record.feed;
  feed.kind = record.feed_kind == "pour"      ? FeedKind::pour
              : record.feed_kind == "placed"  ? FeedKind::placed
              : record.feed_kind == "lattice" ? FeedKind::lattice
              : record.feed_kind == "scatter" ? FeedKind::scatter
                                              : FeedKind::layers;
  if (feed.kind != FeedKind::placed) return feed;
  for (const PlacedRecord& r : record.placed) {
    feed.placed.push_back(r.pellet);
    if (r.turn)
      feed.placed.back().pose.rotation = Quat(Eigen::AngleAxisd(*r.turn, r.turn_about.normalized()));
  }
  if (!record.feed_csv.empty())
    problems.guard("feed.csv", [&] {
      feed.placed = read_placed_csv((fs::path(record.folder) / record.feed_csv).string());
    });
  for (std::size_t i = 0; i < feed.placed.size(); ++i)
    if (feed.placed[i].kind >= record.pellets.size())
      problems.add(
          fmt::format("feed.placed[{}].kind", i), fmt::format("{}", feed.placed[i].kind),
          fmt::format("0 to {}: there {} [[pellet]]", record.pellets.size() - 1,
                      record.pellets.size() == 1 ? "is one" : fmt::format("are {}", record.pellets.size())));
  return feed;
}

void check_fit(Problems& problems, const Scene& scene, const PelletKind& kind, const std::string& key) {
  const Shape& shape = *kind.shape;
  const double smallest = smallest_scale(kind.sizes),
               bounding = largest_scale(kind.sizes) * shape.bounding_radius;
  const double thickness = smallest * shape.smallest_thickness;
  const Container& c = scene.container;
  const bool has_wall = c.radius > 0 && has_sides(c.kind);
  const double across = 2 * bounding, inner = 2 * c.radius;
  if (has_wall && largest_scale(kind.sizes) * shape.smallest_thickness > inner)
    problems.add(
        key,
        fmt::format("a pellet at least {} thick",
                    length_text(largest_scale(kind.sizes) * shape.smallest_thickness)),
        fmt::format("less than the container's inner diameter, {}", length_text(inner)),
        "the pellet is larger than the container: check the unit of the pellet and of the container");
  else if (has_wall && across >= inner && scene.feed.kind != FeedKind::placed)
    problems.add(
        key, fmt::format("a pellet of {} across", length_text(across)),
        fmt::format("less than the container's inner diameter, {}, so that it enters in every rotation",
                    length_text(inner)),
        "take a wider container, or feed.kind = \"placed\"");
  if (scene.feed.kind != FeedKind::placed && !scene.feed.above_bed && scene.feed.drop_height < bounding &&
      c.kind != ContainerKind::none)
    problems.add("feed.drop_height", length_text(scene.feed.drop_height),
                 fmt::format("at least {}, the pellet's bounding radius", length_text(bounding)),
                 "pellets would enter inside the floor");
  if (scene.analysis.voxels && scene.analysis.voxel > thickness)
    problems.add("analysis.voxel", length_text(scene.analysis.voxel),
                 fmt::format("at most the pellet's thinnest part, {}", length_text(thickness)),
                 "a coarser grid misses the pellet; a tenth of that or less is usual");
}

void check_kernel(Problems& problems, const Scene& scene, const Shape& shape, const std::string& key) {
  const bool good =
      scene.kernel == "auto" || scene.kernel == "field" || scene.kernel == to_string(shape.kind);
  if (!good)
    problems.add("kernel", fmt::format("\"{}\"", scene.kernel),
                 fmt::format("\"auto\" or \"field\": {} is a {}", key, to_string(shape.kind)));
}

void check_container(Problems& problems, const Scene& scene) {
  const Container& c = scene.container;
  const Feed& feed = scene.feed;
  const bool has_wall = has_sides(c.kind);
  if (feed.kind == FeedKind::placed) return;
  if (c.kind == ContainerKind::none)
    problems.add("container.shape", "\"none\" with a poured bed", "a container with a floor",
                 "free space is for feed.kind = \"placed\"");
  if (c.kind == ContainerKind::plane && feed.radius == 0)
    problems.add("feed.radius", "\"auto\" on a plane", "a length",
                 "a plane has no wall that could tell how wide to pour");
  if (c.core_radius > 0 && feed.kind == FeedKind::layers)
    problems.add("feed.kind", "\"layers\" round a core", "\"pour\" or \"placed\"",
                 "a layer fills the whole circle and finds no room: feed.kind = \"pour\"");
  double turning = 0;  // radius that a pellet needs to enter in any rotation
  for (const PelletKind& kind : scene.pellets)
    turning = std::max(turning, kind.shape->bounding_radius * largest_scale(kind.sizes));
  if (has_wall && c.radius > turning && feed.radius > (c.radius - turning) * (1 + 1e-9))
    problems.add("feed.radius", length_text(feed.radius),
                 fmt::format("at most {}, so that every rotation of a pellet stays clear of the wall",
                             length_text(c.radius - turning)),
                 "pellets would enter inside the wall: leave it out for the widest circle");
  if (has_wall && feed.height && *feed.height > c.height)
    problems.add("feed.height", length_text(*feed.height),
                 fmt::format("at most the container's, {}", length_text(c.height)),
                 "the bed would run over the rim");
}

}  // namespace

std::vector<std::string> contradictions(const CaseRecord& r, const std::string& case_file) {
  std::vector<std::string> list;
  Problems problems(case_file, list);
  for (std::size_t i = 0; i < r.pellets.size(); ++i)
    if (!r.pellets[i].file.empty())
      check_unit(problems, pellet_key(r, i), r.pellets[i].file, r.pellets[i].unit);
  if (!r.container.file.empty()) check_unit(problems, "container", r.container.file, r.container.unit);
  const bool sized = std::any_of(r.pellets.begin(), r.pellets.end(),
                                 [](const PelletRecord& p) { return p.sizes_of_pellets.law != "one"; });
  if (sized && r.feed_kind == "placed")
    problems.add("pellet.sizes", "sizes of placed pellets", "nothing: each placed pellet has its own scale",
                 "remove [pellet.sizes], or feed the pellets");
  if ((r.feed_kind == "lattice" || r.feed_kind == "scatter") && packs_on_lattice(r.method))
    problems.add("feed.kind", fmt::format("\"{}\" with method \"{}\"", r.feed_kind, r.method),
                 "\"layers\", \"pour\" or \"placed\"",
                 "pellets that start far above the container have no cells there");
  if (r.feed_kind != "placed") {
    const bool counted = r.pellets.size() == 1 && counts_itself(r.pellets[0].sizes_of_pellets);
    if (!r.feed.count && !r.feed.height && !r.feed.mass && !counted)
      problems.add("feed", "no end of feeding", "count, height or mass (the one reached first ends it)",
                   "for example count = 300");
    if (!(r.gravity.norm() > 0))
      problems.add("gravity", "0 with a poured bed", "a gravity that pulls pellets down",
                   "without gravity nothing falls: use feed.kind = \"placed\"");
  } else if (r.placed.empty() == r.feed_csv.empty()) {
    problems.add("feed", r.placed.empty() ? "no placed pellets" : "both csv and [[feed.placed]]",
                 "either csv = \"file\" or [[feed.placed]] tables");
  }
  for (const auto& [contact, key] :
       {std::pair{&r.pellet_contact, "contact"}, {&r.wall_contact, "contact.wall"}})
    if (contact->law == "hertz" && contact->stiffness)
      problems.add(fmt::format("{}.stiffness", key), "a stiffness with law = \"hertz\"",
                   "youngs_modulus or allowed_overlap", "Hertz's stiffness grows with the overlap");
  if (r.lattice_rotation == "cells" && r.method == "digidem")
    problems.add("lattice.rotation", "\"cells\" with method = \"digidem\"", "\"shape\"",
                 "digidem follows its pellets' own rotation: take digipac or digicgp");
  if (r.shaking_kind != "none" && r.method != "mesh" && r.method != "digidem")
    problems.add(
        "shaking.kind", fmt::format("\"{}\" with method = \"{}\"", r.shaking_kind, r.method),
        "method = \"mesh\" or \"digidem\"",
        "pellets of the other methods have no velocity that a tap could change, or are not shaken yet");
  if (r.analysis.to_diameters <= r.analysis.from_diameters)
    problems.add("analysis.to_diameters", fmt::format("{}", r.analysis.to_diameters),
                 fmt::format("more than from_diameters, {}", r.analysis.from_diameters));
  return list;
}

Scene make_scene(const CaseRecord& r, const std::string& case_file, std::vector<std::string>& list) {
  Problems problems(case_file, list);
  Scene scene;
  scene.name = r.name;
  scene.method = r.method;
  scene.kernel = r.kernel;
  scene.seed = r.seed;
  scene.gravity = r.gravity;
  scene.overlap_limit = r.overlap_limit;
  scene.impact_limit = r.impact_limit;
  scene.field = r.field;
  scene.pellet_contact = contact_law(r.pellet_contact);
  scene.wall_contact = contact_law(r.wall_contact);
  scene.stepping = r.stepping;
  scene.stepping.gear = r.integrator == "gear";
  scene.lattice = r.lattice;
  scene.lattice.turn_cells = r.lattice_rotation == "cells";
  scene.shaking = r.shaking;
  scene.shaking.kind = r.shaking_kind == "taps"        ? ShakingKind::taps
                       : r.shaking_kind == "vibration" ? ShakingKind::vibration
                                                       : ShakingKind::none;
  scene.analysis = r.analysis;
  scene.output = r.output;
  scene.feed = make_feed(r, problems);
  double shares = 0;
  for (const PelletRecord& pellet : r.pellets) shares += pellet.share;
  for (std::size_t i = 0; i < r.pellets.size(); ++i)
    problems.guard(pellet_key(r, i), [&] {
      scene.pellets.push_back(
          {make_pellet(r, r.pellets[i]), r.pellets[i].density, r.pellets[i].share / shares});
      scene.pellets.back().asked = size_distribution(r.pellets[i].sizes_of_pellets, r.folder);
    });
  const bool sized = std::any_of(scene.pellets.begin(), scene.pellets.end(),
                                 [](const PelletKind& kind) { return kind.asked.law != SizeLaw::one; });
  if (sized && list.empty()) problems.guard("pellet.sizes", [&] { share_out_sizes(r, scene); });
  problems.guard("container", [&] { scene.container = make_container_of(r); });
  if (!list.empty()) return scene;
  for (std::size_t i = 0; i < scene.pellets.size(); ++i) {
    check_fit(problems, scene, scene.pellets[i], pellet_key(r, i));
    check_kernel(problems, scene, *scene.pellets[i].shape, pellet_key(r, i));
  }
  check_container(problems, scene);
  return scene;
}

}  // namespace packbed
