#pragma once
// A checkpoint: a mark that changes with the state's layout, the state, and the feeder's few numbers.
#include "packers/archive.hpp"
#include "packers/feed.hpp"

namespace packbed {

/// visit(io) names every member of the state to the archive.
template <class Visit>
std::vector<std::byte> checkpoint_of(std::uint64_t format, const Feeder& feeder, const Visit& visit) {
  ArchiveWriter io;
  io(format);
  visit(io);
  io(feeder.save());
  return std::move(io.bytes);
}

/// Throws SystemError when the bytes are not of that format and layout; the feeder is restored last.
template <class Visit>
void restore_checkpoint(std::span<const std::byte> bytes, const char* what, std::uint64_t format,
                        Feeder& feeder, const Visit& visit) {
  ArchiveReader io(bytes, what);
  std::uint64_t found = 0;
  io(found);
  if (found != format) io.fail();
  visit(io);
  std::vector<std::byte> feed;
  io(feed);
  if (!io.at_end()) io.fail();
  feeder.restore(feed);
}

}  // namespace packbed
