#include "mpm_ros/record/ground_outputs.hpp"

#include "mpm_ros/message/ground_messages.hpp"
#include "mpm_ros/message/topics.hpp"

namespace mpm_ros {

GroundOutputs::GroundOutputs(const mpm::Simulation& simulation, OutputSinks& sinks, const LocalFrame& frame,
                             const std::optional<mpm::GroundOutput>& ground)
    : simulation_(simulation), sinks_(sinks), frame_(frame) {
  if (ground) record_.emplace(simulation, *ground);
}

void GroundOutputs::write(bool all) {
  written_at_ = simulation_.time();
  if (!record_) return;
  bool anyone = false;
  for (const char* topic : {topics::kTerrain, topics::kTerrainCloud, topics::kTerrainImage})
    anyone = anyone || sinks_.wanted(topic);
  if (!simulation_.on_any_rank(anyone)) return;
  if (!record_->look(simulation_, all)) return;
  if (sinks_.wanted(topics::kTerrain)) {
    HeightMap message = to_message(record_->map(), simulation_.definition().grid.min.z());
    message.header = sinks_.header();
    sinks_.put(topics::kTerrain, message);
  }
  if (sinks_.wanted(topics::kTerrainCloud)) {
    sensor_msgs::PointCloud2 cloud = to_cloud(record_->map(), record_->before(), frame_);
    cloud.header = sinks_.header(frame_.name);
    sinks_.put(topics::kTerrainCloud, cloud);
  }
  if (sinks_.wanted(topics::kTerrainImage)) {
    sensor_msgs::Image image = to_image(record_->map());
    image.header = sinks_.header();
    sinks_.put(topics::kTerrainImage, image);
  }
}

void GroundOutputs::serialise(mpm::StateArchive& archive) {
  std::uint64_t grounds = record_ ? 1 : 0;
  archive.value("grounds", grounds);
  if (!record_ || grounds == 0) return;
  const mpm::StateArchive::Group group(archive, "ground");
  record_->serialise(archive);
}

}  // namespace mpm_ros
