#pragma once
// digicgp: what the cells that stop a pellet do to it and to those whose cells they are.
//
//        o          each cell that a pellet would enter and finds taken is a pair of colliding voxels. Both
//        of
//      /   \        their pellets feel a force of 1: along the line from the cell to their own centre of mass
//     o     |       for the net force, square to the face that it comes through for the torque
//   ##x     x##
#include <span>
#include <vector>

#include "packers/lattice/model.hpp"

namespace packbed::lattice {

/// Cells as columns of numbers, counted from one pellet's cell, so that whole vectors of them are worked on.
struct CellColumns {
  std::vector<float> x, y, z;
  Cell sum{0, 0, 0};  // of all cells

  void clear();
  /// The cells of one word whose first bit is (x0, y0, z0).
  void add(std::uint64_t bits, int x0, int y0, int z0);
};

/// What was tried with a pellet and found taken.
struct Tried {
  const Stamp& stamp;
  Vec3 phase;                    // of the centre of mass then
  Cell by;                       // that the stamp's cell would be from the pellet's
  std::span<const HitRow> hits;  // of the stamp
  Vec3 face;                     // that the cells come through, towards the pellet; zero: not known
};

/// Turns collisions into pushes; keeps its memory between calls (one a thread).
class Collisions {
 public:
  /// Appends what pellet i feels of the cells that stopped it, and what the pellets feel that they belong to.
  void push(const State& state, std::size_t i, const Tried& tried, std::vector<Push>& pushes);

 private:
  struct Other {
    std::uint32_t pellet = 0;
    const Stamp* stamp = nullptr;
    Cell offset{0, 0, 0}, corner{0, 0, 0};  // of its cell and of its box, from the cell of pellet i
    CellColumns cells;
  };
  void find_others(const State& state, std::size_t i, const Tried& tried);
  void attribute(std::uint64_t bits, int x, int y, int z);

  CellColumns own_;
  std::vector<Other> others_;  // the first count_ of them
  std::size_t count_ = 0, last_ = 0;
};

}  // namespace packbed::lattice
