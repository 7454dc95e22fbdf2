#pragma once
// How far apart two analyses are: curves by their RMS distance, orientations by Kolmogorov and Smirnov's.
#include <string>
#include <vector>

#include "analysis/results.hpp"

namespace packbed {

/// Root mean square of b - a at the points of `a` that `b` reaches; b is interpolated linearly between its
/// own. x is in pellet diameters. NaN where the curves have no point in common.
double rms_distance(const Profile& a, const Profile& b);

/// Largest difference of the two distribution functions of the angles, 0 to 1, and the value that two samples
/// of these sizes from one distribution exceed in one case of twenty (Smirnov: 1.358 sqrt((n + m) / (n m))).
struct KolmogorovSmirnov {
  double distance = 0, limit_5_percent = 0;
};
/// NaN entries (pellets without an axis) are left out; both numbers are NaN when a side has none.
KolmogorovSmirnov ks_distance(std::vector<double> a, std::vector<double> b);

struct Distances {
  double bulk = 0;               // density of the second less that of the first
  double axial = 0, radial = 0;  // RMS
  KolmogorovSmirnov orientation;
};
/// Of `other` from `first`; the axial curves over the lower of the two middle sections' ends, in diameters.
Distances distances(const AnalysisResult& first, const AnalysisResult& other);

}  // namespace packbed
