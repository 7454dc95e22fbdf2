#pragma once
// What holds the bed. Axes of the bed: z up, the floor at z = 0, the container's axis through the origin.
#include <string>
#include <string_view>

#include "mesh/mesh.hpp"

namespace packbed {

enum class ContainerKind {
  none,   // free space: isolated clouds, single impacts between pellets
  plane,  // a floor at z = 0 without end
  tube,   // a round vertical tube of inner radius `radius` on a flat floor at z = 0, open above
  box,    // an upright box of inner sides `width` and `depth` on a flat floor at z = 0, open above
  mesh    // any closed solid (the wall material); pellets stay out of it
};
std::string_view to_string(ContainerKind);

struct Container {
  ContainerKind kind = ContainerKind::tube;
  std::string name, source;
  double radius =
      0;  // tube: inner radius [m]; box: half its shorter side; mesh: radius of the largest upright cylinder
          // round the axis that fits at mid-height, round the core if there is one [m]
  double width = 0, depth = 0;  // box: inner sides along x and y [m]
  double core_radius = 0;       // mesh: of the material round the axis at mid-height [m]; 0: there is none
  double height = 0;            // of the inside, floor to rim [m]
  TriangleMesh surface;    // of the wall solid as read, in bed axes; empty for none and plane, and for a tube
                           // or box given by its sizes
  double mesh_volume = 0;  // of the wall solid as read [m3]
};

/// Tube, box and mesh hold pellets from the sides; a plane and free space do not.
bool has_sides(ContainerKind);

Container make_tube(const std::string& name, double inner_diameter, double height);
Container make_box(const std::string& name, double width, double depth, double height);
/// From a checked closed mesh of the wall solid; moves it so that the floor's inner face is at z = 0 and the
/// axis at the origin when it can tell. Recognises a tube and a box with a flat floor within
/// kRecogniseTolerance unless `recognise` is false.
Container make_container(const std::string& name, const std::string& source, const TriangleMesh& mesh,
                         bool recognise = true);

}  // namespace packbed
