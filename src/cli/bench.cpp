// packbed bench: run time against error, as CSV, pictures and a page.
#include <fmt/format.h>

#include <cstdio>
#include <thread>

#include "bench/page.hpp"
#include "cli/commands.hpp"
#include "math/clock.hpp"
#include "math/threads.hpp"

namespace packbed::cli {
namespace {

int list() {
  for (const bench::Bench& b : bench::benches()) fmt::print("{:<12} {}\n", b.name, b.asks);
  return 0;
}

bench::Finished run_one(const bench::Bench& bench, const bench::Options& options) {
  bench::Finished finished{&bench, {}, 0};
  const double start = cpu_seconds();
  finished.outcome = bench.run(options);
  finished.cpu_s = cpu_seconds() - start;
  return finished;
}

}  // namespace

int bench(const BenchOptions& o) {
  if (o.list) return list();
  set_threads(o.threads > 0 ? o.threads : 1);
  std::vector<const bench::Bench*> chosen;
  for (const std::string& name : o.names) chosen.push_back(&bench::find_bench(name));
  if (o.names.empty())
    for (const bench::Bench& b : bench::benches()) chosen.push_back(&b);
  bench::Options options{o.quick, o.case_file, o.pellets, o.seeds, {}};
  if (!o.quiet) options.told = [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); };
  std::vector<bench::Finished> all;
  bool passed = true;
  for (const bench::Bench* b : chosen) {
    all.push_back(run_one(*b, options));
    const bench::Finished& f = all.back();
    write_outcome(o.out, f, options);
    write_page(o.out, all, options);
    fmt::print("{} ({:.1f} CPU s)\n", b->name, f.cpu_s);
    for (const std::string& s : f.outcome.findings) fmt::print("  {}\n", s);
    passed = passed && f.outcome.passed;
  }
  fmt::print("{}/bench.html\n", o.out);
  return passed ? 0 : 1;
}

}  // namespace packbed::cli
