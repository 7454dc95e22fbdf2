// Contact kernels: errors of force, torque, direction and line of action against the cost of a look.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "bench/bench.hpp"
#include "bench/contact_poses.hpp"
#include "bench/statistics.hpp"
#include "math/clock.hpp"

namespace packbed::bench {
namespace {

constexpr std::array kDepths = {0.1, 0.2, 0.5, 1.0, 2.0, 5.0};  // edges of the bins [% D]

/// What a kernel does at the poses of one bin.
struct Errors {
  std::vector<double> force, torque;          // against the converged law [-]
  std::vector<double> angle, action;          // against the pressure field [degrees], [D]
  std::vector<double> law_angle, law_action;  // of the converged law itself
  int missed = 0;
};

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / kPi;
}

void against_pressure(const PosePair& pair, const Touch& t, double size, std::vector<double>& angle,
                      std::vector<double>& action) {
  if (!pair.pressure || !(t.delta > 0)) return;
  angle.push_back(angle_between(t.gradient, pair.pressure->force));
  const Vec3 torque = t.torque_a + pair.a.position.cross(t.gradient);
  action.push_back(distance_of_action(t.gradient, torque, pair.pressure->point) / size);
}

void add_errors(Errors& errors, const PosePair& pair, const Touch& t, const Touch& law, double size) {
  if (!(t.delta > 0)) {
    if (pair.depth > 0.005 * size) ++errors.missed;
    if (!(law.delta > 0)) return;
  }
  const double scale = law.delta * law.gradient.norm();
  errors.force.push_back((t.delta * t.gradient - law.delta * law.gradient).norm() / scale);
  errors.torque.push_back((t.delta * t.torque_a - law.delta * law.torque_a).norm() / (scale * size));
  against_pressure(pair, t, size, errors.angle, errors.action);
  against_pressure(pair, law, size, errors.law_angle, errors.law_action);
}

void append(std::vector<double>& all, const std::vector<double>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

Errors together(const std::array<Errors, kDepths.size() - 1>& bins) {
  Errors all;
  for (const Errors& e : bins) {
    append(all.force, e.force);
    append(all.torque, e.torque);
    append(all.angle, e.angle);
    append(all.action, e.action);
    append(all.law_angle, e.law_angle);
    append(all.law_action, e.law_action);
    all.missed += e.missed;
  }
  return all;
}

double nanoseconds(const std::vector<PosePair>& pairs, const TouchAt& touch) {
  double best = 1e300, sum = 0;
  for (int round = 0; round < 3; ++round) {
    const double start = cpu_seconds();
    int looks = 0;
    do {
      for (const PosePair& p : pairs) sum += touch(p.a, p.b).delta;
      looks += static_cast<int>(pairs.size());
    } while (cpu_seconds() - start < 0.02);
    best = std::min(best, (cpu_seconds() - start) / looks);
  }
  return sum >= 0 ? 1e9 * best : 0;
}

struct Row {
  const ContactSubject* subject;
  const ContactKernel* kernel;
  double spread, ns;
};

void add_row(Table& table, const Row& row, const std::string& bin, const Errors& e) {
  table.add(row.subject->name, row.kernel->name, row.kernel->accuracy, bin, e.force.size(),
            100 * quantile(e.force, 0.5), 100 * quantile(e.force, 0.99), 100 * quantile(e.torque, 0.5),
            100 * quantile(e.torque, 0.99), quantile(e.angle, 0.5), quantile(e.angle, 0.99),
            100 * quantile(e.action, 0.5), quantile(e.law_angle, 0.5), 100 * quantile(e.law_action, 0.5),
            e.missed, row.spread, row.ns);
}

Errors run_kernel(const ContactSubject& subject, const ContactKernel& kernel,
                  const std::vector<PosePair>& pairs, const std::vector<Touch>& law, Table& table, Row& row) {
  std::array<Errors, kDepths.size() - 1> bins;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    std::size_t bin = 0;
    while (bin + 2 < kDepths.size() && pairs[i].depth > 0.01 * kDepths[bin + 1] * subject.size) ++bin;
    add_errors(bins[bin], pairs[i], kernel.touch(pairs[i].a, pairs[i].b), law[i], subject.size);
  }
  row = {&subject, &kernel, stiffness_spread(subject, kernel.touch), nanoseconds(pairs, kernel.touch)};
  for (std::size_t k = 0; k < bins.size(); ++k)
    add_row(table, row, fmt::format("{:g} to {:g}", kDepths[k], kDepths[k + 1]), bins[k]);
  const Errors all = together(bins);
  add_row(table, row, "all", all);
  return all;
}

void tell(Outcome& out, const Row& row, const Errors& all) {
  const double median = 100 * quantile(all.force, 0.5), far = 100 * quantile(all.force, 0.99);
  out.findings.push_back(fmt::format(
      "{}, {} {}: force within {:.2g} % of the converged law in the median, {:.2g} % at the 99th percentile; "
      "{} missed deeper than 0.5 % D; {}; {:.0f} ns a look",
      row.subject->name, row.kernel->name, row.kernel->accuracy, median, far, all.missed,
      std::isfinite(row.spread) ? fmt::format("stiffness within a factor of {:.2g}", row.spread)
                                : std::string("a kind of touch is not seen at 0.5 % D"),
      row.ns));
}

Series& last_or_new(Picture& picture, const std::string& name) {
  if (picture.series.empty() || picture.series.back().name != name)
    picture.series.push_back({name, {}, {}, {}, {}});
  return picture.series.back();
}

void add_point(Picture& picture, const Row& row, double y) {
  Series& series = last_or_new(picture, row.subject->name + ", " + row.kernel->name);
  series.x.push_back(row.ns);
  series.y.push_back(y);
  series.label.push_back(row.kernel->accuracy);
}

std::vector<Touch> law_at(const ContactKernel& kernel, const std::vector<PosePair>& pairs) {
  std::vector<Touch> law;
  for (const PosePair& p : pairs) law.push_back(kernel.law(p.a, p.b));
  return law;
}

void run_subject(const ContactSubject& subject, int poses, Outcome& out) {
  const std::vector<PosePair> pairs = random_pairs(subject, poses);
  std::vector<Touch> law;
  const ContactKernel* before = nullptr;
  for (const ContactKernel& kernel : subject.kernels) {
    if (!before || before->name != kernel.name) law = law_at(kernel, pairs);  // kernels of one name share it
    before = &kernel;
    Row row{};
    const Errors all = run_kernel(subject, kernel, pairs, law, out.table, row);
    tell(out, row, all);
    add_point(out.pictures[0], row, 100 * quantile(all.force, 0.5));
    if (subject.solid->convex) add_point(out.pictures[1], row, quantile(all.angle, 0.5));
  }
}

}  // namespace

