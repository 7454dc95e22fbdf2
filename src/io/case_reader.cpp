#include "io/case_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "io/case_writer.hpp"
#include "math/error.hpp"

namespace packbed {
namespace {

using Kind = TomlNode::Kind;

/// Letters inserted, left out, changed or swapped with a neighbour (optimal string alignment).
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        now[j] = std::min(now[j], before[j - 2] + 1);
    }
    before = last;
    last = now;
  }
  return last[b.size()];
}

std::string join(const std::vector<std::string_view>& words, const char* separator) {
  return fmt::format("{}", fmt::join(words, separator));
}

class Reader : public Fields {
 public:
  Reader(const TomlNode& root, std::string folder, std::vector<std::string>& problems)
      : problems_(problems), folder_(std::move(folder)) {
    open("", root);
  }
  void finish() { close(); }
  bool reading() const override { return true; }

  void section(std::string_view name, std::string_view, const std::function<void()>& body) override {
    static const TomlNode empty;
    const TomlNode* node = take(name);
    if (node && node->kind != Kind::table) {
      refuse(*node, name, "a table", fmt::format("write [{}] and its keys below", path(name)));
      node = nullptr;
    }
    const std::string where = node ? node->where : top().node->where;
    open(name, node ? *node : empty, where);
    body();
    close();
  }

  void list(std::string_view name, std::string_view, std::size_t count,
            const std::function<void(std::size_t)>& body) override {
    const TomlNode* node = take(name);
    if (node && node->kind == Kind::array) {
      if (node->items.empty()) refuse(*node, name, "at least one table");
      for (std::size_t i = 0; i < node->items.size(); ++i)
        one(fmt::format("{}[{}]", name, i), node->items[i], i, body);
    } else if (node) {
      one(std::string(name), *node, 0, body);
    } else {
      static const TomlNode empty;
      for (std::size_t i = 0; i < count; ++i) {
        open(name, empty, top().where);
        body(i);
        close();
      }
    }
  }

  void when(bool holds, std::string_view condition, const std::function<void()>& body) override {
    const std::string before = unless_;
    if (!holds && unless_.empty()) unless_ = condition;
    body();
    unless_ = before;
  }

