// Rule by which `method: auto` takes implicit steps (advice/implicit_choice.hpp). 0.1 s.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "mpm/scene/scene.hpp"

namespace implicit_choice_test {

// A blade in sand that moves across gravity.
constexpr const char* kScene = R"yaml(
geometry: plane_strain
gravity: [0, -9.81]
grid: {cell: 0.05, min: [0, 0], max: [2, 0.6]}
time: {end: 1, sync: 0.02}
materials: [{name: sand, law: drucker_prager, density: 1600, young: 1 MPa, poisson: 0.3, friction_angle: 30 deg}]
bodies: [{name: bed, material: sand, shape: {box: {min: [0, 0], max: [2, 0.3]}}}]
rigid_bodies: [{name: tool, shape: {box: {size: [0.15, 0.2]}}, pose: {position: [0.2, 0.35]}, friction: 0.3,
  motion: {velocity: [0.4, "-0.04 * max(0, 1 - t)"]}}]
boundaries: {all: slip}
)yaml";

mpm::Scene read(const std::vector<std::string>& overrides) { return mpm::parse_scene(kScene, "scene", overrides); }
bool takes_implicit(const std::vector<std::string>& overrides) {
  return read(overrides).definition.method.update == mpm::UpdateScheme::implicit;
}

TEST(ImplicitChoice, TakesThemForSlowToolsInSoil) {
  EXPECT_TRUE(takes_implicit({}));
  EXPECT_TRUE(takes_implicit({"method={auto: {}, precision: single}"}));
  EXPECT_TRUE(takes_implicit({"method={auto: {}, transfer: apic}"}));
  EXPECT_TRUE(takes_implicit({"materials.sand.law=mohr_coulomb"}));
  // A wheel.
  EXPECT_TRUE(takes_implicit(
      {"rigid_bodies.tool.free={mass: 5, axes: [x, z]}", "rigid_bodies.tool.motion={rotation_rate: 2}"}));
  // On a finer grid too, where the tool crosses a cell in half of the usual step.
  EXPECT_TRUE(takes_implicit({"grid.cell=0.002", "rigid_bodies.tool.motion={velocity: [0.4, 0]}"}));
  // A tool that commands move, of which the scene says what it is.
  EXPECT_TRUE(takes_implicit({"rigid_bodies.tool.motion={}", "target={real_time: 1, tool: blade, length: 0.1}"}));
}

TEST(ImplicitChoice, LeavesExplicitStepsToAllElse) {
  const std::vector<std::vector<std::string>> others = {
      {"method={update: usavg}"},
      {"method={precision: single}"},
      {"method={auto: {strain: 0.1}}"},
      {"method={auto: {}, shape: cpdi}"},
      {"rigid_bodies.tool.motion={velocity: [0.05, -0.1]}"},                   // pressed down
      {"rigid_bodies.tool.motion={}"},                                         // by commands
      {"rigid_bodies.tool.motion={velocity: [0.4, \"t < 0.5 ? -0.3 : 0\"]}"},  // pressed in, then drawn
      {"rigid_bodies.tool.free={mass: 5}", "rigid_bodies.tool.motion={}"},     // falls
      {"rigid_bodies.tool.motion={velocity: [6, 0]}"},                         // a fifth of the waves
      {"rigid_bodies.tool.shape={plane: {normal: [0, -1]}}"},
      {"rigid_bodies=[]"},
      {"gravity=[0, 0]"},
      {"time.step=0.001"},  // a single explicit step is as long
      {"grid.cell=0.4", "grid.max=[2, 0.8]"},
      {"materials=[{name: sand, law: neo_hookean, density: 1000, young: 1 MPa, poisson: 0.3}]"},
      {"materials=[{name: sand, law: j2_plasticity, density: 1600, young: 1 MPa, poisson: 0.3, yield_stress: 2 kPa}]"},
      {"materials=[{name: sand, law: mu_i, density: 1500, young: 1 MPa, poisson: 0.3, mu_s: 0.38, mu_2: 0.64, I_0: "
       "0.28, "
       "grain_diameter: 1 mm, grain_density: 2500}]"},
      {"boundaries.x_min=absorbing"}};
  for (const auto& overrides : others) EXPECT_FALSE(takes_implicit(overrides)) << overrides.front();
}

// With them go their transfer and their step, and a scene that is read again is the same.
TEST(ImplicitChoice, BringsWhatBelongsToThem) {
  const mpm::Scene scene = read({});
  EXPECT_EQ(scene.definition.method.transfer.flip, 0.95);
  EXPECT_EQ(scene.definition.time.step, 0.01);
  int transfers = 0;
  for (const auto& [key, why] : scene.choices) transfers += key == "method.transfer" ? 1 : 0;
  EXPECT_EQ(transfers, 0);  // it stands with the method
  const mpm::Scene again = mpm::parse_scene(scene.text, "scene", {});
  EXPECT_EQ(again.definition.method.update, mpm::UpdateScheme::implicit);
  EXPECT_EQ(again.definition.method.transfer.flip, 0.95);
  EXPECT_EQ(again.definition.time.step, 0.01);
  EXPECT_EQ(read({"time.step=0.02"}).definition.time.step, 0.02);
}

}  // namespace implicit_choice_test
