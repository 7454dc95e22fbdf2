#include "analysis/coordination.hpp"

#include <algorithm>
#include <unordered_map>

#include "analysis/size_rows.hpp"

namespace packbed {
namespace {

constexpr int kHolds = 4;  // contacts that can hold a sphere without friction

/// Of each pellet (n each): other pellets that it touches, and contacts with the container.
struct Touches {
  std::vector<int> pellets, container;
};

Touches from_contacts(const PackedBed& bed) {
  std::unordered_map<std::uint32_t, std::size_t> place;
  for (std::size_t i = 0; i < bed.pellets.size(); ++i) place[bed.pellets[i].id] = i;
  Touches t{std::vector<int>(bed.pellets.size()), std::vector<int>(bed.pellets.size())};
  for (const Contact& c : bed.contacts) {
    if (!(c.overlap > 0)) continue;
    const std::size_t a = place.at(c.a);
    if (c.b == kContainer) {
      ++t.container[a];
      continue;
    }
    ++t.pellets[a];
    ++t.pellets[place.at(c.b)];
  }
  return t;
}

Touches from_overlaps(const PackedBed& bed, const std::vector<Overlap>& overlaps) {
  Touches t{std::vector<int>(bed.pellets.size()), std::vector<int>(bed.pellets.size())};
  for (const Overlap& o : overlaps) {
    ++(o.b == kContainer ? t.container : t.pellets)[o.a];
    if (o.b != kContainer) ++t.pellets[o.b];
  }
  return t;
}

struct Mean {
  double sum = 0, n = 0;
  void add(int x) {
    sum += x;
    ++n;
  }
  double value() const { return n > 0 ? sum / n : kNone; }
};

}  // namespace

Coordination coordination(const PackedBed& bed, const std::vector<Overlap>& overlaps,
                          const std::vector<SizeRow>& rows, const std::optional<CoreRegion>& core) {
  Coordination out;
  const bool forces = !bed.contacts.empty();
  out.source = forces ? "forces of the packer" : "overlaps";
  const Touches touches = forces ? from_contacts(bed) : from_overlaps(bed, overlaps);
  Mean all, inner, bearing;
  std::vector<Mean> sizes(rows.size());
  for (std::size_t i = 0; i < bed.pellets.size(); ++i) {
    const Pellet& p = bed.pellets[i];
    const int n = touches.pellets[i];
    const bool rattles = n + touches.container[i] < kHolds;
    out.rattlers += rattles;
    out.histogram.resize(std::max(out.histogram.size(), static_cast<std::size_t>(n) + 1));
    ++out.histogram[static_cast<std::size_t>(n)];
    all.add(n);
    if (const std::size_t row = row_of(rows, bed, p); row < rows.size()) sizes[row].add(n);
    if (!core || !core->holds(p.pose.position)) continue;
    inner.add(n);
    if (!rattles) bearing.add(n);
  }
  out.mean = all.value();
  out.core = inner.value();
  out.core_bearing = bearing.value();
  for (const Mean& m : sizes) out.by_size.push_back(m.value());
  return out;
}

}  // namespace packbed
