// A scene whose ground comes in a message: the node waits for it, and what it records runs again without it.
#include <mpm_ros/HeightMap.h>

#include <cmath>

#include "simulator_process.hpp"

namespace mpm_ros::test {
namespace terrain_node_test {

constexpr const char* kTerrainScene = R"yaml(
geometry: solid
grid: {cell: 0.1, min: [0, 0, 0], max: [1, 1, 1]}
time: {end: 0.1, sync: 0.01}
gravity: [0, 0, -9.81]
materials: [{name: soft, law: neo_hookean, density: 1000, young: 1 MPa, poisson: 0.3}]
bodies: [{name: soil, material: soft, shape: {height_field: {topic: /hills, bottom: 0.1}}}]
boundaries: {all: slip}
)yaml";

HeightMap hills() {
  HeightMap map;
  map.resolution = 0.5;
  map.columns = map.rows = 3;
  map.origin.z = 0.1;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) map.heights.push_back(0.25F + 0.1F * i + 0.07F * j);
  }
  return map;
}

class Terrain : public ::testing::Test {
 protected:
  void SetUp() override { std::ofstream(scene_) << kTerrainScene; }
  TemporaryFolder folder_;
  const std::string scene_ = folder_.file("terrain.yaml");
  ros::Publisher publisher_ = ros::NodeHandle().advertise<HeightMap>("/hills", 1, true);
};

TEST_F(Terrain, StartsWithTheMessageAndRunsAgainWithoutIt) {
  const std::string bag = folder_.file("run.bag");
  SimulatorProcess simulator({"scene:=" + scene_, "pacing:=lockstep", "record:=" + bag});
  ASSERT_TRUE(eventually([&] {
    return simulator.log().find("waits for the heights of 'soil' on /hills") != std::string::npos;
  })) << simulator.log();
  EXPECT_FALSE(ros::service::exists(simulator.name("step"), false));
  publisher_.publish(hills());
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  EXPECT_TRUE(eventually([&] {
    return simulator.log().find("has the heights of 'soil' from /hills") != std::string::npos;
  })) << simulator.log();
  EXPECT_TRUE(simulator.step(2).success);
  simulator.signal(SIGTERM);
  EXPECT_EQ(simulator.wait(), 0) << simulator.log();
  // Places of columns 0.05 m apart, with centres below 0.35 + 0.2 x + 0.14 y and above 0.1 m, and of each column at
  // most one more, which the surface cuts.
  std::uint64_t expected = 0;
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < 20; ++j) {
      for (int k = 2; k < 20; ++k)
        expected += 0.05 * (k + 0.5) < 0.35 + 0.2 * 0.05 * (i + 0.5) + 0.14 * 0.05 * (j + 0.5) ? 1 : 0;
    }
  }
  EXPECT_GE(last_state_in(bag).particles, expected);
  EXPECT_LE(last_state_in(bag).particles, expected + 20 * 20);
  ProgramProcess again("run_scene", {"--from-bag", bag}, kNoNode);
  EXPECT_EQ(again.wait(), 0) << again.log();
  ProgramProcess alone("run_scene", {scene_}, kNoNode);
  EXPECT_EQ(alone.wait(), 2);
  EXPECT_NE(alone.log().find("run the simulator's node, or write file"), std::string::npos) << alone.log();
}

TEST_F(Terrain, AMapThatIsNoneEndsTheNodeAndASignalEndsItsWait) {
  HeightMap map = hills();
  map.heights[4] = std::nanf("");
  publisher_.publish(map);
  SimulatorProcess hole({"scene:=" + scene_, "pacing:=lockstep"});
  EXPECT_EQ(hole.wait(), 2) << hole.log();
  EXPECT_NE(hole.log().find("have no height, the first at x = 0.5 m, y = 0.5 m"), std::string::npos) << hole.log();
  map.heights.pop_back();
  publisher_.publish(map);
  SimulatorProcess small({"scene:=" + scene_, "pacing:=lockstep"});
  EXPECT_EQ(small.wait(), 2) << small.log();
  EXPECT_NE(small.log().find("the map of heights on /hills has 8 heights for 3 x 3 points"), std::string::npos)
      << small.log();
  publisher_.shutdown();
  SimulatorProcess waiting({"scene:=" + scene_, "pacing:=lockstep"});
  ASSERT_TRUE(eventually([&] { return waiting.log().find("waits for the heights") != std::string::npos; }));
  waiting.signal(SIGTERM);
  EXPECT_EQ(waiting.wait(), 0) << waiting.log();
}

}  // namespace terrain_node_test
}  // namespace mpm_ros::test
