#include "io/case.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "io/case_reader.hpp"
#include "io/case_scene.hpp"
#include "io/case_writer.hpp"
#include "math/error.hpp"

namespace packbed {
namespace {

namespace fs = std::filesystem;
using Kind = TomlNode::Kind;

std::string read_text(const std::string& path, const std::string& where) {
  std::error_code error;
  if (!fs::exists(path, error))
    throw InputError(where, "no such file", "a case file (TOML)",
                     "check the name; cases/quick.toml is an example");
  if (!fs::is_regular_file(path, error))
    throw InputError(where, "something that is not a file", "a case file (TOML)");
  if (fs::file_size(path, error) > (16u << 20))
    throw InputError(where, "more than 16 MB", "a case file (TOML)");
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw InputError(where, "a file that cannot be read", "a readable case file (TOML)");
  return text.str();
}

fs::path folder_of(const TomlNode& root, const std::string& case_file) {
  const fs::path own = fs::path(case_file).parent_path();
  const TomlNode* folder = root.find("folder");
  if (folder && folder->kind == Kind::string) return own / folder->text;
  return own.empty() ? "." : own;
}

/// File names of an extended case count from its own folder: makes them count from `to`.
void move_path(TomlNode& table, const char* key, const fs::path& from, const fs::path& to) {
  TomlNode* node = table.kind == Kind::table ? table.find(key) : nullptr;
  if (!node || node->kind != Kind::string || node->text.empty()) return;
  const fs::path full = fs::absolute(from / node->text).lexically_normal();
  node->text = full.lexically_proximate(fs::absolute(to).lexically_normal()).string();
}

void move_paths_of_pellet(TomlNode& pellet, const fs::path& from, const fs::path& to) {
  move_path(pellet, "file", from, to);
  if (TomlNode* sizes = pellet.kind == Kind::table ? pellet.find("sizes") : nullptr)
    move_path(*sizes, "csv", from, to);
}

void move_paths(TomlNode& root, const fs::path& from, const fs::path& to) {
  if (fs::absolute(from).lexically_normal() == fs::absolute(to).lexically_normal()) return;
  if (TomlNode* pellet = root.find("pellet")) {
    move_paths_of_pellet(*pellet, from, to);
    if (pellet->kind == Kind::array)
      for (TomlNode& one : pellet->items) move_paths_of_pellet(one, from, to);
  }
  if (TomlNode* container = root.find("container")) move_path(*container, "file", from, to);
  if (TomlNode* feed = root.find("feed")) move_path(*feed, "csv", from, to);
}

/// The text's tree laid over the tree of the case that it extends, and so on down.
TomlNode tree_of(const std::string& text, const std::string& case_file, int depth) {
  TomlNode root = parse_toml(text, case_file);
  const TomlNode* extends = root.find("extends");
  if (!extends) return root;
  const std::string where = extends->where + ": extends";
  if (extends->kind != Kind::string)
    throw InputError(where, shown(*extends), "the name of another case file, in quotes");
  if (depth >= 16)
    throw InputError(where, "more than 16 cases that extend each other", "a chain with an end");
  const fs::path folder = folder_of(root, case_file);
  const std::string base_file =
      (fs::path(case_file).parent_path() / extends->text).lexically_normal().string();
  TomlNode base = tree_of(read_text(base_file, where + ": " + base_file), base_file, depth + 1);
  move_paths(base, folder_of(base, base_file), folder);
  base.remove("folder");
  base.remove("name");  // each case has its own
  root.remove("extends");
  lay_over(base, std::move(root));
  base.where = case_file + ":1";
  return base;
}

[[noreturn]] void refuse(const std::string& case_file, const std::vector<std::string>& problems) {
  if (problems.size() == 1) throw InputError(problems[0]);
  throw InputError(
      fmt::format("{}: {} problems\n  {}", case_file, problems.size(), fmt::join(problems, "\n  ")));
}

CaseRecord record_of(const std::string& text, const std::string& case_file,
                     const std::vector<std::string>& sets, std::optional<std::uint64_t> seed) {
  TomlNode root = tree_of(text, case_file, 0);
  TomlNode over;
  for (const std::string& assignment : sets) add_assignment(over, assignment);
  if (!over.keys.empty()) lay_over(root, std::move(over));
  if (root.where.empty()) root.where = case_file + ":1";
  const fs::path folder = folder_of(root, case_file);
  std::vector<std::string> problems;
  CaseRecord record = read_record(root, folder.string(), problems);
  record.folder = fs::absolute(folder).lexically_normal().string();
  if (record.name.empty()) record.name = fs::path(case_file).stem().string();
  if (record.name.empty()) record.name = "case";
  if (seed) record.seed = *seed;
  if (problems.empty()) problems = contradictions(record, case_file);
  if (!problems.empty()) refuse(case_file, problems);
  return record;
}

Scene scene_of(const CaseRecord& record, const std::string& case_file) {
  std::vector<std::string> problems;
  Scene scene = make_scene(record, case_file, problems);
  if (!problems.empty()) refuse(case_file, problems);
  scene.case_file = case_file;
  scene.case_text = write_record(record);
  return scene;
}

}  // namespace

Scene read_case(const std::string& path, const std::vector<std::string>& sets,
                std::optional<std::uint64_t> seed) {
  return read_case_text(read_text(path, path), path, sets, seed);
}

Scene read_case_text(const std::string& text, const std::string& case_file,
                     const std::vector<std::string>& sets, std::optional<std::uint64_t> seed) {
  return scene_of(record_of(text, case_file, sets, seed), case_file);
}

AnalysisWish read_analysis(const std::string& text, const std::string& case_file) {
  return record_of(text, case_file, {}, {}).analysis;
}

std::string case_with_defaults(const std::string& path, const std::vector<std::string>& sets,
                               std::optional<std::uint64_t> seed) {
  return write_record(record_of(read_text(path, path), path, sets, seed));
}

void check_case(const std::string& path) {
  const Scene scene = read_case(path);
  std::cout << path << ": a good case\n" << plan(scene);
}

std::string case_keys_as_markdown() {
  return keys_as_markdown();
}

}  // namespace packbed
