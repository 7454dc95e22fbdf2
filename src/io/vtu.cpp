#include "io/vtu.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "io/atomic_file.hpp"

namespace packbed {
namespace {

constexpr std::size_t kBlock = 1 << 20;  // of compression [byte]; readers unpack block by block
constexpr int kRound = 32;               // facets of a cylinder as drawn

// VTK's numbers for kinds of cells
constexpr std::uint8_t kVertexCell = 1, kTriangleCell = 5, kPolygonCell = 7, kQuadCell = 9;

/// The appended part of a file: arrays one behind the other, each cut into compressed blocks.
class Appended {
 public:
  template <class T>
  std::size_t add(const std::vector<T>& values) {
    const std::size_t offset = bytes_.size();
    const auto* data = reinterpret_cast<const unsigned char*>(values.data());
    append(data, values.size() * sizeof(T));
    return offset;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void append(const unsigned char* data, std::size_t size) {
    const std::size_t blocks = (size + kBlock - 1) / kBlock;
    std::vector<std::uint64_t> header = {blocks, kBlock, size % kBlock};
    std::string packed;
    for (std::size_t b = 0; b < blocks; ++b) {
      const std::size_t length = std::min(kBlock, size - b * kBlock);
      uLongf room = compressBound(length);
      const std::size_t at = packed.size();
      packed.resize(at + room);
      if (compress2(reinterpret_cast<Bytef*>(packed.data() + at), &room, data + b * kBlock, length, 6) !=
          Z_OK)
        throw std::runtime_error("zlib: compressing failed");
      packed.resize(at + room);
      header.push_back(room);
    }
    bytes_.append(reinterpret_cast<const char*>(header.data()), header.size() * sizeof header[0]);
    bytes_ += packed;
  }
  std::string bytes_;
};

template <class T>
constexpr const char* type_name() {
  if constexpr (std::is_same_v<T, float>) return "Float32";
  if constexpr (std::is_same_v<T, double>) return "Float64";
  if constexpr (std::is_same_v<T, std::int32_t>) return "Int32";
  if constexpr (std::is_same_v<T, std::int64_t>) return "Int64";
  if constexpr (std::is_same_v<T, std::uint8_t>) return "UInt8";
}

/// An unstructured grid in the making.
struct Grid {
  std::vector<float> points;
  std::vector<std::int32_t> connectivity;
  std::vector<std::int64_t> offsets;
  std::vector<std::uint8_t> types;
  std::string point_data, cell_data;  // XML of the arrays
  Appended appended;

  template <class T>
  std::string array(const char* name, const std::vector<T>& values, int components = 1) {
    return fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
        type_name<T>(), name, components, appended.add(values));
  }
  void point(const Vec3& x) {
    for (int k = 0; k < 3; ++k) points.push_back(static_cast<float>(x[k]));
  }
  void cell(std::uint8_t type) {
    types.push_back(type);
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  }
};

void write_grid(const std::string& path, Grid& grid) {
  const std::string points = grid.array("Points", grid.points, 3);
  const std::string cells = grid.array("connectivity", grid.connectivity) +
                            grid.array("offsets", grid.offsets) + grid.array("types", grid.types);
  const std::string head = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
      "compressor=\"vtkZLibDataCompressor\">\n<UnstructuredGrid>\n"
      "<Piece NumberOfPoints=\"{}\" "
      "NumberOfCells=\"{}\">\n<PointData>\n{}</PointData>\n<CellData>\n{}</CellData>\n"
      "<Points>\n{}</Points>\n<Cells>\n{}</Cells>\n</Piece>\n</UnstructuredGrid>\n"
      "<AppendedData encoding=\"raw\">\n_",
      grid.points.size() / 3, grid.types.size(), grid.point_data, grid.cell_data, points, cells);
  write_atomically(path, head + grid.appended.bytes() + "\n</AppendedData>\n</VTKFile>\n");
}

/// A closed surface of faces with any number of corners.
struct Faces {
  std::vector<Vec3> vertices;
  std::vector<std::vector<std::int32_t>> faces;
};

/// A prism that holds the cylinder's volume.
Faces prism(double radius, double half_height) {
  const double turn = 2 * kPi / kRound;
  const double r = radius * std::sqrt(turn / std::sin(turn));
  Faces out;
  std::vector<std::int32_t> bottom, top;
  for (int i = 0; i < kRound; ++i) {
    for (const double z : {-half_height, half_height})
      out.vertices.emplace_back(r * std::cos(i * turn), r * std::sin(i * turn), z);
    const int j = (i + 1) % kRound;
    out.faces.push_back({2 * i, 2 * j, 2 * j + 1, 2 * i + 1});
    bottom.insert(bottom.begin(), 2 * i);
    top.push_back(2 * i + 1);
  }
  out.faces.push_back(bottom);
  out.faces.push_back(top);
  return out;
}

Faces faces_of(const TriangleMesh& mesh) {
  Faces out{mesh.vertices, {}};
  for (const auto& t : mesh.triangles) out.faces.push_back({t[0], t[1], t[2]});
  return out;
}

Faces faces_of(const Shape& shape) {
  return shape.kind == ShapeClass::cylinder ? prism(shape.radius, shape.half_height)
                                            : faces_of(shape.surface);
}

void add_faces(Grid& grid, const Faces& faces, const Pose& pose, double scale) {
  const auto first = static_cast<std::int32_t>(grid.points.size() / 3);
  for (const Vec3& v : faces.vertices) grid.point(pose.to_world(scale * v));
  for (const auto& face : faces.faces) {
    for (const std::int32_t corner : face) grid.connectivity.push_back(first + corner);
    grid.cell(face.size() == 3 ? kTriangleCell : face.size() == 4 ? kQuadCell : kPolygonCell);
  }
}

void add_point(Grid& grid, const Pellet& p) {
  grid.connectivity.push_back(static_cast<std::int32_t>(grid.types.size()));
  grid.point(p.pose.position);
  grid.cell(kVertexCell);
}

/// The inside of a round tube with its floor, drawn open above.
Faces tube_inside(const Container& tube) {
  Faces out = prism(tube.radius, tube.height / 2);
  for (Vec3& v : out.vertices) v.z() += tube.height / 2;
  out.faces.pop_back();
  return out;
}

Faces box_inside(const Container& box) {
  const double x = box.width / 2, y = box.depth / 2, z = box.height;
  Faces out;
  for (const double height : {0.0, z})
    for (const Vec2& corner : {Vec2(-x, -y), Vec2(x, -y), Vec2(x, y), Vec2(-x, y)})
      out.vertices.emplace_back(corner.x(), corner.y(), height);
  out.faces = {{0, 1, 2, 3}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}};
  return out;
}

