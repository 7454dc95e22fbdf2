#include "contact/surface_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "mesh/topology.hpp"

namespace packbed {
namespace {

struct Sample {
  Vec3 x = Vec3::Zero();
  Vec3 normal = Vec3::Zero();  // of faces and edges, for telling the two sides of a plate apart
  double weight = 0;           // [m]
};

constexpr double kGolden = 2.399963229728653;    // angle that spreads points evenly round a spiral [rad]
constexpr double kHexagon = 0.8660254037844386;  // area a point of a hexagonal lattice of unit spacing
constexpr double kFine = 1.0 / 3;  // spacing of the dense samples that the points are chosen from
constexpr double kStep = 0.2;      // between spacings on faces of different curvature, of the logarithm
constexpr int kRounds = 3;         // of moving the points to the middle of what they stand for (Lloyd)

std::size_t points_on(double area, double spacing) {
  return static_cast<std::size_t>(std::max(1.0, std::round(area / (kHexagon * spacing * spacing))));
}

/// Spacing of points on faces by how curved these are.
struct FaceSpacing {
  double flat;                         // [m]
  double bulge;                        // [m]
  double of(double curvature) const {  // k1 + k2 [1/m]
    const double share = curvature > 0 ? std::sqrt(8 * bulge / curvature) / flat : 1.0;
    return flat * std::clamp(share, kClosest, 1.0);
  }
};

FaceSpacing face_spacing(const Shape& shape, double spacing) {
  const double relative = spacing * kPointsAcross / shape.equivalent_diameter();
  return {spacing, kBulge * shape.smallest_thickness * relative * relative};
}

// --- sphere, cylinder and tube: evenly spread --------------------------------------------------------

std::vector<Sample> sphere_samples(double radius, const FaceSpacing& faces) {
  const double area = 4 * kPi * radius * radius, spacing = faces.of(2 / radius);
  const std::size_t n = std::max<std::size_t>(12, points_on(area, spacing));
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < n; ++i) {
    const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(n), r = std::sqrt(1 - z * z);
    const double angle = kGolden * static_cast<double>(i);
    const Vec3 normal(r * std::cos(angle), r * std::sin(angle), z);
    samples.push_back({radius * normal, normal, area / static_cast<double>(n) * (1 + 2 * kCurved) / radius});
  }
  return samples;
}

/// `size` makes areas lengths [m]; the hole of the cap may be 0 wide.
void add_cap(std::vector<Sample>& samples, double radius, double hole, double z, double size,
             double spacing) {
  const double area = kPi * (radius * radius - hole * hole);
  const std::size_t n = std::max<std::size_t>(7, points_on(area, spacing));
  for (std::size_t i = 0; i < n; ++i) {
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    const double r = std::sqrt(hole * hole + share * (radius * radius - hole * hole));
    const double angle = kGolden * static_cast<double>(i);
    samples.push_back({{r * std::cos(angle), r * std::sin(angle), z},
                       {0, 0, z > 0 ? 1.0 : -1.0},
                       area / static_cast<double>(n) / size});
  }
}

/// Rows of a hexagonal pattern, every other one shifted, and both rims. `inner`: of a hole, which is hollow
/// and has no curvature that would count.
void add_side(std::vector<Sample>& samples, double radius, double half_height, bool inner, double size,
              const FaceSpacing& faces) {
  const double round = 2 * kPi * radius, height = 2 * half_height;
  const double spacing = inner ? faces.flat : faces.of(1 / radius);
  const auto rows = static_cast<std::size_t>(std::max(1.0, std::round(height / (kHexagon * spacing))));
  const auto columns = static_cast<std::size_t>(std::max(6.0, std::round(round / spacing)));
  const double cell = round * height / static_cast<double>(rows * columns);
  const double outward = inner ? -1.0 : 1.0, weight = 1 / size + (inner ? 0 : kCurved / radius);
  for (std::size_t k = 0; k < rows; ++k)
    for (std::size_t i = 0; i < columns; ++i) {
      const double angle = 2 * kPi * (static_cast<double>(i) + 0.5 * static_cast<double>(k % 2)) /
                           static_cast<double>(columns);
      const Vec3 out(std::cos(angle), std::sin(angle), 0);
      const double z = height * ((static_cast<double>(k) + 0.5) / static_cast<double>(rows) - 0.5);
      samples.push_back({radius * out + Vec3(0, 0, z), outward * out, cell * weight});
    }
  const auto n = static_cast<std::size_t>(std::max(12.0, std::round(round / (kEdgeSpacing * faces.flat))));
  for (const double side : {-1.0, 1.0})
    for (std::size_t i = 0; i < n; ++i) {
      const double angle = 2 * kPi * static_cast<double>(i) / static_cast<double>(n);
      const Vec3 out(std::cos(angle), std::sin(angle), 0);
      samples.push_back({radius * out + Vec3(0, 0, side * half_height),
                         (outward * out + Vec3(0, 0, side)).normalized(),
                         kEdge * kPi / 2 * round / static_cast<double>(n)});
    }
}

/// Of a cylinder, or of a tube when inner_radius is not 0.
std::vector<Sample> tube_samples(const Shape& shape, double size, const FaceSpacing& faces) {
  std::vector<Sample> samples;
  for (const double side : {1.0, -1.0})
    add_cap(samples, shape.radius, shape.inner_radius, side * shape.half_height, size, faces.flat);
  add_side(samples, shape.radius, shape.half_height, false, size, faces);
  if (shape.inner_radius > 0) add_side(samples, shape.inner_radius, shape.half_height, true, size, faces);
  return samples;
}

// --- meshes -----------------------------------------------------------------------------------------------

/// Cut at the longest side until none is longer than `longest`.
void cut_triangle(const Vec3& a, const Vec3& b, const Vec3& c, double longest, const Vec3& normal,
                  double density, std::vector<Sample>& out) {
  const double ab = (b - a).squaredNorm(), bc = (c - b).squaredNorm(), ca = (a - c).squaredNorm();
  if (std::max({ab, bc, ca}) <= longest * longest) {
    out.push_back({(a + b + c) / 3, normal, 0.5 * (b - a).cross(c - a).norm() * density});
  } else if (ab >= bc && ab >= ca) {
    const Vec3 m = 0.5 * (a + b);
    cut_triangle(a, m, c, longest, normal, density, out);
    cut_triangle(m, b, c, longest, normal, density, out);
  } else if (bc >= ca) {
    cut_triangle(b, c, a, longest, normal, density, out);
  } else {
    cut_triangle(c, a, b, longest, normal, density, out);
  }
}

/// Distance that takes points on surfaces of different direction for distant.
double apart2(const Sample& a, const Sample& b, double spacing) {
  return (a.x - b.x).squaredNorm() + spacing * spacing * (a.normal - b.normal).squaredNorm();
}

/// Farthest-point choice: every sample ends within about 3/4 of the spacing of a chosen one, and gives it its
/// weight. The samples are sorted along z, so that a new point is held only against those that it can serve
/// better. `seed_of` (n): which point a sample belongs to.
std::vector<std::size_t> choose(const std::vector<Sample>& dense, double spacing,
                                std::vector<std::size_t>& seed_of) {
  constexpr std::size_t kRun = 128;
  const std::size_t n = dense.size(), runs = (n + kRun - 1) / kRun;
  std::vector<std::size_t> chosen, worst(runs, 0);  // worst: the worst served sample of each run
  std::vector<double> distance2(n, std::numeric_limits<double>::infinity());
  for (std::size_t run = 0; run < runs; ++run) worst[run] = run * kRun;
  seed_of.assign(n, 0);
  const double enough = 0.75 * spacing;
  for (std::size_t next = 0; n > 0;) {
    chosen.push_back(next);
    const double reach = std::sqrt(distance2[next]), z = dense[next].x.z();
    for (std::size_t run = 0; run < runs; ++run) {
      const std::size_t first = run * kRun, last = std::min(n, first + kRun);
      if (dense[first].x.z() > z + reach || dense[last - 1].x.z() < z - reach) continue;
      for (std::size_t i = first; i < last; ++i) {
        const double d2 = apart2(dense[i], dense[next], spacing);
        if (d2 < distance2[i]) distance2[i] = d2, seed_of[i] = chosen.size() - 1;
      }
      worst[run] = first;
      for (std::size_t i = first; i < last; ++i)
        if (distance2[i] > distance2[worst[run]]) worst[run] = i;
    }
    next = worst[0];
    for (const std::size_t i : worst)
      if (distance2[i] > distance2[next]) next = i;
    if (distance2[next] <= enough * enough) break;
  }
  return chosen;
}

/// Chosen samples in cells, for finding those near a place.
class Cells {
 public:
  Cells(const std::vector<Sample>& dense, const std::vector<std::size_t>& chosen, double side) {
    for (const Sample& s : dense) box_.extend(s.x);
    side_ = std::max(side, box_.sizes().maxCoeff() / 200);  // at most 8 million cells
    for (int k = 0; k < 3; ++k) n_[k] = static_cast<std::int64_t>(box_.sizes()[k] / side_) + 1;
    first_.assign(static_cast<std::size_t>(n_[0] * n_[1] * n_[2]) + 1, 0);
    const auto cell = [&](std::size_t k) { return index(at(dense[chosen[k]].x)); };
    for (std::size_t k = 0; k < chosen.size(); ++k) ++first_[cell(k) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    member_.resize(chosen.size());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t k = 0; k < chosen.size(); ++k) member_[next[cell(k)]++] = k;
  }
  template <class Visit>
  void visit(const Vec3& x, const Visit& visit) const {
    const std::array<std::int64_t, 3> c = at(x);
    for (std::int64_t k = std::max<std::int64_t>(0, c[2] - 1); k <= std::min(n_[2] - 1, c[2] + 1); ++k)
      for (std::int64_t j = std::max<std::int64_t>(0, c[1] - 1); j <= std::min(n_[1] - 1, c[1] + 1); ++j) {
        const std::size_t from = index({std::max<std::int64_t>(0, c[0] - 1), j, k});
        const std::size_t to = index({std::min(n_[0] - 1, c[0] + 1), j, k});
        for (std::size_t m = first_[from]; m < first_[to + 1]; ++m) visit(member_[m]);
      }
  }

