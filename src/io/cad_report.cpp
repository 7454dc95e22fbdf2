#include "io/cad_report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "math/quantity.hpp"
#include "mesh/check.hpp"

namespace packbed {
namespace {

std::string length(double metres) {
  return format_quantity(metres, Dimension::length, 6);
}
std::string volume(double cubic_metres) {
  return fmt::format("{:.6g} mm3", 1e9 * cubic_metres);
}
std::string area(double square_metres) {
  return fmt::format("{:.6g} mm2", 1e6 * square_metres);
}

constexpr const char* kField =
    "field: points on the surface against a distance field, which is made once for the shape";

class Page {
 public:
  void line(const std::string& name, const std::string& value) {
    text += fmt::format("{:<18}{}\n", name, value);
  }
  void more(const std::string& value) { line("", value); }
  std::string text;
};

void say_file(Page& page, const CadModel& model) {
  page.line("file", model.path);
  page.line("format", model.detail);
  page.line("unit", model.format == CadFormat::step ? "of the file itself" : model.unit);
  if (model.solids > 0) page.line("solids", fmt::format("{}, as the CAD kernel counts", model.solids));
  for (const std::string& note : model.notes) page.line("note", note);
}

void say_mesh(Page& page, const CadModel& model, const MeshReport& report) {
  page.line("triangles",
            fmt::format("{}, {} vertices{}", report.mesh.triangles.size(), report.mesh.vertices.size(),
                        report.welded > 0 ? fmt::format(" ({} copies joined)", report.welded) : ""));
  const MassProperties m = mass_properties(report.mesh);
  page.line("volume", fmt::format("{} (of the mesh)", volume(m.volume)));
  if (model.volume)
    page.more(fmt::format("{} (exact, from the CAD kernel; the mesh is off by {:+.3f} %)",
                          volume(*model.volume), 100 * (m.volume / *model.volume - 1)));
  page.line("area", fmt::format("{} (of the mesh)", area(m.area)));
  if (model.area) page.more(fmt::format("{} (exact, from the CAD kernel)", area(*model.area)));
  const Vec3 size = 1e3 * bounding_box(report.mesh).sizes(), centre = 1e3 * m.centre;
  page.line("size", fmt::format("{:.6g} x {:.6g} x {:.6g} mm", size.x(), size.y(), size.z()));
  page.line("centre of mass",
            fmt::format("({:.6g}, {:.6g}, {:.6g}) mm in the file", centre.x(), centre.y(), centre.z()));
  if (report.thinnest_wall > 0)
    page.line("thinnest wall", fmt::format("{} at ({:.4g}, {:.4g}, {:.4g}) mm", length(report.thinnest_wall),
                                           1e3 * report.thinnest_place.x(), 1e3 * report.thinnest_place.y(),
                                           1e3 * report.thinnest_place.z()));
  if (report.cavities > 0) page.line("cavities", fmt::format("{} closed in the material", report.cavities));
}

void say_findings(Page& page, const MeshReport& report) {
  if (report.findings.empty())
    page.line("checks", "closed, one orientation, no crossing, no degenerate triangle");
  for (const MeshFinding& f : report.findings)
    page.line(f.fatal ? "REFUSED" : "note", fmt::format("{}: {}", to_string(f.problem), f.sentence));
}

void say_tets(Page& page, const TetMesh& tets) {
  page.line("tetrahedra",
            fmt::format("{} of {} in all", tets.tets.size(), volume(mass_properties(tets).volume)));
}

void say_class(Page& page, const Shape& s) {
  switch (s.kind) {
    case ShapeClass::sphere:
      page.line("shape", fmt::format("sphere of diameter {}", length(2 * s.radius)));
      page.line("kernel", "sphere: exact, needs neither field nor triangles in the run");
      return;
    case ShapeClass::cylinder:
      page.line("shape", fmt::format("cylinder of diameter {} and height {}", length(2 * s.radius),
                                     length(2 * s.half_height)));
      page.line("kernel",
                "cylinder: exact rims, side and ends; needs neither field nor triangles in the run");
      return;
    case ShapeClass::tube:
      page.line("shape",
                fmt::format("tube of outer diameter {}, inner diameter {} and height {}",
                            length(2 * s.radius), length(2 * s.inner_radius), length(2 * s.half_height)));
      page.line("kernel", kField);
      return;
    case ShapeClass::convex:
      page.line("shape", fmt::format("convex polyhedron of {} faces and {} corners", s.planes.size(),
                                     s.corners.size()));
      page.line("kernel", kField);
      return;
    case ShapeClass::mesh:
      page.line("shape", "mesh: no sphere, cylinder, tube or convex polyhedron");
      page.line("kernel", kField);
      return;
  }
}

void say_pellet(Page& page, const CadModel& model, const MeshReport& report, const CadOptions& options) {
  const ShapePtr s =
      make_shape("pellet", model.path, report.mesh, options.recognise, model.volume.value_or(0));
  page.text += "\nas a pellet\n";
  say_class(page, *s);
  const double change = 100 * (s->volume / s->mesh_volume - 1);
  page.line("volume",
            fmt::format("{}{}", volume(s->volume),
                        std::abs(change) > 1e-6 ? fmt::format(", {:+.3f} % against the mesh, which is "
                                                              "stretched to it",
                                                              change)
                                                : ""));
  page.line("equal sphere", fmt::format("diameter {}", length(s->equivalent_diameter())));
  const Vec3 k = 1e6 * s->inertia / s->volume;
  page.line("inertia / mass",
            fmt::format("{:.6g}, {:.6g}, {:.6g} mm2 about its own x, y, z", k.x(), k.y(), k.z()));
  page.line("bounding radius", length(s->bounding_radius));
  page.line("thickness", fmt::format("{}: overlaps are fractions of it", length(s->smallest_thickness)));
  if (s->thin_walled())
    page.line("thin wall", fmt::format("{:.3g} % of its size across, under {:.3g} %: impacts are held to a "
                                       "fraction of that wall, which takes short steps",
                                       50 * s->smallest_thickness / s->bounding_radius, 100 * kThinWalled));
  if (!model.tets)
    page.line("skipped", "tetrahedra (--tets makes them; no kernel of the mesh packer needs any)");
}

void say_container(Page& page, const CadModel& model, const MeshReport& report, const CadOptions& options) {
  const Container c = make_container("container", model.path, report.mesh, options.recognise);
  page.text += "\nas a container\n";
  if (c.kind == ContainerKind::tube) {
    page.line("shape", fmt::format("tube of inner diameter {} and inner height {} on a flat floor",
                                   length(2 * c.radius), length(c.height)));
    page.line("kernel", "tube: exact, needs neither field nor triangles in the run");
  } else if (c.kind == ContainerKind::box) {
    page.line("shape", fmt::format("box of {} x {} and inner height {} on a flat floor", length(c.width),
                                   length(c.depth), length(c.height)));
    page.line("kernel", "box: exact, needs neither field nor triangles in the run");
  } else {
    page.line("shape", "mesh: no upright round tube or box on a flat floor");
    page.line("kernel", "field: a distance field of the wall, made once");
    if (c.height > 0) page.line("inner height", fmt::format("{}, floor to rim", length(c.height)));
    if (c.radius > 0)
      page.line("free diameter", fmt::format("{} round the axis at mid-height", length(2 * c.radius)));
    if (c.core_radius > 0)
      page.line("core",
                fmt::format("of diameter {} there: pour, layers find no room", length(2 * c.core_radius)));
    if (c.radius == 0) page.line("note", "no hollow round the axis at mid-height: nothing can be poured in");
  }
  page.line("axes", "moved so that the floor is at z = 0 and the axis at the origin");
}

}  // namespace

CadReport describe_cad(const std::string& path, const CadOptions& options, bool container) {
  const CadModel model = read_cad(path, options);
  const MeshReport report = check_mesh(model.mesh, {.several_solids = container});
  Page page;
  say_file(page, model);
  if (report.fatal() == nullptr) say_mesh(page, model, report);
  say_findings(page, report);
  if (report.fatal() != nullptr) return {page.text, false};
  if (model.tets) say_tets(page, *model.tets);
  container ? say_container(page, model, report, options) : say_pellet(page, model, report, options);
  return {page.text, true};
}

}  // namespace packbed
