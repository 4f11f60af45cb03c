// Warnings of what is possible in a scene and most often not meant: slips of units, ends between sync points, transport
// that sets the pace; and what --explain prints so that they are seen.
#include "mpm/advice/scene_warnings.hpp"

#include <gtest/gtest.h>

#include "mpm/advice/explain.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm {
namespace scene_warnings_test {

const char* const kScene =
    "grid: {cell: 0.05, min: [0, 0, 0], max: [0.4, 0.4, 0.4]}\n"
    "time: {end: 0.1, sync: 0.01}\n"
    "gravity: [0, 0, -10]\n"
    "materials: [{name: foam, density: 100, law: linear_elastic, young: 20 kPa, poisson: 0}]\n"
    "bodies: [{name: block, material: foam, shape: {box: {min: [0.1, 0.1, 0], max: [0.3, 0.3, 0.2]}}}]\n"
    "rigid_bodies: [{name: tool, shape: {box: {size: [0.1, 0.1, 0.1]}}, pose: {position: [0.2, 0.2, 0.3]},\n"
    "  motion: {velocity: [0, 0, \"-0.1*t\"]}, friction: 0.3}]\n"
    "boundaries: {all: slip}\n";

std::vector<std::string> warnings(const std::vector<std::string>& set) {
  return build(parse_scene(kScene, "test.yaml", set)).warnings;
}

void expect_one(const std::vector<std::string>& set, const std::string& start, const std::string& part = "") {
  const std::vector<std::string> found = warnings(set);
  ASSERT_EQ(found.size(), 1U) << set[0];
  EXPECT_EQ(found[0].substr(0, start.size()), start) << found[0];
  EXPECT_NE(found[0].find(part), std::string::npos) << found[0];
}

/// Warnings of a run that are of transport.
std::vector<std::string> of_stages(const Scene& scene) {
  std::vector<std::string> found;
  for (const std::string& warning : Simulation(scene, {1}).warnings()) {
    if (warning.find("stages") != std::string::npos || warning.find("pace") != std::string::npos) {
      found.push_back(warning);
    }
  }
  return found;
}

TEST(SceneWarnings, ASoundSceneHasNone) {
  EXPECT_TRUE(warnings({}).empty());
  EXPECT_TRUE(warnings({"time.end=0.03"}).empty());
}

// Some of them soft, fast or liquid, and meant.
TEST(SceneWarnings, NoShippedSceneHasOne) {
  for (const auto& [name, line] : shipped_scenes()) {
    for (const std::string& warning : scene_warnings(load_scene(name))) ADD_FAILURE() << name << ": " << warning;
  }
}

// Without the warning such a run ends in steps of 1e-16 s.
TEST(SceneWarnings, ASprayOfApicWithSplines) {
  const std::string water = "materials.0={name: foam, law: newtonian_fluid, density: 1000, sound_speed: 25}";
  expect_one({water, "method={shape: bspline2, transfer: apic}"}, "body 'block': with apic and bspline2 drops");
  EXPECT_TRUE(warnings({water, "method={shape: ugimp, transfer: apic}"}).empty());
  EXPECT_TRUE(warnings({"method={shape: bspline2, transfer: apic}"}).empty());
}

TEST(SceneWarnings, AnEndBetweenSyncPoints) {
  expect_one({"time.end=0.004"}, "the run goes on to 0.01 s, the first sync point after its end at 0.004 s");
  expect_one({"time.end=0.021"}, "the run goes on to 0.03 s, the first sync point after its end at 0.021 s");
  // Whoever runs it has it from there.
  const Simulation run(parse_scene(kScene, "test.yaml", {"time.end=0.021"}), {1});
  ASSERT_FALSE(run.warnings().empty());
  EXPECT_EQ(run.warnings()[0].find("the run goes on to 0.03 s"), 0U);
}

TEST(SceneWarnings, SlipsOfUnits) {
  // 100 x 10 x 0.2 = 200 Pa on a stiffness of 1,900 Pa is a strain of 10.5 %; on 2,100 Pa of 9.5 %.
  expect_one({"materials.foam.young=1900"}, "body 'block': its own weight would strain it by 11 %: ");
  EXPECT_TRUE(warnings({"materials.foam.young=2100"}).empty());
  expect_one({"materials.foam.young=0.5", "rigid_bodies.tool.motion.velocity=[0, 0, 0]"},
             "body 'block': its own weight would strain it by 4e+04 %: ", "0.5 is 0.5 Pa, write 0.5 MPa");
  EXPECT_TRUE(warnings({"materials.foam.young=1900", "gravity=[0, 0, 0]"}).empty());
  expect_one({"materials.foam.density=1.5"}, "materials.foam.density: 1.5 kg/m^3 is lighter than any solid or liquid");
  expect_one({"materials.foam.density=1e5", "materials.foam.young=1 GPa"},
             "materials.foam.density: 1e+05 kg/m^3 is heavier than any matter");
  // Waves of sqrt(20e3 / 100) = 14.1 m/s.
  expect_one({"rigid_bodies.tool.motion.velocity=[0, 0, \"-200*t\"]"},
             "rigid body 'tool' moves at 20 m/s, faster than waves in 'foam' (14.1 m/s)");
  EXPECT_TRUE(warnings({"rigid_bodies.tool.motion.velocity=[0, 0, \"-130*t\"]"}).empty());
}

// k = 1e-3, meant in m/s: K = k / viscosity = 1 m^2/(Pa s), a conductivity of K 1000 kg/m^3 9.81 m/s^2.
TEST(SceneWarnings, WaterThatSetsThePace) {
  const auto wet = [](const std::string& permeability) {
    return parse_scene(kScene, "test.yaml",
                       {"transport={pore_pressure: {}}",
                        "materials.foam={name: foam, density: 1600, law: linear_elastic, young: 20 MPa, poisson: 0.2, "
                        "storage: 1e-9, fluid_density: 1000, permeability: " +
                            permeability + "}"});
  };
  EXPECT_TRUE(of_stages(wet("1e-12")).empty());
  const std::vector<std::string> found = of_stages(wet("1e-3"));
  ASSERT_EQ(found.size(), 1U);  // and no second one with another number
  EXPECT_EQ(
      found[0].find("materials.foam.permeability: over the viscosity it is 1 m^2/(Pa s), a hydraulic conductivity "
                    "of 9.81e+03 m/s"),
      0U)
      << found[0];
  // C = 1e-9 1/Pa, so K / C = 1 m^2/s, of which a stable step is 0.05^2 / 4 = 6e-4 s, far longer than a step: one
  // stage.
  const Scene scene = wet("1e-12");
  EXPECT_NE(
      explain(scene, build(scene)).find("transport of pore_pressure: 1 m^2/s at most in foam, 1 stage in each step"),
      std::string::npos);
}

// --explain prints what the warning says: kappa = 5e4 W/(m K) over 100 kg/m^3 and 1 J/(kg K), 500 m^2/s. The
// wave of 14.1 m/s crosses half a cell in 1.77e-3 s, 1,414 steps of 0.05^2 / 2000 s = 1.25e-6 s, which 75 stages reach:
// (75^2 + 75 - 2) / 4 = 1,424.5.
TEST(SceneWarnings, TransportIsCountedOnce) {
  const Scene scene = parse_scene(kScene, "test.yaml",
                                  {"transport={temperature: {initial: 293}}", "time.cfl=0.5",
                                   "materials.foam.conductivity=5e4", "materials.foam.heat_capacity=1"});
  EXPECT_NE(explain(scene, build(scene)).find("transport of temperature: 500 m^2/s at most in foam, 75 stages"),
            std::string::npos);
  const std::vector<std::string> found = of_stages(scene);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].find("materials.foam.conductivity: "), 0U) << found[0];
  EXPECT_NE(found[0].find(" takes 75 stages"), std::string::npos) << found[0];
}