 private:
  std::array<std::int64_t, 3> at(const Vec3& x) const {
    std::array<std::int64_t, 3> c;
    for (int k = 0; k < 3; ++k)
      c[static_cast<std::size_t>(k)] = static_cast<std::int64_t>((x[k] - box_.min()[k]) / side_);
    return c;
  }
  std::size_t index(const std::array<std::int64_t, 3>& c) const {
    return static_cast<std::size_t>((c[2] * n_[1] + c[1]) * n_[0] + c[0]);
  }
  Box3 box_;
  double side_ = 0;
  std::int64_t n_[3];
  std::vector<std::size_t> first_, member_;
};

/// Every sample to the nearest of the chosen ones. None of these has moved by more than 3/4 of a spacing
/// since each sample had one as near, so only those within 3/2 are asked.
void assign(const std::vector<Sample>& dense, const std::vector<std::size_t>& chosen, double spacing,
            std::vector<std::size_t>& seed_of) {
  const Cells cells(dense, chosen, 1.51 * spacing);
  for (std::size_t i = 0; i < dense.size(); ++i) {
    double nearest = std::numeric_limits<double>::infinity();
    cells.visit(dense[i].x, [&](std::size_t k) {
      const double d2 = apart2(dense[i], dense[chosen[k]], spacing);
      if (d2 < nearest || (d2 == nearest && k < seed_of[i])) nearest = d2, seed_of[i] = k;
    });
  }
}

/// A sparse set of the dense samples with their weights gathered. `cover` grows to the distance within which
/// every point of the surface has one of them.
std::vector<Sample> thinned(std::vector<Sample> dense, double spacing, double* cover = nullptr) {
  std::stable_sort(dense.begin(), dense.end(),
                   [](const Sample& a, const Sample& b) { return a.x.z() < b.x.z(); });
  std::vector<std::size_t> seed_of;
  std::vector<std::size_t> chosen = choose(dense, spacing, seed_of);
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Sample> mean(chosen.size());
    for (std::size_t i = 0; i < dense.size(); ++i) {
      Sample& m = mean[seed_of[i]];
      m.x += dense[i].weight * dense[i].x;
      m.normal += dense[i].weight * dense[i].normal;
      m.weight += dense[i].weight;
    }
    for (Sample& m : mean) m.x /= m.weight, m.normal /= m.weight;
    std::vector<double> best(chosen.size(), std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < dense.size(); ++i) {  // the sample nearest to the middle takes over
      const double d2 = apart2(dense[i], mean[seed_of[i]], spacing);
      if (d2 < best[seed_of[i]]) best[seed_of[i]] = d2, chosen[seed_of[i]] = i;
    }
    assign(dense, chosen, spacing, seed_of);
  }
  std::vector<Sample> out;
  for (const std::size_t i : chosen) out.push_back({dense[i].x, dense[i].normal, 0});
  for (std::size_t i = 0; i < dense.size(); ++i) out[seed_of[i]].weight += dense[i].weight;
  if (cover)
    for (std::size_t i = 0; i < dense.size(); ++i)
      *cover = std::max(*cover, (dense[i].x - out[seed_of[i]].x).norm() + kFine * spacing / std::sqrt(3.0));
  return out;
}

