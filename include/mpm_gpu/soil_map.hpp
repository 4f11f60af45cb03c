// Blocks and nodes of the table as the host's grid of an implicit step numbers them, and what the device needs of that
// grid: who holds which nodes, which blocks share no node, and which nodes sleep holds. Found anew after each sort.
// Weak: on the host, in a time that grows with the number of all blocks.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mpm/implicit/soil_grid.hpp"
#include "mpm/step/device.hpp"
#include "mpm_gpu/near_copies.hpp"
#include "mpm_gpu/soil_passes.hpp"

namespace mpm_gpu {

template <class T>
class SoilMap {
 public:
  explicit SoilMap(const mpm::GridLayout& layout) : layout_(layout), copies_(layout.dim(), false) {}

  void make_room(long nodes);
  /// Lets a grid of the host have the blocks of the table, and the nodes at rest of `rest`, which may be null.
  void take_blocks(Executor& run, const Step<T>& step, const SoilPassTable<T>& passes, mpm::Grid& grid,
                   mpm::HostRest* rest);
  /// Takes over what was found of that grid since.
  void take_grid(const mpm::SoilGrid& grid);

  /// Number in the table of a node of the host's grid; none() where that has none.
  std::int32_t node(int number) const {
    return number < static_cast<int>(nodes_.size()) ? nodes_[static_cast<std::size_t>(number)] : none_;
  }
  std::int32_t none() const { return none_; }
  /// Numbers of all nodes, by those of the host: how many, and where kernels read them.
  long count() const { return static_cast<long>(nodes_.size()); }
  const std::int32_t* all() const { return nodes_there_.data(); }
  /// Numbers in the table of the host's blocks.
  const std::vector<std::int32_t>& blocks() const { return blocks_; }
  /// Blocks of a colour, for kernels.
  const std::int32_t* blocks_of(int colour) const { return order_.data() + begin_[static_cast<std::size_t>(colour)]; }
  long count_of(int colour) const {
    return begin_[static_cast<std::size_t>(colour) + 1] - begin_[static_cast<std::size_t>(colour)];
  }
  /// [node][world axis]
  const std::uint8_t* holders() const { return holder_.data(); }
  /// Numbers of the nodes at rest, in the order of Grid::at_rest.
  long at_rest() const { return static_cast<long>(at_rest_.size()); }
  const std::int32_t* at_rest_there() const { return at_rest_there_.data(); }
  std::size_t bytes() const;

 private:
  void take_rest(mpm::Grid& grid, mpm::HostRest* rest);

  const mpm::GridLayout layout_;
  NearCopies<T> copies_;
  long table_ = 0;  ///< number of nodes in the table
  std::int32_t none_ = 0;
  std::vector<std::uint64_t> keys_, owners_;
  std::vector<std::uint8_t> bytes_;
  std::vector<std::int32_t> nodes_, blocks_, list_, at_rest_;
  std::array<long, 9> begin_{};  ///< places where the blocks of each colour begin in order_
  Buffer<std::uint8_t> holder_, flag_;
  Buffer<std::int32_t> nodes_there_, order_, at_rest_there_;
};

}  // namespace mpm_gpu
