#pragma once
// Fills a CaseRecord from a TOML tree and gathers everything that is wrong with it.
#include <string>
#include <vector>

#include "io/case_keys.hpp"
#include "io/toml_tree.hpp"

namespace packbed {

/// `folder` is where relative paths count from. Problems are InputError messages, in the order of the keys;
/// with any of them the record is not to be used.
CaseRecord read_record(const TomlNode& root, const std::string& folder, std::vector<std::string>& problems);

/// The candidate with the fewest typing errors (inserted, left out, changed or swapped letters) against
/// `word`.
std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace packbed
