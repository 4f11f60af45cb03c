// State of the nodes of frictional walls, free, sliding or sticking, in the step before, which decides how they are
// held for the strain (step/coulomb.hpp): a number for each face and node, taken along when the table of blocks is
// found anew.
#pragma once

#include <cstddef>

#include "mpm_gpu/executor.hpp"
#include "mpm_gpu/views.hpp"

namespace mpm_gpu {

class WallHolds {
 public:
  /// `faces`: 2 * dim, or 0 where no wall is frictional; nothing is kept then.
  WallHolds(int dim, int faces) : faces_(faces), per_block_(nodes_of_block(dim)) {}

  /// Makes room for so many nodes, and keeps what is there. Between steps only.
  void make_room(Executor& run, long nodes);
  /// After a sort: lays the numbers as the blocks lie now; a block that was not there held nothing.
  void carry(Executor& run, const NodeView& now);
  /// [face][node] of Hold.
  std::uint8_t* data() { return hold_.data(); }
  std::size_t bytes() const { return hold_.bytes() + other_.bytes() + key_.bytes() + other_key_.bytes(); }

 private:
  int faces_;
  long per_block_, blocks_ = 0;
  Buffer<std::uint8_t> hold_, other_;
  Buffer<std::uint64_t> key_, other_key_;  ///< keys of the blocks that the numbers are of
};

}  // namespace mpm_gpu
