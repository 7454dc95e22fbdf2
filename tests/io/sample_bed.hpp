#pragma once
// A bed made up of random cylinders in a tube, with every field set to something that a reader could lose. It
// is no physical packing: pellets stand on a jittered lattice that leaves them apart.
#include <cmath>

#include "analysis/results.hpp"
#include "bed/packed_bed.hpp"
#include "bed/run_record.hpp"
#include "bed/scene.hpp"
#include "math/random.hpp"

namespace packbed {

inline TriangleMesh cylinder_surface(double radius, double half_height, int facets = 24) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, -half_height}, {0, 0, half_height}};
  for (int i = 0; i < facets; ++i)
    for (const double z : {-half_height, half_height})
      mesh.vertices.emplace_back(radius * std::cos(2 * kPi * i / facets),
                                 radius * std::sin(2 * kPi * i / facets), z);
  for (int i = 0; i < facets; ++i) {
    const int a = 2 + 2 * i, b = 2 + 2 * ((i + 1) % facets);
    mesh.triangles.push_back({0, b, a});
    mesh.triangles.push_back({1, a + 1, b + 1});
    mesh.triangles.push_back({a, b, b + 1});
    mesh.triangles.push_back({a, b + 1, a + 1});
  }
  return mesh;
}

inline ShapePtr sample_cylinder(const std::string& name = "a38") {
  auto shape = std::make_shared<Shape>();
  shape->name = name;
  shape->source = "sample \"cylinder\"";
  shape->kind = ShapeClass::cylinder;
  shape->radius = 1.71e-3;
  shape->half_height = 1.73e-3;
  shape->volume = kPi * std::pow(shape->radius, 2) * 2 * shape->half_height;
  shape->area = 2 * kPi * shape->radius * (shape->radius + 2 * shape->half_height);
  shape->inertia = Vec3(1.1e-15, 1.2e-15, 1.3e-15);
  shape->bounding_radius = std::hypot(shape->radius, shape->half_height);
  shape->smallest_thickness = 2 * shape->radius;
  shape->surface = cylinder_surface(shape->radius, shape->half_height);
  shape->mesh_volume = 0.99 * shape->volume;
  shape->from_file.position = Vec3(0.1, -0.2, 1.0 / 3);
  shape->from_file.rotation = Quat(0.5, -0.5, 0.5, 0.5);
  return shape;
}

inline ShapePtr sample_mesh_pellet() {
  auto shape = std::make_shared<Shape>(*sample_cylinder("tetrahedron"));
  shape->kind = ShapeClass::mesh;
  shape->radius = shape->half_height = 0;
  shape->surface = {{{0, 0, 0}, {3e-3, 0, 0}, {0, 3e-3, 0}, {0, 0, 3e-3}},
                    {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  shape->tets = TetMesh{shape->surface.vertices, {{0, 1, 2, 3}}};
  return shape;
}

inline PackedBed sample_bed(int pellets = 300) {
  PackedBed bed;
  bed.shapes = {sample_cylinder()};
  bed.densities = {2410};
  bed.container.kind = ContainerKind::tube;
  bed.container.name = "lc";
  bed.container.source = "sizes";
  bed.container.radius = 22.25e-3;
  bed.container.height = 0.12;
  const double spacing = 4.0e-3;
  for (int layer = 0; static_cast<int>(bed.pellets.size()) < pellets; ++layer)
    for (int i = -5; i <= 5; ++i)
      for (int j = -5; j <= 5; ++j) {
        const auto id = static_cast<std::uint32_t>(bed.pellets.size());
        if (std::hypot(i * spacing, j * spacing) > bed.container.radius - 2.6e-3 ||
            static_cast<int>(id) == pellets)
          continue;
        Random random(1, Stream::test, id);
        Pellet p;
        p.id = id;
        p.pose.position = Vec3(i * spacing, j * spacing, 2.5e-3 + layer * spacing) +
                          Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)) * 4e-4;
        p.pose.rotation = random.rotation();
        p.velocity = random.on_sphere() * 1e-5;
        p.spin = random.on_sphere() / 3;
        p.fixed = id % 7 == 0;
        bed.pellets.push_back(p);
      }
  for (std::uint32_t i = 0; i + 1 < bed.pellets.size(); ++i)
    bed.contacts.push_back({i, i % 10 == 0 ? kContainer : i + 1, bed.pellets[i].pose.position,
                            Vec3(0, 1e-4, i / 3.0), 1e-6 / (i + 1)});
  bed.provenance = {"name = \"sample\"\n[feed]\ncount = 300 # µ, ü and \"quotes\"\n",
                    "cases/sample.toml",
                    "0.1.0",
                    "mesh",
                    "cylinder",
                    0xfedcba9876543210ULL};
  return bed;
}

