#include "io/toml_tree.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <sstream>

#include "math/error.hpp"

namespace packbed {
namespace {

using Kind = TomlNode::Kind;

TomlNode converted(const toml::node& node, const std::string& file) {
  TomlNode out;
  out.where = fmt::format("{}:{}", file, node.source().begin.line);
  if (const toml::table* table = node.as_table()) {
    out.kind = Kind::table;
    for (const auto& [key, value] : *table) {
      out.keys.emplace_back(key.str());
      out.items.push_back(converted(value, file));
    }
  } else if (const toml::array* array = node.as_array()) {
    out.kind = Kind::array;
    for (const toml::node& item : *array) out.items.push_back(converted(item, file));
  } else if (const auto* string = node.as_string()) {
    out.kind = Kind::string;
    out.text = string->get();
  } else if (const auto* integer = node.as_integer()) {
    out.kind = Kind::integer;
    out.integer = integer->get();
    out.real = static_cast<double>(out.integer);
  } else if (const auto* real = node.as_floating_point()) {
    out.kind = Kind::real;
    out.real = real->get();
  } else if (const auto* boolean = node.as_boolean()) {
    out.kind = Kind::boolean;
    out.boolean = boolean->get();
  } else {
    out.kind = Kind::other;
    std::ostringstream text;
    node.visit([&](const auto& value) { text << value; });
    out.text = text.str();
  }
  return out;
}

void set_where(TomlNode& node, const std::string& where) {
  node.where = where;
  for (TomlNode& item : node.items) set_where(item, where);
}

bool is_index(const std::string& key) {
  return !key.empty() && key.size() < 9 &&
         std::all_of(key.begin(), key.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// Keys of which a case gives one: an overriding one drops the others from the case below.
void drop_alternatives(TomlNode& base, const TomlNode& over) {
  struct Rule {
    const char* key;
    std::vector<const char*> drops;
  };
  static const std::vector<Rule> rules = {
      {"damping", {"restitution", "dissipation", "tangential_dissipation"}},
      {"restitution", {"damping", "dissipation", "tangential_dissipation"}},
      {"dissipation", {"damping", "restitution"}},
      {"stiffness", {"allowed_overlap", "youngs_modulus", "poisson_ratio", "shear_modulus"}},
      {"allowed_overlap", {"stiffness", "youngs_modulus", "poisson_ratio", "shear_modulus"}},
      {"youngs_modulus", {"stiffness", "allowed_overlap"}},
      {"csv", {"placed", "diameters", "fractions", "amounts"}},
      {"diameters", {"csv"}},
      {"fractions", {"amounts"}},
      {"amounts", {"fractions"}},
      {"law", {"csv", "diameters", "fractions", "amounts", "modulus", "exponent", "deviation"}},
      {"placed", {"csv"}},
      {"file", {"unit", "shape", "diameter", "height", "inner_diameter"}},
      {"shape", {"file", "unit", "recognise", "diameter", "height", "inner_diameter"}}};
  for (const Rule& rule : rules) {
    const TomlNode *now = over.find(rule.key), *before = base.find(rule.key);
    if (!now || (before && before->kind == Kind::string && before->text == now->text)) continue;
    for (const char* key : rule.drops) base.remove(key);
  }
}

bool changes_elements(const TomlNode& base, const TomlNode& over) {
  return base.kind == Kind::array && over.kind == Kind::table && !over.keys.empty() &&
         std::all_of(over.keys.begin(), over.keys.end(), [&](const std::string& key) {
           return is_index(key) && std::stoul(key) < base.items.size();
         });
}

}  // namespace

const TomlNode* TomlNode::find(const std::string& key) const {
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (keys[i] == key) return &items[i];
  return nullptr;
}

TomlNode* TomlNode::find(const std::string& key) {
  return const_cast<TomlNode*>(static_cast<const TomlNode*>(this)->find(key));
}

TomlNode& TomlNode::set(const std::string& key, TomlNode value) {
  if (TomlNode* old = find(key)) return *old = std::move(value);
  keys.push_back(key);
  items.push_back(std::move(value));
  return items.back();
}

void TomlNode::remove(const std::string& key) {
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (keys[i] == key) {
      keys.erase(keys.begin() + static_cast<std::ptrdiff_t>(i));
      items.erase(items.begin() + static_cast<std::ptrdiff_t>(i));
      return;
    }
}

TomlNode parse_toml(const std::string& text, const std::string& file) {
  try {
    return converted(toml::parse(std::string_view(text), std::string_view(file)), file);
  } catch (const toml::parse_error& e) {
    throw InputError(fmt::format("{}:{}:{}", file, e.source().begin.line, e.source().begin.column),
                     fmt::format("text that is not TOML ({})", e.description()),
                     "lines such as `friction = 0.6`, `step = \"5 us\"` and `[contact]`",
                     "see https://toml.io for the notation, docs/case.md for the keys");
  }
}

void add_assignment(TomlNode& root, const std::string& assignment) {
  const std::string where = "--set " + assignment;
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos)
    throw InputError(where, "no \"=\"", "key=value", "for example --set contact.friction=0.6");
  TomlNode value;
  try {
    TomlNode line = parse_toml("value = " + assignment.substr(equals + 1), where);
    if (line.keys.size() != 1) throw InputError(where, "several keys", "one key");
    value = std::move(line.items[0]);
  } catch (const InputError&) {
    value.kind = Kind::string;
    value.text = assignment.substr(equals + 1);
  }
  set_where(value, where);
  TomlNode* node = &root;
  std::istringstream path(assignment.substr(0, equals) + ".");
  std::vector<std::string> parts;
  for (std::string part; std::getline(path, part, '.');) {
    const std::size_t from = part.find_first_not_of(" \t"), to = part.find_last_not_of(" \t");
    if (from == std::string::npos)
      throw InputError(where, "an empty key", "key=value with a key such as feed.count");
    parts.push_back(part.substr(from, to - from + 1));
  }
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    TomlNode* next = node->find(parts[i]);
    if (!next || next->kind != Kind::table) {
      TomlNode table;
      table.where = where;
      next = &node->set(parts[i], table);
    }
    node = next;
  }
  node->set(parts.back(), std::move(value));
}

void lay_over(TomlNode& base, TomlNode over) {
  if (changes_elements(base, over)) {
    for (std::size_t i = 0; i < over.keys.size(); ++i)
      lay_over(base.items[std::stoul(over.keys[i])], std::move(over.items[i]));
    return;
  }
  if (base.kind != Kind::table || over.kind != Kind::table) {
    base = std::move(over);
    return;
  }
  drop_alternatives(base, over);
  for (std::size_t i = 0; i < over.keys.size(); ++i) {
    if (TomlNode* old = base.find(over.keys[i]))
      lay_over(*old, std::move(over.items[i]));
    else
      base.set(over.keys[i], std::move(over.items[i]));
  }
}

std::string shown(const TomlNode& node) {
  switch (node.kind) {
    case Kind::table:
      return "a table";
    case Kind::array:
      return fmt::format("a list of {}", node.items.size());
    case Kind::string:
      return toml_string(node.text);
    case Kind::integer:
      return fmt::format("{}", node.integer);
    case Kind::real:
      return fmt::format("{}", node.real);
    case Kind::boolean:
      return node.boolean ? "true" : "false";
    case Kind::other:
      return node.text;
  }
  return "";
}

std::string toml_string(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += fmt::format("\\{}", c);
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      out += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    else
      out += c;
  }
  return out + "\"";
}

}  // namespace packbed
