// Frames survive a kill and a resumed run adds no doubles: the files end up as if nothing had happened.
#include "io/trajectory.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "io/atomic_file.hpp"
#include "io/sample_bed.hpp"
#include "io/temporary_folder.hpp"
#include "io/trajectory_log.hpp"

namespace packbed {
namespace {

namespace fs = std::filesystem;

/// The state of a made-up run at a time: pellets fall, one more every frame.
std::vector<Pellet> pellets_at(double time) {
  std::vector<Pellet> pellets = sample_bed(5 + static_cast<int>(std::lround(10 * time))).pellets;
  for (Pellet& p : pellets) p.pose.position.z() -= time * time;
  return pellets;
}

void add_frames(TrajectoryWriter& writer, int from, int to) {
  for (int i = from; i < to; ++i) {
    const std::vector<Pellet> pellets = pellets_at(0.1 * i);
    writer.add(
        {0.1 * i, &pellets, std::vector<PelletEnergy>(pellets.size(), {1e-6 * i, 2e-6, 1.0 / 3}), 1e-9 * i});
  }
}

std::string content_of(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) names.push_back(entry.path().string());
  std::sort(names.begin(), names.end());
  std::string all;
  for (const std::string& name : names) all += name.substr(folder.size()) + "\n" + read_file(name);
  return all;
}

std::string uninterrupted(int frames) {
  const TemporaryFolder folder;
  TrajectoryWriter writer({folder.path()}, sample_bed(1).shapes, 20);
  add_frames(writer, 0, frames);
  writer.finish();
  return content_of(folder.path());
}

TEST(Trajectory, AResumedOneIsTheUninterruptedOne) {
  const TemporaryFolder folder;
  {
    TrajectoryWriter writer({folder.path()}, sample_bed(1).shapes, 20);
    add_frames(writer, 0, 7);
  }
  // the checkpoint was older than the last frames: the resumed run gives frames 4 to 6 again
  TrajectoryWriter writer({folder.path()}, sample_bed(1).shapes, 20, true);
  EXPECT_EQ(writer.frames(), 7);
  add_frames(writer, 4, 10);
  EXPECT_EQ(writer.frames(), 10);
  writer.finish();
  EXPECT_EQ(content_of(folder.path()), uninterrupted(10));
}

TEST(Trajectory, ATornFrameIsCutOffAndAllBeforeItStay) {
  const TemporaryFolder whole;
  {
    TrajectoryWriter writer({whole.path()}, sample_bed(1).shapes, 20);
    add_frames(writer, 0, 4);
  }
  const std::string log = read_file(whole / "trajectory.part");
  for (const std::size_t lost : {1u, 100u, 500u}) {
    const TemporaryFolder folder;
    fs::copy(whole.path(), folder.path(), fs::copy_options::recursive);
    fs::resize_file(folder / "trajectory.part", log.size() - lost);
    std::ofstream(folder / "trajectory.csv", std::ios::app) << "0.3,1,0.0";  // a line cut short
    TrajectoryWriter writer({folder.path()}, sample_bed(1).shapes, 20, true);
    EXPECT_EQ(writer.frames(), 3);
    add_frames(writer, 3, 6);
    writer.finish();
    EXPECT_EQ(content_of(folder.path()), uninterrupted(6));
  }
}

TEST(Trajectory, SurvivesKillAtAnyMoment) {
  for (int round = 0; round < 5; ++round) {
    const TemporaryFolder folder;
    int alive[2];
    ASSERT_EQ(pipe(alive), 0);
    const pid_t child = fork();
    if (child == 0) {
      TrajectoryWriter writer({folder.path()}, sample_bed(1).shapes, 20);
      for (int i = 0;; ++i) {
        add_frames(writer, i, i + 1);
        if (write(alive[1], "x", 1) != 1) _exit(1);
      }
    }
    char seen[1];
    for (int i = 0; i <= round; ++i) ASSERT_EQ(read(alive[0], seen, 1), 1);
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    close(alive[0]);
    close(alive[1]);
    for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
      if (entry.path().extension() == ".tmp") fs::remove(entry.path());
    TrajectoryWriter writer({folder.path()}, sample_bed(1).shapes, 20, true);
    const int frames = writer.frames();
    EXPECT_GE(frames, round + 1) << "frames that were reported are there";
    add_frames(writer, frames - 1, frames + 2);
    writer.finish();
    EXPECT_EQ(content_of(folder.path()), uninterrupted(frames + 2));
  }
}

TEST(Trajectory, TableHasTheAgreedColumns) {
  const TemporaryFolder folder;
  TrajectoryWriter writer({folder.path()}, sample_bed(1).shapes, 20);
  add_frames(writer, 0, 2);
  const std::string table = read_file(folder / "trajectory.csv");
  EXPECT_EQ(
      table.substr(0, table.find('\n')),
      "t_s,id,x_m,y_m,z_m,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz,e_trans_J,e_rot_J,e_height_J,e_elastic_total_J");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 5 + 6);
}

TEST(Trajectory, ALargeSceneHasNoTable) {
  const TemporaryFolder folder;
  TrajectoryWriter writer({folder.path()}, sample_bed(1).shapes, kSmallScene + 1);
  add_frames(writer, 0, 2);
  writer.finish();
  EXPECT_FALSE(fs::exists(folder / "trajectory.csv"));
  EXPECT_TRUE(fs::exists(folder / "trajectory.h5"));
  EXPECT_TRUE(fs::exists(folder / "frames/frame_000001.vtu"));
}

TEST(Trajectory, AForeignOrTornLogHoldsNoFrames) {
  const TemporaryFolder folder;
  write_atomically(folder / "log",
                   "this is no log of frames, but it is longer than the head of a frame ......");
  EXPECT_EQ(TrajectoryLog(folder / "log", true).frames(), 0);
  write_atomically(folder / "log", "x");
  EXPECT_EQ(TrajectoryLog(folder / "log", true).frames(), 0);
}

}  // namespace
}  // namespace packbed
