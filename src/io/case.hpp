#pragma once
// The case file: TOML text in, one checked Scene in SI out. docs/case.md has every key.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bed/scene.hpp"

namespace packbed {

/// Reads a case file, after `extends` and with every `key=value` of sets laid over it; `seed` overrules the
/// key of that name. Scene::case_text holds the case with all defaults filled in. Throws InputError with all
/// problems of the file, one a line.
Scene read_case(const std::string& path, const std::vector<std::string>& sets = {},
                std::optional<std::uint64_t> seed = {});

/// The same from text: a Scene::case_text gives the scene that it came from, from any working folder.
/// `case_file` names the text in messages and is where relative paths count from when the text does not say
/// `folder`.
Scene read_case_text(const std::string& text, const std::string& case_file,
                     const std::vector<std::string>& sets = {}, std::optional<std::uint64_t> seed = {});

/// What the text says of the analysis; opens no CAD file.
AnalysisWish read_analysis(const std::string& text, const std::string& case_file);

/// The case as TOML with every key that applies, its unit, default and range in comments; opens no CAD file.
std::string case_with_defaults(const std::string& path, const std::vector<std::string>& sets = {},
                               std::optional<std::uint64_t> seed = {});

/// Prints what the case will do, or throws the InputError that says what is wrong with it.
void check_case(const std::string& path);

/// What a run of the scene will do (for --dry): shapes and kernels, what is made, what is skipped and why,
/// memory and time expected.
std::string plan(const Scene& scene);

/// Every key that a case may have, as the tables of docs/case.md.
std::string case_keys_as_markdown();

}  // namespace packbed
