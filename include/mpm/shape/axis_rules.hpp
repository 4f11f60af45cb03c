// Treatment of the neighbourhood of the axis in an axisymmetric scene: what a shape function does with a domain that
// would reach across it, and how particles near it are moved. The defaults are those that measured best
// (doc/axisymmetric.md); the others serve for comparison. Source: Nairn & Guilkey (2015) 4.1.
#pragma once

#include <array>

namespace mpm {

enum class AxisDomains {
  fitted,  ///< uGIMP's box is cut off at r = 0; a domain that deforms is shrunk until it touches the axis
  whole,   ///< domains stay as they are, even where they reach across the axis
};
enum class AxisFunctions {
  weighted,  ///< averages over rings, weighted with r
  planar,    ///< planar shape functions, with T = S / r
};
/// Velocity of nodes beyond the axis, to which planar functions and whole domains give mass.
enum class AxisGhosts {
  free,    ///< not constrained
  zero,    ///< zero radial velocity, as on the axis
  mirror,  ///< opposite radial velocity to that of the node at the same distance from the axis
};
/// Radial velocity that moves a particle.
enum class AxisMotion {
  mean,   ///< averaged by S like the particle's own velocity: that of the mass in its domain
  point,  ///< motion of the grid at the particle, interpolated by the hat functions
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
