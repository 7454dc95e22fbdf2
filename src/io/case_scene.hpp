#pragma once
// From what a case says to the scene that a packer takes: opens the CAD files and sees whether things fit.
#include <string>
#include <vector>

#include "io/case_keys.hpp"

namespace packbed {

/// What is wrong between the keys of a record, each of which is good by itself. No file is opened.
std::vector<std::string> contradictions(const CaseRecord& record, const std::string& case_file);

/// Reads CAD and CSV, makes shapes and container. Problems are added to the list; with any of them the scene
/// is not to be used.
Scene make_scene(const CaseRecord& record, const std::string& case_file, std::vector<std::string>& problems);

}  // namespace packbed
