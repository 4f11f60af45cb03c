// Material in volumes: counts by hand of a lattice at rest that volumes stand in and move through. 0.3 s.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm {
namespace volumes_test {

// A block of 20 by 10 particles of 2.5 kg, 0.05 m apart, at rest; a cart above it that touches nothing carries a
// volume through it, from x = 0 ... 0.4 m to 1 ... 1.4 m.
const char* const kCart = R"yaml(
geometry: plane_strain
grid: {cell: 0.1, min: [0, 0], max: [2, 1]}
time: {end: 2, sync: 0.01, step: 5 ms}
materials: [{name: m, law: linear_elastic, density: 1000, young: 1000, poisson: 0.25}]
bodies: [{name: block, material: m, shape: {box: {min: [0.5, 0], max: [1.5, 0.5]}}}]
rigid_bodies:
  - {name: cart, shape: {box: {size: [0.1, 0.1]}}, pose: {position: [0.2, 0.9]}, motion: {velocity: [0.5, 0]}}
volumes:
  - {name: scoop, of: cart, shape: {box: {size: [0.4, 0.4]}}, pose: {position: [0, -0.65]}}
  - {name: left, shape: {box: {size: [1, 1]}}, pose: {position: [0.5, 0.5]}}
  - {name: empty, shape: {sphere: {radius: 0.05}}, pose: {position: [1.9, 0.9]}}
metrics: {carried: {number: scoop_mass}, seen: {number: scoop_mass_in}}
)yaml";

constexpr double kRoundOff = 1e-10;  // bound on that of sums of some hundred masses [kg]

TEST(Volumes, CountWhatIsInThemAndWhatCameAndWent) {
  Simulation simulation(parse_scene(kCart, "cart.yaml"));
  std::vector<VolumeReport> volumes = simulation.volumes();
  ASSERT_EQ(volumes.size(), 3U);
  EXPECT_EQ(volumes[0].mass, 0.0);
  EXPECT_TRUE(std::isnan(volumes[0].centre.z()));
  EXPECT_NEAR(volumes[1].mass, 250.0, kRoundOff);
  while (simulation.time() < nanoseconds_of(2.0)) simulation.advance();
  volumes = simulation.volumes();
  // 8 columns and 8 rows at the end; 18 columns from 0.525 to 1.375 m were passed.
  EXPECT_EQ(volumes[0].name, "scoop");
  EXPECT_NEAR(volumes[0].mass, 160.0, kRoundOff);
  EXPECT_NEAR(volumes[0].volume, 0.16, 1e-12);
  EXPECT_NEAR((volumes[0].centre - Vec3(1.2, 0.0, 0.25)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(volumes[0].mass_in, 360.0, kRoundOff);
  EXPECT_NEAR(volumes[0].mass_out, 200.0, kRoundOff);
  EXPECT_NEAR(volumes[1].mass, 250.0, kRoundOff);
  EXPECT_NEAR((volumes[1].centre - Vec3(0.75, 0.0, 0.25)).norm(), 0.0, 1e-12);
  EXPECT_EQ(volumes[1].mass_in + volumes[1].mass_out, 0.0);
  EXPECT_EQ(volumes[2].mass, 0.0);
  EXPECT_NEAR(simulation.state().number("left_mass"), 250.0, kRoundOff);
  const auto metrics = simulation.metrics();
  EXPECT_NEAR(metrics.at(0).second, 160.0, kRoundOff);
  EXPECT_NEAR(metrics.at(1).second, 360.0, kRoundOff);
}

TEST(Volumes, ASceneWithoutAnyRemembersNothing) {
  const std::string scene(kCart);
  const std::string plain = scene.substr(0, scene.find("volumes:"));
  const Simulation simulation(parse_scene(plain, "cart.yaml"));
  EXPECT_TRUE(simulation.volumes().empty());
  std::vector<double> values;
  EXPECT_THROW(simulation.particle_field("in_volumes", values), DefinitionError);
}

TEST(Volumes, BadOnesSayWhatIsWrong) {
  const auto expect = [](const std::string& volume, const std::string& text) {
    try {
      parse_scene(kCart, "cart.yaml", {"metrics={}", "volumes=[" + volume + "]"});
      ADD_FAILURE() << volume;
    } catch (const SceneError& error) {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  };
  expect("{name: a, of: card, shape: {box: {size: [1, 1]}}}", "no rigid body 'card'; did you mean 'cart'?");
  expect("{name: a}", "shape");
  expect("{name: a, shape: {polygon: {points: [[0, 0], [1, 1], [1, 0], [0, 1]]}}}", "cuts");
  expect("{name: a, shape: {box: {size: [1, 1]}}}, {name: a, shape: {box: {size: [1, 1]}}}", "a second volume 'a'");
  try {
    parse_scene(kCart, "cart.yaml", {"metrics={carried: {number: scoop_mas}}"});
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'scoop_mass'?"), std::string::npos) << error.what();
  }
}

}  // namespace volumes_test
}  // namespace mpm
