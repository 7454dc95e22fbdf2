// What is written is what is read, bit for bit, and nothing else is taken for a bed.
#include "io/bed.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "io/atomic_file.hpp"
#include "io/hdf5_image.hpp"
#include "io/placed_csv.hpp"
#include "io/sample_bed.hpp"
#include "io/summary.hpp"
#include "io/temporary_folder.hpp"
#include "math/error.hpp"

namespace packbed {
namespace {

void expect_same_bits(double a, double b) {
  EXPECT_EQ(std::bit_cast<std::uint64_t>(a), std::bit_cast<std::uint64_t>(b)) << a << " " << b;
}
void expect_same(const Vec3& a, const Vec3& b) {
  for (int k = 0; k < 3; ++k) expect_same_bits(a[k], b[k]);
}
void expect_same(const Pose& a, const Pose& b) {
  expect_same(a.position, b.position);
  for (int k = 0; k < 4; ++k) expect_same_bits(a.rotation.coeffs()[k], b.rotation.coeffs()[k]);
}
void expect_same(const TriangleMesh& a, const TriangleMesh& b) {
  ASSERT_EQ(a.vertices.size(), b.vertices.size());
  for (std::size_t i = 0; i < a.vertices.size(); ++i) expect_same(a.vertices[i], b.vertices[i]);
  EXPECT_EQ(a.triangles, b.triangles);
}
void expect_same(const Shape& a, const Shape& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.source, b.source);
  EXPECT_EQ(a.kind, b.kind);
  for (const auto member : {&Shape::radius, &Shape::half_height, &Shape::volume, &Shape::area,
                            &Shape::bounding_radius, &Shape::smallest_thickness, &Shape::mesh_volume})
    expect_same_bits(a.*member, b.*member);
  expect_same(a.inertia, b.inertia);
  expect_same(a.from_file, b.from_file);
  expect_same(a.surface, b.surface);
  ASSERT_EQ(a.tets.has_value(), b.tets.has_value());
  if (a.tets) {
    EXPECT_EQ(a.tets->tets, b.tets->tets);
  }
}
void expect_same(const PackedBed& a, const PackedBed& b) {
  ASSERT_EQ(a.shapes.size(), b.shapes.size());
  for (std::size_t i = 0; i < a.shapes.size(); ++i) expect_same(*a.shapes[i], *b.shapes[i]);
  EXPECT_EQ(a.densities, b.densities);
  EXPECT_EQ(a.container.kind, b.container.kind);
  EXPECT_EQ(a.container.name, b.container.name);
  expect_same_bits(a.container.radius, b.container.radius);
  expect_same_bits(a.container.height, b.container.height);
  expect_same(a.container.surface, b.container.surface);
  ASSERT_EQ(a.pellets.size(), b.pellets.size());
  for (std::size_t i = 0; i < a.pellets.size(); ++i) {
    const Pellet &p = a.pellets[i], &q = b.pellets[i];
    EXPECT_EQ(p.id, q.id);
    EXPECT_EQ(p.shape, q.shape);
    EXPECT_EQ(p.fixed, q.fixed);
    expect_same(p.pose, q.pose);
    expect_same_bits(p.scale, q.scale);
    expect_same(p.velocity, q.velocity);
    expect_same(p.spin, q.spin);
  }
  ASSERT_EQ(a.contacts.size(), b.contacts.size());
  for (std::size_t i = 0; i < a.contacts.size(); ++i) {
    EXPECT_EQ(a.contacts[i].a, b.contacts[i].a);
    EXPECT_EQ(a.contacts[i].b, b.contacts[i].b);
    expect_same(a.contacts[i].point, b.contacts[i].point);
    expect_same(a.contacts[i].force, b.contacts[i].force);
    expect_same_bits(a.contacts[i].overlap, b.contacts[i].overlap);
  }
  EXPECT_EQ(a.provenance.case_text, b.provenance.case_text);
  EXPECT_EQ(a.provenance.case_file, b.provenance.case_file);
  EXPECT_EQ(a.provenance.version, b.provenance.version);
  EXPECT_EQ(a.provenance.method, b.provenance.method);
  EXPECT_EQ(a.provenance.kernel, b.provenance.kernel);
  EXPECT_EQ(a.provenance.seed, b.provenance.seed);
}

PackedBed two_shapes() {
  PackedBed bed = sample_bed(50);
  bed.shapes.push_back(sample_mesh_pellet());
  bed.densities.push_back(1.0 / 3);
  bed.pellets[3].shape = 1;
  bed.pellets[4].scale = 0.7;
  bed.pellets[5].velocity = {-0.0, 5e-324, 1e308};  // signed zero and the ends of the range survive too
  bed.container.surface = cylinder_surface(0.02, 0.1);
  bed.container.kind = ContainerKind::mesh;
  return bed;
}

TEST(Bed, ComesBackBitForBit) {
  const TemporaryFolder folder;
  const PackedBed bed = two_shapes();
  write_bed(folder / "bed.h5", bed);
  expect_same(read_bed(folder / "bed.h5"), bed);
  expect_same(read_bed(folder.path()), bed);
}

TEST(Bed, AnEmptyBedIsABed) {
  const TemporaryFolder folder;
  PackedBed bed = two_shapes();
  bed.pellets.clear();
  bed.contacts.clear();
  bed.container = Container{};
  write_bed(folder / "bed.h5", bed);
  expect_same(read_bed(folder / "bed.h5"), bed);
}

TEST(Bed, EqualBedsAreEqualFiles) {
  const TemporaryFolder folder;
  write_bed(folder / "a.h5", two_shapes());
  write_bed(folder / "b.h5", two_shapes());
  EXPECT_EQ(read_file(folder / "a.h5"), read_file(folder / "b.h5"));
}

TEST(Bed, KeepsTheRecordOfTheRun) {
  const TemporaryFolder folder;
  const RunRecord record = sample_record();
  write_bed(folder / "bed.h5", sample_bed(5), &record);
  const auto back = read_run_record(folder / "bed.h5");
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(record_json(*back), record_json(record));
  write_bed(folder / "bed.h5", sample_bed(5));
  EXPECT_FALSE(read_run_record(folder / "bed.h5").has_value());
}

void expect_refused(const std::string& path) {
  try {
    read_bed(path);
    FAIL() << path << " was taken for a bed";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find(path), std::string::npos) << e.what();
  }
}

