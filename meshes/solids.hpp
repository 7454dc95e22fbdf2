#pragma once
// Bodies of bodies.toml as exact solids of the CAD kernel.
#include <toml++/toml.h>

#include <string>
#include <utility>
#include <vector>

namespace packbed::meshes {

using Profile = std::vector<std::pair<double, double>>;  // (r, z) [mm]

Profile profile_of(const toml::table& body);

/// Makes the body in gmsh's current model [mm]. std::runtime_error for a shape that is not known or a size
/// that is missing.
void build_solid(const toml::table& body);

}  // namespace packbed::meshes
