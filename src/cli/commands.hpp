#pragma once
// One function a sub-command; main.cpp reads the command line into these records. Each returns the exit code.
#include <optional>
#include <string>
#include <vector>

namespace packbed::cli {

struct RunOptions {
  std::string case_file, out;     // out empty: results/<case name>
  std::vector<std::string> sets;  // key=value
  std::optional<unsigned long long> seed;
  int threads = 0;  // 0: as many as the machine has
  bool quiet = false, dry = false, force = false;
};
int run(const RunOptions&);

struct ResumeOptions {
  std::string folder;
  int threads = 0;
  bool quiet = false;
};
int resume(const ResumeOptions&);

struct VoxeliseOptions {
  std::string bed, pitch = "0.1 mm", out;
  bool labels = false;
  int threads = 0;
};
int voxelise(const VoxeliseOptions&);

struct AnalyseOptions {
  std::string input, out, pitch = "0.1 mm";
  std::string container_diameter;  // for a grid that does not say it
  int threads = 0;
};
int analyse(const AnalyseOptions&);

struct CheckOptions {
  std::string file, unit;  // unit: of STL, OBJ, PLY
  bool tets = false;
  bool container = false;  // read it as a container, not as a pellet
};
int check(const CheckOptions&);

struct CompareOptions {
  std::vector<std::string> inputs;  // result folders, bed.h5, voxels.h5; with ladder: one case
  std::string out = "comparison";
  std::optional<std::string> pitch;  // unset: as the case of the first bed says, else as a case is without it
  std::optional<double> from, to;    // middle section [dp]; unset: likewise
  bool ladder = false, quiet = false;
  std::vector<std::string> methods{"digipac", "digicgp", "digidem", "mesh"};
  std::vector<std::string> sets;  // key=value, of the ladder's case
  std::optional<unsigned long long> seed;
  int threads = 0;
};
int compare(const CompareOptions&);

struct LawOptions {
  std::vector<std::string> inputs;  // result folders
  std::string out = "study", published;
};
int law(const LawOptions&);

struct HandoverOptions {
  std::string bed, to = "mesh", out = "handover";
  std::vector<std::string> sets;
  bool quiet = false, force = false;
  int threads = 0;
};
int handover(const HandoverOptions&);

struct BenchOptions {
  std::vector<std::string> names;  // empty: all
  std::string out = "bench", case_file = "cases/quick.toml";
  bool quick = false, list = false, quiet = false;
  int pellets = 0, seeds = 0;  // 0: as the case says, as the bench likes
  int threads = 0;             // 0: one
};
int bench(const BenchOptions&);

struct ExportOptions {
  std::string bed, to = "vtu", out;
};
int export_bed(const ExportOptions&);

}  // namespace packbed::cli
