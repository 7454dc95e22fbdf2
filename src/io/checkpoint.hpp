#pragma once
// The state of a running packer on disk, so that `packbed resume` can continue it bit for bit.
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace packbed {

struct Checkpoint {
  std::string version;           // of the program that wrote it
  std::string case_hash;         // of the case text that the state belongs to
  std::vector<std::byte> state;  // as the packer gave it
};

/// Sixteen hexadecimal digits over a case text.
std::string case_hash(const std::string& case_text);

/// Whole or not at all; throws SystemError.
void write_checkpoint(const std::string& path, const std::string& case_text,
                      std::span<const std::byte> state);

/// Throws InputError when the file is missing, cut, changed, of another version of the program or of another
/// case.
Checkpoint read_checkpoint(const std::string& path, const std::string& case_text);

}  // namespace packbed
