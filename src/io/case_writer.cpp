#include "io/case_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/toml_tree.hpp"

namespace packbed {
namespace {

std::string plain_number(double value) {
  return fmt::format("{}", value);
}

std::string value_text(const Key& key, double value) {
  if (!key.automatic.empty() && value == 0) return "\"auto\"";
  return key.dimension ? "\"" + format_quantity_exactly(value, *key.dimension) + "\"" : plain_number(value);
}

std::string vector_text(const Key& key, const Vec3& v) {
  if (key.downwards && v.x() == 0 && v.y() == 0 && v.z() <= 0) return value_text(key, -v.z());
  return fmt::format("[{}, {}, {}]", value_text(key, v.x()), value_text(key, v.y()), value_text(key, v.z()));
}

std::string seed_text(std::uint64_t seed) {
  return seed >> 63 ? fmt::format("\"{}\"", seed) : fmt::format("{}", seed);
}

std::string choices_text(const std::vector<std::string_view>& allowed) {
  return fmt::format("{}", fmt::join(allowed, " | "));
}

std::string range_text(const Key& key) {
  std::string text = to_string(key.range, key.dimension);
  if (!key.automatic.empty()) text += fmt::format("; auto = {}", key.automatic);
  return text;
}

std::string inner_path(const std::string& path, std::string_view name) {
  return path.empty() ? std::string(name) : fmt::format("{}.{}", path, name);
}

/// What a key is worth, as both the file and the documentation show it.
class Shower : public Fields {
 public:
  void section(std::string_view name, std::string_view meaning, const std::function<void()>& body) override {
    nested(name, meaning, false, body);
  }
  std::optional<std::size_t> one_of(const std::vector<std::string_view>&) override { return {}; }

  void real(const Key& k, double& v) override { row(k, value_text(k, v), range_text(k)); }
  void real(const Key& k, std::optional<double>& v) override {
    row(k, v ? value_text(k, *v) : "", range_text(k));
  }
  void whole(const Key& k, int& v) override { row(k, fmt::format("{}", v), to_string(k.range, {})); }
  void whole(const Key& k, std::optional<int>& v) override {
    row(k, v ? fmt::format("{}", *v) : "", to_string(k.range, {}));
  }
  void seed(const Key& k, std::uint64_t& v) override { row(k, seed_text(v), "0 to 2^64 - 1"); }
  void flag(const Key& k, bool& v) override { row(k, v ? "true" : "false", "true | false"); }
  void choice(const Key& k, std::string& v, const std::vector<std::string_view>& allowed) override {
    row(k, v.empty() ? "" : toml_string(v), choices_text(allowed));
  }
  void text(const Key& k, std::string& v) override { row(k, v.empty() ? "" : toml_string(v), "text"); }
  void path(const Key& k, std::string& v) override { row(k, v.empty() ? "" : toml_string(v), "a file"); }
  void vector(const Key& k, Vec3& v) override { row(k, vector_text(k, v), range_text(k)); }
  void numbers(const Key& k, std::vector<double>& v) override {
    std::string list;
    for (const double x : v) list += (list.empty() ? "" : ", ") + value_text(k, x);
    row(k, v.empty() ? "" : "[" + list + "]", "a list, each " + range_text(k));
  }
  void rotation(const Key& k, Quat& q) override {
    row(k, fmt::format("[{}, {}, {}, {}]", q.w(), q.x(), q.y(), q.z()), "four numbers");
  }

 protected:
  virtual void row(const Key& key, const std::string& value, const std::string& range) = 0;
  virtual void nested(std::string_view name, std::string_view meaning, bool element,
                      const std::function<void()>& body) = 0;
  std::string path_;
};

class Writer : public Shower {
 public:
  std::string out;

  void list(std::string_view name, std::string_view meaning, std::size_t count,
            const std::function<void(std::size_t)>& body) override {
    for (std::size_t i = 0; i < count; ++i)
      nested(name, meaning, count > 1 || name == "placed", [&] { body(i); });
  }
  void when(bool holds, std::string_view, const std::function<void()>& body) override {
    if (holds) body();
  }

