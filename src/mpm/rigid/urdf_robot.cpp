#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>

#include "mpm/math/nearest.hpp"
#include "mpm/rigid/robot_model.hpp"
#include "mpm/rigid/surface.hpp"
#include "urdf_text.hpp"

namespace mpm {
namespace {

/// Limit of a joint; a URDF writes 0 where there is none.
double limit_of(double written) { return written > 0.0 ? written : kInfinity; }

class RobotReader {
 public:
  explicit RobotReader(const std::string& file) : text_(file, {"visual", "collision"}) {
    const Complaints complaints;
    model_ = text_.parse(complaints);
    if (complaints.any()) {
      throw RigidError(complaints.first() +
                       (text_.has_xacro() ? fmt::format("; the file holds elements of xacro: {}", kExpand) : ""));
    }
  }

  RobotModel read() {
    RobotModel robot;
    robot.name = model_->getName();
    check_parents();
    const urdf::LinkConstSharedPtr root = model_->getRoot();
    add_link(*root, robot);
    add_children(*root, robot);
    for (std::size_t j = 0; j < robot.joints.size(); ++j) add_mimic(robot, j);
    for (std::size_t l = 0; l < robot.links.size(); ++l) check_mass(robot, static_cast<int>(l));
    return robot;
  }

 private:
  std::string start(const char* kind, const std::string& name) const {
    return fmt::format("{}{} '{}': ", text_.line_of(kind, name), kind, name);
  }

  /// Refuses a link that two joints lead to: urdfdom keeps one of them.
  void check_parents() const {
    std::map<std::string, std::string> leads_to;
    for (const auto& [name, joint] : model_->joints_) {
      const auto [known, is_new] = leads_to.emplace(joint->child_link_name, name);
      if (is_new) continue;
      throw RigidError(
          fmt::format("{}it leads to link '{}', as joint '{}' does: a URDF is a tree, and closed loops are not "
                      "simulated; leave one of them out",
                      start("joint", name), joint->child_link_name, known->second));
    }
  }

  void add_link(const urdf::Link& link, RobotModel& robot) const {
    ModelLink added;
    added.name = link.name;
    const std::vector<int> collisions = text_.collisions_of(link.name);
    added.shaped = !collisions.empty();
    if (link.inertial) {
      const urdf::Inertial& given = *link.inertial;
      const Pose pose = urdf_pose(given.origin);
      added.mass = given.mass;
      added.centre = pose.position;
      Mat3 own;
      own << given.ixx, given.ixy, given.ixz, given.ixy, given.iyy, given.iyz, given.ixz, given.iyz, given.izz;
      const Mat3 axes = pose.orientation.toRotationMatrix();
      added.inertia = axes * own * axes.transpose();
      if (!(added.mass >= 0.0) || !std::isfinite(added.mass) || !added.inertia.allFinite()) {
        throw RigidError(start("link", link.name) + "its mass is negative, or mass or inertia is not finite");
      }
      const Vec3 moments = Eigen::SelfAdjointEigenSolver<Mat3>(own).eigenvalues();
      if (moments[0] < 0.0 || moments[2] > 1.000001 * (moments[0] + moments[1])) {
        throw RigidError(start("link", link.name) +
                         fmt::format("no body has the principal moments of inertia {:g}, {:g} and {:g} kg m^2: none is "
                                     "negative, and none is more than the sum of the others",
                                     moments[0], moments[1], moments[2]));
      }
    }
    robot.links.push_back(std::move(added));
  }

  void add_children(const urdf::Link& parent, RobotModel& robot) const {
    const int place = robot.find_link(parent.name);
    std::vector<urdf::JointSharedPtr> joints = parent.child_joints;
    std::sort(joints.begin(), joints.end(), [&](const auto& a, const auto& b) { return a->name < b->name; });
    for (const urdf::JointSharedPtr& joint : joints) {
      add_joint(*joint, place, robot);
      const urdf::LinkConstSharedPtr child = model_->getLink(joint->child_link_name);
      add_link(*child, robot);
      add_children(*child, robot);
    }
  }

