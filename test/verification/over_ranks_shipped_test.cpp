// Every shipped scene over 1, 2, 3 and 8 ranks: as on one process over a hundred steps or more.
//
// Scenes run as they are shipped, but for: cells of the scene of a million particles, which are coarser; the rover's
// soil, of which there is less before its wheel, in double precision (doc/ranks.md); and a probe that waits for
// commands, which presses. Those in which soil sleeps run awake, too, on coarser cells, a blade with one side.
//
// What is computed in single precision is asked to agree to its last places, and to 1e-10 in double precision.
// Cost: 7 min on two processors, of which the rover takes 3 and scenes that measure speed 1.
#include <gtest/gtest.h>

#include "over_ranks_run.hpp"

namespace verification {
namespace over_ranks {
namespace over_ranks_shipped_test {

// Each rank settles all of the soil, so it does not settle for long.
std::vector<std::string> awake(std::vector<std::string> overrides, const std::vector<std::string>& bodies) {
  overrides.emplace_back("sleep=off");
  for (const std::string& body : bodies) overrides.push_back("bodies." + body + ".initial.geostatic.residual=0.05");
  return overrides;
}

const std::vector<std::string> kBlade =
    awake({"rigid_bodies.blade.sides=one", "grid.cell=0.07"}, {"cut", "bed", "lower_step", "upper_step"});
const std::vector<std::string> kWheel = {"grid.max=[1.2, 0.6, 0.8]", "method.precision=double"};
const std::vector<std::string> kWheelAwake = awake({"grid.cell=0.08"}, {"soil"});
const std::vector<std::string> kTouching = {"rigid_bodies.probe.pose.position=[0, 120.5 mm]",
                                            R"(rigid_bodies.probe.motion={velocity: [0, "-0.5"]})"};

/// Changes of a scene.
std::vector<Case> cases_of(const std::string& name) {
  if (name == "speed_block_3d_million") return {{name, {"grid.cell=0.04"}}};
  if (name == "foam_probe") return {{name, kTouching}};
  if (name == "blade_in_soil") return {{name, {}}, {name, kBlade, 150}};
  if (name == "rover_wheel_terrain") return {{name, kWheel}, {name, kWheelAwake}};
  if (name == "column_collapse") return {{name, {}, 1000}};  // to its end
  return {{name, {}}};
}

std::vector<std::string> names() {
  std::vector<std::string> list;
  for (const auto& [name, line] : mpm::shipped_scenes()) list.push_back(name);
  return list;
}

void expect_same_on_all(const Case& run, double part) {
  const Outcome process = run_alone(run);
  for (const int count : {1, 2, 3, 8}) {
    SCOPED_TRACE(count);
    expect_equal(run_over(run, count), process, part);
  }
}

class ShippedScene : public testing::TestWithParam<std::string> {};

TEST_P(ShippedScene, MovesAsOnOneProcess) {
  for (Case run : cases_of(GetParam())) {
    if (scene_of(run).definition.method.precision == mpm::Precision::float32) {
      // A sum that differs in the last place of a double moves a float by its last place, 6e-8 of a velocity. Under the
      // wheel there are grains that part: in one process a friction that differs in the last place of a float moves one
      // of them by 4e-6.
      expect_same_on_all(run, GetParam() == "rover_wheel_terrain" ? 1e-5 : 1e-6);
      run.overrides.push_back("method.precision=double");
    }
    expect_same_on_all(run, 1e-10);
  }
}

INSTANTIATE_TEST_SUITE_P(Full, ShippedScene, testing::ValuesIn(names()), [](const auto& scene) { return scene.param; });

}  // namespace over_ranks_shipped_test
}  // namespace over_ranks
}  // namespace verification