  std::optional<std::size_t> one_of(const std::vector<std::string_view>& names) override {
    std::optional<std::size_t> given;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const TomlNode* node = top().node->find(std::string(names[i]));
      if (!node) continue;
      if (given)
        refuse(*node, names[i], fmt::format("one of {}, not both", join(names, ", ")), "remove one of them");
      if (!given) given = i;
    }
    return given;
  }

  void real(const Key& key, double& value) override {
    const TomlNode* node = get(key);
    if (!node) return;
    if (!key.automatic.empty() && node->kind == Kind::string && node->text == "auto")
      value = 0;
    else if (const auto read = number(key, *node))
      value = *read;
  }
  void real(const Key& key, std::optional<double>& value) override {
    if (const TomlNode* node = get(key))
      if (const auto read = number(key, *node)) value = *read;
  }
  void whole(const Key& key, int& value) override {
    std::optional<int> read;
    whole(key, read);
    if (read) value = *read;
  }
  void whole(const Key& key, std::optional<int>& value) override {
    const TomlNode* node = get(key);
    if (!node) return;
    const std::string allowed = "a whole number, " + to_string(key.range, {});
    if (node->kind != Kind::integer)
      refuse(*node, key.name, allowed);
    else if (in_range(*node, key, static_cast<double>(node->integer), allowed))
      value = static_cast<int>(node->integer);
  }
  void seed(const Key& key, std::uint64_t& value) override {
    const TomlNode* node = get(key);
    if (!node) return;
    // TOML integers end at 2^63 - 1: larger seeds are written as strings
    const bool digits =
        node->kind == Kind::string && !node->text.empty() && node->text.size() <= 20 &&
        std::all_of(node->text.begin(), node->text.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (node->kind == Kind::integer && node->integer >= 0)
      value = static_cast<std::uint64_t>(node->integer);
    else if (digits && (node->text.size() < 20 || node->text <= "18446744073709551615"))
      value = std::stoull(node->text);
    else
      refuse(*node, key.name, "a whole number from 0 to 18446744073709551615 (above 2^63 in quotes)");
  }
  void flag(const Key& key, bool& value) override {
    const TomlNode* node = get(key);
    if (!node) return;
    if (node->kind == Kind::boolean)
      value = node->boolean;
    else
      refuse(*node, key.name, "true or false");
  }
  void choice(const Key& key, std::string& value, const std::vector<std::string_view>& allowed) override {
    const std::string list = "\"" + join(allowed, "\", \"") + "\"";
    const TomlNode* node = get(key, list);
    if (!node) return;
    if (node->kind == Kind::string &&
        std::find(allowed.begin(), allowed.end(), node->text) != allowed.end()) {
      value = node->text;
      return;
    }
    std::string fix;
    if (node->kind == Kind::string)
      fix = fmt::format("did you mean \"{}\"?", nearest_word(node->text, {allowed.begin(), allowed.end()}));
    refuse(*node, key.name, list, fix);
  }
  void text(const Key& key, std::string& value) override {
    const TomlNode* node = get(key);
    if (!node) return;
    if (node->kind == Kind::string && !node->text.empty())
      value = node->text;
    else
      refuse(*node, key.name, "a string that is not empty", "put it in quotes");
    if (key.name == "folder") folder_ = value;
  }
  void path(const Key& key, std::string& value) override {
    const TomlNode* node = get(key);
    if (!node) return;
    if (node->kind != Kind::string || node->text.empty() || node->text.find('\0') != std::string::npos) {
      refuse(*node, key.name, "the name of a file, in quotes");
      return;
    }
    value = node->text;
    const std::filesystem::path full = std::filesystem::path(folder_) / value;
    std::error_code error;
    if (!std::filesystem::is_regular_file(full, error))
      refuse(*node, key.name, "a file that is there (looked for " + full.string() + ")",
             "paths count from the folder of the case file");
  }
  void vector(const Key& key, Vec3& value) override {
    const TomlNode* node = get(key);
    if (!node) return;
    if (key.downwards && node->kind == Kind::string) {
      if (const auto read = number(key, *node)) value = Vec3(0, 0, -*read);
      return;
    }
    if (node->kind != Kind::array || node->items.size() != 3) {
      refuse(*node, key.name,
             fmt::format("{}three {}, [x, y, z]", key.downwards ? "one quantity that points down, or " : "",
                         what(key)));
      return;
    }
    Vec3 read;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto part = number(key, node->items[i]);
      if (!part) return;
      read[static_cast<Eigen::Index>(i)] = *part;
    }
    if (key.name == "turn_about" && !(read.norm() > 0)) {
      refuse(*node, key.name, "a direction, not all zero");
      return;
    }
    value = read;
  }
  void numbers(const Key& key, std::vector<double>& value) override {
    const TomlNode* node = get(key);
    if (!node) return;
    if (node->kind != Kind::array || node->items.empty()) {
      refuse(*node, key.name, fmt::format("a list of {}", what(key)));
      return;
    }
    std::vector<double> read;
    for (const TomlNode& item : node->items) {
      const auto one = number(key, item);
      if (!one) return;
      read.push_back(*one);
    }
    value = read;
  }
  void rotation(const Key& key, Quat& value) override {
    const TomlNode* node = get(key);
    if (!node) return;
    Eigen::Vector4d q = Eigen::Vector4d::Zero();
    bool good = node->kind == Kind::array && node->items.size() == 4;
    for (std::size_t i = 0; good && i < 4; ++i) {
      const TomlNode& item = node->items[i];
      good = (item.kind == Kind::real || item.kind == Kind::integer) && std::isfinite(item.real) &&
             std::abs(item.real) < 1e9;
      q[static_cast<Eigen::Index>(i)] = item.real;
    }
    if (!good || !(q.norm() > 1e-9)) {
      refuse(*node, key.name, "four finite numbers, [w, x, y, z], not all zero");
      return;
    }
    // as written when it has unit length already, so that a case that was written reads back bit for bit
    if (std::abs(q.squaredNorm() - 1) > 1e-15) q.normalize();
    value = Quat(q[0], q[1], q[2], q[3]);
  }

 private:
  struct Level {
    std::string path;  // "", "contact", "contact.wall"
    const TomlNode* node;
    std::string where;               // of its header
    std::vector<std::string> known;  // keys asked for
  };

  Level& top() { return levels_.back(); }
  std::string path(std::string_view name) const {
    return levels_.back().path.empty() ? std::string(name) : fmt::format("{}.{}", levels_.back().path, name);
  }
  void open(std::string_view name, const TomlNode& node) { open(name, node, node.where); }
  void open(std::string_view name, const TomlNode& node, const std::string& where) {
    levels_.push_back({levels_.empty() ? "" : path(name), &node, where, {}});
  }
  void one(const std::string& name, const TomlNode& node, std::size_t i,
           const std::function<void(std::size_t)>& body) {
    if (node.kind != Kind::table) {
      refuse(node, name, "a table",
             fmt::format("write [[{}]] and its keys below", path(name.substr(0, name.find('[')))));
      return;
    }
    open(name, node);
    body(i);
    close();
  }
  /// Names what nobody asked for.
  void close() {
    const Level level = top();
    for (std::size_t i = 0; i < level.node->keys.size(); ++i) {
      const std::string& key = level.node->keys[i];
      if (std::find(level.known.begin(), level.known.end(), key) != level.known.end()) continue;
      const std::string elsewhere = section_with_key(key);
      std::string fix = fmt::format("the nearest known key is \"{}\"", nearest_word(key, level.known));
      if (!elsewhere.empty() && elsewhere != level.path)
        fix = fmt::format("\"{}\" is a key of [{}]", key, elsewhere);
      problems_.push_back(InputError(fmt::format("{}: {}", level.node->items[i].where, path(key)),
                                     "an unknown key", fmt::format("{}", fmt::join(level.known, ", ")), fix)
                              .what());
    }
    levels_.pop_back();
  }

  const TomlNode* take(std::string_view name) {
    top().known.emplace_back(name);
    const TomlNode* node = top().node->find(std::string(name));
    if (node && !unless_.empty()) {
      refuse(*node, name, fmt::format("this key only with {}", unless_), "remove it");
      return nullptr;
    }
    return node;
  }
  const TomlNode* get(const Key& key, const std::string& allowed = "") {
    const TomlNode* node = take(key.name);
    if (!node && key.required && unless_.empty() && !top().node->find(std::string(key.name)))
      problems_.push_back(InputError(fmt::format("{}: {}", top().where, path(key.name)), "nothing",
                                     allowed.empty() ? expected(key) : allowed,
                                     fmt::format("give {} ({})", key.name, key.meaning))
                              .what());
    return node;
  }

  void refuse(const TomlNode& node, std::string_view name, const std::string& allowed,
              const std::string& fix = "") {
    problems_.push_back(
        InputError(fmt::format("{}: {}", node.where, path(name)), shown(node), allowed, fix).what());
  }

  static std::string what(const Key& key) {
    return key.dimension ? fmt::format("quantities in quotes with a unit of {} ({})",
                                       to_string(*key.dimension), accepted_units(*key.dimension))
                         : "numbers";
  }
  static std::string expected(const Key& key) {
    const std::string limits = to_string(key.range, key.dimension);
    const std::string kind = key.dimension
                                 ? fmt::format("a string with a number and a unit of {} ({})",
                                               to_string(*key.dimension), accepted_units(*key.dimension))
                                 : "a number";
    return kind + (limits == "any" ? "" : ", " + limits) + (key.automatic.empty() ? "" : ", or \"auto\"");
  }

  /// A plain number, or a quantity in SI; refused with the reason otherwise.
  std::optional<double> number(const Key& key, const TomlNode& node) {
    const bool bare = node.kind == Kind::real || node.kind == Kind::integer;
    double value = node.real;
    if (key.dimension) {
      if (bare) {
        refuse(node, key.name, expected(key),
               fmt::format("add the unit, for example \"{} {}\"", shown(node), example(key)));
        return {};
      }
      if (node.kind != Kind::string) {
        refuse(node, key.name, expected(key));
        return {};
      }
      try {
        value = parse_quantity(node.text, *key.dimension, fmt::format("{}: {}", node.where, path(key.name)));
      } catch (const InputError& e) {
        problems_.emplace_back(e.what());
        return {};
      }
    } else if (!bare || !std::isfinite(value)) {
      refuse(node, key.name, expected(key), bare ? "a finite number" : "");
      return {};
    }
    if (!in_range(node, key, value, expected(key))) return {};
    return value;
  }
  static std::string example(const Key& key) {
    if (*key.dimension == Dimension::length) return "mm";
    const std::string all = accepted_units(*key.dimension);
    return all.substr(0, all.find(','));
  }

  bool in_range(const TomlNode& node, const Key& key, double value, const std::string& allowed) {
    const Range& r = key.range;
    const bool good = (r.without_low ? value > r.low : value >= r.low) &&
                      (r.without_high ? value < r.high : value <= r.high);
    if (!good) refuse(node, key.name, allowed, std::string(r.why));
    return good;
  }

  std::vector<std::string>& problems_;
  std::string folder_;
  std::vector<Level> levels_;
  std::string unless_;  // why keys asked for now do not apply
};

}  // namespace

std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t least = static_cast<std::size_t>(-1);
  const std::string head = word.substr(0, 200);  // a hundred-kilobyte key is not a typing error
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(head, candidate);
    if (distance < least) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

CaseRecord read_record(const TomlNode& root, const std::string& folder, std::vector<std::string>& problems) {
  CaseRecord record;
  Reader reader(root, folder, problems);
  visit_case(reader, record);
  reader.finish();
  return record;
}

}  // namespace packbed
