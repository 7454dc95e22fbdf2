#pragma once
// Cells at the surface of a turned pellet, found without drawing it: most turns that do not fit are seen by
// one of them.
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "lattice/core.hpp"
#include "lattice/stamp.hpp"
#include "math/with_first.hpp"

namespace packbed {

class Probes {
 public:
  /// Some hundred of cylinders and tubes, whose inside a formula tells; a thousand of meshes, which take long
  /// to draw and whose inside a core tells; none of spheres.
  Probes(const Shape& shape, double pitch);

  /// Whether taken(cell), counted from the pellet's own cell, is true of one of them. Each is a cell of
  /// StampMaker::make's stamp. The eight numbered `first` are asked first; those that met something are
  /// left there, for the next turn of the same pellet often meets the same.
  template <class Taken>
  bool meet(double scale, const Quat& rotation, const Vec3& phase, std::uint8_t& first,
            const Taken& taken) const {
    const Placed placed = place(scale, rotation, phase);
    for (std::size_t k = 0; k < eights_.size(); ++k) {
      const std::size_t at = with_first(first, k);
      Cells cells;
      find_cells(eights_[at], placed, cells);
      if (core_) ask_core(placed, cells);
      for (std::size_t l = 0; l < kLane; ++l)
        if (cells.solid[l] && taken(Cell{cells.x[l], cells.y[l], cells.z[l]})) {
          first = static_cast<std::uint8_t>(at);
          return true;
        }
    }
    return false;
  }

 private:
  static constexpr std::size_t kLane = 8;
  using Row = std::array<double, kLane>;
  /// Places on the pellet's surface are scale * grown + fixed [cells]; the second brings them inside.
  struct Eight {
    Row grown[3], fixed[3];
  };
  struct Placed {
    double turn[3][3], phase[3], per_cell;      // per_cell: cells of the core
    double scale, half_height, radius2, bore2;  // [cells], squared
  };
  struct Cells {
    std::array<std::int32_t, kLane> x, y, z, solid;
  };
  Placed place(double scale, const Quat& rotation, const Vec3& phase) const;
  void add(std::size_t n, const Vec3& grown, const Vec3& fixed);
  void add_rings();
  void add_places(const Shape& shape, double pitch);
  static void find_cells(const Eight& eight, const Placed& placed, Cells& cells);
  void ask_core(const Placed& placed, Cells& cells) const;

  std::optional<Core> core_;                        // of shapes that no formula knows
  double radius_ = 0, bore_ = 0, half_height_ = 0;  // at scale 1 [cells]
  std::vector<Eight> eights_;
};

}  // namespace packbed
