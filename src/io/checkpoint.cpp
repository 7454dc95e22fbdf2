#include "io/checkpoint.hpp"

#include <fmt/format.h>

#include "io/atomic_file.hpp"
#include "io/seal.hpp"
#include "math/error.hpp"
#include "math/hash.hpp"

namespace packbed {
namespace {

constexpr std::string_view kKind = "state";

/// One line before the state: "packbed-checkpoint VERSION CASE_HASH".
std::string first_line(const std::string& version, const std::string& hash) {
  return fmt::format("packbed-checkpoint {} {}\n", version, hash);
}

}  // namespace

std::string case_hash(const std::string& case_text) {
  Hash hash;
  hash.add(std::as_bytes(std::span(case_text.data(), case_text.size())));
  return hash.hex();
}

void write_checkpoint(const std::string& path, const std::string& case_text,
                      std::span<const std::byte> state) {
  std::string content = first_line(PACKBED_VERSION, case_hash(case_text));
  content.append(reinterpret_cast<const char*>(state.data()), state.size());
  write_atomically(path, sealed(content, kKind));
}

Checkpoint read_checkpoint(const std::string& path, const std::string& case_text) {
  const std::string content = unsealed_file(path, kKind);
  const std::string head = content.substr(0, content.find('\n') + 1);
  Checkpoint checkpoint;
  const std::string mark = "packbed-checkpoint ";
  const std::size_t gap = head.rfind(' ');
  if (!head.starts_with(mark) || gap < mark.size())
    throw InputError(path, "a file without the first line of a checkpoint", "a checkpoint of packbed");
  checkpoint.version = head.substr(mark.size(), gap - mark.size());
  checkpoint.case_hash = head.substr(gap + 1, head.size() - gap - 2);
  if (checkpoint.version != PACKBED_VERSION)
    throw InputError(path, "a checkpoint of packbed " + checkpoint.version, "one of packbed " PACKBED_VERSION,
                     "resume with that version, or run the case again");
  if (checkpoint.case_hash != case_hash(case_text))
    throw InputError(path, "a checkpoint of another case (case.toml was changed after the run began)",
                     "the case that the run began with",
                     "put the old case.toml back, or run the new case anew");
  const auto* bytes = reinterpret_cast<const std::byte*>(content.data());
  checkpoint.state.assign(bytes + head.size(), bytes + content.size());
  return checkpoint;
}

}  // namespace packbed
