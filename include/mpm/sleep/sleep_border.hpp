// The nodes between material that is awake and blocks that are asleep. What is asleep does not move, so they are held
// at rest. By how much the force of both sides and their weight fail to balance there, and how fast the material awake
// comes in, says which blocks have to wake.
//
// A force without balance is told as the speed of a plane wave that would bring it: |f| / (m c / h), with m c / h the
// wave's impedance over the area of a node [m/s].
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mpm/grid/fields.hpp"
#include "mpm/sleep/sleeping_blocks.hpp"
#include "mpm/step/step_context.hpp"

namespace mpm {

class SleepBorder {
 public:
  struct Node {
    NodeRef ref;
    double mass = 0.0;          ///< of what is asleep [kg]
    Vec3 force = Vec3::Zero();  ///< internal, of what is asleep [N]
    double rate = 0.0;          ///< by which a wave would cross a cell [1/s]
    bool at_wall = false;       ///< a wall holds it too, with a force that is not known here
    int first = 0, count = 0;   ///< of sleepers()
  };

  /// Of a velocity field, as particles are sorted now.
  void find(int field, const Grid& grid, const SleepingBlocks& asleep);
  const std::vector<Node>& nodes() const { return nodes_; }
  /// The blocks that reach a node.
  const SleepingBlock& sleeper(const Node& node, int i) const { return *sleepers_[node.first + i]; }
  /// What fails to balance at a node, once the forces are gathered, or the speed of what comes in: the larger [m/s].
  static double unrest(const Node& node, const Grid& grid, const Vec3& gravity);

 private:
  /// What one block in use is given by what sleeps around it.
  struct Given {
    std::vector<double> mass;
    std::vector<Vec3> force;
  };
  void add_block(int block, const Grid& grid, const std::vector<const SleepingBlock*>& around);

  std::vector<Node> nodes_;
  std::vector<const SleepingBlock*> sleepers_, around_;
};

}  // namespace mpm
