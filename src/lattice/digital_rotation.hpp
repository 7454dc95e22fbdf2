#pragma once
// The CT paper's own way to rotate: the cells themselves are turned, and cells are added or taken at the
// surface until there are as many as before. The volume is kept; the shape wears with every rotation.
#include "lattice/stamp.hpp"

namespace packbed {

/// The stamp turned about its centre of mass, which is at `phase` [cells] from the centre of its cell: a cell
/// is solid when the cell nearest to where it came from was; then surface cells with the fewest solid
/// neighbours go, or empty ones with the most are filled.
Stamp turn_cells(const Stamp& stamp, const Vec3& phase, const Quat& turn);

/// Share of a pellet's cells by which a stamp differs from the one drawn from the shape.
double wear(const Stamp& worn, const Stamp& drawn);

}  // namespace packbed
