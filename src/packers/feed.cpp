#include "packers/feed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "math/error.hpp"
#include "math/random.hpp"
#include "packers/entry.hpp"
#include "packers/layer.hpp"
#include "packers/overlap_test.hpp"
#include "packers/scatter.hpp"

namespace packbed {
namespace {

constexpr double kWait = 0.25;         // of the interval, between tries while there is no room
constexpr int kTurns = 8;              // patterns tried for one layer before it waits
constexpr int kDraws = 100;            // points tried for one pellet of a handful before it waits
constexpr int kScatterDraws = 10000;   // places tried for one pellet of a cloud
constexpr double kDensityGuess = 0.6;  // packing density, only for estimates of how many will be asked for
constexpr double kForever = std::numeric_limits<double>::infinity();

std::string millimetres(double length) {
  return fmt::format("{:.6g} mm", length * 1e3);
}

double mass_of(const Scene& scene, std::uint32_t kind, double scale) {
  return scene.pellets[kind].shape->volume * scale * scale * scale * scene.pellets[kind].density;
}

std::uint32_t draw_kind(const Scene& scene, std::uint32_t id) {
  if (scene.pellets.size() == 1) return 0;
  double u = Random(scene.seed, Stream::feed_shape, id).uniform();
  for (std::uint32_t k = 0; k + 1 < scene.pellets.size(); ++k) {
    u -= scene.pellets[k].share;
    if (u < 0) return k;
  }
  return static_cast<std::uint32_t>(scene.pellets.size() - 1);
}

/// Kind and scale of a pellet.
struct Sort {
  std::uint32_t kind = 0;
  double scale = 1;
};

/// Everything that a scene of given sizes feeds, in random order: the totals are exact. Empty without sizes.
std::vector<Sort> shuffled_sorts(const Scene& scene) {
  std::vector<Sort> sorts;
  for (std::uint32_t k = 0; k < scene.pellets.size(); ++k)
    for (const SizeClass& c : scene.pellets[k].sizes) sorts.insert(sorts.end(), c.count, {k, c.scale});
  Random random(scene.seed, Stream::feed_size, 0);
  shuffle(sorts, random);
  return sorts;
}

bool in_one_piece(FeedKind kind) {
  return kind == FeedKind::lattice || kind == FeedKind::scatter;
}

/// At entry: of a random direction; when all enter together, of random components.
Vec3 entry_velocity(const Scene& scene, std::uint32_t id) {
  const double speed = scene.feed.speed;
  if (!(speed > 0)) return Vec3::Zero();
  Random random(scene.seed, Stream::feed_velocity, id);
  if (!in_one_piece(scene.feed.kind)) return speed * random.on_sphere();
  Vec3 velocity;
  for (int d = 0; d < 3; ++d) velocity[d] = random.uniform(-speed, speed);
  return velocity;
}

std::vector<Pellet> placed_pellets(const Scene& scene) {
  std::vector<Pellet> pellets;
  for (const PlacedPellet& placed : scene.feed.placed) {
    Pellet pellet;
    pellet.id = static_cast<std::uint32_t>(pellets.size());
    pellet.shape = placed.kind;
    pellet.scale = placed.scale;
    pellet.pose = placed.pose;
    pellet.velocity = placed.velocity;
    pellet.spin = placed.spin;
    pellet.fixed = placed.fixed;
    if (placed.kind >= scene.pellets.size())
      throw InputError(fmt::format("placed pellet {}", pellet.id), fmt::format("pellet kind {}", placed.kind),
                       fmt::format("0 to {}", scene.pellets.size() - 1));
    pellets.push_back(pellet);
  }
  return pellets;
}

/// Radius of the circle that centres may enter in.
double feed_circle(const Scene& scene, double pellet_radius) {
  const bool walls = has_sides(scene.container.kind);
  const double given = scene.feed.radius;
  if (!walls) {
    if (given > 0) return given;
    throw InputError("feed.radius", "none", "a radius greater than 0",
                     "a container without walls does not say how wide the feed is");
  }
  const double widest = scene.container.radius - pellet_radius;
  if (widest < 0)
    throw InputError(
        "feed", fmt::format("a pellet that needs {} to turn", millimetres(2 * pellet_radius)),
        fmt::format("less than the container's inner diameter, {}", millimetres(2 * scene.container.radius)),
        "not one pellet can enter: check the units of both files, or take a wider container");
  if (given > widest * (1 + 1e-9))
    throw InputError("feed.radius", millimetres(given), fmt::format("at most {}", millimetres(widest)),
                     "so that every rotation of a pellet stays clear of the wall");
  return given > 0 ? given : widest;
}

/// What the settings must be for layers and handfuls.
void check_settings(const Scene& scene, double pellet_radius) {
  const Feed& feed = scene.feed;
  if (!feed.count && !feed.height && !feed.mass)
    throw InputError("feed", "no end", "a count, a height or a mass", "add for example feed.count = 300");
  if (in_one_piece(feed.kind) && !feed.count && !feed.mass)
    throw InputError("feed", "pellets that enter together, until a height", "a count or a mass",
                     "all pellets of a lattice or a cloud enter before there is a bed");
  if (!(feed.interval > 0)) throw InputError("feed.interval", "0", "greater than 0");
  if (feed.per_layer < 1) throw InputError("feed.per_layer", fmt::format("{}", feed.per_layer), "at least 1");
  const bool floor = scene.container.kind != ContainerKind::none;
  if ((floor || feed.above_bed) && feed.drop_height < pellet_radius)
    throw InputError("feed.drop_height", millimetres(feed.drop_height),
                     fmt::format("at least {}", millimetres(pellet_radius)),
                     "the pellet's bounding sphere has to be above the floor");
}

}  // namespace

struct Feeder::Plan {
  explicit Plan(const Scene& s) : scene(s), test(s.pellets), room(s.container) {
    for (std::uint32_t k = 0; k < scene.pellets.size(); ++k) {
      Pellet largest;
      largest.shape = k;
      largest.scale = largest_scale(scene.pellets[k].sizes);
      radius = std::max(radius, test.bounding_radius(largest));
    }
    if (scene.feed.kind == FeedKind::placed) {
      placed = placed_pellets(scene);
      check_placed(scene, test, room, placed);
      return;
    }
    check_settings(scene, radius);
    sorts = shuffled_sorts(scene);
    if (!sorts.empty() && scene.feed.count != static_cast<int>(sorts.size()))
      throw InputError("feed.count", scene.feed.count ? fmt::format("{}", *scene.feed.count) : "none",
                       fmt::format("{}, as many as there are of all sizes", sorts.size()));
    circle = feed_circle(scene, radius);
    if (scene.feed.kind == FeedKind::layers) {
      loose = layer_pattern(circle, 2 * radius, scene.feed.per_layer, true);
      dense = layer_pattern(circle, 2 * radius, scene.feed.per_layer, false);
    }
    if (scene.feed.kind == FeedKind::lattice) plane = lattice_plane();
    if (scene.feed.kind == FeedKind::scatter) cloud_height = height_of_cloud();
    check_wall();
  }

