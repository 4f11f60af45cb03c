// How an axisymmetric scene treats the neighbourhood of the axis: what a shape function does with a domain that would
// reach across it, and how particles near it are moved. The defaults are what measured best (doc/axisymmetric.md); the
// others are there for comparison with them: Nairn & Guilkey (2015) 4.1.
#pragma once

#include <array>

namespace mpm {

enum class AxisDomains {
  fitted,  ///< uGIMP's box is cut off at r = 0, a domain that deforms is shrunk until it touches it
  whole,   ///< as they are, though they reach across
};
enum class AxisFunctions {
  weighted,  ///< averages over rings, with the weight r
  planar,    ///< those of a plane, with T = S / r
};
/// Of nodes beyond the axis, which planar functions and whole domains give mass to.
enum class AxisGhosts {
  free,    ///< nothing is asked of them
  zero,    ///< no radial velocity, as on the axis
  mirror,  ///< the opposite radial velocity of the node at the same distance from the axis
};
/// The radial velocity that moves a particle.
enum class AxisMotion {
  mean,   ///< the one that its own velocity is made of, by S: that of the mass in its domain
  point,  ///< the grid's at its place, by the hat functions
};

inline constexpr std::array<const char*, 2> kAxisDomainNames = {"fitted", "whole"};
inline constexpr std::array<const char*, 2> kAxisFunctionNames = {"weighted", "planar"};
inline constexpr std::array<const char*, 3> kAxisGhostNames = {"free", "zero", "mirror"};
inline constexpr std::array<const char*, 2> kAxisMotionNames = {"mean", "point"};

struct AxisRules {
  AxisDomains domains = AxisDomains::fitted;
  AxisFunctions functions = AxisFunctions::weighted;
  AxisGhosts ghosts = AxisGhosts::zero;
  AxisMotion motion = AxisMotion::point;
};

}  // namespace mpm
