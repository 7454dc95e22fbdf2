#pragma once
// Frames of a run as they happen. A kill at any moment leaves the frames before it readable, and a resumed
// run goes on where its own frames begin, without doubles.
#include <memory>
#include <string>
#include <vector>

#include "io/result_folder.hpp"
#include "packers/packer.hpp"

namespace packbed {

/// Scenes of more pellets get no trajectory.csv, and points instead of surfaces in their ParaView frames.
inline constexpr int kSmallScene = 1000;

/// While the run goes on: frames/frame_000000.vtu ..., trajectory.pvd, trajectory.csv (small scenes) and
/// trajectory.part, which finish() turns into trajectory.h5.
class TrajectoryWriter {
 public:
  /// A new trajectory, or with `resume` the one of an interrupted run. `pellets`: how many the run will have.
  /// Throws SystemError.
  TrajectoryWriter(const ResultFolder& folder, const std::vector<ShapePtr>& shapes, int pellets,
                   bool resume = false);
  ~TrajectoryWriter();
  TrajectoryWriter(const TrajectoryWriter&) = delete;
  TrajectoryWriter& operator=(const TrajectoryWriter&) = delete;

  /// Written when it returns. Frames that are already there for this time or later ones are replaced: a
  /// resumed run gives them again.
  void add(const Snapshot& snapshot);
  /// Makes trajectory.h5 of all frames and removes trajectory.part.
  void finish();
  int frames() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace packbed