  Sort sort_of(std::uint32_t id) const {
    return sorts.empty() ? Sort{draw_kind(scene, id), 1} : sorts[std::min<std::size_t>(id, sorts.size() - 1)];
  }

  /// All of the pellet but its place.
  Pellet make_pellet(std::uint32_t id) const {
    Pellet pellet;
    pellet.id = id;
    const Sort sort = sort_of(id);
    pellet.shape = sort.kind;
    pellet.scale = sort.scale;
    pellet.pose.rotation = Random(scene.seed, Stream::feed_rotation, id).rotation();
    pellet.velocity = entry_velocity(scene, id);
    return pellet;
  }

  double lattice_spacing() const { return scene.feed.spacing > 0 ? scene.feed.spacing : 2 * radius; }

  /// Sites of one plane of the lattice: a square pattern about the axis, where the largest pellet has room.
  std::vector<Vec2> lattice_plane() const {
    const double spacing = lattice_spacing();
    if (spacing < 2 * radius * (1 - 1e-9))
      throw InputError("feed.spacing", millimetres(spacing),
                       fmt::format("at least {}", millimetres(2 * radius)),
                       "the largest pellets would overlap: leave it out for the closest lattice");
    const Vec2 half = rectangle();
    const auto sites_over = [&](double width) {
      return static_cast<int>(std::floor(2 * width / spacing * (1 + 1e-9))) + 1;
    };
    const auto at = [&](int i, int of) { return (i - 0.5 * (of - 1)) * spacing; };
    const int across = sites_over(half.x()), along = sites_over(half.y());
    std::vector<Vec2> sites;
    for (int j = 0; j < along; ++j)
      for (int i = 0; i < across; ++i) {
        const Vec2 site(at(i, across), at(j, along));
        if (may_enter(site) && room.holds_sphere({site.x(), site.y(), scene.feed.drop_height}, radius))
          sites.push_back(site);
      }
    if (sites.empty()) throw InputError("feed.spacing", millimetres(spacing), "room for one site in a plane");
    return sites;
  }

