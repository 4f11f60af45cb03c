#include "mpm_ros/record/run_scene_csv.hpp"

#include "mpm_ros/message/topics.hpp"

namespace mpm_ros {

CsvSink::CsvSink(const std::string& folder, const Stamps& stamps, bool axisymmetric)
    : stamps_(stamps), tables_(folder, axisymmetric), snapshots_(folder) {}

void CsvSink::close() {
  tables_.close();
  snapshots_.close();
}

bool CsvSink::wants(const std::string& topic) const {
  // The rest repeats these in another form, or is for displays.
  for (const char* table :
       {topics::kContactForces, topics::kBodies, topics::kSolverState, topics::kGlobalQuantities, topics::kCracks,
        topics::kRobots, topics::kParticles, topics::kCommands, topics::kTerrain}) {
    if (topic == table) return true;
  }
  return topic == topics::kMarkers || topic == topics::kTfStatic;
}

void CsvSink::put(const std::string&, const ros::Time& stamp, const ContactForces& message) {
  tables_.contact_forces(stamps_.time_of(stamp), message);
}
void CsvSink::put(const std::string&, const ros::Time& stamp, const BodyStates& message) {
  tables_.bodies(stamps_.time_of(stamp), message);
}
void CsvSink::put(const std::string&, const ros::Time& stamp, const SolverState& message) {
  tables_.solver_state(stamps_.time_of(stamp), message);
}
void CsvSink::put(const std::string&, const ros::Time& stamp, const GlobalQuantities& message) {
  tables_.global_quantities(stamps_.time_of(stamp), message);
}
void CsvSink::put(const std::string&, const ros::Time& stamp, const Cracks& message) {
  tables_.cracks(stamps_.time_of(stamp), message);
}
void CsvSink::put(const std::string&, const ros::Time& stamp, const RobotStates& message) {
  tables_.robots(stamps_.time_of(stamp), message);
}
void CsvSink::put(const std::string&, const ros::Time& stamp, const Command& message) {
  tables_.command(stamps_.time_of(stamp), message);
}
void CsvSink::put(const std::string&, const ros::Time& stamp, const sensor_msgs::PointCloud2& message) {
  const auto origin = origins_.find(message.header.frame_id);
  const std::int64_t time = stamps_.time_of(stamp);
  if (origin == origins_.end()) return snapshots_.particles(time, message);
  snapshots_.particles(time, in_world(message, origin->second));
}
void CsvSink::put(const std::string&, const ros::Time& stamp, const HeightMap& message) {
  tables_.terrain(stamps_.time_of(stamp), message);
}
void CsvSink::put(const std::string&, const ros::Time&, const visualization_msgs::MarkerArray& message) {
  tables_.markers(message);
}
void CsvSink::put(const std::string&, const ros::Time&, const tf2_msgs::TFMessage& message) {
  origins_ = origins_of(message);
}

}  // namespace mpm_ros
