#pragma once
// Frames of a run as they happen. A kill at any moment leaves the frames before it readable, and a resumed
// run goes on behind the last one that is not ahead of its checkpoint.
#include <memory>
#include <string>

#include "bed/packed_bed.hpp"
#include "io/result_folder.hpp"
#include "packers/packer.hpp"

namespace packbed {

/// Scenes of more pellets than this get no trajectory.csv and no surfaces in their ParaView frames.
inline constexpr int kSmallScene = 1000;

/// Writes trajectory.h5, frames/frame_000000.vtu ... with trajectory.pvd, and trajectory.csv for small
/// scenes.
class TrajectoryWriter {
 public:
  /// A new trajectory, or the one of an interrupted run: frames later than `resume_from` [s] are dropped,
  /// because the run will give them again. Pass a negative number for a new one. Throws SystemError,
  /// InputError.
  TrajectoryWriter(const ResultFolder& folder, const std::vector<ShapePtr>& shapes, double resume_from = -1);
  ~TrajectoryWriter();
  TrajectoryWriter(const TrajectoryWriter&) = delete;
  TrajectoryWriter& operator=(const TrajectoryWriter&) = delete;

  void add(const Snapshot& snapshot);  ///< on disk when it returns; a time that is already there is skipped
  int frames() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace packbed
