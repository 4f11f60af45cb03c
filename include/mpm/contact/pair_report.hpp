// A report of the action of two deformable bodies on each other: plain values, SI.
#pragma once

#include <limits>
#include <string>

#include "mpm/math/geometry.hpp"

namespace mpm {

/// Forces are averaged over the interval since the last report. In axisymmetric scenes they are those of the whole
/// body, so only their z component is not zero.
struct PairReport {
  std::string name;               ///< "first/second"
  Vec3 force = Vec3::Zero();      ///< on the second body, from the first; the opposite acts on the first [N]
  Vec3 friction = Vec3::Zero();   ///< the part of it along the surface [N]
  double pressing = 0.0;          ///< sum over nodes of the magnitude of the pressing normal force [N]
  double area = 0.0;              ///< area of the nodes that pressed in the last step [m^2]
  double interval = 0.0;          ///< [s]
  int nodes = 0;                  ///< in contact in the last step
  Vec3 impulse = Vec3::Zero();    ///< on the second body since the start [N s]
  double friction_energy = 0.0;   ///< taken by sliding since the start [J]
  double interface_energy = 0.0;  ///< stored in an imperfect interface when the last step began [J]
  /// Mean of the nodes that pressed, by the normal impulse there, over the interval [m]; not a number while none did.
  Vec3 centre = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
};

}  // namespace mpm
