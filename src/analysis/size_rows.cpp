#include "analysis/size_rows.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace packbed {
namespace {

constexpr double kAlike = 1e-9;  // of a size, within which two are one

double cube(double x) {
  return x * x * x;
}

double size_of(const PackedBed& bed, const Pellet& p) {
  return p.scale * bed.shapes[p.shape]->equivalent_diameter();
}

bool in_row(const SizeRow& row, double d) {
  return d >= row.from_m * (1 - kAlike) && d <= row.to_m * (1 + kAlike);
}

/// Empty rows for the sizes of one shape, largest first.
std::vector<SizeRow> rows_for(std::uint32_t shape, const std::vector<double>& sizes) {
  std::vector<SizeRow> rows;
  if (sizes.size() <= kMostSizes) {
    for (auto d = sizes.rbegin(); d != sizes.rend(); ++d)
      rows.push_back({.shape = shape, .from_m = *d, .to_m = *d, .diameter_m = *d});
    return rows;
  }
  const double low = sizes.front(), ratio = sizes.back() / low;
  for (std::size_t k = kSizeClasses; k-- > 0;) {
    const auto edge = [&](std::size_t i) {
      return low * std::pow(ratio, static_cast<double>(i) / kSizeClasses);
    };
    rows.push_back({.shape = shape,
                    .from_m = edge(k),
                    .to_m = edge(k + 1),
                    .diameter_m = std::sqrt(edge(k) * edge(k + 1))});
  }
  return rows;
}

void fill(std::vector<SizeRow>& rows, const PackedBed& bed, std::uint32_t shape) {
  double number = 0, volume = 0;
  std::vector<double> diameters(rows.size(), 0);
  for (const Pellet& p : bed.pellets) {
    if (p.shape != shape) continue;
    const double d = size_of(bed, p);
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const SizeRow& r) { return in_row(r, d); });
    ++row->count;
    row->volume += cube(d);
    diameters[static_cast<std::size_t>(row - rows.begin())] += d;
    ++number;
    volume += cube(d);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].count > 0) rows[i].diameter_m = diameters[i] / rows[i].count;
    rows[i].number = rows[i].count / number;
    rows[i].volume /= volume;
  }
}

/// Share of the law from the row's lower to its upper end, both within.
double asked(const SizeDistribution& sizes, const SizeRow& row, SizeBasis by) {
  return share_under(sizes, row.to_m * (1 + kAlike), by) - share_under(sizes, row.from_m * (1 - kAlike), by);
}

void add_missing(std::vector<SizeRow>& rows, const PelletKind& kind, std::uint32_t shape) {
  if (kind.asked.law != SizeLaw::table) return;
  for (const SizeClass& c : kind.sizes) {
    const double d = c.scale * kind.shape->equivalent_diameter();
    const bool there = std::any_of(rows.begin(), rows.end(),
                                   [&](const SizeRow& r) { return r.shape == shape && in_row(r, d); });
    if (!there) rows.push_back({.shape = shape, .from_m = d, .to_m = d, .diameter_m = d});
  }
}

}  // namespace

std::vector<SizeRow> size_rows(const PackedBed& bed) {
  std::vector<SizeRow> out;
  for (std::uint32_t shape = 0; shape < bed.shapes.size(); ++shape) {
    std::set<double> found;
    for (const Pellet& p : bed.pellets)
      if (p.shape == shape) found.insert(size_of(bed, p));
    if (found.size() < 2) continue;
    std::vector<SizeRow> rows = rows_for(shape, {found.begin(), found.end()});
    fill(rows, bed, shape);
    out.insert(out.end(), rows.begin(), rows.end());
  }
  return out;
}

std::size_t row_of(const std::vector<SizeRow>& rows, const PackedBed& bed, const Pellet& pellet) {
  const double d = size_of(bed, pellet);
  const auto row = std::find_if(rows.begin(), rows.end(),
                                [&](const SizeRow& r) { return r.shape == pellet.shape && in_row(r, d); });
  return static_cast<std::size_t>(row - rows.begin());
}

void add_asked(std::vector<SizeRow>& rows, const std::vector<PelletKind>& kinds) {
  for (std::uint32_t k = 0; k < kinds.size(); ++k) {
    if (kinds[k].asked.law == SizeLaw::one) continue;
    add_missing(rows, kinds[k], k);
    for (SizeRow& row : rows) {
      if (row.shape != k) continue;
      row.asked_number = asked(kinds[k].asked, row, SizeBasis::number);
      row.asked_volume = asked(kinds[k].asked, row, SizeBasis::volume);
    }
  }
}

}  // namespace packbed
