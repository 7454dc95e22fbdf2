#include "math/error.hpp"
#include "packers/packer.hpp"

namespace packbed {

PackResult pack(const Scene& scene, const Watch& watch, std::span<const std::byte> state) {
  if (scene.method == "mesh") return pack_mesh(scene, watch, state);
  if (scene.method == "spheres") return pack_spheres(scene, watch, state);
  if (packs_on_lattice(scene.method)) return pack_lattice(scene, watch, state);
  throw InputError(scene.case_file + ": method", '"' + scene.method + '"',
                   "\"mesh\", \"spheres\", \"digipac\", \"digicgp\" or \"digidem\" in this version",
                   "set method = \"mesh\"");
}

}  // namespace packbed
