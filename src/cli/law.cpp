// packbed law: the fractal law of the core porosity over finished runs of different smallest sizes.
#include <fmt/format.h>

#include <filesystem>

#include "cli/commands.hpp"
#include "io/size_study.hpp"
#include "math/error.hpp"

namespace packbed::cli {

int law(const LawOptions& options) {
  std::error_code error;
  std::filesystem::create_directories(options.out, error);
  if (error)
    throw InputError(options.out, error.message(), "a folder that can be made", "choose another --out");
  std::map<std::string, Published> published;
  if (!options.published.empty()) published = read_published(options.published);
  const Study study = make_study(read_study(options.inputs), std::move(published));
  write_study(options.out, study);
  fmt::print("{}\npage: {}/study.html\n", study_text(study), options.out);
  return 0;
}

}  // namespace packbed::cli
