#include "io/case_sizes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

#include "io/csv_table.hpp"
#include "math/error.hpp"

namespace packbed {
namespace {

constexpr double kSumTolerance = 1e-3;  // of fractions; a sieve table is printed with three digits
constexpr double kMostPellets = 1e7;

std::string length_text(double metres) {
  return format_quantity(metres, Dimension::length);
}

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

void check_fractions(const std::vector<double>& fractions, const std::string& where) {
  const double sum = sum_of(fractions);
  if (std::abs(sum - 1) > kSumTolerance)
    throw InputError(where, fmt::format("fractions that add up to {:.6g}", sum), "1, within 0.001",
                     "correct them, or give amounts, which need not add up to anything");
}

struct Column {
  std::size_t at = 0;
  std::string name, unit;  // "diameter", "mm"
};

std::vector<Column> columns_of(const CsvLine& header) {
  std::vector<Column> columns;
  for (std::size_t i = 0; i < header.cells.size(); ++i) {
    const std::string& cell = header.cells[i];
    const std::size_t bar = cell.find('_');
    columns.push_back({i, cell.substr(0, bar), bar == std::string::npos ? "" : cell.substr(bar + 1)});
  }
  return columns;
}

const Column* find(const std::vector<Column>& columns, const std::string& name) {
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

/// Columns diameter_UNIT and that of the basis: count or number_fraction, volume or volume_fraction, mass or
/// mass_fraction; an amount may have a unit behind it (volume_m3). Others are ignored.
void read_table(const std::string& path, const std::string& by, SizeDistribution& out) {
  const CsvTable table = read_csv_table(path, "sizes");
  const std::vector<Column> columns = columns_of(table.header);
  const Column* diameter = find(columns, "diameter");
  const Column* amount = find(columns, by == "number" ? "count" : by);
  if (!amount) amount = find(columns, by);
  if (!diameter || diameter->unit.empty() || !amount)
    throw InputError(table.header.where, fmt::format("columns {}", fmt::join(table.header.cells, ", ")),
                     fmt::format("diameter with a unit (diameter_mm), and {0} or {1}_fraction",
                                 by == "number" ? "count" : by, by),
                     "by says which amounts are read");
  for (const CsvLine& line : table.lines) {
    out.diameter.push_back(parse_quantity(line.cells[diameter->at] + " " + diameter->unit, Dimension::length,
                                          line.where + ": diameter"));
    out.amount.push_back(csv_number(line.cells[amount->at], line.where + ": " + amount->name));
    if (!(out.diameter.back() > 0) || out.amount.back() < 0)
      throw InputError(line.where, fmt::format("{} of {}", line.cells[amount->at], line.cells[diameter->at]),
                       "a diameter greater than 0 and an amount not less than 0");
  }
  if (amount->unit == "fraction") check_fractions(out.amount, path);
}

void inline_table(const SizesRecord& r, SizeDistribution& out) {
  const std::vector<double>& amounts = r.amounts.empty() ? r.fractions : r.amounts;
  if (amounts.size() != r.diameters.size())
    throw InputError(
        "pellet.sizes",
        fmt::format("{} diameters and {} fractions or amounts", r.diameters.size(), amounts.size()),
        "as many of the one as of the other");
  if (r.amounts.empty()) check_fractions(r.fractions, "pellet.sizes.fractions");
  out.diameter = r.diameters;
  out.amount = amounts;
}

void check_table(const SizeDistribution& d) {
  double left = 0;
  for (std::size_t i = 0; i < d.diameter.size(); ++i)
    if (d.diameter[i] >= d.smallest && d.diameter[i] <= d.largest) left += d.amount[i];
  if (!(left > 0))
    throw InputError("pellet.sizes", "a table with nothing between smallest and largest", "one size at least",
                     "check the unit of smallest and largest");
}

void set_cut_offs(const SizesRecord& r, SizeDistribution& out) {
  const bool ends = out.law == SizeLaw::gates_gaudin_schuhmann;
  if (!r.smallest || (!r.largest && !ends))
    throw InputError("pellet.sizes", fmt::format("no {}", r.smallest ? "largest" : "smallest"),
                     "the cut-offs of the law",
                     "a law has no end of its own, and pellets of no size at all cannot be packed");
  out.smallest = *r.smallest;
  out.largest = ends ? std::min(r.largest.value_or(r.modulus), r.modulus) : *r.largest;
  if (!(out.smallest < out.largest))
    throw InputError("pellet.sizes.smallest", length_text(out.smallest),
                     fmt::format("less than the largest size, {}", length_text(out.largest)));
}

/// One pellet of the kind, on average [kg].
double mean_mass(const PelletKind& kind) {
  const double whole = kind.density * kind.shape->volume;
  return kind.asked.law == SizeLaw::one
             ? whole
             : whole * mean_cube(kind.asked) / std::pow(kind.shape->equivalent_diameter(), 3);
}

/// Pellets that the tables count themselves, within their cut-offs.
double own_count(const Scene& scene) {
  double count = 0;
  for (const PelletKind& kind : scene.pellets)
    for (std::size_t i = 0; i < kind.asked.diameter.size(); ++i)
      if (kind.asked.diameter[i] >= kind.asked.smallest && kind.asked.diameter[i] <= kind.asked.largest)
        count += kind.asked.amount[i];
  return std::round(count);
}

std::uint32_t total_count(const CaseRecord& record, const Scene& scene) {
  const Feed& feed = scene.feed;
  double count = std::numeric_limits<double>::infinity();
  if (feed.count) count = *feed.count;
  if (feed.mass) {
    double mean = 0;
    for (const PelletKind& kind : scene.pellets) mean += kind.share * mean_mass(kind);
    count = std::min(count, std::max(1.0, std::round(*feed.mass / mean)));
  }
  const bool counted = record.pellets.size() == 1 && counts_itself(record.pellets[0].sizes_of_pellets);
  if (!std::isfinite(count) && counted) count = own_count(scene);
  if (!std::isfinite(count))
    throw InputError("feed", "no count and no mass", "how many pellets share the sizes out",
                     "add for example count = 2000 (height may end the feeding before)");
  if (!(count >= 1 && count <= kMostPellets))
    throw InputError("feed", fmt::format("{:g} pellets", count), fmt::format("1 to {:g}", kMostPellets));
  return static_cast<std::uint32_t>(count);
}

}  // namespace

bool counts_itself(const SizesRecord& r) {
  return r.law == "table" && r.by == "number" && (!r.csv.empty() || !r.amounts.empty());
}

SizeDistribution size_distribution(const SizesRecord& r, const std::string& folder) {
  SizeDistribution out;
  if (r.law == "one") return out;
  out.by = r.by == "number" ? SizeBasis::number : SizeBasis::volume;
  if (r.law == "table") {
    out.law = SizeLaw::table;
    out.smallest = r.smallest.value_or(out.smallest) * (1 - 1e-9);  // "2.81 mm" lets 2.81 mm in
    out.largest = r.largest.value_or(out.largest) * (1 + 1e-9);
    if (r.csv.empty())
      inline_table(r, out);
    else
      read_table((std::filesystem::path(folder) / r.csv).string(), r.by, out);
    check_table(out);
    return out;
  }
  out.law = r.law == "rosin_rammler" ? SizeLaw::rosin_rammler
            : r.law == "log_normal"  ? SizeLaw::log_normal
                                     : SizeLaw::gates_gaudin_schuhmann;
  out.modulus = r.modulus;
  out.exponent = r.exponent;
  out.deviation = r.deviation;
  set_cut_offs(r, out);
  return out;
}

void share_out_sizes(const CaseRecord& record, Scene& scene) {
  const std::uint32_t total = total_count(record, scene);
  std::vector<double> shares;
  for (const PelletKind& kind : scene.pellets) shares.push_back(kind.share);
  const std::vector<std::uint32_t> counts = largest_remainder(shares, total);
  for (std::size_t k = 0; k < counts.size(); ++k) {
    PelletKind& kind = scene.pellets[k];
    kind.sizes = size_classes(kind.asked, counts[k], kind.shape->equivalent_diameter());
  }
  scene.feed.count = static_cast<int>(total);
  scene.feed.mass.reset();  // it has said how many
}

}  // namespace packbed
