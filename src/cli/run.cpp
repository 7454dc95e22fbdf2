// packbed run and packbed resume: case file in, result folder out.
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <thread>

#include "cli/commands.hpp"
#include "cli/finish.hpp"
#include "cli/progress.hpp"
#include "io/atomic_file.hpp"
#include "io/case.hpp"
#include "io/checkpoint.hpp"
#include "io/trajectory.hpp"
#include "math/error.hpp"
#include "math/threads.hpp"

namespace packbed::cli {
namespace {

std::atomic<bool> stop_asked{false};

void use_threads(int wanted) {
  if (wanted < 0)
    throw InputError("--threads", std::to_string(wanted), "1 or more", "leave it out to use all");
  set_threads(wanted > 0 ? wanted : static_cast<int>(std::max(1U, std::thread::hardware_concurrency())));
}

std::unique_ptr<TrajectoryWriter> trajectory_in(const ResultFolder& folder, const Scene& scene,
                                                bool goes_on) {
  std::vector<ShapePtr> shapes;
  for (const PelletKind& kind : scene.pellets) shapes.push_back(kind.shape);
  const int pellets = scene.feed.kind == FeedKind::placed ? static_cast<int>(scene.feed.placed.size())
                                                          : scene.feed.count.value_or(kSmallScene + 1);
  return std::make_unique<TrajectoryWriter>(folder, shapes, pellets, goes_on);
}

/// open: makes the folder, once it is known that the scene can be packed: a scene that is refused leaves
/// nothing behind and costs no earlier results.
int pack_into(const std::function<ResultFolder()>& open, const Scene& scene, std::span<const std::byte> state,
              bool quiet) {
  ProgressLine line(quiet);
  Watch watch;
  ResultFolder folder;
  std::unique_ptr<TrajectoryWriter> trajectory;
  watch.stop = &stop_asked;
  watch.progress = [&](const Progress& p) { line.show(p); };
  watch.checkpoint = [&](std::span<const std::byte> bytes) {
    write_checkpoint(folder.file(result_file::kCheckpoint), scene.case_text, bytes);
  };
  watch.accepted = [&] {
    folder = open();
    if (scene.output.trajectory_interval > 0) trajectory = trajectory_in(folder, scene, !state.empty());
  };
  watch.snapshot = [&](const Snapshot& snapshot) {
    trajectory->add(snapshot);
  };  // at an interval, else never
  std::signal(SIGINT, [](int) { stop_asked = true; });
  std::signal(SIGTERM, [](int) { stop_asked = true; });
  PackResult result = pack(scene, watch, state);
  line.end();
  if (result.stopped) {
    std::fprintf(stderr, "packbed: stopped at %.3f s simulated; continue with: packbed resume %s\n",
                 result.record.time.simulated_s, folder.path.c_str());
    return 1;
  }
  if (trajectory) trajectory->finish();
  return finish(folder, scene, result);
}

}  // namespace

int run(const RunOptions& options) {
  const Scene scene = read_case(options.case_file, options.sets, options.seed);
  if (options.dry) {
    std::fputs((scene.case_text + '\n' + plan(scene)).c_str(), stdout);
    return 0;
  }
  use_threads(options.threads);
  const std::string path = options.out.empty() ? "results/" + scene.name : options.out;
  require_new_folder(path, options.force);
  const auto open = [&] {
    ResultFolder folder = new_result_folder(path, options.force);
    write_atomically(folder.file(result_file::kCase), scene.case_text);
    return folder;
  };
  return pack_into(open, scene, {}, options.quiet);
}

int resume(const ResumeOptions& options) {
  const ResultFolder folder = interrupted_result_folder(options.folder);
  if (folder.has(result_file::kSummary)) {
    std::fprintf(stderr, "packbed: the run in %s has ended; nothing to resume\n", folder.path.c_str());
    return 0;
  }
  const std::string case_file = folder.file(result_file::kCase);
  const Scene scene = read_case_text(read_file(case_file), case_file);
  use_threads(options.threads);
  std::vector<std::byte> state;  // killed before the first checkpoint: from the start
  if (folder.has(result_file::kCheckpoint))
    state = read_checkpoint(folder.file(result_file::kCheckpoint), scene.case_text).state;
  return pack_into([&] { return folder; }, scene, state, options.quiet);
}

}  // namespace packbed::cli
