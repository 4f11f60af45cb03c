// Every shipped scene as a user runs it: to a bag, tables and files for ParaView, for two sync periods; and what
// --explain says of it.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "mpm/scene/scene.hpp"
#include "mpm_ros/report/temporary_folder.hpp"
#include "mpm_ros/run/run_scene.hpp"

namespace mpm_ros::test {
namespace shipped_outputs_test {

/// A million particles and more: half a minute each, and more; the others take 0.1 to 3 s each.
const std::set<std::string> kLarge = {"rover_wheel_terrain", "speed_block_3d_million"};

void expect_runs(const std::string& scene) {
  const TemporaryFolder folder;
  RunSceneOptions options;
  options.scene = scene;
  options.threads = 2;
  options.end = std::to_string(1.5e-9 * static_cast<double>(mpm::load_scene(scene).definition.time.sync));
  options.bag = folder.file("run.bag");
  options.csv = folder.file("csv");
  options.vtk = folder.file("vtk");
  options.summary = folder.file("summary.json");
  std::ostringstream out, err;
  EXPECT_EQ(run_scene(options, out, err, false, [] { return false; }), RunSceneResult::done) << err.str();
  for (const char* file : {"run.bag", "csv/solver_state.csv", "vtk/run.pvd", "summary.json"}) {
    EXPECT_GT(std::filesystem::file_size(folder.file(file)), 100U) << file;
  }
}

class ShippedScene : public testing::TestWithParam<std::string> {};

TEST_P(ShippedScene, RunsToEveryOutput) { expect_runs(GetParam()); }

std::vector<std::string> names() {
  std::vector<std::string> names;
  for (const auto& [name, line] : mpm::shipped_scenes()) {
    if (kLarge.count(name) == 0) names.push_back(name);
  }
  return names;
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShippedScene, testing::ValuesIn(names()), [](const auto& info) { return info.param; });

TEST(FullShippedScene, TheLargeOnesRunToEveryOutput) {
  for (const std::string& scene : kLarge) expect_runs(scene);
}

}  // namespace shipped_outputs_test
}  // namespace mpm_ros::test
