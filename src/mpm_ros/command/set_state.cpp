#include "mpm_ros/command/set_state.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>

#include "mpm/math/nearest.hpp"
#include "mpm/yaml/source.hpp"
#include "mpm_ros/message/conversions.hpp"

namespace mpm_ros {
namespace {

constexpr std::array kBaseKinds = {"fixed", "free", "moving"};  ///< in the order of mpm::BaseKind

bool is_given(const geometry_msgs::Pose& pose) {
  const auto& q = pose.orientation;
  return !(q.x == 0.0 && q.y == 0.0 && q.z == 0.0 && q.w == 0.0);
}

std::string text_of(const mpm::Pose& pose) {
  const auto& q = pose.orientation;
  // With a unit, since those of the scene may be others.
  return fmt::format(
      "{{position: [{:.17g} m, {:.17g} m, {:.17g} m], quaternion: [{:.17g}, {:.17g}, {:.17g}, {:.17g}]}}",
      pose.position.x(), pose.position.y(), pose.position.z(), q.x(), q.y(), q.z(), q.w());
}

/// The override of a joint's position at the start.
std::string joint_override(const mpm::RobotDefinition& robot, const std::string& name, double position,
                           std::string& problem) {
  std::vector<std::string> names;
  for (const mpm::JointDefinition& joint : robot.joints) names.push_back(robot.model.joints[joint.joint].name);
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    problem = fmt::format("robot '{}': no joint '{}' can be set; {}", robot.name, name, mpm::suggest(name, names));
    return {};
  }
  const mpm::ModelJoint& model = robot.model.joints[robot.model.find_joint(name)];
  if (!(position >= model.lower && position <= model.upper)) {
    problem = fmt::format("robot '{}': joint '{}' is to begin at {:g}, outside its limits from {:g} to {:g}",
                          robot.name, name, position, model.lower, model.upper);
    return {};
  }
  return fmt::format("robots.{}.joints.{}.position={:.17g} {}", robot.name, name, position,
                     model.kind == mpm::ModelJoint::Kind::prismatic ? "m" : "rad");
}

/// The override of a base's pose at the start, which keeps what the scene says of it beside.
std::string base_override(const mpm::RobotDefinition& robot, const mpm::Pose& pose, const mpm::Scene& scene) {
  const YAML::Node base = mpm::node_at(YAML::Load(scene.text), fmt::format("robots.{}.base", robot.name));
  if (base && base.IsMap()) return fmt::format("robots.{}.base.pose={}", robot.name, text_of(pose));
  return fmt::format("robots.{}.base={{kind: {}, pose: {}}}", robot.name,
                     kBaseKinds[static_cast<std::size_t>(robot.base.kind)], text_of(pose));
}

}  // namespace

mpm::StateSet read_state(const SetState::Request& request, const std::string& world_frame, std::string& problem) {
  mpm::StateSet state;
  state.name = request.model_name;
  if (!request.reference_frame.empty() && request.reference_frame != world_frame) {
    problem = fmt::format("reference_frame is '{}'; states are set in '{}' alone, so transform it first",
                          request.reference_frame, world_frame);
  }
  if (is_given(request.pose)) {
    if (problem.empty()) problem = problem_of(request.pose);
    if (problem.empty()) problem = problem_of(request.twist);
    state.pose = from_message(request.pose);
    state.twist = from_message(request.twist);
  }
  state.joints = request.joint_names;
  state.positions = request.joint_positions;
  state.velocities = request.joint_velocities;
  return state;
}

StateSet to_message(const mpm::StateSet& state, std::int64_t effect, const std::string& world_frame,
                    const Stamps& stamps) {
  StateSet message;
  message.header.stamp = stamps.at(effect);
  message.header.frame_id = world_frame;
  message.model_name = state.name;
  if (state.pose) message.pose = to_message(*state.pose);
  message.twist = to_message(state.twist);
  message.joint_names = state.joints;
  message.joint_positions = state.positions;
  message.joint_velocities = state.velocities;
  message.effect_ns = effect;
  return message;
}

mpm::StateSet from_message(const StateSet& message) {
  mpm::StateSet state;
  state.name = message.model_name;
  if (is_given(message.pose)) state.pose = from_message(message.pose);
  state.twist = from_message(message.twist);
  state.joints = message.joint_names;
  state.positions = message.joint_positions;
  state.velocities = message.joint_velocities;
  return state;
}

std::vector<std::string> start_overrides(const std::vector<StateSet>& robots, const mpm::Scene& scene,
                                         std::string& problem) {
  std::vector<std::string> overrides;
  std::vector<std::string> names;
  for (const mpm::RobotDefinition& robot : scene.definition.robots) names.push_back(robot.name);
  for (const StateSet& start : robots) {
    const auto found = std::find(names.begin(), names.end(), start.model_name);
    if (found == names.end()) {
      problem = fmt::format("there is no robot '{}'; {}", start.model_name,
                            names.empty() ? "the scene has none" : mpm::suggest(start.model_name, names));
      return {};
    }
    const mpm::RobotDefinition& robot = scene.definition.robots[static_cast<std::size_t>(found - names.begin())];
    if (start.joint_positions.size() != start.joint_names.size()) {
      problem = fmt::format("robot '{}': {} joints and {} positions; give one a joint", robot.name,
                            start.joint_names.size(), start.joint_positions.size());
      return {};
    }
    for (std::size_t j = 0; j < start.joint_names.size(); ++j) {
      overrides.push_back(joint_override(robot, start.joint_names[j], start.joint_positions[j], problem));
      if (!problem.empty()) return {};
    }
    if (!is_given(start.pose)) continue;
    problem = problem_of(start.pose);
    if (!problem.empty()) {
      problem = fmt::format("robot '{}': the pose of its base: {}", robot.name, problem);
      return {};
    }
    overrides.push_back(base_override(robot, checked_pose(start.pose), scene));
  }
  return overrides;
}

}  // namespace mpm_ros
