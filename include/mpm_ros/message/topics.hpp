// Names of topics and services, relative to the node's namespace unless they begin with a slash.
#pragma once

#include <array>
#include <string>

namespace mpm_ros::topics {

constexpr const char* kParticles = "particles";
constexpr const char* kContactForces = "contact_forces";
constexpr const char* kBodies = "bodies";
constexpr const char* kRobots = "robots";             ///< joints, sensors and energies of all
constexpr const char* kJointStates = "joint_states";  ///< joints of each robot
constexpr const char* kJointCommand = "joint_command";
constexpr const char* kJointTrajectory = "joint_trajectory";
constexpr const char* kJointCommands = "joint_commands";  ///< as they were applied
constexpr const char* kStatesSet = "states_set";          ///< by the service set_state
constexpr const char* kCommands = "commands";
constexpr const char* kSolverState = "solver_state";
constexpr const char* kGlobalQuantities = "global_quantities";
constexpr const char* kCracks = "cracks";
constexpr const char* kCrackMarkers = "crack_markers";  ///< a line a face
constexpr const char* kVolumes = "volumes";
constexpr const char* kTerrain = "terrain";             ///< heights of the ground, latched
constexpr const char* kTerrainCloud = "terrain_cloud";  ///< the same as points, with the change since the start
constexpr const char* kTerrainImage = "terrain_image";  ///< the same as an image
constexpr const char* kRunInfo = "run_info";
constexpr const char* kMarkers = "markers";             ///< shapes of the rigid bodies, latched
constexpr const char* kForceMarkers = "force_markers";  ///< an arrow a body
constexpr const char* kClock = "/clock";
constexpr const char* kTf = "/tf";
constexpr const char* kTfStatic = "/tf_static";  ///< latched; of scenes far from the origin alone (local_frame.hpp)

constexpr const char* kPause = "pause";
constexpr const char* kReset = "reset";
constexpr const char* kResetWith = "reset_with";
constexpr const char* kStep = "step";
constexpr const char* kSetState = "set_state";
constexpr const char* kSaveCheckpoint = "save_checkpoint";
constexpr const char* kLoadCheckpoint = "load_checkpoint";

/// `robots/<name>/<leaf>`
inline std::string of_robot(const std::string& robot, const std::string& leaf) {
  return std::string(kRobots) + "/" + robot + "/" + leaf;
}
/// `robots/<name>/base/<leaf>`, of a base that moves
inline std::string of_base(const std::string& robot, const std::string& leaf) {
  return of_robot(robot, "base/" + leaf);
}
/// True for a robot's link, whose name as a rigid body is `<robot>/<link>`.
inline bool is_link(const std::string& body) { return body.find('/') != std::string::npos; }
/// `bodies/<name>/<leaf>`, or of a robot's link `robots/<robot>/links/<link>/<leaf>`
inline std::string of_body(const std::string& body, const std::string& leaf) {
  const std::size_t slash = body.find('/');
  if (slash != std::string::npos) {
    return of_robot(body.substr(0, slash), "links/" + body.substr(slash + 1) + "/" + leaf);
  }
  return std::string(kBodies) + "/" + body + "/" + leaf;
}
constexpr const char* kWrench = "wrench";
constexpr const char* kWrenchFiltered = "wrench_filtered";
constexpr const char* kCmdVel = "cmd_vel";
constexpr const char* kCmdVelStamped = "cmd_vel_stamped";
constexpr const char* kCmdVelBody = "cmd_vel_body";
constexpr const char* kCmdWrench = "cmd_wrench";
constexpr const char* kCmdWrenchStamped = "cmd_wrench_stamped";
constexpr const char* kCmdPose = "cmd_pose";

/// All services of the node.
constexpr std::array<const char*, 7> kServices{kPause,    kReset,          kResetWith,     kStep,
                                               kSetState, kSaveCheckpoint, kLoadCheckpoint};

/// Names that come after the body's on the topics of its commands.
constexpr std::array<const char*, 6> kCommandLeaves{kCmdVel,    kCmdVelStamped,    kCmdVelBody,
                                                    kCmdWrench, kCmdWrenchStamped, kCmdPose};

}  // namespace mpm_ros::topics
