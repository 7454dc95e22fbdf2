#pragma once
// Pellets and the kernels that answer for pairs of them, with the law that each should follow.
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "analysis/solid_body.hpp"
#include "contact/field.hpp"
#include "contact/touch.hpp"

namespace packbed::bench {

using TouchAt = std::function<Touch(const Pose&, const Pose&)>;

struct ContactKernel {
  std::string name, accuracy;
  TouchAt touch;
  TouchAt law;  // the same law, integrated until it no longer changes
};

/// A pellet and all kernels that can do it, the finest last.
struct ContactSubject {
  std::string name;
  std::shared_ptr<SolidShape> solid;
  double size = 0;  // D, that depths are told in: smallest thickness of convex bodies, else diameter of equal
                    // volume [m]
  std::vector<ContactKernel> kernels;

  Body at(const Pose& pose) const;
};

struct SubjectWish {
  std::string only;                                  // name of a pellet; empty: all
  double finest = 112;                               // points across the diameter of the law of field kernels
  std::vector<double> across{8, kPointsAcross, 28};  // ... of the kernels
};
/// Calls visit with each pellet in turn; its kernels are made just before.
void for_subjects(const SubjectWish& wish, const std::function<void(const ContactSubject&)>& visit);

}  // namespace packbed::bench
