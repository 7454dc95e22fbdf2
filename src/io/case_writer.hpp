#pragma once
// A CaseRecord as TOML text with every key that applies, and the keys themselves as tables for people.
#include <string>

#include "io/case_keys.hpp"

namespace packbed {

/// Reads back to the same record, bit for bit.
std::string write_record(const CaseRecord& record);

/// Markdown: a table a section, a row a key (key, meaning, default, range, only with).
std::string keys_as_markdown();

/// The section that has a key of this name ("" is the head of the file: then "top of the file"); empty when
/// none has.
std::string section_with_key(const std::string& key);

}  // namespace packbed
