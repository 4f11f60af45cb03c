// The order of a step: update strain first (USF), last (USL) or half first and half last (USAVG).
//
// USF costs least and conserves energy less well; USL takes strain from the momentum that the particles end the step
// with (the modified form, re-extrapolated) and loses energy; USAVG does both and has the smallest energy drift.
// An implicit step has no strain of its own: a stage (implicit/implicit_step.hpp) finds velocities and stresses
// together. Contact and walls act on velocities beside the gathered momentum, which stays as it was, so nothing has to
// be undone before the update. Source: Nairn, GIMP notes 2.2; method reference 5.4.
#pragma once

#include <array>

#include "mpm/step/mechanics.hpp"
#include "mpm/step/modules.hpp"

namespace mpm {

enum class UpdateScheme { usf, usl, usavg, implicit };

/// True if particles keep their places while they move, since strain is updated from there afterwards.
constexpr bool strains_after_motion(UpdateScheme update) {
  return update == UpdateScheme::usl || update == UpdateScheme::usavg;
}

/// StepContext::strain_at_start of explicit steps.
constexpr double strain_at_start(UpdateScheme update) {
  return update == UpdateScheme::usf ? 1.0 : update == UpdateScheme::usavg ? 0.5 : 0.0;
}

/// In the order of UpdateScheme.
inline constexpr std::array<const char*, 4> kUpdateNames = {"usf", "usl", "usavg", "implicit"};

void step_usf(Mechanics& mechanics, const Modules& modules, StepContext& context);
void step_usl(Mechanics& mechanics, const Modules& modules, StepContext& context);
void step_usavg(Mechanics& mechanics, const Modules& modules, StepContext& context);
void step_implicit(Mechanics& mechanics, const Modules& modules, StepContext& context);

}  // namespace mpm
