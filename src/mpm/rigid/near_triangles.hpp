// For each cell of a grid around a mesh, the triangles that can be nearest to a point of the cell: a distance then asks
// a few triangles instead of a tree. Contact asks for the same surroundings of a tool in every step.
//
// A cell is filled when a point in it is asked for first, by one thread, while others go to the tree. The triangle
// found is the same to the bit, so it does not matter which thread came first. That a whole cell is outside is taken
// from its middle, which holds for meshes whose sign changes at the surface alone.
//
// A triangle t is left out if for some point q of the surface all points p of the cell have d(p, t) > |p - q|. Since
// |p - y|^2 - |p - q|^2 is linear in p for every y in t, it is enough to look at the cell's corners. Weak: where more
// than Cell::kMost triangles remain, as near the middle of a sphere or in a cell much larger than triangles, the tree
// is asked.
// A mesh of 256 triangles or more takes 4 MB for the cells.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

#include "triangle_tree.hpp"

namespace mpm {

class NearTriangles {
 public:
  /// True if a point is inside, from what is nearest to it.
  using Inside = std::function<bool(const Vec3& point, const Nearest& nearest)>;

  /// `tree` and its triangles must outlive this object. `bounds`: of the mesh [m].
  NearTriangles(const TriangleTree& tree, const std::vector<Triangle>& triangles, const Box& bounds, Inside inside);
  /// Finds what nearest_of() finds among all triangles, to the bit. False, with no answer, if the point is known to be
  /// outside and farther away than `band` [m].
  bool nearest(const Vec3& point, double band, Nearest& best) const;

 private:
  struct alignas(64) Cell {
    static constexpr int kMost = 12;
    enum State : std::uint8_t { empty, being_filled, filled };
    std::atomic<std::uint8_t> state{empty};
    std::uint8_t count = 0;  ///< 0: there are too many
    float clear = -1.0F;  ///< all its points are outside and farther away than this [m]; negative where that is not so
    std::array<std::int32_t, kMost> triangles{};
  };

  /// The cell of a point after it was filled; null outside the grid, and while another thread fills it.
  const Cell* cell(const Vec3& point) const;
  void fill(Cell& cell, const Vec3& middle) const;

  const TriangleTree& tree_;
  const std::vector<Triangle>& triangles_;
  Inside inside_;
  Vec3 low_, per_metre_;
  Vec3 half_;  ///< half the edges of a cell [m]
  std::array<int, 3> count_{};
  mutable std::vector<Cell> cells_;
};

}  // namespace mpm
