// What a scene is like, as far as a choice of method asks: how much its material strains and turns, and whether it
// meets tools, walls with friction or other bodies. From the scene's own numbers, before anything runs.
//
// Strain is 1 where a material flows (fluid, gas, soil, plastic). Else it is, of each body, v/c + g H/c^2, and of all
// bodies the largest: c its material's wave speed, H its height along gravity, v its largest speed at the start with
// what it gains in a fall from there to the face of the grid, v^2 = v0^2 + 2 g h. A body that hits something at v
// strains by about v/c, one that stands under its weight by about g H/c^2. At least 0.1 with rigid bodies, which may be
// commanded, loads, or a stress at the start, which this does not look into.
//
// Turn is 90 degrees where a material flows or a rigid body turns. Else it is what the body that turns fastest at the
// start would turn by until the end of the run, or 90 degrees where the run has no end. Its rate w is that of the
// rotation about its middle that fits its velocity best: sum (r^2 I - r r) w = sum r x v.
//
// Weak: an order of magnitude. It does not see a body that begins to tumble later, nor a wave that gathers in a point;
// the keys `strain` and `turn` of method.auto are for those. Source: own; v/c is the strain of a one-dimensional
// impact.
#pragma once

#include <string>

#include "mpm/scene/scene.hpp"

namespace mpm {

struct ExpectedMotion {
  double strain = 0.0;     ///< largest, [-]
  std::string strain_why;  ///< where it is from, for --explain
  double turn = 0.0;       ///< largest [rad]
  std::string turn_why;
  bool flows = false;    ///< deforms without end: a fluid, gas, soil or plastic material
  bool contact = false;  ///< rigid bodies, or walls with friction
  bool free = false;     ///< bodies that move at the start, fall, or are more than one and can meet
};

/// Of a scene that is read, without its method.
ExpectedMotion expected_motion(const Scene& scene);

}  // namespace mpm
