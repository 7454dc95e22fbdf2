#pragma once
// The usual ranges of the keys of a case.
#include "io/case_fields.hpp"

namespace packbed {

constexpr Range at_least(double low, std::string_view why = {}) {
  return {.low = low, .why = why};
}
constexpr Range between(double low, double high, std::string_view why = {}) {
  return {.low = low, .high = high, .why = why};
}
constexpr Range above_zero(std::string_view why = {}) {
  return {.low = 0, .without_low = true, .why = why};
}
constexpr Range above_zero_to(double high, std::string_view why = {}) {
  return {.low = 0, .high = high, .without_low = true, .why = why};
}

inline constexpr Range kSize = above_zero_to(100, "a body has a size");

}  // namespace packbed
