#pragma once
// A 64-bit hash of bytes (FNV-1a over 8-byte words with a final mix), for "same bed, same bytes" and for
// checkpoints.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>

namespace packbed {

class Hash {
 public:
  void add(std::span<const std::byte> bytes) {
    std::size_t i = 0;
    for (; i + 8 <= bytes.size(); i += 8) {
      std::uint64_t word;
      std::memcpy(&word, bytes.data() + i, 8);
      mix(word);
    }
    std::uint64_t tail = 0;
    for (; i < bytes.size(); ++i) tail = (tail << 8) ^ static_cast<std::uint64_t>(bytes[i]);
    mix(tail);
    mix(bytes.size());
  }
  template <class T>
  void add(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    static_assert(!std::is_convertible_v<T, std::span<const std::byte>>,
                  "give bytes as std::span<const std::byte>");
    add(std::span<const std::byte>(std::as_bytes(std::span<const T, 1>(&value, 1))));
  }
  std::uint64_t value() const {
    std::uint64_t h = state_;
    h ^= h >> 33;
    h *= 0xff51afd7ed558ccdULL;
    h ^= h >> 33;
    return h;
  }
  std::string hex() const;  ///< sixteen hexadecimal digits

 private:
  void mix(std::uint64_t word) {
    state_ = (state_ ^ word) * 0x100000001b3ULL;
    state_ ^= state_ >> 29;
  }
  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

}  // namespace packbed