std::vector<Sample> face_samples(const TriangleMesh& mesh, const std::vector<Vec3>& normal,
                                 const std::vector<MeshEdge>& edges, double size, const FaceSpacing& faces,
                                 double& cover) {
  std::vector<double> curved(mesh.triangles.size(), 0.0);  // (k1 + k2) area of each triangle [m]
  for (const MeshEdge& e : edges) {
    if (!(e.angle > 0) || e.angle >= kSharpAngle) continue;
    curved[static_cast<std::size_t>(e.left)] += 0.5 * e.angle * edge_vector(mesh, e).norm();
    curved[static_cast<std::size_t>(e.right)] += 0.5 * e.angle * edge_vector(mesh, e).norm();
  }
  const auto spacing_of = [&](int step) { return faces.flat * std::exp(-kStep * step); };
  std::map<int, std::vector<Sample>> dense;  // by spacing, in steps down from that on flat faces
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    const double area = triangle_area_vector(mesh, t).norm();
    if (!(area > 0)) continue;
    const int step = static_cast<int>(std::ceil(std::log(faces.flat / faces.of(curved[i] / area)) / kStep));
    cut_triangle(corner(mesh, t, 0), corner(mesh, t, 1), corner(mesh, t, 2), kFine * spacing_of(step),
                 normal[i], 1 / size + kCurved * curved[i] / area, dense[step]);
  }
  std::vector<Sample> all;
  for (auto& [step, samples] : dense) {
    const std::vector<Sample> kept = thinned(std::move(samples), spacing_of(step), &cover);
    all.insert(all.end(), kept.begin(), kept.end());
  }
  return all;
}

