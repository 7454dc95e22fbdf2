#pragma once
// A TOML text as plain records that remember where they came from, and how one text is laid over another
// (`extends`, --set).
#include <cstdint>
#include <string>
#include <vector>

namespace packbed {

struct TomlNode {
  enum class Kind { table, array, string, integer, real, boolean, other };
  Kind kind = Kind::table;
  std::string where;              // "cases/quick.toml:12" or "--set feed.count=3"
  std::vector<std::string> keys;  // table: one an item
  std::vector<TomlNode> items;    // table and array
  std::string text;               // string; other: as written
  std::int64_t integer = 0;
  double real = 0;
  bool boolean = false;

  const TomlNode* find(const std::string& key) const;  // of a table; nullptr: not there
  TomlNode* find(const std::string& key);
  TomlNode& set(const std::string& key, TomlNode value);  // replaces or adds
  void remove(const std::string& key);
};

/// Throws InputError with file, line and column for text that is not TOML.
TomlNode parse_toml(const std::string& text, const std::string& file);

/// `a.b.c=value`, into a tree that is then laid over a case. The value is TOML; what is not TOML ("2.5 mm", a
/// bare word) is taken as a string.
void add_assignment(TomlNode& root, const std::string& assignment);

/// Tables merge key by key, everything else is replaced; a table with keys "0", "1", ... changes elements of
/// an array. A key that is an alternative to another one (damping and restitution, file and shape, ...)
/// takes its place.
void lay_over(TomlNode& base, TomlNode over);

/// A value as a message shows it: `"3 mm"`, `7`, `a table`.
std::string shown(const TomlNode& node);

/// `text` as a TOML string with quotes and escapes.
std::string toml_string(const std::string& text);

}  // namespace packbed
