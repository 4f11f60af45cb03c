// Effect of growth on the strain of particles near it.
//
// A particle's deformation is the history of the velocities of the nodes that it had. When a crack grows, some pairs of
// particle and node go over to the field across the crack. If that field had material before, its node has opened away
// from the one that the pair had, and the particle has not felt this motion: its strain would keep the opening as
// stress for good, about a third of the energy that growth releases, and J would fall behind. So in the step after
// growth each such pair moves its node once by what the two fields have opened, for the strain of this particle alone:
// it is then strained as if its node had been in that field since the node was divided.
//
// Openings of nodes near tips that may grow are the sums of their velocities over the steps.
// Weak: they are those of a place, not of the material that moves through it: right while the material moves by less
// than a cell between the time when a tip comes to a node and the time when it has left it behind.
// Source: derived here; crack reference 2.1 for the fields, 5.3 for growth.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm/crack/divided_node.hpp"
#include "mpm/math/state_archive.hpp"

namespace mpm {

class FieldJumps {
 public:
  /// `fields` outlive this object. `growth`: length of a step of growth [cells].
  FieldJumps(const Fields& fields, double growth) : fields_(fields), growth_(growth) {}

  /// Adds the motion of a pass that updates the strain over `dt` [s] to the openings of those `nodes` that lie near
  /// `tips`, and forgets other nodes.
  void move(const std::vector<Vec2>& tips, const std::vector<DividedNode>& nodes, double dt);
  /// Notes that a crack has grown along `line` [m], in its order.
  void add(int crack, std::vector<Vec2> line) { growths_.push_back({crack, std::move(line)}); }
  /// Forgets growth, which a step has felt.
  void forget_growth() { growths_.clear(); }
  bool any() const { return !growths_.empty(); }

  struct Jump {
    int code = 0;            ///< the same for all that jump alike at a node; 0: none; less than kCodes
    Vec2 by = Vec2::Zero();  ///< [m]
  };
  static constexpr int kCodes = 17;
  /// Finds the jump of a pair of a particle that heeds the cracks `heeded` (one mark each) and a node of the group
  /// whose field 0 is `first`, with these cracks between them now.
  Jump find(int first, const Vec2& particle, const Vec2& node, const CracksBetween& now,
            const std::vector<std::uint8_t>& heeded) const;

  void serialise(StateArchive& archive);

 private:
  struct Growth {
    int crack = 0;
    std::vector<Vec2> line;
  };
  /// A node, what its fields hold, and how far they have moved away from its field 0.
  struct Opened : FieldLabels {
    int first = 0;
    Vec2 place = Vec2::Zero();
    std::array<bool, kFields> known{};
    std::array<Vec2, kFields> opening{};  ///< [m]
  };
  const Opened* find_opened(int first, const Vec2& place) const;

  const Fields& fields_;
  double growth_;
  std::vector<Growth> growths_;
  std::vector<Opened> opened_, next_;
};

}  // namespace mpm
