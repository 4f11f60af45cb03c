// The nodes between material that is awake and blocks that are asleep. What is asleep does not move, so they are held
// at rest. What happens there says which blocks have to wake:
// - waves, by the force that both sides and their weight leave without balance, told as the speed of the plane wave
//   that would bring it, |f| / (m c / h), with m c / h the wave's impedance over the area of a node;
// - what comes in, by its speed;
// - a load or a support that changes slowly, by the mean of that force over a time, as a part of the force that the
//   block had on the node when it fell asleep, and of the node's weight.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mpm/grid/fields.hpp"
#include "mpm/ranks/halo.hpp"
#include "mpm/sleep/sleeping_blocks.hpp"
#include "mpm/step/step_context.hpp"

namespace mpm {

class SleepBorder {
 public:
  struct Node {
    NodeRef ref;
    double mass = 0.0;          ///< mass of what is asleep [kg]
    Vec3 force = Vec3::Zero();  ///< internal, of what is asleep [N]
    double stress = 0.0;        ///< as in BlockForces, of what is asleep [J]
    double rate = 0.0;          ///< by which a wave would cross a cell [1/s]
    std::uint32_t from = 0;     ///< a bit for each block around that is asleep and reaches the node
    bool at_wall = false;       ///< a wall holds it too, with a force that is not known here
    Vec3 mean = Vec3::Zero();   ///< mean of the force without balance, over a time [N]
  };

  explicit SleepBorder(const GridLayout& layout);

  /// Finds the border of a velocity field, as particles are sorted now. `halo`: null for one process.
  void find(int field, const Grid& grid, const SleepingBlocks& asleep, const Halo* halo);
  const std::vector<Node>& nodes() const { return nodes_; }
  std::vector<Node>& nodes() { return nodes_; }
  /// Adds the names of the blocks asleep that reach a node.
  void add_names(const Node& node, const Grid& grid, std::vector<BlockName>& names) const;
  struct Unrest {
    double speed = 0.0;  ///< larger speed of a wave that would bring the force and of what comes in [m/s]
    double lost = 0.0;   ///< mean force without balance over that of the block asleep and the node's weight
  };
  /// At a node, once the forces are gathered. `part`: of the mean, that this step makes anew.
  /// `of_awake`: the internal force of what is awake [N].
  static Unrest find_unrest(Node& node, const Grid& grid, const Vec3& of_awake, const Vec3& gravity, double part);

  /// The mean of the force without balance at a node, as ranks tell each other of it.
  struct Mean {
    std::uint64_t key;  ///< key of the block
    std::int32_t field, node;
    double force[3];  ///< [N]
  };
  /// Adds those of a block of this key.
  void add_means(std::uint64_t key, std::vector<Mean>& list) const;
  /// Means of nodes that this rank has not known so far, for the next find().
  void take_means(const std::vector<Mean>& list);

  /// The means, which the next find() takes over.
  void serialise(StateArchive& archive);

 private:
  /// A node of a block in the tile of a block beside it.
  struct Shared {
    int node, of_tile;
  };

  std::uint64_t key_beside(const std::array<int, 3>& block, int side) const;
  /// Finds the nodes of a block that awake particles may give to, until they are sorted again.
  void find_reached(int block, const Grid& grid);
  void add_block(int block, const Grid& grid);
  void keep_means();
  /// Sorts what is in nodes_ and keys_; what is there twice is there once then.
  void put_in_order();

  const GridLayout* layout_;
  int field_ = 0;
  int sides_ = 0;                               ///< blocks around one, itself in the middle
  std::array<std::vector<Shared>, 27> shared_;  ///< with the block on each side
  std::vector<const SleepingBlock*> around_;    ///< on each side
  std::vector<std::uint8_t> is_awake_;          ///< for each block in use, 1 if particles in it are awake
  std::vector<std::uint8_t> reached_;           ///< marks of the nodes of a block
  std::vector<Halo::Nodes> reached_by_others_;  ///< nodes of each block in use, by particles of other ranks
  std::vector<Node> of_block_, nodes_, before_;
  std::vector<std::uint64_t> keys_, keys_before_;  ///< keys of the blocks of nodes_ and before_
};

}  // namespace mpm