  std::size_t count_at_once() const {
    return static_cast<std::size_t>(allowance(0, 0, std::numeric_limits<int>::max()));
  }
  /// Radius of the bounding sphere [m].
  double reach_of(std::uint32_t id) const {
    const Sort sort = sort_of(id);
    Pellet pellet;
    pellet.shape = sort.kind;
    pellet.scale = sort.scale;
    return test.bounding_radius(pellet);
  }
  /// So high that the bounding spheres fill the share of the cloud that the case asks for.
  double height_of_cloud() const {
    double cubes = 0;
    const std::size_t count = count_at_once();
    for (std::uint32_t id = 0; id < count; ++id) cubes += std::pow(reach_of(id), 3);
    const Vec2 half = rectangle() + Vec2::Constant(radius);
    const double section = feeds_rectangle() ? 4 * half.x() * half.y() : kPi * half.x() * half.x();
    return std::max(2 * radius, 4.0 / 3.0 * kPi * cubes / (section * scene.feed.cloud_density));
  }
  /// A random place in the cloud for a sphere.
  Vec3 in_cloud(Random& random, double reach) const {
    const double low = scene.feed.drop_height - radius;
    const double height = random.uniform(low + reach, low + cloud_height - reach);
    return at_random(random, height, radius - reach);
  }
  std::size_t last_level(std::size_t count) const { return (count - 1) / plane.size(); }

  /// A box is fed over all of its section, unless the case gives a circle.
  bool feeds_rectangle() const {
    return scene.container.kind == ContainerKind::box && !(scene.feed.radius > 0);
  }
  /// Half widths of what holds all centres.
  Vec2 rectangle() const {
    if (!feeds_rectangle()) return Vec2::Constant(circle);
    return 0.5 * Vec2(scene.container.width, scene.container.depth) - Vec2::Constant(radius);
  }
  bool may_enter(const Vec2& site) const { return feeds_rectangle() || site.norm() <= circle * (1 + 1e-9); }

  /// A mesh container has to leave room somewhere at a fixed drop height.
  void check_wall() const {
    if (scene.container.kind != ContainerKind::mesh || scene.feed.above_bed) return;
    Random random(scene.seed, Stream::feed_position, 0xffffffff);
    for (int draw = 0; draw < kDraws; ++draw)
      if (room.holds_sphere(at_random(random, scene.feed.drop_height), radius)) return;
    throw InputError("feed.drop_height", millimetres(scene.feed.drop_height),
                     fmt::format("a height at which a sphere of {} fits between the container's walls",
                                 millimetres(2 * radius)),
                     "change the height, or give feed.radius");
  }

  /// `nearer`: how much nearer to the walls than the largest pellet [m].
  Vec3 at_random(Random& random, double height, double nearer = 0) const {
    if (feeds_rectangle()) {
      const Vec2 half = rectangle() + Vec2::Constant(nearer);
      const double x = random.uniform(-half.x(), half.x()), y = random.uniform(-half.y(), half.y());
      return {x, y, height};
    }
    const double r = (circle + nearer) * std::sqrt(random.uniform()), angle = random.uniform(0, 2 * kPi);
    return {r * std::cos(angle), r * std::sin(angle), height};
  }

  /// Room for this pellet among the others and inside the container.
  bool free(const Pellet& pellet, std::span<const Pellet> near, std::span<const Pellet> entering) const {
    const auto hits = [&](const Pellet& other) { return test.overlap(pellet, other); };
    if (std::any_of(near.begin(), near.end(), hits)) return false;
    if (std::any_of(entering.begin(), entering.end(), hits)) return false;
    return room.holds_sphere(pellet.pose.position, test.bounding_radius(pellet));
  }

  /// How many of the pellets that follow `fed` may enter together before the count or the mass is reached.
  int allowance(int fed, double mass, int most) const {
    int n = scene.feed.count ? std::min(most, *scene.feed.count - fed) : most;
    if (!scene.feed.mass) return n;
    int within = 0;
    while (within < n && mass < *scene.feed.mass) {
      const Sort sort = sort_of(static_cast<std::uint32_t>(fed + within));
      mass += mass_of(scene, sort.kind, sort.scale);
      ++within;
    }
    return within;
  }

