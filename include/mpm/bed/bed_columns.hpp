// Columns of the grid's blocks: one block wide along x and y, as high as the grid. Ground comes and goes by columns.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "mpm/bed/bed_definition.hpp"
#include "mpm/grid/grid_layout.hpp"
#include "mpm/math/geometry.hpp"

namespace mpm {

class BedColumns {
 public:
  /// One flag for each column.
  using Flags = std::vector<std::uint8_t>;

  /// Columns of a grid with z as its last axis; `layout` outlives it.
  explicit BedColumns(const GridLayout& layout);

  int count() const { return counts_[0] * counts_[1]; }
  double width() const { return kBlockEdge * layout_->largest_cell(); }  ///< [m]
  /// The column of a block; of one beyond the grid's faces that at the face.
  int of_block(const std::array<int, 3>& block) const;
  /// The column of the block that a particle at this place belongs to.
  int of_point(const Vec3& place) const;
  /// Number from 0 to below kNodes of the particle's nearest node among those of its column.
  int node_of(const Vec3& place) const;
  static constexpr int kNodes = kBlockEdge * kBlockEdge;
  /// True of a place in the grid along x and y.
  bool holds(const Vec3& place) const;
  /// Place of a column along x and y, without bounds along z [m].
  Box bounds(int column) const;
  /// The same of the area of one of its nodes.
  Box bounds_of_node(int column, int node) const;
  /// Sets the flags of columns that are nearer to a point than `within` [m].
  void mark_near(const Vec3& point, double within, Flags& flags) const;
  /// Sets the flags of columns that overlap a box along x and y.
  void mark_in(const Box& box, Flags& flags) const;
  /// Calls visit(neighbour) for the columns around one.
  template <class Visit>
  void each_beside(int column, Visit&& visit) const {
    const int x = column / counts_[1], y = column % counts_[1];
    for (int i = std::max(0, x - 1); i <= std::min(counts_[0] - 1, x + 1); ++i) {
      for (int j = std::max(0, y - 1); j <= std::min(counts_[1] - 1, y + 1); ++j) {
        if (i != x || j != y) visit(i * counts_[1] + j);
      }
    }
  }
  /// The flagged columns and those beside them.
  Flags grown(const Flags& flags) const;

 private:
  bool is_flat() const { return layout_->dim() == 2; }
  int nearest(int k, const Vec3& place) const {
    return GridLayout::nearest(layout_->in_cells(k, place[layout_->axis(k)]));
  }
  /// Numbers of columns along x or y, as far as they overlap the bounds.
  std::array<int, 2> range(int k, double low, double high) const;

  const GridLayout* layout_;
  std::array<int, 2> counts_{1, 1};  ///< along x and y
};

/// The columns that have ground when bodies that it follows are at these places: those that reach within the distance,
/// and one more around them, whose ground stays asleep and carries the others.
BedColumns::Flags columns_with_ground(const BedColumns& columns, const std::vector<Vec3>& places, double within);

/// Adds the particles of a column as the source has them.
void add_column(const BedColumns& columns, int column, const GroundSource& source, GroundParticles& ground);

}  // namespace mpm