TEST(Bed, MissingEmptyAndForeignFilesAreRefused) {
  const TemporaryFolder folder;
  expect_refused(folder / "none.h5");
  expect_refused(folder.path());  // a folder without bed.h5
  write_atomically(folder / "empty.h5", "");
  expect_refused(folder / "empty.h5");
  write_atomically(folder / "text.h5", std::string(5000, 'x'));
  expect_refused(folder / "text.h5");
  Hdf5Writer other;
  other.text("/hello", "world");
  write_atomically(folder / "plain.h5", other.image());
  expect_refused(folder / "plain.h5");
  write_atomically(folder / "kind.h5", sealed(other.image(), "grid"));
  expect_refused(folder / "kind.h5");
  write_atomically(folder / "layout.h5", sealed(other.image(), "bed"));
  expect_refused(folder / "layout.h5");
  write_atomically(folder / "no_hdf5.h5", sealed("not HDF5 at all", "bed"));
  expect_refused(folder / "no_hdf5.h5");
}

TEST(Bed, ContentThatContradictsItselfIsRefused) {
  const TemporaryFolder folder;
  PackedBed bed = two_shapes();
  bed.pellets[2].shape = 7;  // of two
  write_bed(folder / "shape.h5", bed);
  expect_refused(folder / "shape.h5");
  bed = two_shapes();
  auto broken = std::make_shared<Shape>(*bed.shapes[1]);
  broken->surface.triangles[0][0] = 99;
  bed.shapes[1] = broken;
  write_bed(folder / "vertex.h5", bed);
  expect_refused(folder / "vertex.h5");
}

