// The program: reads the command line and hands over to one function a sub-command.
#include <CLI/CLI.hpp>
#include <cstdio>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "cli/commands.hpp"
#include "math/error.hpp"

namespace packbed::cli {
namespace {

void add_run(CLI::App& app, int& code) {
  auto o = std::make_shared<RunOptions>();
  CLI::App* c =
      app.add_subcommand("run", "pack a bed as a case file says, analyse it, write the result folder");
  c->add_option("case", o->case_file, "case file (TOML)")->required();
  c->add_option("--out", o->out, "result folder (default: results/<case name>)");
  c->add_option("--set", o->sets, "change a key of the case, e.g. --set contact.friction=0.6")->take_all();
  c->add_option("--seed", o->seed, "seed of all random numbers");
  c->add_option("--threads", o->threads,
                "threads (default: as many as the machine has); the bed is the same for any number");
  c->add_flag("--quiet", o->quiet, "no progress, only the summary");
  c->add_flag("--dry", o->dry, "print the case with its defaults and the plan; pack nothing");
  c->add_flag("--force", o->force, "overwrite an existing result folder");
  c->footer(
      "Examples:\n  packbed run cases/quick.toml\n  packbed run cases/quick.toml --set feed.count=100 --seed "
      "7 --out /tmp/q7");
  c->callback([o, &code] { code = run(*o); });
}

void add_resume(CLI::App& app, int& code) {
  auto o = std::make_shared<ResumeOptions>();
  CLI::App* c = app.add_subcommand("resume", "continue an interrupted run, bit for bit");
  c->add_option("folder", o->folder, "result folder of the interrupted run")->required();
  c->add_option("--threads", o->threads, "threads");
  c->add_flag("--quiet", o->quiet, "no progress, only the summary");
  c->footer("Example:\n  packbed resume results/a38_lc_poured");
  c->callback([o, &code] { code = resume(*o); });
}

void add_voxelise(CLI::App& app, int& code) {
  auto o = std::make_shared<VoxeliseOptions>();
  CLI::App* c = app.add_subcommand("voxelise", "bed to grid");
  c->add_option("bed", o->bed, "bed.h5 or result folder")->required();
  c->add_option("--pitch", o->pitch, "edge of a voxel, e.g. \"0.1 mm\"");
  c->add_option("--out", o->out, "file to write (default: voxels.h5 beside the bed)");
  c->add_flag("--labels", o->labels, "store which pellet fills a voxel, not only that one does");
  c->add_option("--threads", o->threads, "threads");
  c->footer("Example:\n  packbed voxelise results/quick --pitch \"0.05 mm\"");
  c->callback([o, &code] { code = voxelise(*o); });
}

void add_analyse(CLI::App& app, int& code) {
  auto o = std::make_shared<AnalyseOptions>();
  CLI::App* c = app.add_subcommand("analyse", "profiles, orientations, overlaps of a bed or a grid");
  c->add_option("input", o->input, "bed.h5, voxels.h5 or result folder")->required();
  c->add_option("--out", o->out, "folder for the curves (default: beside the input)");
  c->add_option("--pitch", o->pitch, "edge of a voxel for a bed, e.g. \"0.1 mm\"");
  c->add_option("--diameter", o->container_diameter,
                "inner diameter of the container, for a grid that does not say it");
  c->add_option("--threads", o->threads, "threads");
  c->footer("Example:\n  packbed analyse results/quick --pitch \"0.05 mm\" --out /tmp/fine");
  c->callback([o, &code] { code = analyse(*o); });
}

void add_bench(CLI::App& app, int& code) {
  auto o = std::make_shared<BenchOptions>();
  CLI::App* c = app.add_subcommand("bench", "run time against error: tables, pictures and a page");
  c->add_option("names", o->names, "benches to run (default: all)");
  c->add_option("--out", o->out, "folder for bench.html, and a CSV and pictures each (default: bench)");
  c->add_option("--case", o->case_file, "case of the benches that pour beds (default: cases/quick.toml)");
  c->add_option("--pellets", o->pellets, "of these beds (default: as the case says)")
      ->check(CLI::PositiveNumber);
  c->add_option("--seeds", o->seeds, "of these beds (default: as the bench likes)")
      ->check(CLI::PositiveNumber);
  c->add_option("--threads", o->threads, "threads (default: 1, so that CPU times are those of one core)");
  c->add_flag("--quick", o->quick, "small sizes, about a minute in all");
  c->add_flag("--list", o->list, "tell the benches and what they ask");
  c->add_flag("--quiet", o->quiet, "no progress");
  c->footer("Examples:\n  packbed bench --quick --out results/bench\n  packbed bench contact integrator");
  c->callback([o, &code] { code = bench(*o); });
}

void add_check(CLI::App& app, int& code) {
  auto o = std::make_shared<CheckOptions>();
  CLI::App* c =
      app.add_subcommand("check", "what is wrong with a CAD file or a case, and what will be made of it");
  c->add_option("file", o->file, "STEP, MSH, STL, OBJ, PLY or TOML")->required();
  c->add_option("--unit", o->unit, "of lengths in STL, OBJ, PLY and MSH files: m, cm, mm, um, in");
  c->add_flag("--tets", o->tets, "also fill it with tetrahedra");
  c->add_flag("--container", o->container, "read it as a container");
  c->footer(
      "Examples:\n  packbed check meshes/a38.step\n  packbed check pellet.stl --unit mm\n  packbed check "
      "cases/quick.toml");
  c->callback([o, &code] { code = check(*o); });
}

void add_export(CLI::App& app, int& code) {
  auto o = std::make_shared<ExportOptions>();
  CLI::App* c = app.add_subcommand("export", "a bed as a file of another kind");
  c->add_option("bed", o->bed, "bed.h5 or result folder")->required();
  c->add_option("--to", o->to, "stl | vtu | csv | obj | contacts")
      ->check(CLI::IsMember({"stl", "vtu", "csv", "obj", "contacts"}));
  c->add_option("--out", o->out, "file to write (default: bed.<kind> beside the bed)");
  c->footer("Example:\n  packbed export results/quick --to stl --out bed.stl");
  c->callback([o, &code] { code = export_bed(*o); });
}

void add_compare(CLI::App& app, int& code) {
  auto o = std::make_shared<CompareOptions>();
  CLI::App* c = app.add_subcommand(
      "compare", "beds and grids side by side: densities, curves, orientations, time, memory");
  c->add_option("inputs", o->inputs, "result folders, bed.h5 or voxels.h5; with --ladder one case file")
      ->required();
  c->add_option("--out", o->out, "folder for tables, curves and the page (default: comparison)");
  c->add_option("--pitch", o->pitch,
                "edge of a voxel for beds, e.g. \"0.1 mm\" (default: as the case of the first bed says)");
  c->add_option("--from", o->from,
                "lower end of the middle section, in pellet diameters (default: likewise)");
  c->add_option("--to", o->to, "upper end of the middle section, in pellet diameters (default: likewise)");
  c->add_flag("--ladder", o->ladder, "pack the case by each of --methods first, unless that has been done");
  c->add_option("--methods", o->methods, "of the ladder (default: digipac,digicgp,digidem,mesh)")
      ->delimiter(',');
  c->add_option("--set", o->sets, "change a key of the ladder's case")->take_all();
  c->add_option("--seed", o->seed, "of the ladder");
  c->add_option("--threads", o->threads, "threads");
  c->add_flag("--quiet", o->quiet, "no progress");
  c->footer(
      "Examples:\n  packbed compare results/a results/b\n  packbed compare --ladder cases/quick.toml --out "
      "results/ladder");
  c->callback([o, &code] { code = compare(*o); });
}

void add_law(CLI::App& app, int& code) {
  auto o = std::make_shared<LawOptions>();
  CLI::App* c = app.add_subcommand(
      "law", "beds of different smallest sizes side by side: core porosity, segregation, the fractal law");
  c->add_option("inputs", o->inputs, "result folders")->required();
  c->add_option("--out", o->out, "folder for table, law and page (default: study)");
  c->add_option("--published", o->published,
                "CSV of published numbers to put beside (quantity,value,low,high)");
  c->footer("Example:\n  packbed law results/wood_chips/* --published cases/wood_chips/published.csv");
  c->callback([o, &code] { code = law(*o); });
}

void add_handover(CLI::App& app, int& code) {
  auto o = std::make_shared<HandoverOptions>();
  CLI::App* c =
      app.add_subcommand("handover", "start a run of another method from a bed, and compare the two");
  c->add_option("bed", o->bed, "bed.h5 or result folder")->required();
  c->add_option("--to", o->to, "method (default: mesh)")
      ->check(CLI::IsMember({"mesh", "digipac", "digicgp", "digidem"}));
  c->add_option("--out", o->out, "folder for the runs and their comparison (default: handover)");
  c->add_option("--set", o->sets, "change a key of the bed's case")->take_all();
  c->add_option("--threads", o->threads, "threads");
  c->add_flag("--quiet", o->quiet, "no progress");
  c->add_flag("--force", o->force, "overwrite earlier results");
  c->footer("Example:\n  packbed handover results/table1_digipac --to mesh --out results/polished");
  c->callback([o, &code] { code = handover(*o); });
}

/// Lists of contacts are made anew many times a second: their memory is kept instead of being given back to
/// the system, which would clear each page again.
void keep_memory() {
#ifdef __GLIBC__
  constexpr int kMost = 1 << 26;  // larger pieces, those of checkpoints, do go back
  mallopt(M_MMAP_THRESHOLD, kMost);
  mallopt(M_TRIM_THRESHOLD, 4 * kMost);
#endif
}

}  // namespace
}  // namespace packbed::cli

int main(int argc, char** argv) {
  using namespace packbed;
  cli::keep_memory();
  CLI::App app{"packbed pours CAD pellets into CAD containers and tells what the bed is like."};
  app.set_version_flag("--version", "packbed " PACKBED_VERSION);
  app.require_subcommand(1);
  app.footer("Exit codes: 0 good; 1 the run ended but its audit failed; 2 wrong input; 3 internal error.");
  int code = 0;
  cli::add_run(app, code);
  cli::add_resume(app, code);
  cli::add_voxelise(app, code);
  cli::add_analyse(app, code);
  cli::add_bench(app, code);
  cli::add_check(app, code);
  cli::add_export(app, code);
  cli::add_compare(app, code);
  cli::add_law(app, code);
  cli::add_handover(app, code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  } catch (const InputError& e) {
    std::fprintf(stderr, "packbed: %s\n", e.what());
    return 2;
  } catch (const SystemError& e) {
    std::fprintf(stderr, "packbed: %s\n", e.what());
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "packbed: internal error: %s\n", e.what());
    return 3;
  }
  return code;
}