  int expected() const {
    const Feed& feed = scene.feed;
    if (feed.kind == FeedKind::placed) return static_cast<int>(placed.size());
    double mean_volume = 0, mean_mass = 0;
    for (std::uint32_t k = 0; k < scene.pellets.size(); ++k) {
      const double share = scene.pellets[k].share * mean_cubed_scale(scene.pellets[k].sizes);
      mean_volume += share * scene.pellets[k].shape->volume;
      mean_mass += share * mass_of(scene, k, 1);
    }
    double n = feed.count ? *feed.count : kForever;
    if (feed.mass) n = std::min(n, std::ceil(*feed.mass / mean_mass));
    if (!feed.count && !feed.mass) {
      const double width = scene.container.radius > 0 ? scene.container.radius : circle + radius;
      n = std::ceil(kDensityGuess * kPi * width * width * *feed.height / mean_volume);
    }
    return static_cast<int>(std::min(n, 2e9));
  }

  const Scene scene;
  OverlapTest test;
  Room room;
  double radius = 0;  // of the largest bounding sphere [m]
  double circle = 0;  // radius of the feed circle [m]
  std::vector<Sort> sorts;
  LayerPattern loose, dense;
  std::vector<Vec2> plane;  // of the lattice
  double cloud_height = 0;  // [m]
  std::vector<Pellet> placed;
};

Feeder::Feeder(const Scene& scene) : plan_(std::make_unique<Plan>(scene)) {
  if (plan_->expected() <= 0) state_.done = 1;
}
Feeder::~Feeder() = default;
Feeder::Feeder(Feeder&&) noexcept = default;
Feeder& Feeder::operator=(Feeder&&) noexcept = default;

double Feeder::next_time() const {
  return state_.done ? kForever : state_.next_time;
}
int Feeder::fed() const {
  return state_.fed;
}
double Feeder::fed_mass() const {
  return state_.mass;
}
int Feeder::asked() const {
  return state_.done ? state_.fed : std::max(state_.fed, plan_->expected());
}
bool Feeder::done() const {
  return state_.done != 0;
}
bool Feeder::waiting() const {
  return state_.waiting != 0;
}

std::vector<Pellet> Feeder::enter(double time, std::span<const Pellet> present, double surface) {
  const Scene& scene = plan_->scene;
  const Feed& feed = scene.feed;
  if (state_.done || time < state_.next_time) return {};
  std::vector<Pellet> entering;
  int wanted = 0;
  if (feed.kind == FeedKind::placed) {
    entering = plan_->placed;
    wanted = static_cast<int>(entering.size());
  } else if (in_one_piece(feed.kind)) {
    entering = feed.kind == FeedKind::lattice ? enter_lattice() : enter_scattered();
    wanted = static_cast<int>(entering.size());
  } else {
    if (feed.height && surface >= *feed.height) {
      state_.done = 1;
      state_.waiting = 0;
      return {};
    }
    const double height = feed.drop_height + (feed.above_bed ? surface : 0.0);
    std::vector<Pellet> near;  // nothing enters below this, however many planes a layer has
    for (const Pellet& p : present)
      if (p.pose.position.z() + plan_->test.bounding_radius(p) > height - plan_->radius * (1 + 1e-6))
        near.push_back(p);
    wanted = plan_->allowance(state_.fed, state_.mass, feed.per_layer);
    entering = feed.kind == FeedKind::layers ? enter_layer(near, height, wanted)
                                             : enter_handful(near, height, wanted);
  }
  for (const Pellet& p : entering) state_.mass += mass_of(scene, p.shape, p.scale);
  state_.fed += static_cast<std::int32_t>(entering.size());
  state_.waiting = static_cast<int>(entering.size()) < wanted;
  state_.attempt = entering.empty() ? state_.attempt + 1 : 0;
  state_.next_time += entering.empty() ? kWait * feed.interval : feed.interval;
  if (enters_at_once(feed.kind) || plan_->allowance(state_.fed, state_.mass, 1) < 1) state_.done = 1;
  return entering;
}

std::vector<Pellet> Feeder::enter_layer(std::span<const Pellet> near, double height, int count) {
  const std::uint32_t first = static_cast<std::uint32_t>(state_.fed);
  for (int turn = 0; turn < kTurns; ++turn) {
    // the later tries take the densest pattern, which has more sites than are needed to choose from
    const LayerPattern& pattern = turn < kTurns / 2 ? plan_->loose : plan_->dense;
    const int per_plane = std::min(plan_->scene.feed.per_layer, static_cast<int>(pattern.sites.size()));
    const int planes = (count + per_plane - 1) / per_plane;
    Random random(plan_->scene.seed, Stream::feed_position, first,
                  static_cast<std::uint32_t>(state_.attempt * kTurns + turn));
    std::vector<Pellet> layer;
    for (int plane = 0; plane < planes; ++plane)
      for (const Vec2& site : shaken(pattern, plan_->circle, random)) {
        if (static_cast<int>(layer.size()) == count) break;
        Pellet pellet = plan_->make_pellet(first + static_cast<std::uint32_t>(layer.size()));
        pellet.pose.position = {site.x(), site.y(), height + plane * 2 * plan_->radius * (1 + 1e-6)};
        if (plan_->free(pellet, near, {})) layer.push_back(pellet);
      }
    if (static_cast<int>(layer.size()) == count) return layer;
  }
  return {};
}

double Feeder::highest() const {
  const double low = plan_->scene.feed.drop_height;
  if (plan_->scene.feed.kind == FeedKind::scatter) return low - plan_->radius + plan_->cloud_height;
  return low + static_cast<double>(plan_->last_level(plan_->count_at_once())) * plan_->lattice_spacing();
}

/// Planes from the drop height upwards; the last one is filled at random sites.
std::vector<Pellet> Feeder::enter_lattice() const {
  const Scene& scene = plan_->scene;
  std::vector<Vec2> plane = plan_->plane;
  Random random(scene.seed, Stream::feed_position, 0);
  const std::size_t count = plan_->count_at_once(), last = plan_->last_level(count);
  std::vector<Pellet> entering;
  entering.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = i % plane.size(), level = i / plane.size();
    if (at == 0 && level == last) shuffle(plane, random);
    Pellet pellet = plan_->make_pellet(static_cast<std::uint32_t>(i));
    pellet.pose.position = {plane[at].x(), plane[at].y(),
                            scene.feed.drop_height + static_cast<double>(level) * plan_->lattice_spacing()};
    entering.push_back(pellet);
  }
  return entering;
}

