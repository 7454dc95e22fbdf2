#include "io/export.hpp"

#include <fmt/format.h>

#include <cstring>
#include <iterator>

#include "io/atomic_file.hpp"
#include "io/bed.hpp"
#include "io/vtu.hpp"
#include "math/error.hpp"

namespace packbed {
namespace {

constexpr std::size_t kStlHeader = 80;

template <class T>
void put(std::string& out, const T& value) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof value);
  out.append(bytes, sizeof bytes);
}

void put_point(std::string& out, const Vec3& x) {
  for (int k = 0; k < 3; ++k) put(out, static_cast<float>(x[k]));
}

TriangleMesh placed_surface(const PackedBed& bed, const Pellet& p) {
  return transformed(bed.shapes[p.shape]->surface, p.scale, p.pose.rotation, p.pose.position);
}

void write_stl(const std::string& path, const PackedBed& bed) {
  std::string out = "binary STL of packbed, lengths in mm";
  out.resize(kStlHeader, ' ');
  std::uint64_t count = 0;
  for (const Pellet& p : bed.pellets) count += bed.shapes[p.shape]->surface.triangles.size();
  if (count > UINT32_MAX)
    throw InputError(path, fmt::format("a bed of {} triangles", count),
                     "at most 4294967295 triangles in an STL", "export to vtu or obj");
  put(out, static_cast<std::uint32_t>(count));
  out.reserve(out.size() + 50 * count);
  for (const Pellet& p : bed.pellets) {
    const TriangleMesh mesh = placed_surface(bed, p);
    for (const auto& [a, b, c] : mesh.triangles) {
      const Vec3 &u = mesh.vertices[static_cast<std::size_t>(a)],
                 &v = mesh.vertices[static_cast<std::size_t>(b)],
                 &w = mesh.vertices[static_cast<std::size_t>(c)];
      put_point(out, (v - u).cross(w - u).stableNormalized());
      for (const Vec3& x : {u, v, w}) put_point(out, 1e3 * x);
      put(out, std::uint16_t{0});
    }
  }
  write_atomically(path, out);
}

void write_obj(const std::string& path, const PackedBed& bed) {
  std::string out = "# packbed, lengths in m\n";
  std::size_t first = 1;  // OBJ counts from 1
  for (const Pellet& p : bed.pellets) {
    const TriangleMesh mesh = placed_surface(bed, p);
    fmt::format_to(std::back_inserter(out), "o pellet_{}\n", p.id);
    for (const Vec3& v : mesh.vertices)
      fmt::format_to(std::back_inserter(out), "v {:.9g} {:.9g} {:.9g}\n", v.x(), v.y(), v.z());
    for (const auto& t : mesh.triangles)
      fmt::format_to(std::back_inserter(out), "f {} {} {}\n", first + static_cast<std::size_t>(t[0]),
                     first + static_cast<std::size_t>(t[1]), first + static_cast<std::size_t>(t[2]));
    first += mesh.vertices.size();
  }
  write_atomically(path, out);
}

}  // namespace

ExportKind export_kind_from(const std::string& word) {
  if (word == "stl") return ExportKind::stl;
  if (word == "vtu") return ExportKind::vtu;
  if (word == "csv") return ExportKind::csv;
  if (word == "obj") return ExportKind::obj;
  if (word == "contacts") return ExportKind::contacts;
  throw InputError("--to", word, "stl, vtu, csv, obj, contacts");
}

std::string ending(ExportKind kind) {
  switch (kind) {
    case ExportKind::stl:
      return ".stl";
    case ExportKind::vtu:
      return ".vtu";
    case ExportKind::csv:
      return ".csv";
    case ExportKind::obj:
      return ".obj";
    case ExportKind::contacts:
      return "_contacts.csv";
  }
  return "";
}

void export_bed(const PackedBed& bed, ExportKind kind, const std::string& path) {
  switch (kind) {
    case ExportKind::stl:
      return write_stl(path, bed);
    case ExportKind::vtu:
      return write_vtu(path, bed);
    case ExportKind::csv:
      return write_poses_csv(path, bed);
    case ExportKind::obj:
      return write_obj(path, bed);
    case ExportKind::contacts:
      return write_contacts_csv(path, bed);
  }
}

}  // namespace packbed
