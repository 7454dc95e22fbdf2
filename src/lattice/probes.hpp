#pragma once
// A few cells at the surface of a turned pellet, found without drawing it: most turns that do not fit are
// seen by one of them.
#include <cmath>
#include <vector>

#include "lattice/stamp.hpp"

namespace packbed {

class Probes {
 public:
  /// Of cylinders and tubes; none of other shapes, which no formula tells the inside of.
  Probes(const Shape& shape, double pitch);

  /// Whether taken(cell), counted from the pellet's own cell, is true of one of them. Each is a cell of
  /// StampMaker::make's stamp.
  template <class Taken>
  bool meet(double scale, const Quat& rotation, const Vec3& phase, const Taken& taken) const {
    constexpr double kInset = 0.3;  // cells
    const double radius = scale * radius_, bore = scale * bore_, half = scale * half_height_;
    const Mat3 turn = rotation.toRotationMatrix();
    const Vec3 axis = turn.col(2);
    for (const Point& p : points_) {
      const double out = p.in_bore ? bore + kInset : radius - kInset;
      const Vec3 at =
          phase + turn * Vec3(out * p.place.x(), out * p.place.y(), (half - kInset) * p.place.z());
      const Cell cell{static_cast<int>(std::lround(at.x())), static_cast<int>(std::lround(at.y())),
                      static_cast<int>(std::lround(at.z()))};
      const Vec3 centre = Vec3(cell[0], cell[1], cell[2]) - phase;
      const double along = centre.dot(axis), across = centre.squaredNorm() - along * along;
      if (std::abs(along) <= half && across <= radius * radius && across >= bore * bore && taken(cell))
        return true;
    }
    return false;
  }

 private:
  struct Point {
    Vec3 place;  // on a cylinder of radius and half height 1
    bool in_bore;
  };
  double radius_ = 0, bore_ = 0, half_height_ = 0;  // at scale 1 [cells]
  std::vector<Point> points_;
};

}  // namespace packbed