std::vector<Pellet> Feeder::enter_scattered() const {
  const Scene& scene = plan_->scene;
  std::vector<double> reach(plan_->count_at_once());
  for (std::size_t i = 0; i < reach.size(); ++i) reach[i] = plan_->reach_of(static_cast<std::uint32_t>(i));
  const auto draw = [&](std::size_t i, int attempt) -> std::optional<Vec3> {
    Random random(scene.seed, Stream::feed_position, static_cast<std::uint32_t>(i),
                  static_cast<std::uint32_t>(attempt));
    const Vec3 place = plan_->in_cloud(random, reach[i]);
    return plan_->room.holds_sphere(place, reach[i]) ? std::optional(place) : std::nullopt;
  };
  const std::vector<Vec3> places = scattered(reach, kScatterDraws, draw);
  if (places.size() < reach.size())
    throw InputError("feed.cloud_density", fmt::format("{}", scene.feed.cloud_density),
                     "a cloud in which every pellet finds a place", "make it thinner, 0.2 always has room");
  std::vector<Pellet> entering;
  entering.reserve(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    entering.push_back(plan_->make_pellet(static_cast<std::uint32_t>(i)));
    entering.back().pose.position = places[i];
  }
  return entering;
}

bool enters_at_once(FeedKind kind) {
  return kind == FeedKind::placed || in_one_piece(kind);
}

double highest_at_entry(const Scene& scene) {
  return in_one_piece(scene.feed.kind) ? Feeder(scene).highest() : scene.feed.drop_height;
}

std::vector<Pellet> Feeder::enter_handful(std::span<const Pellet> near, double height, int count) {
  std::vector<Pellet> handful;
  for (int i = 0; i < count; ++i) {
    Pellet pellet = plan_->make_pellet(static_cast<std::uint32_t>(state_.fed + i));
    Random random(plan_->scene.seed, Stream::feed_position, pellet.id,
                  static_cast<std::uint32_t>(state_.attempt));
    bool free = false;
    for (int draw = 0; draw < kDraws && !free; ++draw) {
      pellet.pose.position = plan_->at_random(random, height);
      free = plan_->free(pellet, near, handful);
    }
    if (!free) break;
    handful.push_back(pellet);
  }
  return handful;
}

std::vector<std::byte> Feeder::save() const {
  std::vector<std::byte> bytes(sizeof(State));
  std::memcpy(bytes.data(), &state_, sizeof(State));
  return bytes;
}

void Feeder::restore(std::span<const std::byte> state) {
  if (state.size() != sizeof(State)) throw SystemError("checkpoint: the feed's state has a wrong length");
  std::memcpy(&state_, state.data(), sizeof(State));
}

}  // namespace packbed
