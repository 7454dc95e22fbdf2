#include "math/error.hpp"

#include <fmt/format.h>

namespace packbed {

InputError::InputError(const std::string& where, const std::string& found, const std::string& allowed,
                       const std::string& fix)
    : std::runtime_error(fmt::format("{}: found {}; allowed: {}{}{}", where, found, allowed,
                                     fix.empty() ? "" : ". Fix: ", fix)) {}

}  // namespace packbed
