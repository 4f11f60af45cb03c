// A report of the material's action on a rigid body: plain values, SI.
#pragma once

#include <limits>
#include <string>

#include "mpm/rigid/motion.hpp"

namespace mpm {

/// The material's action on one rigid body since the last report. In planar scenes it is that on the whole thickness,
/// in axisymmetric scenes that on the whole body; around the axis all but the force along it cancels, so wrenches,
/// friction and impulse have a z component alone, and the centre of pressure lies on the axis.
///
/// Centre of pressure: the mean of the points where the material pressed, each weighted by the magnitude of the normal
/// impulse it gave there, over all nodes in contact and all steps of the interval. The points are counted from the
/// body's origin (world axes) as it was in their step, and the mean is laid at the origin as it is now: so it travels
/// with a body that moves, and where the contact is flat and smooth, torque = arm x force. Nothing pressed: not a
/// number.
struct ContactReport {
  std::string body;
  Wrench mean;                  ///< averaged over `interval`: applied impulse over time
  Wrench peak;                  ///< wrench of the step with the largest force
  double interval = 0.0;        ///< [s] since the last report; 0 before the first step (then mean is zero)
  int nodes = 0;                ///< grid nodes, or points of the material's surface, in contact in the last step
  Vec3 impulse = Vec3::Zero();  ///< force on the body integrated since the start [N s]
  double area = 0.0;            ///< area of the surface in contact, averaged like `mean`; 0 with contact at nodes [m^2]
  double friction_energy = 0.0;  ///< taken by sliding on the body since the start [J]

  double pressing = 0.0;         ///< sum over nodes of the magnitude of the normal force, averaged like `mean` [N]
  Vec3 friction = Vec3::Zero();  ///< the part of mean.force along the surface; the rest is normal to it [N]
  /// Axisymmetric scenes: force outwards (x) and along the axis (z), averaged like `mean`, over 2 pi [N/rad]; else 0.
  Vec3 per_radian = Vec3::Zero();
  Vec3 origin = Vec3::Zero();  ///< origin of the body at the end of the interval; for a ring, on the axis [m]
  Vec3 arm = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< origin to centre of pressure [m]

  Vec3 centre_of_pressure() const { return origin + arm; }  ///< world [m]; not finite while nothing presses
};

}  // namespace mpm