inline RunRecord sample_record() {
  RunRecord r;
  r.method = "mesh";
  r.kernel = "cylinder";
  r.bed_hash = "0123456789abcdef";
  r.seed = 0xfedcba9876543210ULL;
  r.threads = 2;
  r.pellets = {300, 300, 299, 1};
  r.at_rest = true;
  r.audit = {{"pellets", false, "299 of 300 inside, 1 escaped (limit 0)"},
             {"rest", true, "mean speed 0.02 mm/s (limit 1 mm/s)"},
             {"overlap", true, "largest 0.31 % (limit 0.5 %)"},
             {"energy", true, "ledger open by 0.12 % (limit 1 %)"}};
  r.time.wall_s = 41.5;
  r.time.cpu_s = 78.25;
  r.time.setup_s = 0.3;
  r.time.step_s = 5e-6;
  r.time.simulated_s = 1.0 / 3;
  r.time.steps = 66667;
  r.time.phases_s = {{"find_pairs", 10.1}, {"collide", 55.0}, {"integrate", 8.0}};
  r.peak_rss_bytes = 123456789;
  r.overlap = {3e-4, 3.1e-3, 0.041, 2e-4};
  r.energy = {0.123, 1e-9, 0.04, 1e-6, 0.03, 0.05, 0.002, 1.2e-3};
  r.wall = {1.5, 0.7, 2.2};
  r.counters = {{"contacts", 1.5e9}, {"rebuilds", 812}};
  r.notes = {"waited 0.4 s for room at layer 12"};
  return r;
}

inline Scene sample_scene() {
  const PackedBed bed = sample_bed(1);
  Scene scene;
  scene.name = "sample";
  scene.case_file = "cases/sample.toml";
  scene.case_text = bed.provenance.case_text;
  scene.pellets = {{bed.shapes[0], 2410, 1}};
  scene.container = bed.container;
  return scene;
}

/// Curves with the waves that beds have, made from formulas.
inline AnalysisResult sample_analysis(const PackedBed& bed) {
  AnalysisResult a;
  const double dp = 3.9e-3;
  a.bed_height_m = 36e-3;
  a.bulk = {0.5923,
            0.5921,
            0.0061,
            {3 * dp, 8 * dp},
            1e-4,
            dp,
            "solid voxels over voxels inside the tube, 3 to 8 dp above the floor, voxel 0.1 mm"};
  for (int i = 0; i < 360; ++i) {
    const double z = (i + 0.5) * 1e-4;
    a.axial.x_m.push_back(z);
    a.axial.x_dp.push_back(z / dp);
    a.axial.exact.push_back(0.592 + 0.25 * std::exp(-z / dp) * std::cos(2 * kPi * z / dp));
    a.axial.density.push_back(a.axial.exact.back() + 0.004 * std::sin(i * 1.7));
  }
  for (int i = 0; i < 222; ++i) {
    const double x = (i + 0.5) * 1e-4;
    a.radial.x_m.push_back(x);
    a.radial.x_dp.push_back(x / dp);
    a.radial.exact.push_back(0.592 - 0.3 * std::exp(-0.6 * x / dp) * std::cos(2 * kPi * x / dp));
    a.radial.density.push_back(a.radial.exact.back() + 0.004 * std::sin(i * 2.3));
  }
  PlanarMap map;
  map.size = {89, 89};
  map.pitch = 5e-4;
  map.origin = Vec3(-44.5 * map.pitch, -44.5 * map.pitch, 0);
  for (int y = 0; y < 89; ++y)
    for (int x = 0; x < 89; ++x) {
      const double r = std::hypot(x - 44, y - 44) * map.pitch;
      const double d = (22.25e-3 - r) / dp;
      map.density.push_back(
          d < 0 ? NAN : static_cast<float>(0.592 - 0.3 * std::exp(-0.6 * d) * std::cos(2 * kPi * d)));
    }
  a.planar = map;
  Orientation o;
  for (int i = 0; i < 9; ++i) {
    o.from_deg.push_back(10.0 * i);
    o.to_deg.push_back(10.0 * (i + 1));
    o.count.push_back(0);
    o.isotropic.push_back(std::cos(i * kPi / 18) - std::cos((i + 1) * kPi / 18));
  }
  for (const Pellet& p : bed.pellets) {
    Vec3 axis = p.pose.rotation * Vec3::UnitZ();
    if (axis.z() > 0) axis = -axis;
    const double angle = std::acos(-axis.z()) * 180 / kPi;
    o.angle_deg.push_back(angle);
    o.count[static_cast<std::size_t>(std::min(8, static_cast<int>(angle / 10)))]++;
    const double r = std::sqrt(1 + axis.z()), s = std::hypot(axis.x(), axis.y());
    o.lambert.push_back({r * axis.x() / s, r * axis.y() / s});
  }
  for (const int c : o.count) o.fraction.push_back(c / static_cast<double>(bed.pellets.size()));
  a.orientation = o;
  OverlapAudit overlap;
  overlap.mean = 3e-4;
  overlap.max = 3.1e-3;
  overlap.pairs = 900;
  overlap.volume = 1e-12;
  for (const Pellet& p : bed.pellets)
    overlap.pellet.push_back(3.1e-3 * std::pow(Random(3, Stream::test, p.id).uniform(), 3));
  a.overlap = overlap;
  a.voxelise_cpu_s = 0.21;
  a.analyse_cpu_s = 0.4;
  return a;
}

}  // namespace packbed
