#include "io/bed.hpp"

#include <fmt/format.h>

#include <functional>
#include <type_traits>

#include "io/atomic_file.hpp"
#include "io/hdf5_image.hpp"
#include "io/result_folder.hpp"
#include "io/summary.hpp"
#include "math/error.hpp"

namespace packbed {
namespace {

constexpr std::uint64_t kFormat = 1;  // of bed.h5; raise it when an old reader would misread a new file
constexpr std::string_view kKind = "bed";

/// One array out of one field of many records.
template <class Record, class Field>
auto column(const std::vector<Record>& records, const Field& field) {
  std::vector<std::decay_t<decltype(field(records.front()))>> out;
  out.reserve(records.size());
  for (const Record& r : records) out.push_back(field(r));
  return out;
}

template <class Record, class Field>
std::vector<double> vectors(const std::vector<Record>& records, const Field& field) {
  std::vector<double> out;
  out.reserve(3 * records.size());
  for (const Record& r : records)
    for (int k = 0; k < 3; ++k) out.push_back(field(r)[k]);
  return out;
}

template <std::size_t N>
std::vector<std::int32_t> flattened(const std::vector<std::array<std::int32_t, N>>& tuples) {
  std::vector<std::int32_t> out;
  out.reserve(N * tuples.size());
  for (const auto& t : tuples) out.insert(out.end(), t.begin(), t.end());
  return out;
}

template <std::size_t N>
std::vector<std::array<std::int32_t, N>> tuples(const std::vector<std::int32_t>& flat, std::size_t vertices) {
  std::vector<std::array<std::int32_t, N>> out(flat.size() / N);
  for (std::size_t i = 0; i < flat.size(); ++i) {
    if (flat[i] < 0 || static_cast<std::size_t>(flat[i]) >= vertices)
      throw std::runtime_error("a mesh that names a vertex it does not have");
    out[i / N][i % N] = flat[i];
  }
  return out;
}

Vec3 vector_at(const std::vector<double>& flat, std::size_t i) {
  return {flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]};
}

Quat quaternion_at(const std::vector<double>& flat, std::size_t i) {
  return {flat[4 * i], flat[4 * i + 1], flat[4 * i + 2], flat[4 * i + 3]};
}

std::vector<Vec3> vectors_of(const std::vector<double>& flat) {
  std::vector<Vec3> out(flat.size() / 3);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = vector_at(flat, i);
  return out;
}

const auto kItself = [](const Vec3& v) -> const Vec3& { return v; };

// --- surfaces, shapes, container ------------------------------------------------------------------------

void put_surface(Hdf5Writer& file, const std::string& group, const TriangleMesh& mesh) {
  file.array(group + "/vertices", vectors(mesh.vertices, kItself), 3);
  file.array(group + "/triangles", flattened(mesh.triangles), 3);
}

TriangleMesh get_surface(const Hdf5Reader& file, const std::string& group) {
  TriangleMesh mesh;
  mesh.vertices = vectors_of(file.array<double>(group + "/vertices", 3));
  mesh.triangles = tuples<3>(file.array<std::int32_t>(group + "/triangles", 3), mesh.vertices.size());
  return mesh;
}

/// The numbers of a shape, so that writing and reading cannot disagree on a name.

std::vector<std::pair<const char*, double Shape::*>> shape_numbers() {
  return {{"radius_m", &Shape::radius},
          {"half_height_m", &Shape::half_height},
          {"volume_m3", &Shape::volume},
          {"area_m2", &Shape::area},
          {"bounding_radius_m", &Shape::bounding_radius},
          {"smallest_thickness_m", &Shape::smallest_thickness},
          {"mesh_volume_m3", &Shape::mesh_volume}};
}

std::vector<std::pair<const char*, double Container::*>> container_numbers() {
  return {{"radius_m", &Container::radius},
          {"height_m", &Container::height},
          {"width_m", &Container::width},
          {"depth_m", &Container::depth},
          {"mesh_volume_m3", &Container::mesh_volume}};
}

void put_shape(Hdf5Writer& file, const std::string& group, const Shape& shape, double density) {
  file.group(group);
  file.attribute(group, "name", shape.name);
  file.attribute(group, "source", shape.source);
  file.attribute(group, "class", std::string(to_string(shape.kind)));
  file.attribute(group, "density_kg_m3", density);
  for (const auto& [name, member] : shape_numbers()) file.attribute(group, name, shape.*member);
  file.array(group + "/inertia_m5", vectors(std::vector<Vec3>{shape.inertia}, kItself), 3);
  const Pose& from = shape.from_file;
  file.array(group + "/from_file_position_m", vectors(std::vector<Vec3>{from.position}, kItself), 3);
  file.array(group + "/from_file_rotation_wxyz",
             std::vector<double>{from.rotation.w(), from.rotation.x(), from.rotation.y(), from.rotation.z()},
             4);
  if (shape.kind == ShapeClass::tube) file.attribute(group, "inner_radius_m", shape.inner_radius);
  put_surface(file, group, shape.surface);
  if (!shape.tets) return;
  file.array(group + "/tet_vertices", vectors(shape.tets->vertices, kItself), 3);
  file.array(group + "/tets", flattened(shape.tets->tets), 4);
}

template <class Kind, std::size_t N>
Kind kind_from(const std::string& word, const std::array<Kind, N>& kinds) {
  for (const Kind kind : kinds)
    if (word == to_string(kind)) return kind;
  throw std::runtime_error("a class of shape that this version does not know: " + word);
}

ShapePtr get_shape(const Hdf5Reader& file, const std::string& group) {
  auto shape = std::make_shared<Shape>();
  shape->name = file.text_attribute(group, "name");
  shape->source = file.text_attribute(group, "source");
  shape->kind = kind_from(file.text_attribute(group, "class"),
                          std::array{ShapeClass::sphere, ShapeClass::cylinder, ShapeClass::mesh,
                                     ShapeClass::tube, ShapeClass::convex});
  for (const auto& [name, member] : shape_numbers()) (*shape).*member = file.number_attribute(group, name);
  shape->inertia = vectors_of(file.array<double>(group + "/inertia_m5", 3)).at(0);
  shape->from_file.position = vectors_of(file.array<double>(group + "/from_file_position_m", 3)).at(0);
  shape->from_file.rotation = quaternion_at(file.array<double>(group + "/from_file_rotation_wxyz", 4), 0);
  if (shape->kind == ShapeClass::tube) shape->inner_radius = file.number_attribute(group, "inner_radius_m");
  shape->surface = get_surface(file, group);
  if (shape->kind == ShapeClass::convex && !find_planes(*shape))
    throw std::runtime_error(group + " is called convex and is not");
  if (!file.has(group + "/tets")) return shape;
  TetMesh tets;
  tets.vertices = vectors_of(file.array<double>(group + "/tet_vertices", 3));
  tets.tets = tuples<4>(file.array<std::int32_t>(group + "/tets", 4), tets.vertices.size());
  shape->tets = std::move(tets);
  return shape;
}

void put_container(Hdf5Writer& file, const Container& container) {
  file.group("/container");
  file.attribute("/container", "kind", std::string(to_string(container.kind)));
  file.attribute("/container", "name", container.name);
  file.attribute("/container", "source", container.source);
  for (const auto& [name, member] : container_numbers())
    file.attribute("/container", name, container.*member);
  put_surface(file, "/container", container.surface);
}

Container get_container(const Hdf5Reader& file) {
  Container container;
  container.kind = kind_from(file.text_attribute("/container", "kind"),
                             std::array{ContainerKind::none, ContainerKind::plane, ContainerKind::tube,
                                        ContainerKind::box, ContainerKind::mesh});
  container.name = file.text_attribute("/container", "name");
  container.source = file.text_attribute("/container", "source");
  for (const auto& [name, member] : container_numbers())
    container.*member = file.number_attribute("/container", name);
  container.surface = get_surface(file, "/container");
  return container;
}

// --- pellets and contacts -------------------------------------------------------------------------------

void put_pellets(Hdf5Writer& file, const std::vector<Pellet>& pellets) {
  file.array("/pellets/id", column(pellets, [](const Pellet& p) { return p.id; }));
  file.array("/pellets/shape", column(pellets, [](const Pellet& p) { return p.shape; }));
  file.array("/pellets/position_m",
             vectors(pellets, [](const Pellet& p) -> const Vec3& { return p.pose.position; }), 3);
  std::vector<double> rotation;
  for (const Pellet& p : pellets)
    rotation.insert(rotation.end(),
                    {p.pose.rotation.w(), p.pose.rotation.x(), p.pose.rotation.y(), p.pose.rotation.z()});
  file.array("/pellets/rotation_wxyz", rotation, 4);
  file.array("/pellets/scale", column(pellets, [](const Pellet& p) { return p.scale; }));
  file.array("/pellets/velocity_m_s",
             vectors(pellets, [](const Pellet& p) -> const Vec3& { return p.velocity; }), 3);
  file.array("/pellets/spin_rad_s", vectors(pellets, [](const Pellet& p) -> const Vec3& { return p.spin; }),
             3);
  file.array("/pellets/fixed", column(pellets, [](const Pellet& p) { return std::uint8_t{p.fixed}; }));
}

/// An array of one row for each of n records.
template <class T>
std::vector<T> rows(const Hdf5Reader& file, const std::string& path, std::size_t n, std::size_t columns = 1) {
  std::vector<T> values = file.array<T>(path, columns);
  if (values.size() != n * columns)
    throw std::runtime_error(path + " has another length than its neighbours");
  return values;
}

std::vector<Pellet> get_pellets(const Hdf5Reader& file, std::size_t shapes) {
  const auto id = file.array<std::uint32_t>("/pellets/id");
  const std::size_t n = id.size();
  const auto shape = rows<std::uint32_t>(file, "/pellets/shape", n);
  const auto position = rows<double>(file, "/pellets/position_m", n, 3);
  const auto rotation = rows<double>(file, "/pellets/rotation_wxyz", n, 4);
  const auto scale = rows<double>(file, "/pellets/scale", n);
  const auto velocity = rows<double>(file, "/pellets/velocity_m_s", n, 3);
  const auto spin = rows<double>(file, "/pellets/spin_rad_s", n, 3);
  const auto fixed = rows<std::uint8_t>(file, "/pellets/fixed", n);
  std::vector<Pellet> pellets(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (shape[i] >= shapes) throw std::runtime_error("a pellet of a shape that the file does not hold");
    pellets[i] = {id[i],
                  shape[i],
                  {vector_at(position, i), quaternion_at(rotation, i)},
                  scale[i],
                  vector_at(velocity, i),
                  vector_at(spin, i),
                  fixed[i] != 0};
  }
  return pellets;
}

void put_contacts(Hdf5Writer& file, const std::vector<Contact>& contacts) {
  file.array("/contacts/a", column(contacts, [](const Contact& c) { return c.a; }));
  file.array("/contacts/b", column(contacts, [](const Contact& c) { return c.b; }));
  file.array("/contacts/point_m", vectors(contacts, [](const Contact& c) -> const Vec3& { return c.point; }),
             3);
  file.array("/contacts/force_N", vectors(contacts, [](const Contact& c) -> const Vec3& { return c.force; }),
             3);
  file.array("/contacts/overlap_m", column(contacts, [](const Contact& c) { return c.overlap; }));
}

std::vector<Contact> get_contacts(const Hdf5Reader& file) {
  const auto a = file.array<std::uint32_t>("/contacts/a");
  const std::size_t n = a.size();
  const auto b = rows<std::uint32_t>(file, "/contacts/b", n);
  const auto point = rows<double>(file, "/contacts/point_m", n, 3);
  const auto force = rows<double>(file, "/contacts/force_N", n, 3);
  const auto overlap = rows<double>(file, "/contacts/overlap_m", n);
  std::vector<Contact> contacts(n);
  for (std::size_t i = 0; i < n; ++i)
    contacts[i] = {a[i], b[i], vector_at(point, i), vector_at(force, i), overlap[i]};
  return contacts;
}

// --- the whole ------------------------------------------------------------------------------------------

void put_provenance(Hdf5Writer& file, const PackedBed& bed) {
  const Provenance& from = bed.provenance;
  file.group("/provenance");
  file.attribute("/provenance", "case_file", from.case_file);
  file.attribute("/provenance", "version", from.version);
  file.attribute("/provenance", "method", from.method);
  file.attribute("/provenance", "kernel", from.kernel);
  file.attribute("/provenance", "seed", from.seed);
  file.attribute("/provenance", "bed_hash", bed_hash(bed));
  file.text("/provenance/case", from.case_text);
}

Provenance get_provenance(const Hdf5Reader& file) {
  Provenance from;
  from.case_text = file.text("/provenance/case");
  from.case_file = file.text_attribute("/provenance", "case_file");
  from.version = file.text_attribute("/provenance", "version");
  from.method = file.text_attribute("/provenance", "method");
  from.kernel = file.text_attribute("/provenance", "kernel");
  from.seed = file.count_attribute("/provenance", "seed");
  return from;
}

std::string shape_group(std::size_t i) {
  return fmt::format("/shapes/{:03d}", i);
}

std::string bed_image(const PackedBed& bed, const RunRecord* record) {
  Hdf5Writer file;
  file.attribute("/", "packbed_format", kFormat);
  file.attribute("/", "shapes", std::uint64_t{bed.shapes.size()});
  put_provenance(file, bed);
  put_pellets(file, bed.pellets);
  for (std::size_t i = 0; i < bed.shapes.size(); ++i)
    put_shape(file, shape_group(i), *bed.shapes[i], bed.densities[i]);
  put_container(file, bed.container);
  put_contacts(file, bed.contacts);
  if (record) file.text("/run/record", record_json(*record));
  return file.image();
}

PackedBed bed_from(const Hdf5Reader& file) {
  if (const std::uint64_t format = file.count_attribute("/", "packbed_format"); format != kFormat)
    throw std::runtime_error(fmt::format("format {} where this version reads {}", format, kFormat));
  PackedBed bed;
  const std::uint64_t shapes = file.count_attribute("/", "shapes");
  for (std::size_t i = 0; i < shapes; ++i) {
    bed.shapes.push_back(get_shape(file, shape_group(i)));
    bed.densities.push_back(file.number_attribute(shape_group(i), "density_kg_m3"));
  }
  bed.container = get_container(file);
  bed.pellets = get_pellets(file, bed.shapes.size());
  bed.contacts = get_contacts(file);
  bed.provenance = get_provenance(file);
  if (const std::string hash = file.text_attribute("/provenance", "bed_hash"); hash != bed_hash(bed))
    throw std::runtime_error(fmt::format("a bed of hash {} where {} was written", bed_hash(bed), hash));
  return bed;
}

template <class Read>
auto reading(const std::string& path, const Read& read) {
  std::string image = unsealed_file(path, kKind);
  try {
    return read(Hdf5Reader(std::move(image)));
  } catch (const std::runtime_error& e) {
    throw InputError(path, e.what(), "a bed.h5 of this version of packbed", "run the case again");
  }
}

}  // namespace

void write_bed(const std::string& path, const PackedBed& bed, const RunRecord* record) {
  write_atomically(path, sealed(bed_image(bed, record), kKind));
}

PackedBed read_bed(const std::string& path_or_folder) {
  return reading(file_in(path_or_folder, result_file::kBed), bed_from);
}

std::optional<RunRecord> read_run_record(const std::string& path_or_folder) {
  return reading(file_in(path_or_folder, result_file::kBed),
                 [](const Hdf5Reader& file) -> std::optional<RunRecord> {
                   if (!file.has("/run/record")) return std::nullopt;
                   return record_from_json(file.text("/run/record"));
                 });
}

}  // namespace packbed
