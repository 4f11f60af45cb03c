// The order of the stages of a step, in one table. At every hook stages act in ascending order of the ranks that they
// have there; those of one rank in the order in which they were added to the run.
//
// What holds its nodes whatever happens (the axis, walls that do not let go, prescribed velocities) acts before
// contact, so that friction sees no velocity through it, and once more after contact, which may have pushed its nodes.
// In a run without contact the second time is left out. Source: method reference 5.4, steps 7 to 9.
#pragma once

#include <optional>

namespace mpm {

/// Where a stage may act, in the order of a run and of its steps; what holds there is told at the functions of Stage.
enum class Hook {
  run_begun,
  momentum_gathered,
  before_strain,
  forces_gathered,
  momentum_updated,
  velocity_found,
  increment_found,
  grid_advanced
};
inline constexpr int kHooks = 8;

enum class Rank {
  mass_centre,  ///< where the mass of nodes comes from, which those that tell the sides of a thin tool apart ask
  side,         ///< both sides of a body become one where no tool is between them, before anyone looks at a velocity
  hoop_stress,  ///< books the sum of the internal forces, so no one has added a force yet
  damping,      ///< a force from the gathered momentum, which no one changes
  axis,         ///< holds before contact
  absorbing,    ///< needs the force on its nodes, which a wall or a condition there would hide
  wall,         ///< holds before contact
  condition,    ///< a prescribed velocity stands above walls: what it says of a node is the last word
  pair,         ///< contact of deformable bodies; tools, which give way to nothing, come after it
  rigid_body,   ///< contact with rigid bodies
  frictional_wall,  ///< contact with the domain's faces, which are as rigid and do not move
  axis_again,       ///< holds again what contact has pushed
  wall_again,       ///< the same, in the order of the first time
  condition_again,  ///< the same
  load,             ///< its work is taken with the velocity that all conditions have left
  traction,         ///< the same
  massless_node,    ///< books the force on nodes that take no part, so all forces have been added
  side_again        ///< what acted on one side alone is shared
};

/// Whether a stage of this rank gives the nodes what depends on how they move, so that others have to hold them again.
constexpr bool is_contact(Rank rank) { return rank >= Rank::pair && rank <= Rank::frictional_wall; }
/// Whether the rank is there to hold again what contact has pushed.
constexpr bool mends_contact(Rank rank) { return rank >= Rank::axis_again && rank <= Rank::condition_again; }

/// When a stage acts at a hook: once, or a second time too.
struct Ranks {
  Rank first;
  std::optional<Rank> again = {};
};

/// Of what always holds its nodes.
constexpr Ranks holding(Hook hook, Rank first, Rank again) {
  const bool holds = hook == Hook::before_strain || hook == Hook::momentum_updated || hook == Hook::velocity_found ||
                     hook == Hook::increment_found;
  if (!holds) return {first};
  return {first, again};
}

}  // namespace mpm
