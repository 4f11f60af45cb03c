// Thin tools in bodies that cracks divide, which a tool divides as a crack does: at every node a particle has another
// velocity field where the tool lies on the way to it (crack/crack_fields.hpp), so that beyond the tool's edge the two
// sides share nodes. The way crosses the tool if it meets it and its ends lie on the two sides of its middle
// (contact/thin_tool.hpp). A node in the tool stands for the place before the face nearest to it, so that material that
// is one body under the end of a blade is one body at the nodes that the end has just reached.
//
// The other bodies that a thin tool divides have a field for each side (contact/tool_sides.hpp). Nothing acts between
// the two sides: contact with the tool acts on each. Tools are numbered on from the cracks.
// Weak: a particle that is pressed past the middle of the tool changes sides. Where cracked material and a body that no
// crack divides share one field, they are one body across the tool; a law of contact gives each its own.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm/contact/thin_tool.hpp"
#include "mpm/crack/divided_node.hpp"
#include "mpm/crack/near_blocks.hpp"

namespace mpm {

class ToolCuts {
 public:
  /// A tool and the bodies that it divides in this way.
  struct Cut {
    const ThinTool* tool;
    std::vector<std::uint8_t> divides;  ///< for each set, 1 if it does
  };
  /// No tool.
  ToolCuts() = default;
  /// Tools outlive this object. `cracks`: number of the first tool.
  ToolCuts(std::vector<Cut> cuts, int cracks) : cuts_(std::move(cuts)), cracks_(cracks) {}

  int count() const { return static_cast<int>(cuts_.size()); }
  bool divides(int cut, std::size_t set) const { return cuts_[cut].divides[set] != 0; }
  /// True if a tool may meet the box with these corners [m].
  bool meet(const Vec2& low, const Vec2& high) const;
  /// Adds the tools that lie between two places [m]. Returns false if there are more than fit. `divides(cut)`: whether
  /// the tool divides the material at hand.
  template <class Divides>
  bool add_between(const Vec2& from, const Vec2& to, Divides&& divides, CracksBetween& between) const {
    for (int cut = 0; cut < count(); ++cut) {
      if (!divides(cut) || !crosses(cut, from, to)) continue;
      if (between.count == 2) return false;
      between.across[between.count++] = {cracks_ + cut, above(cut, from)};
    }
    return true;
  }
  /// On which side of the tool a place is.
  bool above(int cut, const Vec2& place) const;
  /// True if the tool parts the box with these corners [m]: none sees one that lies on the other side.
  bool parts(int cut, const Vec2& low, const Vec2& high) const;
  /// visit(block) for every block with a tool within `margin` [cells] of its tile.
  template <class Visit>
  void each_near_block(const GridLayout& layout, double margin, Visit&& visit) const {
    for (const Cut& cut : cuts_) {
      const Box bounds = cut.tool->body().world_bounds();
      const Vec2 low(bounds.min.x(), bounds.min.z()), high(bounds.max.x(), bounds.max.z());
      each_block_near(layout, low, high, margin, [&](const std::array<int, 3>& block) {
        Vec2 middle, half;
        for (int k = 0; k < 2; ++k) {
          middle[k] = layout.origin(k) + layout.cell(k) * (kBlockEdge * block[k] + 0.5 * (kBlockEdge - 1));
          half[k] = layout.cell(k) * (0.5 * (NodeChoice::kEdge - 1) + margin);
        }
        if (within(cut, middle, half.norm())) visit(block);
      });
    }
  }

 private:
  static bool within(const Cut& cut, const Vec2& middle, double radius);
  bool crosses(int cut, const Vec2& from, const Vec2& to) const;

  std::vector<Cut> cuts_;
  int cracks_ = 0;
};

}  // namespace mpm
