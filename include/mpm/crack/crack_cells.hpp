// Sides of cracks in the cells that they cut, so that what is averaged over a cell is averaged on each side alone.
//
// A crack divides a cell if its line passes through it and has no end there: then the way from any place in the cell to
// the cell's first node crosses it or not, and that is the side. A cell in which a crack ends is one, since material
// beyond the tip joins both sides; an exterior end is no such end (Chain::line()).
//
// A thin tool divides a cell if no two corners on its two sides see each other (crack/tool_cuts.hpp).
//
// Weak: of the cracks and tools that a body heeds, two divide a cell, cracks first, and of each kind those that the
// scene names first. A crack that ends on another one within a cell does not divide it there.
#pragma once

#include <array>
#include <vector>

#include "mpm/crack/crack_fields.hpp"
#include "mpm/crack/line_part.hpp"
#include "mpm/grid/grid_layout.hpp"
#include "mpm/mechanics/cell_parts.hpp"

namespace mpm {

class CrackCells final : public CellParts {
 public:
  static constexpr int kMostCracks = 2;  ///< that divide one cell

  /// All outlive this object.
  CrackCells(const std::vector<Crack>& cracks, const ToolCuts& cuts, const std::vector<ParticleSet>& sets,
             const GridLayout& layout)
      : cracks_(cracks), tools_(cuts), sets_(sets), layout_(layout) {}

  int most() const override { return cracks_.size() + tools_.count() == 1 ? 2 : 1 << kMostCracks; }
  void look_at(const std::array<int, 3>& block) override;
  int part_of(const ParticleSet& set, const std::array<int, 3>& cell, const Vec2& place) const override;

 private:
  static constexpr int kEdge = kBlockEdge + 1;  ///< cells along an edge in which particles of a block lie
  /// Part of a crack in a cell that it divides, or a tool, by its number.
  struct Cut {
    int crack;
    LinePart part;
  };
  Vec2 corner(const std::array<int, 3>& cell) const;

  const std::vector<Crack>& cracks_;
  const ToolCuts& tools_;
  const std::vector<ParticleSet>& sets_;
  const GridLayout& layout_;
  std::array<int, 3> block_{};
  std::vector<LinePart> near_;                    ///< part of each crack in the block
  std::vector<Cut> cuts_;                         ///< cell by cell
  std::array<int, kEdge * kEdge + 1> of_cell_{};  ///< first in `cuts_` of each cell, the last axis fastest
};

}  // namespace mpm
