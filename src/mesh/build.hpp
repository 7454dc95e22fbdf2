#pragma once
// Closed meshes of simple bodies, for shapes, containers and tests.
#include <utility>
#include <vector>

#include "mesh/mesh.hpp"

namespace packbed {

/// Body of revolution about z, its circles cut into `facets` sides with the corners ON the circles. `profile`
/// is a closed polygon of (r, z) [m], counter-clockwise in the (r, z) plane; points with r = 0 lie on the
/// axis.
TriangleMesh revolved(const std::vector<std::pair<double, double>>& profile, int facets);
/// Box with one corner at `low` and the opposite one at `high` [m].
TriangleMesh box_mesh(const Vec3& low, const Vec3& high);
/// Both meshes in one record; nothing is joined.
TriangleMesh merged(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace packbed