  void add_joint(const urdf::Joint& joint, int parent, RobotModel& robot) const {
    ModelJoint added;
    added.name = joint.name;
    added.parent = parent;
    try {
      added.origin = urdf_pose(joint.parent_to_joint_origin_transform);
    } catch (const RigidError& error) {
      throw RigidError(start("joint", joint.name) + error.what());
    }
    switch (joint.type) {
      case urdf::Joint::FIXED:
        break;
      case urdf::Joint::REVOLUTE:
      case urdf::Joint::CONTINUOUS:
        added.kind = ModelJoint::Kind::revolute;
        break;
      case urdf::Joint::PRISMATIC:
        added.kind = ModelJoint::Kind::prismatic;
        break;
      default:
        throw RigidError(start("joint", joint.name) +
                         "joints of a robot are fixed, revolute, continuous or prismatic; for a floating base write "
                         "base: free in the scene, and for a planar joint two prismatic ones and a revolute one");
    }
    if (added.moves()) {
      const Vec3 axis = urdf_vector(joint.axis);
      if (!(axis.norm() > 0.0) || !axis.allFinite()) {
        throw RigidError(start("joint", joint.name) + "its axis has no length; write one such as 0 0 1");
      }
      added.axis = axis.normalized();
    }
    if (joint.limits && added.moves()) {
      if (joint.type != urdf::Joint::CONTINUOUS) {
        added.lower = joint.limits->lower;
        added.upper = joint.limits->upper;
        if (!(added.lower <= added.upper)) {
          throw RigidError(start("joint", joint.name) +
                           fmt::format("its lower limit, {:g}, is above the upper, {:g}", added.lower, added.upper));
        }
      }
      added.effort = limit_of(joint.limits->effort);
      added.speed = limit_of(joint.limits->velocity);
    }
    if (joint.dynamics) {
      added.damping = joint.dynamics->damping;
      added.friction = joint.dynamics->friction;
      if (!(added.damping >= 0.0) || !(added.friction >= 0.0) || std::isinf(added.damping + added.friction)) {
        throw RigidError(start("joint", joint.name) + "damping or friction is negative, or not finite");
      }
    }
    robot.joints.push_back(std::move(added));
  }

  void add_mimic(RobotModel& robot, std::size_t place) const {
    ModelJoint& joint = robot.joints[place];
    const auto given = model_->getJoint(joint.name)->mimic;
    if (!given) return;
    const int leader = robot.find_joint(given->joint_name);
    if (leader < 0) {
      std::vector<std::string> names;
      for (const ModelJoint& other : robot.joints) names.push_back(other.name);
      throw RigidError(start("joint", joint.name) + fmt::format("it mimics '{}', and no joint is called so; {}",
                                                                given->joint_name, suggest(given->joint_name, names)));
    }
    if (leader == static_cast<int>(place) || !robot.joints[leader].moves() || !joint.moves() ||
        model_->getJoint(robot.joints[leader].name)->mimic) {
      throw RigidError(
          start("joint", joint.name) +
          "it mimics a joint that is fixed, itself, or one that mimics another; name the joint that moves");
    }
    if (!std::isfinite(given->multiplier) || !std::isfinite(given->offset)) {
      throw RigidError(start("joint", joint.name) + "the numbers of its mimic are not finite");
    }
    joint.mimic = Mimic{leader, given->multiplier, given->offset};
  }

  /// Refuses a moving link without mass, unless one that is fixed to it has some.
  void check_mass(const RobotModel& robot, int link) const {
    if (link == 0 || !robot.joints[link - 1].moves()) return;
    if (robot.carries_mass(link)) return;
    throw RigidError(start("link", robot.links[link].name) +
                     "it moves and has no mass or no moment of inertia; write <inertial> with both");
  }

  UrdfText text_;
  urdf::ModelInterfaceSharedPtr model_;
};

template <class Named>
int find_in(const std::vector<Named>& list, const std::string& name) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace

bool RobotModel::carries_mass(int link) const {
  std::vector<bool> with(links.size(), false);
  with[link] = true;
  for (std::size_t j = link; j < joints.size(); ++j) {
    if (!joints[j].moves() && with[joints[j].parent]) with[j + 1] = true;
  }
  double mass = 0.0, moment = 0.0;
  for (std::size_t l = 0; l < with.size(); ++l) {
    if (!with[l]) continue;
    mass += links[l].mass;
    moment += links[l].inertia.trace();
  }
  return mass > 0.0 && moment > 0.0;
}

int RobotModel::find_link(const std::string& name) const { return find_in(links, name); }
int RobotModel::find_joint(const std::string& name) const { return find_in(joints, name); }

RobotModel load_urdf_robot(const std::string& path) try {
  return RobotReader(urdf_path(path, {})).read();
} catch (const RigidError& error) {
  throw RigidError(fmt::format("{}: {}", path, error.what()));
}

}  // namespace mpm
