// output.first and output.period: the sync points that they require, and refusals.
#include <gtest/gtest.h>

#include <cmath>

#include "mpm/scene/scene.hpp"

namespace mpm {
namespace scene_output_test {

Scene with_output(const std::string& time, const std::string& output) {
  return parse_scene(R"(geometry: plane_strain
grid: {cell: 0.1, min: [0, 0], max: [1, 1]}
materials: [{name: foam, density: 1000, law: neo_hookean, young: 0.1 MPa, poisson: 0.3}]
bodies: [{name: block, material: foam, shape: {box: {min: [0.2, 0.2], max: [0.4, 0.4]}}}]
time: )" + time +
                         "\noutput: " + output + "\n",
                     "scene.yaml");
}

std::string refusal(const std::string& time, const std::string& output) {
  try {
    with_output(time, output);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "not refused";
}

TEST(SceneOutput, SyncPointsHitTheFirstSnapshotAndThePeriod) {
  EXPECT_EQ(with_output("{end: 1}", "{period: 0.02}").output.first, 0.0);
  const Scene scene = with_output("{end: 1}", "{period: 0.02, first: 50 ms}");
  EXPECT_EQ(scene.output.first, 0.05);
  // The greatest common divisor of both is 10 ms, which is not above the default limit of 10 ms.
  EXPECT_EQ(scene.definition.time.sync, 10'000'000);
  // For 20 and 35 ms it is 5 ms.
  EXPECT_EQ(with_output("{end: 1}", "{period: 0.02, first: 0.035}").definition.time.sync, 5'000'000);
  EXPECT_EQ(with_output("{end: 1, sync: 5 ms}", "{period: 0.02, first: 0.035}").output.first, 0.035);
}

TEST(SceneOutput, AFirstSnapshotBetweenSyncPointsIsRefused) {
  EXPECT_EQ(refusal("{end: 1, sync: 10 ms}", "{period: 0.02, first: 0.035}"),
            "scene.yaml:6: output.first: 0.035 s is not a whole number of sync periods of 0.01 s; write 0.04 s");
  const std::string far = refusal("{end: 1}", "{period: 0.02, first: 0.035000001}");
  EXPECT_EQ(far.find("scene.yaml:6: output.first: "), 0U) << far;
  EXPECT_EQ(refusal("{end: 1}", "{first: -1}").find("scene.yaml:6: output.first: "), 0U);
}

}  // namespace scene_output_test
}  // namespace mpm
