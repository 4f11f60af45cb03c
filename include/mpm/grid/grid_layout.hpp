// Places of the nodes of the background grid, and their grouping into blocks of 4 nodes along each axis.
//
// Nodes are numbered by integers along each axis, with node 0 on the domain's lower corner. A planar grid has two axes,
// the world's x and z; a line has one, x. A particle belongs to the block of its nearest node. A block's key is its
// position in the box of all blocks that the domain could need; memory follows the blocks in use and not that box.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "mpm/math/error.hpp"
#include "mpm/math/geometry.hpp"

namespace mpm {

/// Thrown for a grid that cannot be laid out.
class GridError : public Error {
 public:
  using Error::Error;
};

inline constexpr int kBlockEdge = 4;  ///< nodes of a block along an axis
/// Nodes of a block of a grid with `dim` axes.
constexpr int nodes_of_block(int dim) { return dim == 1 ? kBlockEdge : kBlockEdge * nodes_of_block(dim - 1); }

/// Blocks around one, itself among them.
constexpr int neighbours_of(int dim) { return dim == 3 ? 27 : dim == 2 ? 9 : 3; }
/// One of them by its number, the last axis fastest; the block itself is in the middle.
inline std::array<int, 3> neighbour_of(std::array<int, 3> block, int number, int dim) {
  for (int k = dim - 1; k >= 0; --k, number /= 3) block[k] += number % 3 - 1;
  return block;
}

class GridLayout {
 public:
  /// `dim` 1 (x), 2 (x, z) or 3; cell sizes [m] > 0. @throws GridError
  GridLayout(int dim, const Vec3& cell, const Vec3& min, const Vec3& max);

  int dim() const { return dim_; }
  int nodes_per_block() const { return nodes_of_block(dim_); }
  /// World axis of grid axis k.
  int axis(int k) const { return dim_ == 3 ? k : 2 * k; }
  double cell(int k) const { return cell_[k]; }
  double inverse_cell(int k) const { return inverse_cell_[k]; }
  double origin(int k) const { return origin_[k]; }
  double smallest_cell() const;
  double largest_cell() const;
  /// Last node along axis k that lies in the domain; the domain is a whole number of cells.
  int last_node(int k) const { return last_node_[k]; }

  /// World position [m] in cells: node i lies at i.
  double in_cells(int k, double position) const { return (position - origin_[k]) * inverse_cell_[k]; }
  /// Nearest node of a position in cells, for cells > -64. It truncates, since floor is a function call on plain
  /// x86-64.
  static int nearest(double cells) { return static_cast<int>(cells + (64.5 + kTie)) - 64; }
  /// Half way between two nodes the upper one is the nearest, whatever the round-off [cells].
  static constexpr double kTie = 1e-12;

  /// Along a periodic axis the blocks wrap around: the one before the first is the last.
  std::uint64_t key(const std::array<int, 3>& block) const;
  std::array<int, 3> block(std::uint64_t key) const;
  std::int64_t key_stride(int k) const { return stride_[k]; }
  /// One more than the largest key.
  std::uint64_t keys() const { return static_cast<std::uint64_t>(stride_[0]) * static_cast<std::uint64_t>(blocks_[0]); }

  /// Makes axis k periodic: the nodes of its two faces become one. Call it before any block is made. @throws GridError
  /// unless the number of cells is a multiple of 8: the axis must consist of whole blocks, and of an even number of
  /// them, so that neighbours have different colours.
  void make_periodic(int k);
  bool periodic(int k) const { return periodic_blocks_[k] > 0; }
  bool any_periodic() const { return periodic_blocks_[0] + periodic_blocks_[1] + periodic_blocks_[2] > 0; }

  /// World position of a node of a block; 0 along axes that the grid does not have.
  Vec3 node_position(const std::array<int, 3>& block, int local) const;
  /// Number of a block's node along each axis.
  std::array<int, 3> node(const std::array<int, 3>& block, int local) const;

 private:
  int dim_;
  std::array<double, 3> cell_{}, inverse_cell_{}, origin_{};
  std::array<int, 3> last_node_{}, blocks_{};
  std::array<int, 3> periodic_blocks_{};  ///< number of blocks along a periodic axis, 0 along others
  std::array<std::int64_t, 3> stride_{};
};

}  // namespace mpm
