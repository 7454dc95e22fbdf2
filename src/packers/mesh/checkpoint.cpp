#include "packers/mesh/checkpoint.hpp"

#include <cstring>
#include <type_traits>

#include "math/error.hpp"

namespace packbed::mesh {
namespace {

constexpr std::uint64_t kFormat = 0x706b6264'00000004;  // changes with any change of State

class Writer {
 public:
  std::vector<std::byte> bytes;
  template <class T>
  void operator()(const T& value) {
    raw(&value, sizeof(T));
  }
  template <class T>
  void operator()(const std::vector<T>& values) {
    const std::uint64_t n = values.size();
    raw(&n, sizeof n);
    raw(values.data(), n * sizeof(T));
  }

 private:
  void raw(const void* data, std::size_t size) {
    if (size == 0) return;
    const std::size_t at = bytes.size();
    bytes.resize(at + size);
    std::memcpy(bytes.data() + at, data, size);
  }
};

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <class T>
  void operator()(T& value) {
    raw(&value, sizeof(T));
  }
  template <class T>
  void operator()(std::vector<T>& values) {
    std::uint64_t n = 0;
    raw(&n, sizeof n);
    if (n > bytes_.size() / sizeof(T)) fail();
    values.resize(n);
    raw(values.data(), n * sizeof(T));
  }
  bool at_end() const { return bytes_.empty(); }
  [[noreturn]] static void fail() { throw SystemError("checkpoint: not the state of a mesh packing run"); }

 private:
  void raw(void* data, std::size_t size) {
    if (size == 0) return;
    if (size > bytes_.size()) fail();
    std::memcpy(data, bytes_.data(), size);
    bytes_ = bytes_.subspan(size);
  }
  std::span<const std::byte> bytes_;
};

/// Names every member once, for writing and for reading.
template <class Archive, class S>
void visit(Archive& io, S& s) {
  io(s.time), io(s.steps);
  auto& b = s.bodies;
  io(b.kind), io(b.inverse_mass), io(b.mass), io(b.inertia), io(b.inverse_inertia), io(b.bounding_radius);
  io(b.position), io(b.rotation), io(b.axis), io(b.velocity), io(b.angular_momentum), io(b.spin),
      io(b.velocity_ahead), io(b.spin_ahead), io(b.travel);
  io(b.force), io(b.torque), io(b.motion);
  io(s.flight_end), io(s.flight_from), io(s.listed_at), io(s.margin), io(s.doze);
  auto& p = s.pairs;
  io(p.pair), io(p.look_at), io(p.load), io(p.record), io(p.active), io(p.first), io(p.entry), io(p.shore),
      io(p.shore_stale);
  io(s.awake), io(s.next_landing), io(s.search_due);
  io(s.rest_since), io(s.rest_anchor), io(s.at_rest), io(s.last_watch), io(s.rest_speed), io(s.rest_force),
      io(s.rest_drift);
  io(s.rollers), io(s.waited), io(s.snapshots), io(s.wall_s), io(s.cpu_s), io(s.ledger);
}

}  // namespace

std::vector<std::byte> save(const State& state, const Feeder& feeder) {
  Writer writer;
  writer(kFormat);
  visit(writer, state);
  writer(feeder.save());
  return std::move(writer.bytes);
}

void restore(std::span<const std::byte> bytes, State& state, Feeder& feeder) {
  Reader reader(bytes);
  std::uint64_t format = 0;
  reader(format);
  if (format != kFormat) Reader::fail();
  State fresh;
  visit(reader, fresh);
  std::vector<std::byte> feed;
  reader(feed);
  if (!reader.at_end()) Reader::fail();
  feeder.restore(feed);
  state = std::move(fresh);
}

}  // namespace packbed::mesh
