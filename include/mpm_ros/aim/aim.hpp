// A scene with a target, made a scene with a discretisation: by figures of force errors (mpm/pace/target.hpp) and by
// what steps cost on this machine, timed on copies of the scene that serve for nothing else.
//
// Timed are: a coarse copy as far as half a second lets it run, for what steps cost more once tools have reached the
// material than at the start; the scene's own grid (or the finest that fits with few particles) with each precision and
// update; and what is chosen, until what was timed is what is chosen. Costs are kept for a day
// (mpm/pace/kept_costs.hpp), as is that of a run that ended, so a second start times nothing, and knows more.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mpm/kernel/isa.hpp"
#include "mpm/scene/scene.hpp"

namespace mpm_ros {

struct Aim {
  mpm::Scene scene;                   ///< with the choice, where it has a target
  std::vector<std::string> news;      ///< lines on what was chosen and why, a line each; nothing without a target
  std::vector<std::string> warnings;  ///< a target that is not in reach, and what would have to be given up
  std::string table;                  ///< table of choices not taken, with their price; empty where none was made now
};

/// Chooses for a scene whose target is open; any other comes back as it is, with the news of a choice that was
/// recorded.
/// @param threads as RunOptions has it, 0: chosen by the run
/// `ranks`: null for a process that is alone; else this is the first of them, and the others follow its orders.
/// @throws mpm::StoppedError, mpm::SceneError where no figures are for such a scene
Aim aim(mpm::Scene scene, int threads, mpm::Isa isa, const std::function<bool()>& stop,
        mpm::Communicator* ranks = nullptr);
/// The same, to be called on all ranks: the first chooses, with what all of them time together, and the others have its
/// choice, or what it throws.
Aim aim_together(mpm::Scene scene, int threads, mpm::Isa isa, const std::function<bool()>& stop,
                 mpm::Communicator* ranks);

}  // namespace mpm_ros