Outcome bench_contact(const Options& options) {
  Outcome out;
  out.table.columns = {"pellet",
                       "kernel",
                       "accuracy",
                       "depth [% D]",
                       "poses",
                       "force error, median [%]",
                       "force error, 99th percentile [%]",
                       "torque error, median [% F D]",
                       "torque error, 99th percentile [% F D]",
                       "angle to the pressure field, median [deg]",
                       "angle to the pressure field, 99th percentile [deg]",
                       "line of action, median [% D]",
                       "converged law: angle, median [deg]",
                       "converged law: line of action, median [% D]",
                       "missed deeper than 0.5 % D",
                       "stiffness, largest over smallest",
                       "a look [ns]"};
  const Axis cost{"CPU time a look [ns]", true};
  out.pictures = {
      {"contact_force",
       "Force against the converged law",
       cost,
       {"error of the force, median [%]", true},
       {}},
      {"contact_angle", "Direction against the pressure field", cost, {"angle, median [deg]", true}, {}}};
  SubjectWish wish;
  if (options.quick) wish.finest = 28, wish.across = {8, kPointsAcross};
  for_subjects(wish, [&](const ContactSubject& subject) {
    options.tell("contact: " + subject.name);
    run_subject(subject, options.quick ? 60 : 10000, out);
  });
  return out;
}

}  // namespace packbed::bench
