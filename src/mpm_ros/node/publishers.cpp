#include "mpm_ros/node/publishers.hpp"

#include "mpm_ros/message/topics.hpp"

namespace mpm_ros {

namespace {

// Messages that a subscriber may fall behind: enough for a second of small ones at 1 kHz, a few clouds.
constexpr std::uint32_t kSmall = 1000;
constexpr std::uint32_t kLarge = 10;

}  // namespace

Publishers::Publishers(ros::NodeHandle node, const std::vector<std::string>& bodies, bool filtered) : node_(node) {
  publishers_[topics::kRunInfo] = node.advertise<RunInfo>(topics::kRunInfo, 1, true);
  publishers_[topics::kMarkers] = node.advertise<visualization_msgs::MarkerArray>(topics::kMarkers, 1, true);
  publishers_[topics::kSolverState] = node.advertise<SolverState>(topics::kSolverState, kSmall, true);
  publishers_[topics::kForceMarkers] = node.advertise<visualization_msgs::MarkerArray>(topics::kForceMarkers, kSmall);
  publishers_[topics::kContactForces] = node.advertise<ContactForces>(topics::kContactForces, kSmall);
  publishers_[topics::kBodies] = node.advertise<BodyStates>(topics::kBodies, kSmall);
  publishers_[topics::kTf] = node.advertise<tf2_msgs::TFMessage>(topics::kTf, kSmall);
  publishers_[topics::kParticles] = node.advertise<sensor_msgs::PointCloud2>(topics::kParticles, kLarge);
  publishers_[topics::kCommands] = node.advertise<Command>(topics::kCommands, kSmall);
  publishers_[topics::kStatesSet] = node.advertise<StateSet>(topics::kStatesSet, kSmall);
  for (const std::string& body : bodies) {
    const std::string topic = topics::of_body(body, topics::kWrench);
    publishers_[topic] = node.advertise<geometry_msgs::WrenchStamped>(topic, kSmall);
    if (!filtered) continue;
    const std::string smooth = topics::of_body(body, topics::kWrenchFiltered);
    publishers_[smooth] = node.advertise<geometry_msgs::WrenchStamped>(smooth, kSmall);
  }
}

void Publishers::add_global() {
  ros::Publisher& publisher = publishers_[topics::kGlobalQuantities];
  if (!publisher) publisher = node_.advertise<GlobalQuantities>(topics::kGlobalQuantities, kSmall);
}

void Publishers::add_static_frames() {
  ros::Publisher& publisher = publishers_[topics::kTfStatic];
  if (!publisher) publisher = node_.advertise<tf2_msgs::TFMessage>(topics::kTfStatic, 1, true);
}

void Publishers::add_cracks() {
  if (publishers_.count(topics::kCracks) > 0) return;
  publishers_[topics::kCracks] = node_.advertise<Cracks>(topics::kCracks, kSmall);
  publishers_[topics::kCrackMarkers] = node_.advertise<visualization_msgs::MarkerArray>(topics::kCrackMarkers, kLarge);
}

void Publishers::add_robot(const mpm::RobotDefinition& robot) {
  ros::Publisher& commands = publishers_[topics::kJointCommands];
  if (!commands) commands = node_.advertise<JointCommand>(topics::kJointCommands, kSmall);
  ros::Publisher& all = publishers_[topics::kRobots];
  if (!all) all = node_.advertise<RobotStates>(topics::kRobots, kSmall);
  const std::string joints = topics::of_robot(robot.name, topics::kJointStates);
  ros::Publisher& states = publishers_[joints];
  if (!states) states = node_.advertise<sensor_msgs::JointState>(joints, kSmall);
  for (const mpm::SensorDefinition& sensor : robot.sensors) {  // a reset may bring others
    const std::string topic =
        topics::of_robot(robot.name, "sensors/" + robot.model.joints[sensor.joint].name + "/wrench");
    ros::Publisher& wrench = publishers_[topic];
    if (!wrench) wrench = node_.advertise<geometry_msgs::WrenchStamped>(topic, kSmall);
  }
}

void Publishers::add_volumes() {
  ros::Publisher& publisher = publishers_[topics::kVolumes];
  if (!publisher) publisher = node_.advertise<Volumes>(topics::kVolumes, kSmall);
}

void Publishers::add_ground() {
  if (publishers_.count(topics::kTerrain) > 0) return;
  publishers_[topics::kTerrain] = node_.advertise<HeightMap>(topics::kTerrain, kLarge, true);
  publishers_[topics::kTerrainCloud] = node_.advertise<sensor_msgs::PointCloud2>(topics::kTerrainCloud, kLarge, true);
  publishers_[topics::kTerrainImage] = node_.advertise<sensor_msgs::Image>(topics::kTerrainImage, kLarge, true);
}

bool Publishers::wants(const std::string& topic) const {
  const ros::Publisher& publisher = publishers_.at(topic);
  return publisher.isLatched() || publisher.getNumSubscribers() > 0;
}

}  // namespace mpm_ros
