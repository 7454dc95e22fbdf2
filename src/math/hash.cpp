#include "math/hash.hpp"

#include <fmt/format.h>

namespace packbed {

std::string Hash::hex() const {
  return fmt::format("{:016x}", value());
}

}  // namespace packbed