 private:
  void row(const Key& key, const std::string& value, const std::string& range) override {
    std::string unit;
    if (key.dimension)
      unit = accepted_units(*key.dimension).substr(0, accepted_units(*key.dimension).find(','));
    const std::string line =
        value.empty() ? fmt::format("# {} is not given", key.name) : fmt::format("{} = {}", key.name, value);
    out +=
        fmt::format("{:<34}  # {}{}; {}\n", line, key.meaning, unit.empty() ? "" : " [" + unit + "]", range);
  }
  void nested(std::string_view name, std::string_view meaning, bool element,
              const std::function<void()>& body) override {
    const std::string before = path_;
    path_ = inner_path(path_, name);
    out += fmt::format("\n{}{}{}  # {}\n", element ? "[[" : "[", path_, element ? "]]" : "]", meaning);
    body();
    path_ = before;
  }
};

struct KeyRow {
  std::string section, name, meaning, value, range, condition;
  bool required = false;
};

class Lister : public Shower {
 public:
  std::vector<KeyRow> rows;
  std::vector<std::pair<std::string, std::string>> sections{{"", "Top of the file."}};

  void list(std::string_view name, std::string_view meaning, std::size_t,
            const std::function<void(std::size_t)>& body) override {
    nested(name, meaning, true, [&] { body(0); });
  }
  void when(bool, std::string_view condition, const std::function<void()>& body) override {
    const std::string before = condition_;
    condition_ = condition;
    body();
    condition_ = before;
  }

 private:
  void row(const Key& key, const std::string& value, const std::string& range) override {
    rows.push_back(
        {path_, std::string(key.name), std::string(key.meaning), value, range, condition_, key.required});
  }
  void nested(std::string_view name, std::string_view meaning, bool,
              const std::function<void()>& body) override {
    const std::string before = path_, condition = condition_;
    condition_.clear();
    path_ = inner_path(path_, name);
    sections.emplace_back(path_, meaning);
    body();
    path_ = before;
    condition_ = condition;
  }
  std::string condition_;
};

const Lister& listed() {
  static const Lister lister = [] {
    CaseRecord record;
    record.placed.resize(1);
    Lister l;
    visit_case(l, record);
    return l;
  }();
  return lister;
}

std::string in_cell(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|') out += '\\';
    out += c;
  }
  return out;
}

}  // namespace

std::string to_string(const Range& r, std::optional<Dimension> d) {
  const auto end = [&](double x) { return d ? format_quantity_exactly(x, *d) : plain_number(x); };
  const bool low = std::isfinite(r.low), high = std::isfinite(r.high);
  if (low && high && !r.without_low && !r.without_high)
    return fmt::format("{} to {}", end(r.low), end(r.high));
  std::string text;
  if (low) text = fmt::format("{} {}", r.without_low ? ">" : ">=", end(r.low));
  if (high) text += fmt::format("{}{} {}", low ? " and " : "", r.without_high ? "<" : "<=", end(r.high));
  return text.empty() ? "any" : text;
}

std::string write_record(const CaseRecord& record) {
  CaseRecord copy = record;  // Fields may change what they visit; a writer does not
  Writer writer;
  visit_case(writer, copy);
  return writer.out;
}

std::string keys_as_markdown() {
  std::string out;
  for (const auto& [section, meaning] : listed().sections) {
    out += fmt::format(
        "\n### {}\n\n{}\n\n| key | meaning | default | range | only with |\n|---|---|---|---|---|\n",
        section.empty() ? "head" : "[" + section + "]", meaning);
    for (const KeyRow& r : listed().rows) {
      if (r.section != section) continue;
      const std::string value = r.required ? "required" : r.value.empty() ? "none" : "`" + r.value + "`";
      out += fmt::format("| `{}` | {} | {} | {} | {} |\n", r.name, in_cell(r.meaning), value,
                         in_cell(r.range), r.condition.empty() ? "" : "`" + r.condition + "`");
    }
  }
  return out;
}

std::string section_with_key(const std::string& key) {
  for (const KeyRow& r : listed().rows)
    if (r.name == key) return r.section.empty() ? "top of the file" : r.section;
  for (const auto& [section, meaning] : listed().sections)
    if (section == key) return "top of the file";
  return "";
}

}  // namespace packbed
