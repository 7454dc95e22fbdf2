// The integrator: errors of energy and angle against the step, with the cost of a step.
#include <fmt/format.h>

#include <cmath>

#include "bench/bench.hpp"
#include "bench/scenes.hpp"
#include "bench/statistics.hpp"
#include "dynamics/bodies.hpp"
#include "math/clock.hpp"
#include "math/random.hpp"

namespace packbed::bench {
namespace {

/// A free body that spins near its unstable axis, after `turns` periods of that spin.
struct Top {
  Quat rotation;
  double energy_error = 0;  // largest on the way, relative
  double ns = 0;            // CPU time a step
};

Top spin_top(const Vec3& inertia, double steps_per_turn, double turns) {
  Bodies bodies;
  NewBody body;
  body.mass = 1;
  body.inertia = inertia;
  body.bounding_radius = 1;
  body.spin = {0.3, 2 * kPi, 0.2};
  add_body(bodies, body);
  const double step = 1 / steps_per_turn, before = kinetic_rotation(bodies, 0);
  const auto steps = static_cast<std::int64_t>(std::llround(turns * steps_per_turn));
  Top top;
  const double start = cpu_seconds();
  for (std::int64_t i = 0; i < steps; ++i) {
    kick(bodies, 0, Vec3::Zero(), 0.5 * step);
    drift(bodies, 0, step);
    kick(bodies, 0, Vec3::Zero(), 0.5 * step);
    top.energy_error = std::max(top.energy_error, std::abs(kinetic_rotation(bodies, 0) / before - 1));
  }
  top.ns = 1e9 * (cpu_seconds() - start) / static_cast<double>(steps);
  top.rotation = bodies.rotation[0];
  return top;
}

void add_tops(Outcome& out, bool quick) {
  Picture picture{
      "integrator_top", "Torque-free top, ten turns", {"steps a turn", true}, {"error", true}, {}};
  const double turns = 10, finest = quick ? 20000 : 200000;
  for (const auto& [name, inertia] :
       {std::pair("brick (1, 2, 3)", Vec3(1, 2, 3)), std::pair("cylinder (2, 2, 1)", Vec3(2, 2, 1))}) {
    const Top best = spin_top(inertia, finest, turns);
    Series angle{std::string(name) + ": angle [rad]", {}, {}, {}, {}},
        energy{std::string(name) + ": energy", {}, {}, {}, {}};
    for (const double steps : {20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0}) {
      const Top top = spin_top(inertia, steps, turns);
      const double off = top.rotation.angularDistance(best.rotation);
      out.table.add("top, " + std::string(name), steps, top.energy_error, off, "", top.ns);
      angle.x.push_back(steps);
      angle.y.push_back(off);
      energy.x.push_back(steps);
      energy.y.push_back(top.energy_error);
    }
    picture.series.push_back(angle);
    if (inertia.x() != inertia.y()) picture.series.push_back(energy);  // else exact to rounding
  }
  out.pictures.push_back(picture);
}

/// Elastic, frictionless pellets that bounce on a floor, far from one another.
struct Bounces {
  double energy_error = 0;  // rms over pellets that are in the air at the end, relative
  double tilt_error = 0;    // rms against the finest, after the first bounce [rad]; set by the caller
  std::vector<Pellet> after_first;
  double ns = 0;  // CPU time of a pellet's step
};

Bounces bounce(double steps_per_contact, int count, double duration, double first) {
  const ShapePtr shape = make_cylinder("A38", 3.42e-3, 3.46e-3);
  Scene scene = plain_scene(ContainerKind::plane, shape);
  scene.gravity = {0, 0, -kGravity};
  scene.stepping.steps_per_contact = steps_per_contact;
  const double reach = shape->bounding_radius;
  for (int i = 0; i < count; ++i) {
    Random random(11, Stream::test, static_cast<std::uint32_t>(i));
    place(scene, {40 * reach * (i % 16), 40 * reach * (i / 16), 0.01}, random.rotation());
  }
  const Course course = run_scene(scene, duration, first);
  Bounces out;
  std::vector<double> errors;
  const Frame &begin = course.frames.front(), &end = course.frames.back();
  for (std::size_t i = 0; i < end.pellets.size(); ++i) {
    if (end.pellets[i].pose.position.z() < 1.05 * reach) continue;
    errors.push_back(end.energies[i].sum() / begin.energies[i].sum() - 1);
  }
  out.energy_error = root_mean_square(errors);
  out.after_first = course.frames[1].pellets;
  out.ns =
      1e9 * course.result.record.time.cpu_s / static_cast<double>(course.result.record.time.steps) / count;
  return out;
}

void add_bounces(Outcome& out, bool quick) {
  const int count = quick ? 32 : 256;
  const double duration = quick ? 0.5 : 2.0, first = 0.055;
  Picture picture{"integrator_bounce",
                  fmt::format("Elastic A38 bouncing on a floor for {:g} s", duration),
                  {"steps a contact (of two pellets, face to face)", true},
                  {"error", true},
                  {}};
  Series energy{"energy at the end, rms", {}, {}, {}, {}},
      tilt{"angle after one bounce [rad]", {}, {}, {}, {}};
  const Bounces best = bounce(320, count, first, first);
  for (const double steps : {8.0, 12.0, 16.0, 20.0, 30.0, 40.0, 80.0}) {
    const Bounces now = bounce(steps, count, duration, first);
    std::vector<double> off;
    for (std::size_t i = 0; i < now.after_first.size(); ++i)
      off.push_back(now.after_first[i].pose.rotation.angularDistance(best.after_first[i].pose.rotation));
    const double tilts = root_mean_square(off);
    out.table.add("bouncing A38", steps, now.energy_error, "", tilts, now.ns);
    energy.x.push_back(steps);
    energy.y.push_back(now.energy_error);
    tilt.x.push_back(steps);
    tilt.y.push_back(tilts);
    if (steps == 16 || steps == 40)
      out.findings.push_back(
          fmt::format("{:g} steps a contact: energy within {:.2g} % (rms) after {:g} s of bouncing", steps,
                      100 * now.energy_error, duration));
  }
  picture.series = {energy, tilt};
  out.pictures.push_back(picture);
}

}  // namespace

Outcome bench_integrator(const Options& options) {
  Outcome out;
  out.table.columns = {"motion",
                       "steps a turn, or a contact",
                       "energy error [-]",
                       "angle after ten turns [rad]",
                       "angle after one bounce [rad]",
                       "a step of a body [ns]"};
  options.tell("integrator: tops");
  add_tops(out, options.quick);
  options.tell("integrator: bounces");
  add_bounces(out, options.quick);
  return out;
}

}  // namespace packbed::bench
