#include "mpm/grid/grid_layout.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <limits>

namespace mpm {

GridLayout::GridLayout(int dim, const Vec3& cell, const Vec3& min, const Vec3& max) : dim_(dim) {
  std::int64_t stride = 1;
  for (int k = dim - 1; k >= 0; --k) {
    const int a = axis(k);
    if (!(cell[a] > 0.0) || !std::isfinite(cell[a])) {
      throw GridError(fmt::format("grid: cell size {} along {} must be positive", cell[a], "xyz"[a]));
    }
    const double cells = (max[a] - min[a]) / cell[a];
    if (!(cells >= 1.0 - 1e-9) || !(cells < 1e9)) {
      throw GridError(fmt::format("grid: the domain from {} to {} along {} must hold at least one cell of {}", min[a],
                                  max[a], "xyz"[a], cell[a]));
    }
    cell_[k] = cell[a];
    inverse_cell_[k] = 1.0 / cell[a];
    origin_[k] = min[a];
    last_node_[k] = static_cast<int>(std::ceil(cells - 1e-9));
    // One block more on each side, for the halo of a particle on the border, whose nearest node may be one node
    // outside.
    blocks_[k] = (last_node_[k] + 1) / kBlockEdge + 3;
    stride_[k] = stride;
    if (stride > std::numeric_limits<std::int64_t>::max() / (64 * static_cast<std::int64_t>(blocks_[k]))) {
      throw GridError("grid: the domain holds more cells than can be numbered; use a coarser cell or a smaller domain");
    }
    stride *= blocks_[k];
  }
}

double GridLayout::smallest_cell() const { return *std::min_element(cell_.begin(), cell_.begin() + dim_); }

double GridLayout::largest_cell() const { return *std::max_element(cell_.begin(), cell_.begin() + dim_); }

void GridLayout::make_periodic(int k) {
  constexpr int kMultiple = 2 * kBlockEdge;
  const int cells = last_node_[k];
  if (cells % kMultiple != 0) {
    const int below = cells / kMultiple * kMultiple;
    throw GridError(
        fmt::format("grid: {} cells along {}, which is periodic; their number must be a multiple of {}: {}{}", cells,
                    "xyz"[axis(k)], kMultiple, below > 0 ? fmt::format("{} or ", below) : "", below + kMultiple));
  }
  periodic_blocks_[k] = cells / kBlockEdge;
}

std::uint64_t GridLayout::key(const std::array<int, 3>& block) const {
  std::int64_t key = 0;
  for (int k = 0; k < dim_; ++k) {
    const int b = periodic_blocks_[k] > 0 ? (block[k] + periodic_blocks_[k]) % periodic_blocks_[k] : block[k];
    key += (b + 1) * stride_[k];
  }
  return static_cast<std::uint64_t>(key);
}

std::array<int, 3> GridLayout::block(std::uint64_t key) const {
  std::array<int, 3> block{};
  std::int64_t rest = static_cast<std::int64_t>(key);
  for (int k = 0; k < dim_; ++k) {
    block[k] = static_cast<int>(rest / stride_[k]) - 1;
    rest %= stride_[k];
  }
  return block;
}

std::array<int, 3> GridLayout::node(const std::array<int, 3>& block, int local) const {
  std::array<int, 3> node{};
  for (int k = dim_ - 1; k >= 0; --k) {
    node[k] = block[k] * kBlockEdge + local % kBlockEdge;
    local /= kBlockEdge;
  }
  return node;
}

Vec3 GridLayout::node_position(const std::array<int, 3>& block, int local) const {
  const std::array<int, 3> n = node(block, local);
  Vec3 position = Vec3::Zero();
  for (int k = 0; k < dim_; ++k) position[axis(k)] = origin_[k] + n[k] * cell_[k];
  return position;
}

}  // namespace mpm
