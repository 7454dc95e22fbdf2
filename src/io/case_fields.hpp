#pragma once
// The keys of a case file are listed once (case_keys.cpp), as calls on a Fields. Who reads the file, who
// writes it with its defaults and who lists the keys for the documentation are three Fields, so that they
// cannot disagree.
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "math/quantity.hpp"
#include "math/types.hpp"

namespace packbed {

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool without_low = false, without_high = false;  // the ends themselves do not belong
  std::string_view why = {};                       // a wrong value is wrong
};

struct Key {
  std::string_view name, meaning;
  std::optional<Dimension> dimension = {};  // none: a plain number
  Range range = {};
  bool required = false;
  std::string_view automatic = {};  // what "auto" means; empty: not allowed. Stored as 0
  bool downwards = false;           // vector: a single quantity points down
};

class Fields {
 public:
  virtual ~Fields() = default;
  virtual bool reading() const { return false; }

  virtual void section(std::string_view name, std::string_view meaning,
                       const std::function<void()>& body) = 0;
  /// [[name]]: body(i) for each element; a single [name] is a list of one
  virtual void list(std::string_view name, std::string_view meaning, std::size_t count,
                    const std::function<void(std::size_t)>& body) = 0;
  /// Keys that belong only to some cases; `condition` names them, for example `shape = "cylinder"`
  virtual void when(bool holds, std::string_view condition, const std::function<void()>& body) = 0;
  /// Index of the one of these keys that the file gives; none: none given. Two given are an error.
  virtual std::optional<std::size_t> one_of(const std::vector<std::string_view>& names) = 0;

  virtual void real(const Key&, double&) = 0;
  virtual void real(const Key&, std::optional<double>&) = 0;
  virtual void whole(const Key&, int&) = 0;
  virtual void whole(const Key&, std::optional<int>&) = 0;
  virtual void seed(const Key&, std::uint64_t&) = 0;
  virtual void flag(const Key&, bool&) = 0;
  virtual void choice(const Key&, std::string&, const std::vector<std::string_view>& allowed) = 0;
  virtual void text(const Key&, std::string&) = 0;  // empty: not given
  virtual void path(const Key&, std::string&) = 0;  // of a file that must be there; empty: not given
  virtual void vector(const Key&, Vec3&) = 0;
  virtual void numbers(const Key&, std::vector<double>&) = 0;  // a list; empty: not given
  virtual void rotation(const Key&, Quat&) = 0;                // (w, x, y, z)
};

/// "> 0 m, <= 5 m"; "any" without limits.
std::string to_string(const Range&, std::optional<Dimension>);

}  // namespace packbed
