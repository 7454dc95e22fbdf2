// Contact at poses that nobody plans for, and settings that nobody should make.
#include <fmt/format.h>

#include <cmath>

#include "analysis/analyse.hpp"
#include "bench/contact_poses.hpp"
#include "bench/stability.hpp"
#include "io/case.hpp"
#include "math/error.hpp"
#include "math/random.hpp"
#include "packers/packer.hpp"

namespace packbed::bench {
namespace {

/// A pair that is random, or parallel, square, coaxial, level, coincident, or off one of these by next to
/// nothing.
PosePair fuzzed(const ContactSubject& subject, Random& random) {
  const double d = subject.size;
  PosePair pair;
  pair.a.rotation = random.rotation();
  pair.b.rotation = random.rotation();
  pair.b.position = random.uniform(0, 1.6) * d * random.on_sphere();
  const auto kind = random.bits() % 8;
  if (kind >= 2) pair.b.rotation = pair.a.rotation;
  if (kind == 3) pair.b.rotation = pair.b.rotation * Quat(Eigen::AngleAxisd(kPi / 2, Vec3::UnitX()));
  if (kind == 4) pair.b.position = random.uniform(0.9, 1.1) * d * (pair.a.rotation * Vec3::UnitZ());
  if (kind == 5) pair.b.position = random.uniform(0.9, 1.1) * d * (pair.a.rotation * Vec3::UnitX());
  if (kind == 6) pair.b.position = Vec3::Zero();
  if (random.bits() % 2) {
    const double tiny = std::pow(10.0, random.uniform(-320, -6));
    pair.b.position += tiny * random.on_sphere();
    pair.b.rotation = (pair.b.rotation * Quat(Eigen::AngleAxisd(tiny, random.on_sphere()))).normalized();
  }
  return pair;
}

/// What became of one wild setting.
Verdict try_setting(const std::string& case_file, const std::string& setting) {
  Verdict v{"case with " + setting, "refused with words, or the audit fails, or a good bed", "", false};
  try {
    Scene scene = read_case(case_file, {"feed.count=49", "stepping.max_time=\"3 s\"", setting});
    const PackResult result = pack(scene, {});
    AnalysisWish wish = scene.analysis;
    wish.voxels = wish.exact = wish.orientation = false;
    const AnalysisResult analysis = analyse_bed(result.bed, wish);
    const double overlap = analysis.overlap ? analysis.overlap->max : 0;
    const bool good = result.record.audit_passed() && overlap <= scene.overlap_limit;
    double fastest = 0, lowest = 0;
    bool finite = true;
    for (const Pellet& p : result.bed.pellets) {
      finite = finite && p.pose.position.allFinite() && p.velocity.allFinite();
      fastest = std::max(fastest, p.velocity.norm());
      lowest = std::min(lowest, p.pose.position.z());
    }
    // a bed that is called good is good by what can be seen of it here
    v.passed = !good || (finite && lowest >= 0 && fastest < 0.1);
    v.found = good ? "a good bed" : "audit failed";
    for (const AuditLine& line : result.record.audit)
      if (!line.passed) v.found += ": " + line.finding;
  } catch (const InputError& error) {
    v.passed = true;
    v.found = fmt::format("refused: {}", error.what());
    v.found = v.found.substr(0, v.found.find('\n'));
  }
  return v;
}

}  // namespace

Verdict forces_stay_finite(const std::string& kernel, int poses) {
  ContactSubject subject;
  for_subjects({.only = "A38", .finest = 14, .across = {14}}, [&](const ContactSubject& s) { subject = s; });
  const auto& found = *std::find_if(subject.kernels.begin(), subject.kernels.end(),
                                    [&](const ContactKernel& k) { return k.name == kernel; });
  // an explicit step is stable while its square times k |gradient|^2 (1 / m + 1 / m) is under 4
  const double steepest = 2 * Stepping{}.steps_per_contact / kPi;
  int wrong = 0, missed = 0;
  double largest = 0;
  for (int i = 0; i < poses; ++i) {
    Random random(17, Stream::test, static_cast<std::uint32_t>(i));
    const PosePair pair = fuzzed(subject, random);
    const Touch t = found.touch(pair.a, pair.b);
    const bool finite = std::isfinite(t.delta) && t.gradient.allFinite() && t.torque_a.allFinite() &&
                        t.torque_b.allFinite() && t.point.allFinite();
    if (!finite || t.delta < 0) ++wrong;
    largest = std::max(largest, t.gradient.norm());
    if (t.delta > 0) continue;
    const auto p = penetration(subject.at(pair.a), subject.at(pair.b));
    // coincident bodies have no way out that is shorter than another: only touches are asked for
    if (p && p->depth > 0.005 * subject.size && p->depth < 0.1 * subject.size) ++missed;
  }
  return {fmt::format("{} kernel at {} random and degenerate poses", kernel, poses),
          fmt::format("every force finite, gradient under {:.3g} so that the step is stable, nothing missed "
                      "from 0.5 to 10 % D",
                      steepest),
          fmt::format("{} not finite, {} missed, largest gradient {:.2g}", wrong, missed, largest),
          wrong == 0 && missed == 0 && largest < steepest};
}

std::vector<Verdict> wild_settings(const std::string& case_file) {
  std::vector<Verdict> out;
  for (const char* setting : {"stepping.steps_per_contact=1",
                              "stepping.step=\"1 ms\"",
                              "contact.stiffness=\"1 N/m\"",
                              "contact.stiffness=\"1e7 N/m\"",
                              "contact.friction=-0.5",
                              "contact.friction=1e6",
                              "contact.damping=5",
                              "contact.allowed_overlap=0.9",
                              "feed.drop_height=\"-1 m\"",
                              "feed.drop_height=\"10 m\"",
                              "feed.interval=\"0 s\"",
                              "feed.per_layer=100000",
                              "feed.count=-3",
                              "pellet.density=\"0 g/cm3\"",
                              "pellet.density=\"1e9 kg/m3\"",
                              "container.file=\"../meshes/a38.step\"",
                              "pellet.file=\"../meshes/lc.step\"",
                              "stepping.skin=\"1 m\"",
                              "stepping.sleep_displacement=0.5",
                              "analysis.voxel=\"1 nm\""})
    out.push_back(try_setting(case_file, setting));
  return out;
}

}  // namespace packbed::bench
