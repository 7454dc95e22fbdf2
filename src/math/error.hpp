#pragma once
// The two kinds of failure that reach a user. Impossible states are asserts; a failed audit is a result, not
// an error.
#include <stdexcept>
#include <string>

namespace packbed {

/// What the user gave cannot be used (exit code 2). The message names where, what was found, what is allowed
/// and the fix.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
  /// where: file, key or line; found: the offending value; allowed: what would do; fix: the next thing to try
  /// (may be empty)
  InputError(const std::string& where, const std::string& found, const std::string& allowed,
             const std::string& fix = "");
};

/// The machine failed us: no space, no permission, a file that changed under our feet (exit code 2 as well,
/// but not a bad case).
struct SystemError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace packbed
