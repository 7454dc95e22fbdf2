#pragma once
// An append-only file of frames. Each frame carries its length and hash, so a frame that a kill tore is found
// and cut off; all before it stay.
#include <cstdint>
#include <string>
#include <vector>

#include "packers/packer.hpp"

namespace packbed {

/// One pellet in one frame, as stored.
struct FrameRow {
  std::uint32_t id = 0, shape = 0;
  double position[3]{};  // [m]
  double rotation[4]{};  // w, x, y, z
  double scale = 1;      // [-]
  double velocity[3]{};  // [m/s]
  double spin[3]{};      // [rad/s]
  double energy[3]{};    // translation, rotation, height [J]
};

struct Frame {
  double time = 0;              // [s]
  double elastic = 0;           // [J]
  std::uint64_t table_end = 0;  // length of trajectory.csv with this frame [byte]
  std::vector<FrameRow> rows;
};

Frame frame_of(const Snapshot& snapshot);
std::vector<Pellet> pellets_of(const Frame& frame);

class TrajectoryLog {
 public:
  /// A new log, or the whole frames of an existing one. Throws SystemError.
  TrajectoryLog(const std::string& path, bool keep);
  ~TrajectoryLog();
  TrajectoryLog(const TrajectoryLog&) = delete;
  TrajectoryLog& operator=(const TrajectoryLog&) = delete;

  int frames() const { return static_cast<int>(index_.size()); }
  double time(int frame) const { return index_[static_cast<std::size_t>(frame)].time; }
  Frame read(int frame) const;
  void append(const Frame& frame);
  void keep_first(int frames);  ///< cuts off the rest

 private:
  struct Entry {
    std::uint64_t begin = 0, end = 0;  // in the file [byte]
    double time = 0;
  };
  bool read_at(std::uint64_t begin, Frame& frame, std::uint64_t& end) const;
  [[noreturn]] void fail(const std::string& doing) const;

  std::string path_;
  int fd_ = -1;
  std::vector<Entry> index_;
};

}  // namespace packbed
