// Contact with rigid bodies in the steps of a device. It acts on the host (mpm/step/device.hpp): the blocks of nodes
// near bodies, and the particles in them, are copied to the host's grid and sets, and the nodes' velocities back, at
// each of the hooks at which the solver's stages of contact act. So tools, free bodies and robots are the solver's own.
//
// Weak: a step waits for the host at each of these hooks. Which blocks are near is found anew after each sort, and
// looked at in every step, in a time that grows with the number of all blocks. Of what is near all particles are
// copied, though few of them touch.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm/step/device.hpp"
#include "mpm_gpu/near_copies.hpp"
#include "mpm_gpu/stage.hpp"

namespace mpm_gpu {

template <class T>
class NearBodies final : public Stage<T> {
 public:
  /// `contact` outlives this object.
  NearBodies(mpm::HostContact& contact, const GridView& grid);

  void begin_step(Executor& run, Step<T>& step, double start, long sorts) override;
  void act(mpm::Hook hook, Executor& run, const Step<T>& step) override;

 private:
  mpm::Grid& grid() { return *contact_.fields().front(); }
  /// Blocks of the table that are near bodies, in their order.
  void choose();
  /// Lets the host's sets and blocks be those of the chosen blocks.
  void take(Executor& run, const Step<T>& step);
  /// Groups of particles, a node each, as sorts make them. Returns the keys of the blocks that hold particles.
  std::vector<std::uint64_t> fill_groups(int sets, std::vector<std::uint32_t>& particles,
                                         std::vector<std::uint32_t>& of_block);
  void find_velocities();
  void download_particles(Executor& run, const Step<T>& step);

  mpm::HostContact& contact_;
  const mpm::GridLayout layout_;
  GridView grid_view_;
  bool rubs_;      ///< true if a wall is frictional
  double radius_;  ///< radius of the ball around a block that holds its particles and what they reach [m]
  NearCopies<T> copies_;
  long sorts_ = -1;
  std::uint64_t generation_ = 0;     ///< generation of the host's blocks as they were made here
  std::vector<std::uint64_t> keys_;  ///< keys of all blocks of the table
  std::vector<std::int32_t> chosen_, found_;
  std::vector<std::uint32_t> ranges_, particles_, ids_, of_block_;
  std::vector<std::int32_t> blocks_;  ///< numbers in the table of the host's blocks
  std::vector<double> numbers_;
};

}  // namespace mpm_gpu
