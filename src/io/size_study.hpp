#pragma once
// Beds of the same largest and different smallest pellets side by side: table, figures and the fractal law
// (Dziugys et al. 2022) fitted to their core porosity.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/packing_model.hpp"
#include "analysis/power_law.hpp"

namespace packbed {

/// What a study takes from a bed's summary.json; NaN where the summary has null.
struct StudyBed {
  std::string name, audit;
  unsigned long long seed = 0;
  int pellets = 0;
  double smallest_m = 0, largest_m = 0, height_m = 0;
  double porosity = 0, shots = 0, shots_error = 0;  // of the core
  double segregation = 0, coordination = 0;         // touching pellets in the core, rattlers aside
  double cpu_s = 0, wall_s = 0;
  std::vector<SizeShare> sizes;  // that the bed has
  double model = 0;  // porosity of mixture_porosity, from the mean of the beds of equal pellets; NaN without

  double ratio() const { return smallest_m / largest_m; }
  bool of_equal_pellets() const { return ratio() > 1 - 1e-9; }
};

/// Of finished runs: result folders or their summary.json, sorted by the size of the smallest pellet. Throws
/// InputError for what is none.
std::vector<StudyBed> read_study(const std::vector<std::string>& folders);

/// A published number: value, and the ends of its range where it has one (else NaN).
struct Published {
  double value = 0, low = 0, high = 0;
};

/// CSV: quantity,value,low,high with rows a, b, n, sd, segregation, monodisperse; a comment names the source.
std::map<std::string, Published> read_published(const std::string& path);

struct Study {
  std::vector<StudyBed> beds;
  std::map<std::string, Published> published;
  std::optional<PowerLaw> law;
  std::string no_law;                        // why there is none
  std::optional<PowerLaw> with_published_n;  // then, when an exponent was published
};

/// Fits the law to the beds that have a core, and asks the packing model about each.
Study make_study(std::vector<StudyBed> beds, std::map<std::string, Published> published);

/// The table, the law beside the published one, and the range of the segregation.
std::string study_text(const Study& study);
/// beds.csv, law.csv and study.html in the folder. Whole or not at all; SystemError.
void write_study(const std::string& folder, const Study& study);

}  // namespace packbed
