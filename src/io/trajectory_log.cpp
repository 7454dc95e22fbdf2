#include "io/trajectory_log.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <span>

#include "math/error.hpp"
#include "math/hash.hpp"

namespace packbed {
namespace {

constexpr std::uint64_t kMark = 0x31656d6172666270;  // "pbframe1"

struct Head {
  std::uint64_t mark = kMark, rows = 0, hash = 0, table_end = 0;
  double time = 0, elastic = 0;
};

std::uint64_t hash_of(Head head, const std::vector<FrameRow>& rows) {
  head.hash = 0;
  Hash hash;
  hash.add(head);
  hash.add(std::as_bytes(std::span(rows)));
  return hash.value();
}

bool read_whole(int fd, void* into, std::size_t size, std::uint64_t at) {
  char* out = static_cast<char*>(into);
  while (size > 0) {
    const ssize_t n = ::pread(fd, out, size, static_cast<off_t>(at));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    out += n;
    at += static_cast<std::uint64_t>(n);
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

bool write_whole(int fd, const void* from, std::size_t size, std::uint64_t at) {
  const char* in = static_cast<const char*>(from);
  while (size > 0) {
    const ssize_t n = ::pwrite(fd, in, size, static_cast<off_t>(at));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    in += n;
    at += static_cast<std::uint64_t>(n);
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

}  // namespace

Frame frame_of(const Snapshot& snapshot) {
  Frame frame;
  frame.time = snapshot.time;
  frame.elastic = snapshot.elastic;
  const std::vector<Pellet>& pellets = *snapshot.pellets;
  frame.rows.resize(pellets.size());
  for (std::size_t i = 0; i < pellets.size(); ++i) {
    const Pellet& p = pellets[i];
    FrameRow& row = frame.rows[i];
    row.id = p.id;
    row.shape = p.shape;
    row.scale = p.scale;
    for (int k = 0; k < 3; ++k) {
      row.position[k] = p.pose.position[k];
      row.velocity[k] = p.velocity[k];
      row.spin[k] = p.spin[k];
    }
    const Quat& q = p.pose.rotation;
    const double wxyz[4] = {q.w(), q.x(), q.y(), q.z()};
    std::memcpy(row.rotation, wxyz, sizeof wxyz);
    if (i >= snapshot.energies.size()) continue;
    const PelletEnergy& e = snapshot.energies[i];
    const double energy[3] = {e.translation, e.rotation, e.height};
    std::memcpy(row.energy, energy, sizeof energy);
  }
  return frame;
}

std::vector<Pellet> pellets_of(const Frame& frame) {
  std::vector<Pellet> pellets;
  for (const FrameRow& row : frame.rows) {
    Pellet p;
    p.id = row.id;
    p.shape = row.shape;
    p.scale = row.scale;
    p.pose = {Vec3(row.position), Quat(row.rotation[0], row.rotation[1], row.rotation[2], row.rotation[3])};
    p.velocity = Vec3(row.velocity);
    p.spin = Vec3(row.spin);
    pellets.push_back(p);
  }
  return pellets;
}

void TrajectoryLog::fail(const std::string& doing) const {
  throw SystemError(fmt::format("{}: {} failed: {}", path_, doing, std::strerror(errno)));
}

TrajectoryLog::TrajectoryLog(const std::string& path, bool keep)
    : path_(path), fd_(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | (keep ? 0 : O_TRUNC), 0644)) {
  if (fd_ < 0) fail("opening");
  Entry entry;
  for (Frame frame; read_at(entry.begin, frame, entry.end); entry.begin = entry.end) {
    entry.time = frame.time;
    index_.push_back(entry);
  }
  keep_first(frames());
}

TrajectoryLog::~TrajectoryLog() {
  ::close(fd_);
}

bool TrajectoryLog::read_at(std::uint64_t begin, Frame& frame, std::uint64_t& end) const {
  struct stat status {};
  Head head;
  if (::fstat(fd_, &status) != 0 || !read_whole(fd_, &head, sizeof head, begin) || head.mark != kMark)
    return false;
  const std::uint64_t room =
      (static_cast<std::uint64_t>(status.st_size) - begin - sizeof head) / sizeof(FrameRow);
  if (head.rows > room) return false;  // torn, or no frame at all
  frame.time = head.time;
  frame.elastic = head.elastic;
  frame.table_end = head.table_end;
  frame.rows.resize(head.rows);
  const std::size_t bytes = head.rows * sizeof(FrameRow);
  if (!read_whole(fd_, frame.rows.data(), bytes, begin + sizeof head) ||
      hash_of(head, frame.rows) != head.hash)
    return false;
  end = begin + sizeof head + bytes;
  return true;
}

Frame TrajectoryLog::read(int frame) const {
  Frame out;
  std::uint64_t end = 0;
  if (!read_at(index_.at(static_cast<std::size_t>(frame)).begin, out, end)) fail("reading a frame");
  return out;
}

void TrajectoryLog::append(const Frame& frame) {
  Head head;
  head.rows = frame.rows.size();
  head.table_end = frame.table_end;
  head.time = frame.time;
  head.elastic = frame.elastic;
  head.hash = hash_of(head, frame.rows);
  const std::uint64_t begin = index_.empty() ? 0 : index_.back().end;
  const std::size_t bytes = frame.rows.size() * sizeof(FrameRow);
  if (!write_whole(fd_, &head, sizeof head, begin) ||
      !write_whole(fd_, frame.rows.data(), bytes, begin + sizeof head))
    fail("writing");
  index_.push_back({begin, begin + sizeof head + bytes, frame.time});
}

void TrajectoryLog::keep_first(int frames) {
  index_.resize(static_cast<std::size_t>(frames));
  const std::uint64_t end = index_.empty() ? 0 : index_.back().end;
  if (::ftruncate(fd_, static_cast<off_t>(end)) != 0) fail("cutting");
}

}  // namespace packbed