template <class T, class Value>
std::string pellet_array(Grid& grid, const char* name, const std::vector<Pellet>& pellets,
                         const std::vector<std::size_t>& cells, const Value& value) {
  std::vector<T> values;
  for (std::size_t i = 0; i < pellets.size(); ++i)
    values.insert(values.end(), cells[i], static_cast<T>(value(i)));
  return grid.array(name, values);
}

}  // namespace

double angle_to_vertical_deg(const Pellet& pellet) {
  const Vec3 axis = pellet.pose.rotation * Vec3::UnitZ();
  return std::atan2(std::hypot(axis.x(), axis.y()), std::abs(axis.z())) * 180 / kPi;
}

void write_vtu(const std::string& path, const PackedBed& bed, const CellFields& fields) {
  write_vtu(path, bed.shapes, bed.pellets, fields);
}

void write_vtu(const std::string& path, const std::vector<ShapePtr>& shapes,
               const std::vector<Pellet>& pellets, const CellFields& fields) {
  std::vector<Faces> faces;
  for (const ShapePtr& shape : shapes) faces.push_back(faces_of(*shape));
  const bool as_points = pellets.size() > kMostDrawnSpheres &&
                         std::all_of(shapes.begin(), shapes.end(),
                                     [](const ShapePtr& shape) { return shape->kind == ShapeClass::sphere; });
  Grid grid;
  std::vector<float> diameters;
  std::vector<std::size_t> cells;  // of each pellet
  for (const Pellet& p : pellets) {
    if (as_points) {
      add_point(grid, p);
      diameters.push_back(static_cast<float>(2 * p.scale * shapes[p.shape]->radius));
    } else {
      add_faces(grid, faces[p.shape], p.pose, p.scale);
    }
    cells.push_back(as_points ? 1 : faces[p.shape].faces.size());
  }
  if (as_points) grid.point_data = grid.array("diameter_m", diameters);
  const bool known = fields.overlap.size() == pellets.size();
  grid.cell_data = pellet_array<std::int32_t>(grid, "pellet", pellets, cells,
                                              [&](std::size_t i) { return pellets[i].id; }) +
                   pellet_array<std::int32_t>(grid, "shape", pellets, cells,
                                              [&](std::size_t i) { return pellets[i].shape; }) +
                   pellet_array<float>(grid, "height_m", pellets, cells,
                                       [&](std::size_t i) { return pellets[i].pose.position.z(); }) +
                   pellet_array<float>(grid, "angle_deg", pellets, cells,
                                       [&](std::size_t i) { return angle_to_vertical_deg(pellets[i]); }) +
                   pellet_array<float>(grid, "overlap", pellets, cells,
                                       [&](std::size_t i) { return known ? fields.overlap[i] : 0.0; });
  write_grid(path, grid);
}

void write_point_vtu(const std::string& path, const std::vector<Pellet>& pellets) {
  Grid grid;
  std::vector<std::int32_t> id, shape;
  std::vector<float> rotation, velocity, spin, scale;
  for (const Pellet& p : pellets) {
    add_point(grid, p);
    id.push_back(static_cast<std::int32_t>(p.id));
    shape.push_back(static_cast<std::int32_t>(p.shape));
    scale.push_back(static_cast<float>(p.scale));
    const Quat& q = p.pose.rotation;
    for (const double x : {q.w(), q.x(), q.y(), q.z()}) rotation.push_back(static_cast<float>(x));
    for (int k = 0; k < 3; ++k) {
      velocity.push_back(static_cast<float>(p.velocity[k]));
      spin.push_back(static_cast<float>(p.spin[k]));
    }
  }
  grid.point_data = grid.array("pellet", id) + grid.array("shape", shape) + grid.array("scale", scale) +
                    grid.array("rotation_wxyz", rotation, 4) + grid.array("velocity_m_s", velocity, 3) +
                    grid.array("spin_rad_s", spin, 3);
  write_grid(path, grid);
}

void write_container_vtu(const std::string& path, const Container& container) {
  Grid grid;
  const bool drawn = !container.surface.triangles.empty();
  const bool box = container.kind == ContainerKind::box;
  if (drawn || box || container.kind == ContainerKind::tube)
    add_faces(grid,
              drawn ? faces_of(container.surface)
              : box ? box_inside(container)
                    : tube_inside(container),
              Pose{}, 1);
  write_grid(path, grid);
}

}  // namespace packbed
