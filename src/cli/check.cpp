#include <cstdio>

#include "cli/commands.hpp"
#include "io/cad_report.hpp"
#include "io/case.hpp"

namespace packbed::cli {

int check(const CheckOptions& options) {
  if (options.file.ends_with(".toml")) {
    check_case(options.file);
    return 0;
  }
  CadOptions cad;
  cad.unit = options.unit;
  cad.want_tets = options.tets;
  const CadReport report = describe_cad(options.file, cad, options.container);
  std::fputs(report.text.c_str(), stdout);
  std::puts(report.usable ? "\ngood: a run can use it" : "\nunusable: see REFUSED above");
  return report.usable ? 0 : 2;
}

}  // namespace packbed::cli
