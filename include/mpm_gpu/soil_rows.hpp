// Rows of contact of an implicit step on a device: found on the host, solved there block by block, a thread a block,
// and those of free bodies on the host, with the nodes around them. Weak: impulses go to the host after each sweep,
// which looks whether the force on tools has settled; rows of one block are solved one after another.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mpm/implicit/tool_rows.hpp"
#include "mpm/implicit/wall_rows.hpp"
#include "mpm_gpu/soil_map.hpp"

namespace mpm_gpu {

template <class T>
class SoilRows {
 public:
  using Node = mpm_kernel::SoilNode<T>;

  /// All outlive this object.
  SoilRows(mpm::ToolRows<T>& tools, mpm::WallRows<T>& walls, const SoilPassTable<T>& passes, int dim)
      : tools_(tools), walls_(walls), passes_(passes), colours_(1 << dim) {}

  void make_room(long nodes, int dim) { ranges_.fit(4 * (nodes / nodes_of_block(dim))); }
  /// Takes the rows as they are on the host.
  void take(const SoilMap<T>& map, const mpm::SoilGrid& grid);
  /// Solves each contact once, and brings the rows of tools on the host up to date.
  void meet(Executor& run, const SoilView<T>& soil);
  void go_on(Executor& run, T factor);
  /// Brings the rows of walls on the host up to date.
  void end_sweeps(Executor& run);
  /// Copies the nodes of the rows of free bodies to their places among the host's, and back.
  void show(Executor& run, const SoilView<T>& soil, std::vector<Node>& nodes);
  void take_back(Executor& run, const SoilView<T>& soil, const std::vector<Node>& nodes);
  std::size_t bytes() const;

 private:
  RowsView<T> view(long first = 0) { return {row_.data(), wall_.data(), ranges_.data() + 4 * first}; }
  /// Copies the impulses of so many rows of tools, or of walls, to impulses_.
  void download(Executor& run, long tools, long walls);

  mpm::ToolRows<T>& tools_;
  mpm::WallRows<T>& walls_;
  const SoilPassTable<T>& passes_;
  int colours_;
  std::array<long, 9> begin_{};  ///< places where the blocks of each colour that have rows begin in ranges_
  std::vector<mpm_kernel::ContactRow<T>> tools_here_;
  std::vector<mpm_kernel::WallRow<T>> walls_here_;
  std::vector<std::int32_t> list_, free_;
  std::vector<int> free_here_;
  std::vector<T> impulses_;
  std::vector<Node> shown_;
  Buffer<mpm_kernel::ContactRow<T>> row_;
  Buffer<mpm_kernel::WallRow<T>> wall_;
  Buffer<std::int32_t> ranges_, free_there_;
  Buffer<T> impulse_room_;
  Buffer<Node> node_room_;
};

}  // namespace mpm_gpu
