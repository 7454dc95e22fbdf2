#include "io/trajectory.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "io/atomic_file.hpp"
#include "io/hdf5_image.hpp"
#include "io/trajectory_log.hpp"
#include "io/vtu.hpp"
#include "math/error.hpp"

namespace packbed {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kColumns =
    "t_s,id,x_m,y_m,z_m,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz,e_trans_J,e_rot_J,e_height_J,e_elastic_total_J\n";

std::string frame_name(int frame) {
  return fmt::format("{}/frame_{:06d}.vtu", result_file::kFrames, frame);
}

std::string table_lines(const Frame& frame) {
  std::string out;
  for (const FrameRow& r : frame.rows) {
    fmt::format_to(std::back_inserter(out), "{},{}", frame.time, r.id);
    for (const std::span<const double> part :
         {std::span<const double>(r.position), std::span<const double>(r.rotation),
          std::span<const double>(r.velocity), std::span<const double>(r.spin),
          std::span<const double>(r.energy)})
      for (const double x : part) fmt::format_to(std::back_inserter(out), ",{}", x);
    fmt::format_to(std::back_inserter(out), ",{}\n", frame.elastic);
  }
  return out;
}

/// One column of a frame, as the data set of all frames wants it.
template <std::size_t N>
std::vector<double> vectors(const Frame& frame, const double (FrameRow::*member)[N]) {
  std::vector<double> out;
  out.reserve(N * frame.rows.size());
  for (const FrameRow& r : frame.rows) out.insert(out.end(), std::begin(r.*member), std::end(r.*member));
  return out;
}

template <class T>
std::vector<T> scalars(const Frame& frame, T FrameRow::*member) {
  std::vector<T> out;
  out.reserve(frame.rows.size());
  for (const FrameRow& r : frame.rows) out.push_back(r.*member);
  return out;
}

void append_frame(Hdf5Writer& file, const Frame& frame) {
  file.append("/time_s", std::vector<double>{frame.time});
  file.append("/elastic_J", std::vector<double>{frame.elastic});
  file.append("/rows", std::vector<std::uint64_t>{frame.rows.size()});
  file.append("/id", scalars(frame, &FrameRow::id));
  file.append("/shape", scalars(frame, &FrameRow::shape));
  file.append("/scale", scalars(frame, &FrameRow::scale));
  file.append("/position_m", vectors(frame, &FrameRow::position), 3);
  file.append("/rotation_wxyz", vectors(frame, &FrameRow::rotation), 4);
  file.append("/velocity_m_s", vectors(frame, &FrameRow::velocity), 3);
  file.append("/spin_rad_s", vectors(frame, &FrameRow::spin), 3);
  file.append("/energy_J", vectors(frame, &FrameRow::energy), 3);
}

}  // namespace

struct TrajectoryWriter::State {
  ResultFolder folder;
  std::vector<ShapePtr> shapes;
  bool small = false;
  TrajectoryLog log;

  State(const ResultFolder& f, const std::vector<ShapePtr>& s, int pellets, bool resume)
      : folder(f),
        shapes(s),
        small(pellets <= kSmallScene),
        log(f.file(result_file::kTrajectoryLog), resume) {}

  std::string table() const { return folder.file(result_file::kTrajectoryCsv); }

  void start_table() const {
    if (small) write_atomically(table(), kColumns);
  }

  /// Forgets the frames from `count` on, in every file.
  void cut(int count) {
    for (int i = count;; ++i)
      if (!fs::remove(folder.file(frame_name(i)))) break;
    log.keep_first(count);
    if (!small) return;
    if (count == 0) return start_table();
    fs::resize_file(table(), log.read(count - 1).table_end);
  }

  void write_series() const {
    std::string out =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
        "<Collection>\n";
    for (int i = 0; i < log.frames(); ++i)
      fmt::format_to(std::back_inserter(out), "<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n",
                     log.time(i), frame_name(i));
    write_atomically(folder.file(result_file::kTrajectorySeries), out + "</Collection>\n</VTKFile>\n");
  }

  void append_table(Frame& frame) const {
    if (!small) return;
    const std::string lines = table_lines(frame);
    std::ofstream file(table(), std::ios::binary | std::ios::app);
    file.write(lines.data(), static_cast<std::streamsize>(lines.size()));
    file.close();
    if (!file) throw SystemError(table() + ": writing failed (is the disk full?)");
    frame.table_end = fs::file_size(table());
  }
};

TrajectoryWriter::TrajectoryWriter(const ResultFolder& folder, const std::vector<ShapePtr>& shapes,
                                   int pellets, bool resume) try
    : state_(std::make_unique<State>(folder, shapes, pellets, resume)) {
  fs::create_directories(folder.file(result_file::kFrames));
  state_->cut(state_->log.frames());  // a frame that a kill tore
} catch (const fs::filesystem_error& e) {
  throw SystemError(fmt::format("{}: {}", e.path1().string(), e.code().message()));
}

TrajectoryWriter::~TrajectoryWriter() = default;

int TrajectoryWriter::frames() const {
  return state_->log.frames();
}

void TrajectoryWriter::add(const Snapshot& snapshot) {
  int before = frames();
  while (before > 0 && state_->log.time(before - 1) >= snapshot.time) --before;
  if (before < frames()) state_->cut(before);
  Frame frame = frame_of(snapshot);
  const std::string path = state_->folder.file(frame_name(before));
  if (state_->small)
    write_vtu(path, state_->shapes, *snapshot.pellets);
  else
    write_point_vtu(path, *snapshot.pellets);
  state_->append_table(frame);
  state_->log.append(frame);  // last: a frame counts once it is here
  state_->write_series();
}

void TrajectoryWriter::finish() {
  write_atomically(state_->folder.file(result_file::kTrajectory), [&](const std::string& temporary) {
    Hdf5Writer file(temporary);
    for (int i = 0; i < frames(); ++i) append_frame(file, state_->log.read(i));
    file.close();
  });
  fs::remove(state_->folder.file(result_file::kTrajectoryLog));
}

}  // namespace packbed
