#include "mpm_ros/node/frame_start.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <yaml-cpp/yaml.h>

#include "mpm/scene/scene_text.hpp"
#include "mpm/yaml/source.hpp"

namespace mpm_ros {

std::vector<FrameStart> frame_starts(const std::string& name_or_path, const std::vector<std::string>& overrides) {
  const mpm::SceneText scene = mpm::read_scene_text(name_or_path);
  const mpm::Source source(scene.text, scene.path, overrides);
  std::vector<FrameStart> found;
  const YAML::Node list = source.root()["rigid_bodies"];
  for (std::size_t i = 0; list && list.IsSequence() && i < list.size(); ++i) {
    if (!list[i].IsMap() || !list[i]["drive"] || list[i]["pose"]) continue;
    const std::string name = mpm::element_name(list, i);
    found.push_back({name, fmt::format("rigid_bodies.{}.pose", name)});
  }
  const YAML::Node robots = source.root()["robots"];
  for (std::size_t i = 0; robots && robots.IsSequence() && i < robots.size(); ++i) {
    if (!robots[i].IsMap()) continue;
    const YAML::Node base = robots[i]["base"];
    if (!base || !base.IsMap() || !base["drive"] || base["pose"]) continue;
    const std::string name = mpm::element_name(robots, i);
    found.push_back({name, fmt::format("robots.{}.base.pose", name)});
  }
  return found;
}

std::string pose_override(const FrameStart& start, const mpm::Pose& pose, mpm::GeometryKind geometry) {
  std::vector<std::string> position;
  const auto beside = mpm::axes_beside(geometry);
  for (int axis = 0; axis < 3; ++axis) {
    bool counts = true;
    for (const int other : beside) counts = counts && other != axis;
    // With a unit, since those of the scene may be others.
    if (counts) position.push_back(fmt::format("{:.17g} m", pose.position[axis]));
  }
  std::string text = fmt::format("{}={{position: [{}]", start.path, fmt::join(position, ", "));
  if (pose.orientation.vec().squaredNorm() > 0.0) {
    const auto& q = pose.orientation;
    text += fmt::format(", quaternion: [{:.17g}, {:.17g}, {:.17g}, {:.17g}]", q.x(), q.y(), q.z(), q.w());
  }
  return text + "}";
}

std::string recorded_pose(const FrameStart& start, const std::string& scene_text) {
  const YAML::Node pose = mpm::node_at(YAML::Load(scene_text), start.path);
  if (!pose || !pose.IsMap()) return {};
  YAML::Node copy = YAML::Clone(pose);
  copy.SetStyle(YAML::EmitterStyle::Flow);
  return fmt::format("{}={}", start.path, YAML::Dump(copy));
}

}  // namespace mpm_ros
