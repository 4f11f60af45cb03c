// The links and joints of a robot, as a URDF file describes them.
//
// Joints: fixed, revolute, continuous and prismatic; limits, damping, friction and mimic joints. A floating or planar
// joint is refused: the base of a robot can be free instead. Transmissions, sensors and extensions of simulators are
// passed over. Source: the URDF specification, http://wiki.ros.org/urdf/XML; the file is read by urdfdom.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mpm/math/constants.hpp"
#include "mpm/rigid/motion.hpp"

namespace mpm {

struct ModelLink {
  std::string name;
  double mass = 0.0;            ///< [kg]
  Vec3 centre = Vec3::Zero();   ///< centre of mass, link axes [m]
  Mat3 inertia = Mat3::Zero();  ///< about the centre of mass, link axes [kg m^2]
  bool shaped = false;          ///< true if it has collision geometry
};

/// Motion of a joint that follows another one: position = factor * position of that one + offset.
struct Mimic {
  int joint = 0;
  double factor = 1.0;
  double offset = 0.0;  ///< [m], [rad]
};

struct ModelJoint {
  enum class Kind { fixed, revolute, prismatic };
  std::string name;
  Kind kind = Kind::fixed;
  int parent = 0;             ///< link
  Pose origin;                ///< frame of the joint and of the child, in the parent's frame
  Vec3 axis = Vec3::UnitX();  ///< unit, in the joint's frame
  // Limits; infinite where there are none.
  double lower = -kInfinity, upper = kInfinity;  ///< [m], [rad]
  double effort = kInfinity;                     ///< [N], [N m]
  double speed = kInfinity;                      ///< [m/s], [rad/s]
  double damping = 0.0;                          ///< [N s/m], [N m s/rad]
  double friction = 0.0;                         ///< [N], [N m]
  std::optional<Mimic> mimic;

  bool moves() const { return kind != Kind::fixed; }
};

/// A tree: joint j leads to link j + 1, and a parent comes before its children. The first link is the base.
struct RobotModel {
  std::string name;
  std::vector<ModelLink> links;
  std::vector<ModelJoint> joints;

  /// -1 without one of that name.
  int find_link(const std::string& name) const;
  int find_joint(const std::string& name) const;
  /// True if the link, with those that are fixed to it, has mass and moments of inertia.
  bool carries_mass(int link) const;
};

/// Reads a URDF file; `path` as load_urdf_link() has it. @throws RigidError with the path, and the line where it is
/// known, for a file that cannot be read, a joint of another kind, a link with two parents, a moving link without mass
/// and inertia, numbers that are impossible, and a mimic joint without the joint that it follows
RobotModel load_urdf_robot(const std::string& path);

}  // namespace mpm
