// Where the nodes of the background grid are, and how they are grouped into blocks of 4 nodes along each axis.
//
// Nodes are numbered by integers along each axis, node 0 on the domain's lower corner. A planar grid has two axes, the
// world's x and z; a line has one, x. A particle belongs to the block of its nearest node; a block is named by a key,
// its position in the box of all blocks that the domain could need, so memory follows the blocks in use and never that
// box.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "mpm/math/error.hpp"
#include "mpm/math/geometry.hpp"

namespace mpm {

/// A grid that cannot be laid out.
class GridError : public Error {
 public:
  using Error::Error;
};

inline constexpr int kBlockEdge = 4;  ///< nodes of a block along an axis
/// Nodes of a block of a grid with `dim` axes.
constexpr int nodes_of_block(int dim) { return dim == 1 ? kBlockEdge : kBlockEdge * nodes_of_block(dim - 1); }

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
  /// Last node along axis k that lies in the domain; the domain is a whole number of cells.
  int last_node(int k) const { return last_node_[k]; }

  /// Position in cells: node i lies at i.
  double in_cells(int k, double position) const { return (position - origin_[k]) * inverse_cell_[k]; }
  /// Nearest node of a position in cells, for cells > -64 (a truncation: floor is a call on plain x86-64).
  static int nearest(double cells) { return static_cast<int>(cells + (64.5 + kTie)) - 64; }
  /// Half way between two nodes the upper one is nearest, round-off or not [cells].
  static constexpr double kTie = 1e-12;

  /// Along a periodic axis the blocks go round: the one before the first is the last.
  std::uint64_t key(const std::array<int, 3>& block) const;
  std::array<int, 3> block(std::uint64_t key) const;
  std::int64_t key_stride(int k) const { return stride_[k]; }
  /// One more than the largest key.
  std::uint64_t keys() const { return static_cast<std::uint64_t>(stride_[0]) * static_cast<std::uint64_t>(blocks_[0]); }

  /// Makes the nodes of the axis' two faces one. Before any block is made. @throws GridError unless the cells are a
  /// multiple of 8: blocks go round whole, and an even number of them, so that neighbours have different colours.
  void make_periodic(int k);
  bool periodic(int k) const { return around_[k] > 0; }
  bool any_periodic() const { return around_[0] + around_[1] + around_[2] > 0; }

  /// World position of a node of a block; 0 along axes that the grid does not have.
  Vec3 node_position(const std::array<int, 3>& block, int local) const;
  /// Node numbers along each axis.
  std::array<int, 3> node(const std::array<int, 3>& block, int local) const;

 private:
  int dim_;
  std::array<double, 3> cell_{}, inverse_cell_{}, origin_{};
  std::array<int, 3> last_node_{}, blocks_{};
  std::array<int, 3> around_{};  ///< blocks of a periodic axis; 0 of another
  std::array<std::int64_t, 3> stride_{};
};

}  // namespace mpm
