#pragma once
// A few cells at the surface of a turned pellet, found without drawing it: most turns that do not fit are
// seen by one of them.
#include <cmath>
#include <vector>

#include "lattice/stamp.hpp"

namespace packbed {

class Probes {
 public:
  /// Of cylinders; none of other shapes, which no formula tells the inside of.
  Probes(const Shape& shape, double pitch);

  /// Whether taken(cell), counted from the pellet's own cell, is true of one of them. Each is a cell of
  /// StampMaker::make's stamp.
  template <class Taken>
  bool meet(double scale, const Quat& rotation, const Vec3& phase, const Taken& taken) const {
    constexpr double kInset = 0.3;  // cells
    const double radius = scale * radius_, half = scale * half_height_;
    const Mat3 turn = rotation.toRotationMatrix();
    const Vec3 axis = turn.col(2);
    for (const Vec3& p : points_) {
      const Vec3 at =
          phase + turn * Vec3((radius - kInset) * p.x(), (radius - kInset) * p.y(), (half - kInset) * p.z());
      const Cell cell{static_cast<int>(std::lround(at.x())), static_cast<int>(std::lround(at.y())),
                      static_cast<int>(std::lround(at.z()))};
      const Vec3 centre = Vec3(cell[0], cell[1], cell[2]) - phase;
      const double along = centre.dot(axis);
      if (std::abs(along) <= half && centre.squaredNorm() - along * along <= radius * radius && taken(cell))
        return true;
    }
    return false;
  }

 private:
  double radius_ = 0, half_height_ = 0;  // at scale 1 [cells]
  std::vector<Vec3> points_;             // on a cylinder of radius and half height 1
};

}  // namespace packbed
