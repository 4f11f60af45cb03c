// The expected motion of a scene, for the choice of a method: how much its material strains and turns, and whether it
// meets tools, walls with friction or other bodies. It is estimated from the scene's own numbers before the run.
//
// Strain is 1 where a material flows (fluid, gas, soil, plastic). Else it is the largest over all bodies of v/c + g
// H/c^2, with the wave speed c of the body's material, its height H along gravity, and its largest speed v, composed of
// the initial speed and a fall from its initial position to the face of the grid, v^2 = v0^2 + 2 g h. A body that hits
// something at v strains by about v/c, and one that stands under its weight by about g H/c^2. Strain is at least 0.1
// with rigid bodies, which may be commanded, with loads, and with an initial stress, none of which is examined.
//
// Turn is 90 degrees where a material flows or a rigid body turns. Else it is the turn until the end of the run of the
// body that initially turns fastest, or 90 degrees for a run without end. Its rate w is that of the rotation about its
// middle that fits its velocity best: sum (r^2 I - r r) w = sum r x v.
//
// Weak: an order of magnitude. A body that begins to tumble later is not seen, nor a wave that focuses in a point; for
// these there are the keys `strain` and `turn` of method.auto. Source: own; v/c is the strain of a one-dimensional
// impact.
#pragma once

#include <string>

#include "mpm/scene/scene.hpp"

namespace mpm {

struct ExpectedMotion {
  double strain = 0.0;     ///< largest, [-]
  std::string strain_why;  ///< its origin, for --explain
  double turn = 0.0;       ///< largest [rad]
  std::string turn_why;
  bool flows = false;    ///< some material deforms without end: a fluid, gas, soil or plastic one
  bool contact = false;  ///< there are rigid bodies, or walls with friction
  bool free = false;     ///< bodies move at the start, fall, or are several and can meet
};

/// The expected motion of a scene whose sections other than `method` have been read.
ExpectedMotion expected_motion(const Scene& scene);

}  // namespace mpm
