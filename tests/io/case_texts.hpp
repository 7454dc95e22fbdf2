#pragma once
// Texts of cases that the tests change, and files to put them in.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "io/case.hpp"
#include "io/temporary_folder.hpp"
#include "math/error.hpp"

namespace packbed {

namespace fs = std::filesystem;

inline const std::string kCase = R"([pellet]
shape = "cylinder"
diameter = "3.42 mm"
height = "3.46 mm"
density = "2.41 g/cm3"
[container]
shape = "tube"
inner_diameter = "44.5 mm"
height = "150 mm"
[contact]
friction = 0.6
damping = 0.4
[feed]
kind = "layers"
count = 300
per_layer = 49
interval = "40 ms"
drop_height = "135 mm"
)";

inline const std::string kPlaced = R"([pellet]
shape = "sphere"
diameter = "4 mm"
density = "2500 kg/m3"
[container]
shape = "plane"
[feed]
kind = "placed"
[[feed.placed]]
position = ["0 mm", "1 mm", "10 mm"]
velocity = ["0 m/s", "0 m/s", "-1 m/s"]
spin = ["0 rad/s", "60 rpm", "0 rad/s"]
[[feed.placed]]
position = ["20 mm", "0 mm", "2 mm"]
turn = "90 deg"
turn_about = [0, 2, 0]
fixed = true
)";

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

inline Scene read(const std::string& text, const std::vector<std::string>& sets = {}) {
  return read_case_text(text, "bed.toml", sets);
}

/// The message with which a text is refused; empty when it is read.
inline std::string refusal(const std::string& text, const std::vector<std::string>& sets = {}) {
  try {
    read(text, sets);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

/// An empty folder of its own for the test that runs.
class CaseFiles : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_ / "sub"); }
  std::string write(const std::string& name, const std::string& text) const {
    return temporary_.write(name, text);
  }
  std::string message(const std::string& path) const {
    try {
      read_case(path);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  const TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
};

}  // namespace packbed