TEST(SceneWarnings, ExplainShowsWhereToolsAreAndWhatTheyWeigh) {
  const auto explained = [](const std::vector<std::string>& set) {
    const Scene scene = parse_scene(kScene, "test.yaml", set);
    return explain(scene, build(scene));
  };
  const std::string text = explained({});
  EXPECT_NE(text.find("rigid body tool: x 0.15 to 0.25 m, y 0.15 to 0.25 m, z 0.25 to 0.35 m, 0.001 m^3, motion "
                      "prescribed, friction 0.3\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("(linear_elastic), 0.8 kg\n"), std::string::npos) << text;
  EXPECT_EQ(text.find("contact.friction"), std::string::npos) << "each tool has its own";
  const std::string free =
      explained({"rigid_bodies.tool={name: tool, shape: {sphere: {radius: 0.05}}, pose: {position: "
                 "[0.2, 0.2, 0.3]}, free: {density: 1000, axes: [z, rx]}}"});
  // 4/3 pi 0.05^3 = 5.236e-4 m^3.
  EXPECT_NE(free.find("z 0.25 to 0.35 m, 0.0005236 m^3, 0.5236 kg, free along z, rx, friction 0\n"), std::string::npos)
      << free;
  EXPECT_NE(free.find("contact.friction: 0: smooth tools"), std::string::npos) << free;
  EXPECT_EQ(explained({"rigid_bodies.tool.friction=0.1", "contact={friction: 0.2}"}).find("contact.friction"),
            std::string::npos);
}

}  // namespace scene_warnings_test
}  // namespace mpm
