#include "io/cad.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "io/cad_reader/message.hpp"
#include "io/child.hpp"
#include "math/error.hpp"
#include "math/quantity.hpp"

namespace packbed {
namespace {

namespace fs = std::filesystem;

constexpr const char* kReader = "packbed-cad-reader";
constexpr const char* kFormats = "a file named .step, .stp, .msh, .stl, .obj or .ply";

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// The reader stands beside the program, or where it was built or installed.
std::string find_reader() {
  std::error_code error;
  std::vector<fs::path> places;
  if (const char* told = std::getenv("PACKBED_CAD_READER")) places.emplace_back(told);
  const fs::path self = fs::read_symlink("/proc/self/exe", error).parent_path();
  if (!error) {
    places.push_back(self / kReader);
    places.push_back(self.parent_path() / "libexec/packbed" / kReader);
  }
  places.emplace_back(PACKBED_CAD_READER_BUILT);
  places.emplace_back(PACKBED_CAD_READER_INSTALLED);
  for (const fs::path& place : places)
    if (fs::is_regular_file(place, error)) return place.string();
  std::string looked;
  for (const fs::path& place : places) looked += "\n  " + place.string();
  throw SystemError(fmt::format(
      "{}, which reads CAD files for packbed, is nowhere. Looked for:{}\nInstall packbed whole, or "
      "name the program in the environment variable PACKBED_CAD_READER",
      kReader, looked));
}

void check_file(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw InputError(path, "no such file", kFormats, "check the path");
  if (!fs::is_regular_file(status)) throw InputError(path, "a folder or a device", kFormats);
  if (fs::file_size(path, error) == 0) throw InputError(path, "an empty file", kFormats, "export it again");
  if (!std::ifstream(path)) throw InputError(path, std::strerror(errno), "a file that can be read");
}

// First line that says something. gmsh takes what it does not know for a script and runs it: no file gets
// that far.
void check_heading(const std::string& path, CadFormat format) {
  if (format != CadFormat::step && format != CadFormat::msh) return;
  std::ifstream in(path, std::ios::binary);
  std::string head(4096, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  const std::size_t start = std::min(head.find_first_not_of(" \t\r\n"), head.size());
  if (format == CadFormat::step) {
    if (head.compare(start, 13, "ISO-10303-21;") != 0)
      throw InputError(path, "a file that does not begin with ISO-10303-21", "STEP (AP203, AP214 or AP242)",
                       "export it again as STEP");
    return;
  }
  const std::string allowed = "MSH of version 2.2 or 4.1";
  if (head.compare(0, 11, "$MeshFormat") != 0)
    throw InputError(path, "a file that does not begin with $MeshFormat", allowed, "save it again from gmsh");
  const std::size_t version = std::min(head.find_first_not_of(" \t\r\n", 11), head.size());
  const std::string found = head.substr(version, head.find_first_of(" \t\r\n", version) - version);
  if (found != "2.2" && found != "4.1")
    throw InputError(path, fmt::format("MSH of version \"{}\"", found.substr(0, 16)), allowed,
                     "save it again with Mesh.MshFileVersion = 4.1");
}

double scale_of(const std::string& path, CadFormat format, const std::string& unit) {
  if (format == CadFormat::step) {
    if (!unit.empty())
      throw InputError(path, fmt::format("unit = \"{}\" for a STEP file", unit),
                       "no unit: a STEP file has its own", "leave it out");
    return 1;
  }
  const std::string units = accepted_units(Dimension::length);
  if (unit.empty())
    throw InputError(path, "no unit", fmt::format("one of {}: {} files carry none", units, to_string(format)),
                     "give unit = \"mm\" in the case, or --unit mm");
  return length_unit(unit, path);
}

// Wall-clock time that the reader is given, over its processor time: a good file on a busy machine is no bad
// file.
constexpr double kPatience = 3;

std::string why_it_died(const ChildResult& child, const CadLimits& limits) {
  if (child.timed_out || child.signal == SIGXCPU || child.signal == SIGKILL)
    return fmt::format("a file that could not be read within {:g} s", limits.seconds);
  if (child.too_much)
    return fmt::format("a file that grows beyond {:.3g} MB", static_cast<double>(limits.memory) / 1e6);
  if (child.signal != 0)
    return fmt::format("a file that crashes the CAD library ({}; it ran in a process of its own)",
                       signal_name(child.signal));
  return fmt::format("a file that ends the CAD library (exit code {})", child.exit_code);
}

CadMessage ask_reader(const std::string& path, const CadRequest& request, const CadLimits& limits,
                      const std::string& allowed) {
  std::vector<std::string> argv = request.to_arguments();
  argv.insert(argv.begin(), find_reader());
  const ChildResult child = run_child(argv, kPatience * limits.seconds, limits.memory);
  const std::string fix = "open it in the program that made it, mend it and export it again";
  const std::optional<CadMessage> answer = decode(child.output);
  if (!answer) {
    if (child.exit_code == 0 || child.exit_code == 2)
      throw SystemError(fmt::format("{} is of another version than this packbed", argv[0]));
    throw InputError(path, why_it_died(child, limits), allowed, fix);
  }
  if (!answer->error.empty()) throw InputError(path, answer->error, allowed, fix);
  return *answer;
}

MeshReport checked(const CadModel& model, bool several_solids) {
  MeshReport report = check_mesh(model.mesh, {.several_solids = several_solids, .walls = false});
  if (const MeshFinding* wrong = report.fatal())
    throw InputError(model.path, fmt::format("{} ({})", wrong->sentence, to_string(wrong->problem)),
                     "the closed surface of one solid",
                     "mend it in the CAD program; packbed check says more");
  return report;
}

}  // namespace

std::string_view to_string(CadFormat format) {
  constexpr std::array<std::string_view, 5> names{"STEP", "MSH", "STL", "OBJ", "PLY"};
  return names[static_cast<std::size_t>(format)];
}

CadFormat cad_format(const std::string& path) {
  const std::string ending = lower(fs::path(path).extension().string());
  if (ending == ".step" || ending == ".stp") return CadFormat::step;
  if (ending == ".msh") return CadFormat::msh;
  if (ending == ".stl") return CadFormat::stl;
  if (ending == ".obj") return CadFormat::obj;
  if (ending == ".ply") return CadFormat::ply;
  throw InputError(path, ending.empty() ? "a name without an ending" : fmt::format("the ending {}", ending),
                   kFormats);
}

double length_unit(const std::string& unit, const std::string& where) {
  try {
    return parse_quantity("1 " + unit, Dimension::length, where);
  } catch (const InputError&) {
    throw InputError(where, fmt::format("unit = \"{}\"", unit),
                     "one of " + accepted_units(Dimension::length));
  }
}

CadModel read_cad(const std::string& path, const CadOptions& options) {
  CadModel model;
  model.path = path;
  model.format = cad_format(path);
  check_file(path);
  const double scale = scale_of(path, model.format, options.unit);
  check_heading(path, model.format);
  const std::string name(to_string(model.format));
  const CadRequest request{name,
                           path,
                           scale,
                           options.chord_error,
                           options.want_tets,
                           options.tet_size,
                           static_cast<double>(options.limits.memory),
                           options.limits.seconds};
  CadMessage answer =
      ask_reader(path, request, options.limits, fmt::format("a whole {} file of a closed body", name));
  model.unit = model.format == CadFormat::step ? "mm" : options.unit;
  model.detail = std::move(answer.detail);
  model.mesh = std::move(answer.mesh);
  model.tets = std::move(answer.tets);
  model.solids = answer.solids;
  model.volume = answer.volume;
  model.area = answer.area;
  model.notes = std::move(answer.notes);
  return model;
}

ShapePtr load_shape(const std::string& name, const std::string& path, const CadOptions& options) {
  const CadModel model = read_cad(path, options);
  const MeshReport report = checked(model, false);
  const ShapePtr shape = make_shape(name, path, report.mesh, options.recognise, model.volume.value_or(0));
  return model.tets ? with_tets(*shape, *model.tets) : shape;
}

Container load_container(const std::string& name, const std::string& path, const CadOptions& options) {
  const CadModel model = read_cad(path, options);
  return make_container(name, path, checked(model, true).mesh, options.recognise);
}

}  // namespace packbed
