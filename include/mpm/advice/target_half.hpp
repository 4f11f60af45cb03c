// target.symmetric: the half of a scene that is its own mirror image across the middle of its grid along an axis.
//
// Half of the particles give the same forces, halved. What can be seen in the scene is checked: grid, boundaries,
// gravity, boxes of material and how they start, pose, motion and bounds of tools. Weak: what a tool's shape looks like
// between its bounds is not looked at, nor are commands that move it across the plane while the scene runs.
#pragma once

#include <string>
#include <vector>

#include "mpm/scene/scene.hpp"

namespace mpm {

/// Reason why a scene is not its own mirror image across the middle of its grid along an axis, or cannot be halved
/// there, and what to do; empty where the half can be modelled. Shapes of rigid bodies that are height fields are left
/// to the caller.
std::string asymmetry(const Scene& scene, int axis);
/// Settings that leave the half above that plane, "key=value": grid, boxes of bodies, and a plane of symmetry as the
/// lower face. Forces are then those of the half. @param scene without asymmetry
std::vector<std::string> half_lines(const Scene& scene, int axis);

}  // namespace mpm
