// Rigid bodies that follow a tf frame and have no pose in their scene: what their start makes of the scene.
#include "mpm_ros/node/frame_start.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "mpm/scene/scene.hpp"
#include "mpm_ros/report/temporary_folder.hpp"

namespace mpm_ros {
namespace frame_start_test {

std::string scene(const std::string& geometry, const std::string& more) {
  const std::string low = geometry == "solid" ? "[0, 0, 0]" : "[0, 0]",
                    high = geometry == "solid" ? "[1, 1, 1]" : "[1, 1]";
  return "geometry: " + geometry + "\nrigid_bodies: [{name: tool, shape: {sphere: {radius: 0.1}}" + more +
         "}]\ngrid: {cell: 0.1, min: " + low + ", max: " + high +
         "}\nmaterials: [{name: soft, density: 1000, law: neo_hookean, young: 1 MPa, poisson: 0.3}]\n" +
         "bodies: [{name: block, material: soft, shape: {box: {min: " + low + ", max: " + high + "}}}]\n";
}

// Without a pose the body begins at its frame: the node sets it, and it reads as it was meant.
TEST(FrameStart, WithoutAPoseABodyIsPutWhereItsFrameIs) {
  const TemporaryFolder folder;
  const std::string path = folder.file("scene.yaml");
  for (const std::string geometry : {"solid", "plane_strain"}) {
    SCOPED_TRACE(geometry);
    std::ofstream(path) << scene(geometry, ", drive: {tf: tool0}");
    EXPECT_TRUE(frame_starts(path, {"rigid_bodies.tool.pose={position: [0.5, 0.5]}"}).empty());
    const std::vector<FrameStart> starts = frame_starts(path, {});
    ASSERT_EQ(starts.size(), 1U);
    EXPECT_EQ(starts[0].body, "tool");
    const mpm::GeometryKind kind = mpm::load_scene(path).definition.geometry;
    mpm::Pose pose;
    pose.position = {0.1, mpm::planar(kind) ? 0.0 : 0.3, 1.0 / 3.0};
    pose.orientation = Eigen::AngleAxisd(0.7, mpm::Vec3::UnitY());
    const std::string change = pose_override(starts[0], pose, kind);
    const mpm::Scene placed = mpm::load_scene(path, {change});
    EXPECT_EQ(placed.definition.rigid_bodies.at(0).pose.position, pose.position);
    EXPECT_LT(placed.definition.rigid_bodies.at(0).pose.orientation.angularDistance(pose.orientation), 1e-15);
    // A recorded run's text puts it there again, with the same text.
    EXPECT_EQ(mpm::load_scene(path, {recorded_pose(starts[0], placed.text)}).text, placed.text);
    EXPECT_EQ(recorded_pose(starts[0], mpm::load_scene(path).text), "");
  }
  std::ofstream(path) << scene("solid", "");
  EXPECT_TRUE(frame_starts(path, {}).empty());
}

}  // namespace frame_start_test
}  // namespace mpm_ros
