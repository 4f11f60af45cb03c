// Steps of which the host does not wait for each: whether particles are to be sorted, whether the run goes on and what
// it has failed by are numbers of the device. The host asks for them between some steps, at each look of the run at its
// particles and at each sync point. The steps themselves are one recording that is replayed (card.hpp).
#pragma once

#include "mpm_gpu/executor.hpp"
#include "mpm_gpu/faults.hpp"
#include "mpm_gpu/taken.hpp"
#include "mpm_gpu/views.hpp"

namespace mpm_gpu {

class ReplayedSteps {
 public:
  /// Record of what has happened since the last look.
  struct Numbers {
    Taken taken;                   ///< losses of particles in the whole steps, if they are counted
    std::uint32_t sorts;           ///< number of sorts
    std::uint32_t steps;           ///< number of whole steps, without the one that has failed
    std::uint32_t failure;         ///< kInverted or kOutside of a particle; kNoRoom; 0: none
    std::uint32_t id;              ///< id of that particle
    double place[3];               ///< its place along the grid's axes [m]
    std::uint32_t owners, blocks;  ///< numbers that there should be, if there is no room
  };
  static constexpr std::uint32_t kNoRoom = 0x100;

  /// Begins: the run goes on, and nothing has happened.
  void begin(Executor& run);
  /// In a recording: these do their work where particles are to be sorted, and where the run goes on.
  template <class Work>
  void where_to_sort(Executor& run, const Work& work) {
    run.when(flags_, kSorts, work);
  }
  template <class Work>
  void where_it_goes_on(Executor& run, const Work& work) {
    run.when(flags_, kGoesOn, work);
  }
  /// After a sort. `counts`, and the room for both: of the table of cells.
  void sorted(Executor& run, const std::uint32_t* counts, long owners_room, long blocks_room);
  /// After a step. `faults`, `taken`: sums over the particles, `taken` null if nothing is counted; `x`: their places.
  void stepped(Executor& run, const Faults* faults, const Taken* taken, const std::uint32_t* id,
               const std::array<const double*, 3>& x);
  /// Waits for all steps. Afterwards it counts from zero.
  Numbers look(Executor& run);

 private:
  enum Flag : int { kSorts, kGoesOn };
  Buffer<std::uint32_t> flags_;
  Buffer<Numbers> numbers_;
};

}  // namespace mpm_gpu
