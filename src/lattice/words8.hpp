#pragma once
// Eight words, or numbers, side by side, as one wide register, two or four: what the compiler makes of a loop
// over eight is not always that. By reference only, since how wide registers are passed depends on the
// machine.
#include <cstdint>
#include <cstring>

namespace packbed {

typedef std::uint64_t Words8 __attribute__((vector_size(64)));
typedef std::int32_t Numbers8 __attribute__((vector_size(32)));
inline constexpr int kWords8 = 8;

inline void load(const std::uint64_t* from, Words8& to) {
  std::memcpy(&to, from, sizeof to);
}
inline void load(const std::int32_t* from, Numbers8& to) {
  std::memcpy(&to, from, sizeof to);
}
inline void store(const Words8& from, std::uint64_t* to) {
  std::memcpy(to, &from, sizeof from);
}
inline void store(const Numbers8& from, std::int32_t* to) {
  std::memcpy(to, &from, sizeof from);
}
inline bool any_of(const Words8& w) {
  const Words8 half = w | __builtin_shufflevector(w, w, 4, 5, 6, 7, 0, 1, 2, 3);
  const Words8 quarter = half | __builtin_shufflevector(half, half, 2, 3, 0, 1, 6, 7, 4, 5);
  return (quarter[0] | quarter[1]) != 0;
}

}  // namespace packbed
