#pragma once
// What table, law and figures of a study share.
#include <limits>
#include <string>
#include <vector>

#include "io/size_study.hpp"

namespace packbed {

/// A column of the table of beds.
struct StudyColumn {
  const char *title, *csv, *format;
  double (*value)(const StudyBed&);
};
extern const std::vector<StudyColumn> kStudyColumns;
/// As people read it: lengths in millimetres.
std::string shown(const StudyColumn& c, const StudyBed& b);

/// One quantity of the law: fitted value, half of its interval, least and largest.
struct LawLine {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::string name;
  double value = kNone, half = kNone, low = kNone, high = kNone;
};
/// NaN where it is not there.
Published published_of(const Study& study, const std::string& name);
double published_value(const Study& study, const std::string& name);
/// Porosity of the beds of equal pellets: mean, least and largest.
LawLine of_equal_pellets(const Study& study);
std::vector<LawLine> law_lines(const Study& study);
/// The law and its lines.
std::string law_text(const Study& study);

}  // namespace packbed