TEST(Bed, TwoHundredMutatedFilesAreAllRefused) {
  const TemporaryFolder folder;
  const std::string path = folder / "bed.h5";
  write_bed(path, sample_bed(20));
  const std::string whole = read_file(path);
  for (std::uint32_t i = 0; i < 200; ++i) {
    Random random(5, Stream::test, i);
    std::string bad = whole;
    const auto at = static_cast<std::size_t>(random.uniform(0, static_cast<double>(whole.size())));
    switch (i % 4) {
      case 0:
        bad.resize(at);
        break;
      case 1:
        bad[at] = static_cast<char>(bad[at] ^ static_cast<char>(1U << (random.bits() % 8)));
        break;
      case 2:
        bad.insert(at, 1, static_cast<char>(random.bits()));
        break;
      default:
        bad.erase(at, 1 + random.bits() % 64);
    }
    std::ofstream(path, std::ios::binary) << bad;
    expect_refused(path);
  }
}

TEST(Bed, PosesTableHasTheAgreedColumnsAndEveryDigit) {
  const TemporaryFolder folder;
  const PackedBed bed = two_shapes();
  write_poses_csv(folder / "poses.csv", bed);
  std::istringstream lines(read_file(folder / "poses.csv"));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "id,shape,x_m,y_m,z_m,qw,qx,qy,qz,scale");
  for (const Pellet& p : bed.pellets) {
    ASSERT_TRUE(std::getline(lines, line));
    std::istringstream cells(line);
    std::vector<std::string> cell;
    for (std::string c; std::getline(cells, c, ',');) cell.push_back(c);
    ASSERT_EQ(cell.size(), 10u);
    EXPECT_EQ(cell[0], std::to_string(p.id));
    EXPECT_EQ(cell[1], std::to_string(p.shape));
    for (std::size_t k = 0; k < 3; ++k)
      expect_same_bits(std::strtod(cell[2 + k].c_str(), nullptr), p.pose.position[static_cast<int>(k)]);
    expect_same_bits(std::strtod(cell[5].c_str(), nullptr), p.pose.rotation.w());
    expect_same_bits(std::strtod(cell[8].c_str(), nullptr), p.pose.rotation.z());
    expect_same_bits(std::strtod(cell[9].c_str(), nullptr), p.scale);
  }
  EXPECT_FALSE(std::getline(lines, line));
}

TEST(Bed, PosesTableCanBePlacedAgain) {
  const TemporaryFolder folder;
  PackedBed bed = sample_bed(30);
  write_poses_csv(folder / "poses.csv", bed);
  const std::vector<PlacedPellet> placed = read_placed_csv(folder / "poses.csv");
  ASSERT_EQ(placed.size(), bed.pellets.size());
  for (std::size_t i = 0; i < placed.size(); ++i) {
    EXPECT_EQ(placed[i].kind, bed.pellets[i].shape);
    EXPECT_EQ(placed[i].pose.position, bed.pellets[i].pose.position);
    EXPECT_LT(placed[i].pose.rotation.angularDistance(bed.pellets[i].pose.rotation), 1e-15);
  }
}

TEST(Bed, ContactsTableNamesTheContainerMinusOne) {
  const TemporaryFolder folder;
  PackedBed bed = sample_bed(12);
  write_contacts_csv(folder / "contacts.csv", bed);
  const std::string text = read_file(folder / "contacts.csv");
  EXPECT_EQ(text.substr(0, text.find('\n')), "a,b,x_m,y_m,z_m,fx_N,fy_N,fz_N,overlap_m");
  EXPECT_NE(text.find("\n0,-1,"), std::string::npos);
  EXPECT_NE(text.find("\n1,2,"), std::string::npos);
}

}  // namespace
}  // namespace packbed
