#pragma once
// Which kernel answers for which pair.
#include "contact/touch.hpp"
#include "packers/mesh/model.hpp"

namespace packbed::mesh {

/// A side of a box: its number counts +x, -x, +y, -y.
struct BoxSide {
  Vec3 inwards;     // unit normal
  double half = 0;  // from the axis [m]
  double distance(const Vec3& x) const { return inwards.dot(x) + half; }
};
BoxSide side_of(const Container& box, std::uint32_t number);

/// Body i, of a cylinder kind, where it is.
Rod rod_of(const Model& model, const Bodies& bodies, std::uint32_t i);

/// The touch of a pair of spheres or cylinders (for fields see patches.hpp), of two bodies or of one with the
/// container. When they are apart, gap is a lower bound of the way that their surfaces must go before they
/// can touch [m]. features: of two cylinders, made afresh.
Touch touch_pair(const Model& model, const Bodies& bodies, const BodyPair& pair, RodFeatures& features,
                 double& gap);

}  // namespace packbed::mesh
