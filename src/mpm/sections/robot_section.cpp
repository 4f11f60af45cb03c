// robots: URDF files, bases, drives of joints, and links that meet the material, which become rigid bodies.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "mpm/math/nearest.hpp"
#include "mpm/rigid/urdf.hpp"
#include "mpm/robot/poses.hpp"
#include "mpm/robot/robot_keys.hpp"
#include "mpm/sections/sections.hpp"

namespace mpm {
namespace {

constexpr double kSamePlace = 1e-6;  ///< [m], [rad], or part of the position

/// Dimensions of a joint's numbers: rotations have angles where translations have lengths.
struct JointDimensions {
  Dimension position, velocity, effort, stiffness, damping;
};

JointDimensions dimensions_of(const ModelJoint& joint) {
  if (joint.kind == ModelJoint::Kind::prismatic) {
    return {kLength, kVelocity, kForce, {0, 1, -2, 0}, {0, 1, -1, 0}};
  }
  return {kAngle, kAngularRate, kTorque, {2, 1, -2, -1}, {2, 1, -1, -1}};
}

template <class List>
std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> names;
  for (const auto& one : list) names.push_back(one.name);
  return names;
}

/// Names of the keys of a map of links or joints.
std::vector<std::string> keys_of(const Value& value, const char* what) {
  if (!value.is_map()) value.fail(fmt::format("write a map of {}, such as {{bucket: {{…}}}}", what));
  std::vector<std::string> names;
  for (const auto& entry : value.node()) names.push_back(entry.first.as<std::string>());
  return names;
}

/// `commands`: of a base that moves.
BaseDefinition read_base(const Value& value, const std::string& name, Scene& scene, CommandDefinition& commands) {
  BaseDefinition base;
  if (value.is_text()) {
    base.kind = static_cast<BaseKind>(value.choice({"fixed", "free", "moving"}));
    return base;
  }
  const Map map = read_keys(value, base_keys(), base);
  if (const auto pose = map.find("pose")) base.pose = read_pose(*pose, scene.definition.geometry, 0.0);
  const auto motion = map.find("motion");
  const auto kind = map.find("kind");
  if (motion) {
    if (kind && base.kind != BaseKind::moving) kind->fail("a base with a motion is moving; leave out one of the two");
    RigidBodyDefinition moved;
    read_rigid_motion(map, scene.definition.geometry, moved);
    base.kind = BaseKind::moving;
    base.velocity = moved.velocity;
    base.rotation_rate = moved.rotation_rate;
  }
  const auto drive = map.find("drive"), limits = map.find("limits");
  if ((drive || limits) && base.kind != BaseKind::moving) {
    (drive ? *drive : *limits).fail("it is of a base that moves; write kind: moving, or leave it out");
  }
  if (drive && motion) drive->fail("a base follows motion or a frame, not both; leave one out");
  if (drive) commands.frame = read_frame(*drive, name);
  if (limits) read_limits(*limits, commands.limits);
  return base;
}

/// The value of a target at the start.
double at_start(const Value& value, const Function& target) {
  try {
    return target(0.0);
  } catch (const FunctionError& error) {
    value.fail(error.what());
  }
}

/// Refuses names that cannot be a part of topics and files.
void check_name(const Value& value, const std::string& name) {
  const auto fits = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  if (!name.empty() && std::all_of(name.begin(), name.end(), fits)) return;
  value.fail(
      fmt::format("'{}' becomes part of topics and files, which have letters, digits and _ alone; rename it in "
                  "the URDF",
                  name));
}

void read_joint(const Value& value, const ModelJoint& model, JointDefinition& joint) {
  const JointDimensions dimensions = dimensions_of(model);
  const Map map = read_keys(value, joint_keys(), joint);
  const auto position = map.find("position"), target = map.find("target");
  if (position) joint.position = position->number(dimensions.position);
  if (target) {
    const Dimension& dimension = joint.drive == JointDrive::velocity   ? dimensions.velocity
                                 : joint.drive == JointDrive::position ? dimensions.position
                                                                       : dimensions.effort;
    joint.target = target->function(dimension);
    if (joint.drive == JointDrive::position && !position) joint.position = at_start(*target, *joint.target);
  }
  if (!(joint.position >= model.lower && joint.position <= model.upper)) {
    (position ? *position : value)
        .fail(
            fmt::format("the joint starts at {:g}, outside its limits from {:g} to {:g}; write a position within them",
                        joint.position, model.lower, model.upper));
  }
  const auto stiffness = map.find("stiffness"), damping = map.find("damping");
  if (stiffness) {
    if (joint.drive != JointDrive::position) stiffness->fail("it is of a drive by position; leave it out");
    joint.stiffness = stiffness->non_negative(dimensions.stiffness);
  }
  if (damping) {
    if (joint.drive == JointDrive::effort) {
      damping->fail("a drive by effort has none; that of the joint itself is in the URDF, in <dynamics>");
    }
    if (joint.drive == JointDrive::position && joint.stiffness == 0.0) {
      damping->fail("a drive by position without stiffness is rigid; write stiffness too, or leave it out");
    }
    joint.damping = damping->non_negative(dimensions.damping);
  }
  if (target && position && joint.drive == JointDrive::position && joint.stiffness == 0.0) {
    const double begin = at_start(*target, *joint.target);
    if (!(std::abs(begin - joint.position) <= kSamePlace * std::max(1.0, std::abs(begin)))) {
      target->fail(
          fmt::format("it begins at {:g}, and the joint at {:g}, from where a rigid drive would jump; begin at "
                      "one place, or write stiffness",
                      begin, joint.position));
    }
  }
  if (const auto effort = map.find("effort")) joint.effort = effort->positive(dimensions.effort);
}

void read_joints(const Map& map, RobotDefinition& robot) {
  std::vector<std::string> drivable;
  for (std::size_t j = 0; j < robot.model.joints.size(); ++j) {
    const ModelJoint& model = robot.model.joints[j];
    if (!model.moves() || model.mimic) continue;
    JointDefinition joint;
    joint.joint = static_cast<int>(j);
    if (!(joint.position >= model.lower && joint.position <= model.upper)) joint.position = model.lower;
    robot.joints.push_back(joint);
    drivable.push_back(model.name);
  }
  const auto joints = map.find("joints");
  if (!joints) return;
  const std::vector<std::string> written = keys_of(*joints, "joints");
  for (const std::string& name : written) {
    const auto found = std::find(drivable.begin(), drivable.end(), name);
    const Value value = joints->child(joints->node()[name], name);
    if (found == drivable.end()) {
      const int known = robot.model.find_joint(name);
      if (known >= 0) {
        value.fail(robot.model.joints[known].moves() ? "the joint follows another one (mimic); drive that"
                                                     : "the joint is fixed; leave it out");
      }
      value.fail(fmt::format("the robot has no joint '{}'; {}", name, suggest(name, drivable)));
    }
    read_joint(value, robot.model.joints[robot.model.find_joint(name)],
               robot.joints[static_cast<std::size_t>(found - drivable.begin())]);
  }
}

/// Refuses starts that put a joint outside its limits, since it follows another one.
void check_mimics(const Map& map, const RobotDefinition& robot) {
  for (const ModelJoint& model : robot.model.joints) {
    if (!model.mimic) continue;
    const auto leads = [&](const JointDefinition& joint) { return joint.joint == model.mimic->joint; };
    const auto leader = std::find_if(robot.joints.begin(), robot.joints.end(), leads);
    const double position = model.mimic->factor * leader->position + model.mimic->offset;
    if (position >= model.lower && position <= model.upper) continue;
    map.fail(
        fmt::format("joint '{}', which mimics '{}', starts at {:g}, outside its limits from {:g} to {:g}; write "
                    "another position of '{}'",
                    model.name, robot.model.joints[model.mimic->joint].name, position, model.lower, model.upper,
                    robot.model.joints[model.mimic->joint].name));
  }
}

/// Joints that move on the way between two links.
int joints_between(const RobotModel& model, int one, int two) {
  int joints = 0;
  while (one != two) {
    int& later = one > two ? one : two;  // parents come before their children
    const ModelJoint& joint = model.joints[static_cast<std::size_t>(later) - 1];
    if (joint.moves()) ++joints;
    later = joint.parent;
  }
  return joints;
}

/// Links that one joint holds together overlap there, and never collide.
void except_neighbours(const RobotDefinition& robot, std::vector<RigidBodyDefinition>& bodies) {
  for (const LinkContact& one : robot.contacts) {
    const auto body =
        std::find_if(bodies.begin(), bodies.end(), [&](const auto& other) { return other.name == one.body; });
    if (!body->collide) continue;
    for (const LinkContact& two : robot.contacts) {
      if (two.link < one.link && joints_between(robot.model, one.link, two.link) <= 1) {
        body->collide->except.push_back(two.body);
      }
    }
  }
}

/// Links that meet the material, as rigid bodies of the scene named after the robot and the link.
void read_links(const Map& map, const std::string& path, const FrictionLaw& friction, Scene& scene,
                RobotDefinition& robot) {
  const auto links = map.find("links");
  if (!links) return;
  const std::vector<Pose> poses = start_poses(robot);
  for (const std::string& name : keys_of(*links, "links")) {
    const Value value = links->child(links->node()[name], name);
    const int link = robot.model.find_link(name);
    if (link < 0) {
      value.fail(fmt::format("the robot has no link '{}'; {}", name, suggest(name, names_of(robot.model.links))));
    }
    check_name(value, name);
    const Map own(value, {"friction", "collide", "sides"}, {{"pose", "a link is where its joints put it"}});
    RigidBodyDefinition body;
    body.name = robot.name + "/" + name;
    const std::string in_files = robot.name + "_" + name;
    for (const RigidBodyDefinition& other : scene.definition.rigid_bodies) {
      std::string theirs = other.name;
      std::replace(theirs.begin(), theirs.end(), '/', '_');
      if (theirs == in_files) {
        value.fail(fmt::format("files of '{}' and of '{}' would have one name; rename one", body.name, other.name));
      }
    }
    try {
      body.surface = load_urdf_link(path, name, thinnest_mesh(scene.definition));
    } catch (const RigidError& error) {
      value.fail(error.what());
    }
    body.pose = poses[static_cast<std::size_t>(link)];
    const auto own_friction = own.find("friction");
    body.friction = own_friction ? read_friction(*own_friction) : friction;
    const auto own_collide = own.find("collide"), collide = own_collide ? own_collide : map.find("collide");
    if (collide) body.collide = read_collide(*collide);
    // In the order of Sides.
    if (const auto sides = own.find("sides")) body.sides = static_cast<Sides>(sides->choice({"auto", "one", "two"}));
    robot.contacts.push_back({link, body.name});
    scene.definition.rigid_bodies.push_back(std::move(body));
    scene.commands.emplace_back();
  }
  except_neighbours(robot, scene.definition.rigid_bodies);
}

void read_sensors(const Map& map, RobotDefinition& robot) {
  const auto sensors = map.find("sensors");
  if (!sensors) return;
  const auto add = [&](const Value& value, const std::string& name) -> SensorDefinition& {
    const int joint = robot.model.find_joint(name);
    if (joint < 0) {
      value.fail(fmt::format("the robot has no joint '{}'; {}", name, suggest(name, names_of(robot.model.joints))));
    }
    check_name(value, name);
    return robot.sensors.emplace_back(SensorDefinition{joint});
  };
  if (sensors->is_map()) {
    for (const std::string& name : keys_of(*sensors, "joints")) {
      const Value value = sensors->child(sensors->node()[name], name);
      read_keys(value, sensor_keys(), add(value, name));
    }
    return;
  }
  for (const Value& value : sensors->elements()) add(value, value.text());
}

}  // namespace