std::vector<Sample> edge_samples(const TriangleMesh& mesh, const std::vector<Vec3>& normal,
                                 const std::vector<MeshEdge>& edges, double spacing) {
  std::vector<Sample> samples;
  for (const MeshEdge& e : edges) {
    if (e.angle < kSharpAngle) continue;
    const Vec3 &a = mesh.vertices[static_cast<std::size_t>(e.low)],
               &b = mesh.vertices[static_cast<std::size_t>(e.high)];
    const Vec3 n =
        (normal[static_cast<std::size_t>(e.left)] + normal[static_cast<std::size_t>(e.right)]).normalized();
    const double length = (b - a).norm();
    const int parts = std::max(1, static_cast<int>(std::round(length / spacing)));
    for (int k = 0; k < parts; ++k)
      samples.push_back({a + (k + 0.5) / parts * (b - a), n, kEdge * e.angle * length / parts});
  }
  return samples;
}

std::vector<Sample> corner_samples(const TriangleMesh& mesh, const std::vector<MeshEdge>& edges,
                                   double size) {
  std::vector<double> missing(mesh.vertices.size(), 2 * kPi);
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const Vec3 u = corner(mesh, t, (k + 1) % 3) - corner(mesh, t, k),
                 v = corner(mesh, t, (k + 2) % 3) - corner(mesh, t, k);
      missing[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])] -=
          std::atan2(u.cross(v).norm(), u.dot(v));
    }
  std::vector<int> sharp(mesh.vertices.size(), 0);
  for (const MeshEdge& e : edges)
    if (e.angle >= kSharpAngle)
      ++sharp[static_cast<std::size_t>(e.low)], ++sharp[static_cast<std::size_t>(e.high)];
  std::vector<Sample> out;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    if (missing[i] > 0 && (sharp[i] > 2 || missing[i] > 1))  // where edges meet, and tips
      out.push_back({mesh.vertices[i], Vec3::Zero(), kCorner * size * missing[i]});
  return out;
}

