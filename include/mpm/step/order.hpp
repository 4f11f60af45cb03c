// The order of the stages of a step, in one table. At every hook stages act in ascending order of the ranks that they
// have there; those of one rank in the order in which they were added to the run.
//
// Stages that always hold their nodes (the axis, walls other than frictional ones, prescribed velocities) act before
// contact, so that friction does not act on velocity through them, and once more after contact, which may have moved
// their nodes.
// In a run without contact the second time is left out. Source: method reference 5.4, steps 7 to 9.
#pragma once

#include <optional>

namespace mpm {

/// Place where a stage may act, in the order of a run and of its steps. The functions of Stage describe the state at
/// each hook.
enum class Hook {
  run_begun,
  step_begun,
  momentum_gathered,
  before_strain,
  forces_gathered,
  momentum_updated,
  velocity_found,
  increment_found,
  grid_advanced
};
inline constexpr int kHooks = 9;

enum class Rank {
  particle_stress,  ///< changes the particles' stress, which nothing has read in the step yet
  mass_centre,      ///< finds the mass centres of nodes, which `side` needs
  node_choice,      ///< chooses the fields of particles, before anything is gathered
  side,             ///< joins both sides of a body where no tool is between them, before velocities are used
  hoop_stress,      ///< books the sum of the internal forces, so it acts before forces are added
  damping,          ///< a force from the gathered momentum, which no stage changes
  axis,             ///< holds its nodes before contact
  absorbing,        ///< needs the force on its nodes, which a wall or a condition there would hide
  wall,             ///< holds its nodes before contact
  condition,        ///< overrides walls, so it acts after them
  implicit,         ///< finds the velocities for which stresses and all contacts fulfil their laws
  pair,             ///< contact of deformable bodies; before rigid bodies, whose velocity is the last word
  rigid_body,       ///< contact with rigid bodies
  frictional_wall,  ///< contact with the domain's faces, which are rigid too and do not move
  axis_again,       ///< holds nodes again that contact has moved
  wall_again,       ///< the same, in the same order as before contact
  condition_again,  ///< the same
  at_rest,          ///< holds nodes of material asleep, before loads compute their work
  load,             ///< computes its work with the velocity that all conditions have left
  traction,         ///< the same
  transport,        ///< adds the force of the water in pores; moves what is transported when contact has told of heat
  massless_node,    ///< books the force on nodes without mass, so it acts after all forces have been added
  side_again,       ///< shares between both sides what acted on one of them
  asleep            ///< reads the sum of all forces, and holds nodes of material asleep against all else
};

/// True if a stage of this rank is contact, or has it, after which others have to hold their nodes again.
constexpr bool is_contact(Rank rank) { return rank >= Rank::implicit && rank <= Rank::frictional_wall; }
/// True if a stage acts at this rank only because contact may have moved its nodes.
constexpr bool mends_contact(Rank rank) { return rank >= Rank::axis_again && rank <= Rank::condition_again; }

/// The ranks of a stage at a hook: one, or two if it acts twice.
struct Ranks {
  Rank first;
  std::optional<Rank> again = {};
};

/// The ranks of a stage that always holds its nodes: two at hooks where velocities are held, one at others.
constexpr Ranks holding(Hook hook, Rank first, Rank again) {
  const bool holds = hook == Hook::before_strain || hook == Hook::momentum_updated || hook == Hook::velocity_found ||
                     hook == Hook::increment_found;
  if (!holds) return {first};
  return {first, again};
}

}  // namespace mpm