void read_robots(const Map& root, const FrictionLaw& friction, Scene& scene) {
  const auto section = root.find("robots");
  if (!section) return;
  if (scene.definition.geometry != GeometryKind::solid) {
    section->fail("robots are of a solid scene; leave geometry out, or write rigid_bodies that move as its links do");
  }
  std::vector<CommandDefinition> bases;  // come after those of all bodies, to which links belong
  for (const Value& value : section->elements()) {
    RobotDefinition robot;
    const Map map = read_keys(value, robot_keys(), robot);
    robot.name = map.at("name").name();
    const auto same = [&](const auto& other) { return other.name == robot.name; };
    const auto& definition = scene.definition;
    if (std::any_of(definition.robots.begin(), definition.robots.end(), same) ||
        std::any_of(definition.rigid_bodies.begin(), definition.rigid_bodies.end(), same) ||
        std::any_of(scene.bodies.begin(), scene.bodies.end(), same)) {
      value.fail(fmt::format("'{}' is already the name of a body or robot; give each its own name", robot.name));
    }
    const Value urdf = map.at("urdf");
    const std::string path = path_from_scene(urdf);
    try {
      robot.model = load_urdf_robot(path);
    } catch (const RigidError& error) {
      urdf.fail(error.what());
    }
    CommandDefinition commands;
    if (const auto base = map.find("base")) robot.base = read_base(*base, robot.name, scene, commands);
    if (robot.base.kind == BaseKind::moving) bases.push_back(commands);
    if (robot.base.kind == BaseKind::free && !robot.model.carries_mass(0)) {
      map.at("base").fail(
          fmt::format("the base is free, and its link '{}' has no mass or no moment of inertia; write <inertial> with "
                      "both",
                      robot.model.links.front().name));
    }
    read_joints(map, robot);
    check_mimics(map, robot);
    read_links(map, path, friction, scene, robot);
    read_sensors(map, robot);
    scene.definition.robots.push_back(std::move(robot));
  }
  scene.commands.insert(scene.commands.end(), bases.begin(), bases.end());
}

}  // namespace mpm
