#pragma once
// Which pellets enter a scene, when and where: shared by every packer. What pellet number 17 is, how large
// and how turned, depends on (seed, 17) alone (of given sizes, on the place of 17 in a random order of all
// that are fed); where it enters depends on (seed, first pellet of its layer, attempt).
//
//   layers   o o o o   n pellets in one plane on a hexagonal pattern, turned and shaken anew for each layer;
//            o o o o   several planes when one has no room for n
//   pour      o  o o   a handful at random points of a circle, drawn again where they would overlap
//   lattice  o o o o   all at time 0 on a cubic lattice from the drop height upwards, each with a velocity of
//            o o o o   random components
//   scatter   o o  o   all at time 0 at random places of a cloud from the drop height upwards, with
//   velocities
//            o  o   o  as those of a lattice
//   placed             all that the case lists, at time 0
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "bed/packed_bed.hpp"
#include "bed/scene.hpp"

namespace packbed {

class Feeder {
 public:
  /// Throws InputError when not even one pellet can enter, when there is no end to the feeding, and for
  /// placed pellets that overlap one another or the container by more than the scene allows.
  explicit Feeder(const Scene& scene);
  ~Feeder();
  Feeder(Feeder&&) noexcept;
  Feeder& operator=(Feeder&&) noexcept;

  /// Simulated time of the next entry [s]; infinity when all have been fed.
  double next_time() const;

  /// Lets the next layer or handful in. `present`: the pellets now in the scene, `surface`: height of the
  /// bed's surface [m]. What enters overlaps nothing, is wholly inside the container, and has ids that
  /// continue fed(). Empty when the end of the feeding has been reached (done()) or there is no room
  /// (waiting(), and next_time() is a quarter of an interval later). A handful that finds room only for some
  /// of its pellets lets these in and waits with the rest.
  std::vector<Pellet> enter(double time, std::span<const Pellet> present, double surface);

  double highest() const;   ///< of the centres of a lattice or of what may be scattered [m]
  int fed() const;          ///< pellets that have entered
  double fed_mass() const;  ///< [kg]
  /// Pellets that will have entered at the end. For a fill to a height only, an estimate (packing density
  /// 0.6) until done().
  int asked() const;
  bool done() const;     ///< nothing more will enter
  bool waiting() const;  ///< the last enter() found no room

  /// The few numbers that change, for checkpoints; restore() throws SystemError when they are not of this
  /// kind of feed.
  std::vector<std::byte> save() const;
  void restore(std::span<const std::byte> state);

 private:
  struct Plan;  // what never changes
  struct State {
    double next_time = 0, mass = 0;
    std::int32_t fed = 0, attempt = 0;  // attempt: tries since the last entry
    std::int32_t waiting = 0, done = 0;
  };
  std::unique_ptr<const Plan> plan_;
  State state_;

  std::vector<Pellet> enter_layer(std::span<const Pellet> near, double height, int count);
  std::vector<Pellet> enter_lattice() const;
  std::vector<Pellet> enter_scattered() const;
  std::vector<Pellet> enter_handful(std::span<const Pellet> near, double height, int count);
};

/// Whether all pellets are there at time 0.
bool enters_at_once(FeedKind kind);
/// Height of the highest centre that is fed in one piece, else the drop height [m].
double highest_at_entry(const Scene& scene);

}  // namespace packbed
