#include "io/cad_reader/message.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace packbed {
namespace {

constexpr std::uint64_t kMagic = 0x31304441434B4250;  // "PBKCAD01"

struct Writer {
  std::vector<std::byte> bytes;

  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto* from = reinterpret_cast<const std::byte*>(&value);
    bytes.insert(bytes.end(), from, from + sizeof value);
  }
  void put(const std::string& text) {
    put<std::uint64_t>(text.size());
    const auto* from = reinterpret_cast<const std::byte*>(text.data());
    bytes.insert(bytes.end(), from, from + text.size());
  }
  template <class T>
  void put(const std::optional<T>& value) {
    put<std::uint8_t>(value.has_value());
    if (value) put(*value);
  }
  template <class T>
  void put(const std::vector<T>& list) {
    put<std::uint64_t>(list.size());
    for (const T& item : list) put(item);
  }
  void put(const Vec3& v) {
    for (int i = 0; i < 3; ++i) put(v[i]);
  }
  void put(const TriangleMesh& m) {
    put(m.vertices);
    put(m.triangles);
  }
  void put(const TetMesh& m) {
    put(m.vertices);
    put(m.tets);
  }
};

struct Cut {};  // the bytes end too early, or a length is beyond them

struct Reader {
  std::span<const std::byte> left;

  std::span<const std::byte> take(std::size_t n) {
    if (n > left.size()) throw Cut();
    const auto out = left.first(n);
    left = left.subspan(n);
    return out;
  }
  template <class T>
  void get(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
  }
  std::size_t length(std::size_t least_bytes_each) {
    std::uint64_t n = 0;
    get(n);
    if (n > left.size() / least_bytes_each) throw Cut();
    return static_cast<std::size_t>(n);
  }
  void get(std::string& text) {
    const auto from = take(length(1));
    text.assign(reinterpret_cast<const char*>(from.data()), from.size());
  }
  template <class T>
  void get(std::optional<T>& value) {
    std::uint8_t there = 0;
    get(there);
    if (there) get(value.emplace());
  }
  template <class T>
  void get(std::vector<T>& list) {
    list.resize(length(8));  // a string takes 8 bytes, everything else here more
    for (T& item : list) get(item);
  }
  void get(Vec3& v) {
    for (int i = 0; i < 3; ++i) get(v[i]);
  }
  void get(TriangleMesh& m) {
    get(m.vertices);
    get(m.triangles);
  }
  void get(TetMesh& m) {
    get(m.vertices);
    get(m.tets);
  }
};

template <class Stream, class Message, class Each>
void fields(Stream& s, Message& m, const Each& each) {
  each(s, m.error);
  each(s, m.detail);
  each(s, m.notes);
  each(s, m.mesh);
  each(s, m.tets);
  each(s, m.solids);
  each(s, m.volume);
  each(s, m.area);
}

}  // namespace

std::vector<std::byte> encode(const CadMessage& message) {
  Writer out;
  out.put(kMagic);
  fields(out, message, [](Writer& w, const auto& field) { w.put(field); });
  out.put(kMagic);
  return std::move(out.bytes);
}

std::optional<CadMessage> decode(std::span<const std::byte> bytes) {
  Reader in{bytes};
  CadMessage message;
  std::uint64_t first = 0, last = 0;
  try {
    in.get(first);
    if (first != kMagic) return {};
    fields(in, message, [](Reader& r, auto& field) { r.get(field); });
    in.get(last);
  } catch (const Cut&) {
    return {};
  }
  if (last != kMagic || !in.left.empty()) return {};
  return message;
}

std::vector<std::string> CadRequest::to_arguments() const {
  return {format,
          path,
          fmt::format("{:.17g}", scale),
          fmt::format("{:.17g}", chord_error),
          want_tets ? "1" : "0",
          fmt::format("{:.17g}", tet_size),
          fmt::format("{:.17g}", memory),
          fmt::format("{:.17g}", seconds)};
}

std::optional<CadRequest> CadRequest::from_arguments(std::span<char* const> a) {
  if (a.size() != 8) return {};
  const auto number = [](const char* text) { return std::strtod(text, nullptr); };
  return CadRequest{a[0],         a[1],         number(a[2]), number(a[3]), std::strcmp(a[4], "1") == 0,
                    number(a[5]), number(a[6]), number(a[7])};
}

}  // namespace packbed
