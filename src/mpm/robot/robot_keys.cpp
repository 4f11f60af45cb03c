#include "mpm/robot/robot_keys.hpp"

namespace mpm {

const KeyTable<RobotDefinition>& robot_keys() {
  using Robot = RobotDefinition;
  static const auto keys =
      KeyTable<Robot>("robots")
          .rows({other<Robot>("name", "word", {kRequired, "of the robot, in topics and outputs", "digger"}),
                 other<Robot>("urdf", "path",
                              {kRequired, "URDF file, xacro expanded; package://, file:// or from the scene's folder",
                               "package://my_robot/urdf/digger.urdf"}),
                 other<Robot>("base", "`fixed`, `free`, `moving` or a map",
                              {"`fixed`, at the origin", "how the first link is held", "free"}),
                 other<Robot>(
                     "links", "map of links",
                     {"none",
                      "links that meet the material, with `friction`, `collide` and `sides` as a rigid body has them",
                      "{bucket: {friction: 0.4}}"}),
                 other<Robot>("collide", "as of a rigid body",
                              {"`false`",
                               "whether those links meet rigid bodies that collide, walls and each other; a link may "
                               "have its own",
                               "true"}),
                 other<Robot>("joints", "map of joints",
                              {"without a drive", "drives of joints", "{boom: {drive: velocity}}"}),
                 other<Robot>(
                     "sensors", "list or map of joints",
                     {"none", "joints whose wrench is reported, as a force-torque sensor there reads it", "[wrist]"})})
          .advise({{"file", "write urdf"},
                   {"pose", "write it in base: {pose: …}"},
                   {"xacro", "expand it first: xacro robot.xacro > robot.urdf"}});
  return keys;
}

const KeyTable<BaseDefinition>& base_keys() {
  using Base = BaseDefinition;
  static const auto keys =
      KeyTable<Base>("robots.base")
          .rows({word("kind", &Base::kind, {"fixed", "free", "moving"},
                      {"fixed; with `motion` moving", "what holds the base", "free"}),
                 other<Base>("pose", "pose",
                             {"the origin", "of the base at the start, as of a rigid body", "{position: [0, 0, 0.5]}"}),
                 other<Base>("motion", "motion",
                             {"none", "prescribed motion, as of a rigid body, until a command comes",
                              "{velocity: [0.1, 0, 0]}"}),
                 other<Base>("drive", "`tf` or `{tf: frame}`",
                             {"commands on topics", "tf frame that a moving base follows; `tf`: of the robot's name",
                              "{tf: base_link}"}),
                 other<Base>("limits", "map",
                             {"none", "limits of commanded motion, as of a rigid body", "{speed: 0.5}"})});
  return keys;
}

const KeyTable<SensorDefinition>& sensor_keys() {
  static const auto keys = KeyTable<SensorDefinition>("robots.sensors")
                               .rows({plain("gravity", &SensorDefinition::gravity,
                                            {"", "whether the weight of what hangs on the sensor is in it", "false"})})
                               .advise({{"tare", "write gravity: false"}});
  return keys;
}

const KeyTable<JointDefinition>& joint_keys() {
  using Joint = JointDefinition;
  static const auto keys =
      KeyTable<Joint>("robots.joints")
          .rows({word("drive", &Joint::drive, words_of(kJointDriveNames), {"", "what the drive follows", "position"}),
                 other<Joint>("target", "function of t",
                              {"the position at the start; else 0",
                               "velocity, position or effort, until a command comes", "0.2 * sin(t)"}),
                 other<Joint>("stiffness", "N m/rad or N/m ≥ 0",
                              {"rigid", "effort of a drive by position by the distance to its target", "4e4"}),
                 other<Joint>("damping", "N m s/rad or N s/m ≥ 0",
                              {"0; a drive by velocity is rigid", "effort by the difference of velocities", "800"}),
                 other<Joint>("effort", "N m or N > 0",
                              {"that of the URDF; 0 there is none", "largest effort of the drive", "2000"}),
                 other<Joint>("position", "angle or length",
                              {"0; of a drive by position where its target begins", "at the start", "30 deg"})})
          .advise({{"velocity", "write drive: velocity, and target"},
                   {"kp", "write stiffness"},
                   {"kd", "write damping"},
                   {"friction", "it is of the joint's dynamics in the URDF"}});
  return keys;
}

}  // namespace mpm
