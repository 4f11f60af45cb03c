// A physics beside the mechanics that has a say in which blocks of material sleep (sleep/sleep.hpp), because it acts on
// material at rest: it keeps blocks awake, adds its forces to those that a block remembers, and is told of those that
// fall asleep and wake. Modules give themselves to sleep through RunParts::rest_partners.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mpm/grid/nodal_fields.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/step/block_probe.hpp"
#include "mpm/step/step_context.hpp"

namespace mpm {

/// A block of a velocity field that is at rest, awake or asleep.
struct RestingBlock {
  int field = 0;
  std::uint64_t key = 0;
  std::array<int, 3> block{};
  int owner = -1;       ///< number in its field, of a block whose particles are sorted; negative: it is asleep
  int first_owner = 0;  ///< number of its field's first, among the owners of all
  const std::vector<std::vector<std::uint32_t>>* asleep = nullptr;  ///< places of its particles in each set, if asleep

  /// visit(set, particle)
  template <class Visit>
  void each(const std::vector<ParticleSet>& sets, Visit&& visit) const {
    for (std::size_t s = 0; s < sets.size(); ++s) {
      if (asleep != nullptr) {
        for (const std::uint32_t p : (*asleep)[s]) visit(s, static_cast<int>(p));
        continue;
      }
      const int at = first_owner + owner;
      for (std::uint32_t p = sets[s].begin[at]; p < sets[s].begin[at + 1]; ++p) visit(s, static_cast<int>(p));
    }
  }
};

/// Times between which a block is asked about.
struct RestTimes {
  double before = 0.0;  ///< it fell asleep; of one that is awake, it has been at rest since then at least [s]
  double now = 0.0;     ///< [s]
  double ahead = 0.0;   ///< nobody asks again before [s]
  double part = 0.0;    ///< part of itself and the block's weight by which a load may have changed since `before`
};

/// Adds to a block's forces those on the 3^dim blocks around it (ScalarTransfer::spread_of_block()), of as many
/// components as there are axes, or of one, along grid axis `axis` [N].
inline void add_around(const NodalField& around, BlockForces& to, int axis = 0) {
  int dim = 1;
  while (nodes_of_block(dim) < around.nodes_per_block()) ++dim;
  each_tile_node(dim, [&](int t, int block, int node) {
    for (int k = 0; k < around.components(); ++k)
      to.force[axis + k][t] += static_cast<float>(around.at(block, k, node));
  });
}

class RestPartner {
 public:
  virtual ~RestPartner() = default;
  /// True if a block has to be awake.
  virtual bool stirs(const RestingBlock& block, const RestTimes& times) = 0;
  /// True if a block asleep that stirs has to wake after this very step.
  virtual bool at_once() const { return true; }
  /// True if the blocks that it stirs change when it has asked for a sort, as those near a crack that grows do: it is
  /// asked of blocks asleep after every sort then, too, and not at looks alone.
  virtual bool moves_with_sorts() const { return false; }
  /// Adds to `forces` those that a block which is to fall asleep has from this on the nodes of its tile.
  virtual void add_forces(const RestingBlock& /*block*/, BlockForces& /*forces*/) {}
  /// True if this has forces to add.
  virtual bool has_forces() const { return false; }
  /// Finds the forces of this step, which a device takes (step/device.hpp), from particles and masses of nodes as they
  /// are at its start. Books nothing.
  virtual void find_forces(const StepContext&) {}
  /// True if this holds a node of a field along some direction, with a force that is not known.
  virtual bool holds(int /*field*/, const Grid& /*grid*/, NodeRef /*node*/) const { return false; }
  /// A block falls asleep, whose particles are sorted.
  virtual void falls_asleep(const RestingBlock& /*block*/) {}
  /// A block wakes, or is taken away; its particles lie where they have lain asleep.
  virtual void wakes(const RestingBlock& /*block*/) {}
};

}  // namespace mpm
