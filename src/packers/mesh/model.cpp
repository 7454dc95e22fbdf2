#include "packers/mesh/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "math/error.hpp"
#include "packers/expect.hpp"
#include "packers/mesh/kernels.hpp"

namespace packbed::mesh {
namespace {

Kernel kernel_for(const Scene& scene, const Shape& shape) {
  const auto refuse = [&](const char* fits) {
    throw InputError(
        scene.case_file + ": kernel",
        fmt::format("\"{}\" for the {} shape '{}'", scene.kernel, to_string(shape.kind), shape.name), fits,
        "kernel = \"auto\" takes the fastest exact one");
  };
  if (scene.kernel == "field") return Kernel::field;
  if (shape.kind == ShapeClass::sphere) {
    if (scene.kernel != "auto" && scene.kernel != "sphere") refuse("\"auto\", \"sphere\" or \"field\"");
    return Kernel::sphere;
  }
  if (shape.kind == ShapeClass::cylinder) {
    if (scene.kernel != "auto" && scene.kernel != "cylinder") refuse("\"auto\", \"cylinder\" or \"field\"");
    return Kernel::cylinder;
  }
  if (scene.kernel != "auto") refuse("\"auto\" or \"field\"");
  return Kernel::field;
}

std::vector<Kind> make_kinds(const Scene& scene) {
  std::vector<Kind> kinds;
  for (const PelletKind& pellet : scene.pellets) {
    const Shape& shape = *pellet.shape;
    Kind kind;
    kind.shape = pellet.shape;
    kind.kernel = kernel_for(scene, shape);
    kind.mass = pellet.density * shape.volume;
    kind.inertia = pellet.density * shape.inertia;
    kind.bounding_radius = shape.bounding_radius;
    kind.thickness = shape.smallest_thickness;
    kind.radius = 0.5 * shape.equivalent_diameter();
    std::tie(kind.smallest, kind.largest) = scales_of(scene, static_cast<std::uint32_t>(kinds.size()));
    kinds.push_back(kind);
  }
  // kinds of different kernels only meet through the general one
  const bool mixed =
      std::any_of(kinds.begin(), kinds.end(), [&](const Kind& k) { return k.kernel != kinds[0].kernel; });
  const bool general = mixed || scene.container.kind == ContainerKind::mesh;
  if (general)
    for (Kind& kind : kinds) kind.kernel = Kernel::field;
  for (Kind& kind : kinds)
    if (kind.kernel == Kernel::field)
      kind.field = std::make_shared<FieldBody>(
          make_field_body(*kind.shape, {.spacing = kind.shape->equivalent_diameter() / scene.field.points,
                                        .grid = scene.field.grid,
                                        .memory_bytes = 1e6 * scene.field.memory_MB}));
  return kinds;
}

void add_wall_fields(Model& model) {
  const auto set = [&](std::uint32_t which, FieldWall wall) {
    model.wall_field[which - kSide] = std::make_shared<FieldWall>(std::move(wall));
  };
  const ContainerKind kind = model.container.kind;
  if (kind == ContainerKind::plane || kind == ContainerKind::tube || kind == ContainerKind::box)
    set(kFloor, make_field_floor());
  for (std::uint32_t k = 0; k < 4 && kind == ContainerKind::box; ++k) {
    const BoxSide side = side_of(model.container, k);
    set(kSide + k, {DepthField::of_planes({{side.inwards, -side.half}}), 0});
  }
  if (kind == ContainerKind::tube) set(kWall, make_field_bore(model.container.radius));
  if (kind != ContainerKind::mesh) return;
  double thickness = std::numeric_limits<double>::infinity();
  for (const Kind& k : model.kinds) thickness = std::min(thickness, k.smallest * k.thickness);
  set(kSolid, make_field_wall(model.container, thickness));
}

/// k from "the hardest impact of one pellet on a wall may overlap by so much".
double find_stiffness(const Scene& scene, const ContactLaw& law, const std::vector<Kind>& kinds) {
  if (law.stiffness > 0) return law.stiffness;
  const double speed = hardest_impact(scene);
  double stiffness = 0;
  for (const Kind& kind : kinds) {
    const double overlap = law.allowed_overlap * kind.thickness;
    // mass goes like the cube of the scale, the overlap like the scale
    stiffness = std::max(stiffness, kind.largest * kind.mass * speed * speed / (overlap * overlap));
  }
  return stiffness;
}

LawNumbers find_law(const Scene& scene, const ContactLaw& law, const std::vector<Kind>& kinds) {
  return {find_stiffness(scene, law, kinds), law.damping_ratio, law.friction, law.torsion,
          law.rolling_friction};
}

/// Tubes and meshes: what is pressed past the middle of a wall comes out on its other side.
bool is_wall(const Kind& kind) {
  return kind.kernel == Kernel::field &&
         (kind.shape->kind == ShapeClass::tube || kind.shape->kind == ShapeClass::mesh);
}

double find_thinnest_wall(const std::vector<Kind>& kinds) {
  double thinnest = 0;
  for (const Kind& kind : kinds)
    if (const double wall = kind.smallest * kind.thickness;
        is_wall(kind) && !(thinnest > 0 && thinnest <= wall))
      thinnest = wall;
  return thinnest;
}

/// Refuses contacts too soft, and steps too long, for the walls at the expected speed.
void require_safe_walls(const Scene& scene, const Model& model) {
  const double speed = hardest_impact(scene), stiffness = model.pellet_law.stiffness;
  for (const Kind& kind : model.kinds) {
    if (!is_wall(kind)) continue;
    // of the largest: a body twice as large presses sqrt(2) times deeper, beside its wall
    const double depth = speed * std::sqrt(kind.mass * std::pow(kind.largest, 3) / stiffness),
                 thickness = kind.largest * kind.thickness, most = kPierced * thickness;
    if (depth > most)
      throw InputError(
          scene.case_file + ": contact.stiffness",
          fmt::format("{:.4g} N/m: at {:.3g} m/s the wall of {}, {:.3g} mm thick, would be pressed "
                      "in by {:.0f} % of that, and bodies would pass through each other",
                      stiffness, speed, kind.shape->name, 1e3 * thickness, 100 * depth / thickness),
          fmt::format("at least {:.4g} N/m", stiffness * depth * depth / (most * most)),
          "raise it, leave it out, or lower feed.drop_height");
    const double stride = kMostStride * kind.smallest * kind.thickness / speed;
    if (model.step > stride)
      throw InputError(
          scene.case_file + ": stepping.step",
          fmt::format("{:.3g} us: at {:.3g} m/s a body would go {:.0f} % of the thickness of the "
                      "wall of {} in a step, and might pass through",
                      1e6 * model.step, speed, 100 * kMostStride * model.step / stride, kind.shape->name),
          fmt::format("at most {:.3g} us", 1e6 * stride), "leave it out, or lower feed.drop_height");
  }
}

/// Contact time of the stiffest contact: two of the lightest pellets, or one on the wall, face to face.
double shortest_contact(const Model& model) {
  double mass = std::numeric_limits<double>::infinity();
  for (const Kind& kind : model.kinds) mass = std::min(mass, kind.mass * std::pow(kind.smallest, 3));
  const double pellets = std::sqrt(0.5 * mass / model.pellet_law.stiffness);
  const double wall = std::sqrt(mass / model.wall_law.stiffness);
  return kPi * std::min(pellets, wall);
}

}  // namespace

std::string kernel_name(const Model& model) {
  switch (model.kinds.front().kernel) {
    case Kernel::sphere:
      return "sphere";
    case Kernel::cylinder:
      return "cylinder";
    case Kernel::field:
      return "field";
  }
  return "";
}

Model make_model(const Scene& scene) {
  Model model;
  model.kinds = make_kinds(scene);
  model.container = scene.container;
  if (uses_fields(model)) add_wall_fields(model);
  model.gravity = scene.gravity;
  if (scene.gravity.norm() > 0) model.up = -scene.gravity.normalized();
  model.pellet_law = find_law(scene, scene.pellet_contact, model.kinds);
  model.wall_law = find_law(scene, scene.wall_contact, model.kinds);
  model.thinnest_wall = find_thinnest_wall(model.kinds);
  model.stepping = scene.stepping;
  model.shaking = scene.shaking;
  model.size = std::numeric_limits<double>::infinity();
  double largest = 0;
  for (const Kind& kind : model.kinds) {
    model.size = std::min(model.size, kind.smallest * kind.shape->equivalent_diameter());
    largest = std::max(largest, kind.largest * kind.bounding_radius);
  }
  const double contact = shortest_contact(model);
  model.step = step_for(scene, contact, "leave the step out, or lower contact.stiffness");
  require_safe_walls(scene, model);
  model.skin = scene.stepping.skin > 0 ? scene.stepping.skin : 0.05 * largest;
  // leaps need a floor below and nothing above: a container that is not recognised may have anything anywhere
  model.may_fly =
      scene.feed.kind != FeedKind::placed && scene.gravity.norm() > 0 &&
      scene.gravity.cross(Vec3::UnitZ()).norm() < 1e-12 * scene.gravity.norm() &&
      (scene.container.kind == ContainerKind::tube || scene.container.kind == ContainerKind::box ||
       scene.container.kind == ContainerKind::plane);
  model.expected_time = expected_time(scene);
  return model;
}

}  // namespace packbed::mesh
