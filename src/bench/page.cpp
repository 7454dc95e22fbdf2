#include "bench/page.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <sstream>

#include "io/atomic_file.hpp"
#include "math/error.hpp"
#include "math/threads.hpp"

namespace packbed::bench {
namespace {

std::string about(const Finished& f, const Options& options) {
  return fmt::format("packbed {} bench {}{}; {:.1f} CPU s; {} threads; {}", PACKBED_VERSION, f.bench->name,
                     options.quick ? " --quick" : "", f.cpu_s, threads(), processor_name());
}

std::string section(const Finished& f, const Options& options) {
  std::string out =
      fmt::format("<section><h2>{}</h2><p>{}</p>\n", f.bench->name, escaped(std::string(f.bench->asks)));
  for (const Picture& p : f.outcome.pictures) out += to_svg(p);
  out += "<ul>\n";
  for (const std::string& s : f.outcome.findings) out += "<li>" + escaped(s) + "</li>\n";
  return out + "</ul>\n" + to_html(f.outcome.table) + "<p class='about'>" + escaped(about(f, options)) +
         "</p></section>\n";
}

}  // namespace

std::string processor_name() {
  try {
    std::istringstream lines(read_file("/proc/cpuinfo"));
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  } catch (const InputError&) {  // no such file on this system
  }
  return "processor unknown";
}

void write_outcome(const std::string& folder, const Finished& f, const Options& options) {
  std::filesystem::create_directories(folder);
  std::vector<std::string> heading{about(f, options)};
  heading.insert(heading.end(), f.outcome.findings.begin(), f.outcome.findings.end());
  write_atomically(fmt::format("{}/{}.csv", folder, f.bench->name), to_csv(f.outcome.table, heading));
  for (const Picture& p : f.outcome.pictures)
    write_atomically(fmt::format("{}/{}.svg", folder, p.name), to_svg(p));
}

void write_page(const std::string& folder, const std::vector<Finished>& all, const Options& options) {
  std::string page =
      "<!doctype html><html lang='en'><meta charset='utf-8'><title>packbed bench</title><style>"
      "body{font:15px/1.5 system-ui,sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem;color:#1b2026}"
      "svg{width:100%;height:auto}.table{overflow-x:auto}table{border-collapse:collapse;font-size:12px}"
      "td,th{padding:.2rem .6rem;text-align:right;border-bottom:1px solid #e1e5ea}"
      "td:first-child,th:first-child{text-align:left}.about{color:#5b6672;font-size:13px}</style>"
      "<body><h1>packbed bench</h1>\n";
  for (const Finished& f : all) page += section(f, options);
  write_atomically(folder + "/bench.html", page + "</body></html>\n");
}

}  // namespace packbed::bench
