// Damping of the material's motion beside its law: rates for the velocity of the grid and of the particles, a part of
// PIC, and a rate that is controlled by the kinetic energy. mechanics/damping.hpp applies them.
//
// Weak: none of them is physics. Grid and particle damping slow rigid motion as they slow vibration; a part of PIC is
// taken every step, so that it damps more the more steps there are. Source: Nairn, GIMP notes (2.15)-(2.45); method
// reference 6.1 to 6.5.
#pragma once

#include <limits>
#include <optional>

#include "mpm/math/function.hpp"

namespace mpm {

/// Nose-Hoover feedback: d alpha/dt = 2 K / m (E - E_target), from alpha = 0. With a target of 0 alpha never falls;
/// if the energy falls below the target alpha may become negative, and then it accelerates the material.
struct FeedbackDefinition {
  /// `grid`: E is that of the grid's velocity at the particles and alpha adds to the grid's rate; `particle`: both of
  /// the particles' own velocity.
  enum class Of { grid, particle };
  double gain = 0.0;                                       ///< K [1/m^2]
  Function target;                                         ///< E_target, a function of time alone [J]
  double limit = std::numeric_limits<double>::infinity();  ///< largest alpha [1/s]
  Of of = Of::grid;
};

struct DampingDefinition {
  DampingDefinition() = default;
  /// A number is grid damping [1/s], as in a scene.
  DampingDefinition(double rate) : grid(rate) {}  // NOLINT: so that a number can be assigned

  Function grid;      ///< alpha_g: v loses alpha_g v0 dt, v0 being the grid's velocity at the particle [1/s]
  Function particle;  ///< alpha_p: v loses alpha_p v dt [1/s]
  Function pic;       ///< 1 - beta: part of PIC in the update of a step, 0 to 1; the FLIP fraction is 1 without it
  /// True if grid damping is a force on the nodes, before walls and tools act; else it is in the update of particles.
  /// With FLIP both are the same to round-off where no node is held (method reference 6.3). A function of place is
  /// always in the update.
  bool in_force = true;
  std::optional<FeedbackDefinition> feedback;

  /// True if there is any damping.
  bool any() const { return !grid.is_zero() || !particle.is_zero() || !pic.is_zero() || feedback; }
  /// True if damping acts in the update of particles, beside the FLIP fraction.
  bool in_update() const {
    const bool steered = feedback && (feedback->of == FeedbackDefinition::Of::particle || !in_force);
    return !particle.is_zero() || pic.uses_place() || steered || (!grid.is_zero() && !in_force);
  }
};

}  // namespace mpm
