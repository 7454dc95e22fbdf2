#pragma once
// Contact between solid cylinders, and of a cylinder with a floor and with the wall of a tube. Analytic: no
// mesh, no samples on the surface. The features that carry the touch, each integrated where it dips into the
// other body and nowhere else:
//
//     rims       four arcs of Gauss nodes between exact end points    edge and face touches
//     rings      two inside each cap, four round each side            coaxial caps; level parallel sides
//     crossing   the common perpendicular of the axes, closed form    side against side
#include <array>
#include <cstdint>

#include "contact/rod.hpp"
#include "contact/rod_arcs.hpp"
#include "contact/rod_circles.hpp"
#include "contact/touch.hpp"

namespace packbed {

/// What the looks at a pair have found: all that the next one needs while the bodies stay about where they
/// are. Each of the places where a pair can touch (twenty circles, and the crossing of the sides) is
/// looked at again only when the bodies may have gone far enough to change what is known of it.
struct RodFeatures {
  static constexpr std::size_t kMostArcs = 24, kCrossing = kRodCircles, kPlaces = kCrossing + 1;
  bool known = false;     // all the rest holds
  bool crossing = false;  // of the sides touches
  std::uint8_t arcs = 0;  // that touch
  std::array<RodArc, kMostArcs> arc;
  Vec3 wish_a = Vec3::Zero(), wish_b = Vec3::Zero();  // first vectors of the planes of the circles of a, of b
  // how they stood when last looked at: a moving bed carries its pairs along, and a pellet that rolls about
  // its own axis changes nothing
  Vec3 apart = Vec3::Zero();  // centre of b from that of a [m]
  Vec3 axis_a = Vec3::UnitZ(), axis_b = Vec3::UnitZ();
  double gone = 0;                     // way that points of one have gone against the other, at most [m]
  std::array<float, kPlaces> until{};  // `gone` at which a place is looked at again [m]

  /// Way that the bodies may still go before the first of the places is due [m].
  double due() const;
  /// Adds the way from the last look to now.
  void follow(const Rod& a, const Rod& b);
};

/// Looks at everything, and tells what it has found.
Touch touch_cylinders(const Rod& a, const Rod& b, RodFeatures& features);
Touch touch_cylinders(const Rod& a, const Rod& b);

/// Pairs of which much is known, looked at many at a time.
class RodLooks {
 public:
  bool full() const {
    return lanes_ + static_cast<int>(RodFeatures::kMostArcs) > kCapacity || pairs_ == kPairs;
  }
  /// features: known; brought up to date.
  void add(std::uint32_t tag, const Rod& a, const Rod& b, RodFeatures& features);
  /// Calls done(tag, touch, lost) for each in the order of adding. lost: an arc was not where it was looked
  /// for; that pair needs a look at everything.
  template <class Done>
  void finish(const Done& done) {
    evaluate();
    for (int i = 0; i < pairs_; ++i) {
      bool lost = false;
      const Touch touch = result(i, lost);
      done(pair_[static_cast<std::size_t>(i)].tag, touch, lost);
    }
    pairs_ = lanes_ = 0;
  }

 private:
  static constexpr int kCapacity = 64, kPairs = 64;
  struct Entry {
    std::uint32_t tag = 0;
    int lane = 0;
    Vec3 origin;
    Rod a, b;  // seen from there
    RodFeatures* features = nullptr;
  };
  void evaluate();
  Touch result(int i, bool& lost) const;

  std::array<RodArcBatch, kCapacity / kLanes> batch_;
  std::array<Entry, kPairs> pair_;
  int lanes_ = 0, pairs_ = 0;
};

/// With the half space z < 0. gap: way to go before it can touch, when it does not.
Touch touch_floor(const Rod& rod, double& gap);
/// With the outside of an upright tube of inner radius `tube` round the z axis, without end up and down.
Touch touch_tube(const Rod& rod, double tube, double& gap);

}  // namespace packbed
