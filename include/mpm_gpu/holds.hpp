// State of the nodes of walls in the last step, which decides how they hold them for the strain of the next
// (step/coulomb.hpp) and what they take there (step/surface_loss.hpp): bits of walls.hpp for each node, taken along
// when the table of blocks is found anew, and to checkpoints and back.
#pragma once

#include <cstddef>
#include <vector>

#include "mpm_gpu/executor.hpp"
#include "mpm_gpu/views.hpp"

namespace mpm_gpu {

class WallHolds {
 public:
  /// `kept`: false where no step needs it; nothing is kept then.
  WallHolds(int dim, bool kept) : kept_(kept), per_block_(nodes_of_block(dim)) {}

  /// Makes room for so many nodes, and keeps what is there. Between steps only.
  void make_room(Executor& run, long nodes);
  /// After a sort: lays the bits as the blocks lie now; a block that was not there held nothing. `stay`: data() does.
  void carry(Executor& run, const NodeView& now, bool stay);
  /// Bits of each node; null if none are kept.
  std::uint16_t* data() { return hold_.data(); }
  std::size_t bytes() const { return hold_.bytes() + other_.bytes() + key_.bytes() + other_key_.bytes(); }

  /// Bits of all blocks, on the host.
  struct OfBlocks {
    std::vector<std::uint64_t> keys;  ///< keys of blocks, ascending
    std::vector<std::uint16_t> bits;  ///< [block][node]
  };
  OfBlocks download() const;
  /// Goes on from these, in place of what is kept. Between steps only.
  void upload(const OfBlocks& blocks);

 private:
  bool kept_;
  long per_block_, blocks_ = 0;
  Buffer<std::uint16_t> hold_, other_;
  Buffer<std::uint64_t> key_, other_key_;  ///< keys of the blocks that the numbers are of
};

}  // namespace mpm_gpu