std::vector<Sample> mesh_samples(const TriangleMesh& mesh, double size, const FaceSpacing& faces,
                                 double& cover) {
  std::vector<Vec3> normal;
  for (const auto& t : mesh.triangles) normal.push_back(triangle_area_vector(mesh, t).normalized());
  const std::vector<MeshEdge> edges = mesh_edges(mesh);
  std::vector<Sample> all = face_samples(mesh, normal, edges, size, faces, cover);
  for (const Sample& s : edge_samples(mesh, normal, edges, kEdgeSpacing * faces.flat)) all.push_back(s);
  for (const Sample& s : corner_samples(mesh, edges, size)) all.push_back(s);
  return all;
}

// --- clusters ---------------------------------------------------------------------------------------------

/// Sorts so that every run of kCluster lies together: halves at multiples of kCluster along the longest side.
void sort_into_clusters(std::vector<Sample>& s, std::size_t first, std::size_t last) {
  const std::size_t clusters = (last - first + kCluster - 1) / kCluster;
  if (clusters < 2) return;
  Box3 box;
  for (std::size_t i = first; i < last; ++i) box.extend(s[i].x);
  int axis = 0;
  box.sizes().maxCoeff(&axis);
  const std::size_t middle = first + clusters / 2 * kCluster;
  const auto at = [&](std::size_t i) { return s.begin() + static_cast<std::ptrdiff_t>(i); };
  std::stable_sort(at(first), at(last),
                   [axis](const Sample& a, const Sample& b) { return a.x[axis] < b.x[axis]; });
  sort_into_clusters(s, first, middle);
  sort_into_clusters(s, middle, last);
}

SurfacePoints clustered(std::vector<Sample> samples) {
  sort_into_clusters(samples, 0, samples.size());
  SurfacePoints points;
  for (std::size_t first = 0; first < samples.size(); first += kCluster) {
    const std::size_t last = std::min(samples.size(), first + kCluster);
    Box3 box;
    for (std::size_t i = first; i < last; ++i) box.extend(samples[i].x);
    const Vec3 centre = box.center();
    double radius = 0;
    for (std::size_t i = first; i < first + kCluster; ++i) {
      const Sample& s = samples[std::min(i, last - 1)];
      points.x.push_back(s.x.x());
      points.y.push_back(s.x.y());
      points.z.push_back(s.x.z());
      points.weight.push_back(i < last ? s.weight : 0);
      radius = std::max(radius, (s.x - centre).norm());
    }
    points.cluster_x.push_back(centre.x());
    points.cluster_y.push_back(centre.y());
    points.cluster_z.push_back(centre.z());
    points.cluster_radius.push_back(radius * (1 + 1e-12));
  }
  return points;
}

}  // namespace

double size_radius(const Shape& shape) {
  return seen_as_mesh(shape.kind) ? std::cbrt(3 * shape.volume / (4 * kPi)) : shape.radius;
}

SurfacePoints sample_surface(const Shape& shape, double spacing) {
  double cover = spacing;  // of evenly spread points, of which the worst is 0.8 spacings
  const double size = size_radius(shape);
  const FaceSpacing faces = face_spacing(shape, spacing);
  const auto samples = [&] {
    if (shape.kind == ShapeClass::sphere) return sphere_samples(shape.radius, faces);
    if (shape.kind == ShapeClass::cylinder || shape.kind == ShapeClass::tube)
      return tube_samples(shape, size, faces);
    cover = 0;
    return mesh_samples(shape.surface, size, faces, cover);
  };
  SurfacePoints points = clustered(samples());
  points.cover = cover;
  return points;
}

}  // namespace packbed
