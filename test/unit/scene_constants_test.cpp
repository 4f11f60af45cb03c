// `constants` of a scene: numbers with names, for functions and numbers, and the metrics that are formulas.
#include <gtest/gtest.h>

#include <cmath>

#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm {
namespace scene_constants_test {

const char* const kScene =
    "grid: {cell: 0.1, min: [0, 0, 0], max: [1, 1, 1]}\n"
    "time: {end: 1}\n"
    "constants: {slip: 0.2, v: 0.4 m/s, spin: v/(1 - slip)/0.1, stiff: 20 kPa}\n"
    "materials: [{name: soft, density: 1000, law: neo_hookean, young: 2*stiff, poisson: slip}]\n"
    "bodies: [{name: block, material: soft, shape: {box: {min: [0.2, 0.2, 0.2], max: [0.6, 0.6, 0.6]}}}]\n"
    "rigid_bodies: [{name: wheel, shape: {sphere: {radius: 0.1}}, pose: {position: [0.4, 0.4, 0.8]},\n"
    "  motion: {velocity: [v, 0, \"-v*t\"], rotation_rate: [0, spin, 0]}, friction: slip}]\n";

Scene scene(const std::vector<std::string>& set = {}) { return parse_scene(kScene, "test.yaml", set); }

std::string refusal(const std::vector<std::string>& set, const std::string& more = "") {
  try {
    parse_scene(kScene + more, "test.yaml", set);
    return "no error";
  } catch (const SceneError& error) {
    return error.what();
  }
}

TEST(SceneConstants, StandInFunctionsAndNumbers) {
  const Scene read = scene();
  const RigidBodyDefinition& wheel = read.definition.rigid_bodies.at(0);
  EXPECT_EQ(wheel.velocity[0](0.0), 0.4);
  EXPECT_TRUE(wheel.velocity[0].is_constant());
  EXPECT_NEAR(wheel.velocity[2](2.0), -0.8, 1e-15);
  EXPECT_NEAR(wheel.rotation_rate[1](0.0), 5.0, 1e-14);  // 0.4 / 0.8 / 0.1
  EXPECT_EQ(wheel.friction.coefficient, 0.2);
  const auto& law = std::get<NeoHookeanDefinition>(read.definition.materials.at(0).law);
  EXPECT_EQ(law.elasticity.young, 40e3);
  EXPECT_EQ(law.elasticity.poisson, 0.2);
  // One that is changed changes what follows from it; the record has it.
  const Scene changed = scene({"constants.slip=0.3"});
  EXPECT_NEAR(changed.definition.rigid_bodies.at(0).rotation_rate[1](0.0), 0.4 / 0.7 / 0.1, 1e-14);
  EXPECT_EQ(parse_scene(changed.text, "test.yaml").definition.rigid_bodies.at(0).friction.coefficient, 0.3);
}

// Expressions are in the scene's units: 0.4 m/s are 400 mm/s, and 20 kPa are 20,000 Pa, which mm-g-s has.
TEST(SceneConstants, AUnitIsIndependentOfTheScenesUnits) {
  const Scene read = parse_scene(
      "units: mm-g-s\ngrid: {cell: 10, min: [0, 0, 0], max: [100, 100, 100]}\n"
      "constants: {v: 0.4 m/s, stiff: 20 kPa}\n"
      "materials: [{name: soft, density: 1e-3, law: neo_hookean, young: stiff, poisson: 0.2}]\n"
      "bodies: [{name: b, material: soft, shape: {box: {min: [0, 0, 0], max: [20, 20, 20]}},\n"
      "  initial: {velocity: [v, 0.5*v, 0]}}]\n",
      "test.yaml");
  EXPECT_NEAR(read.bodies.at(0).velocity[0](0.0), 0.4, 1e-15);
  EXPECT_NEAR(read.bodies.at(0).velocity[1](0.0), 0.2, 1e-15);
  EXPECT_NEAR(std::get<NeoHookeanDefinition>(read.definition.materials.at(0).law).elasticity.young, 20e3, 1e-9);
}

TEST(SceneConstants, BadOnesAreRefused) {
  const auto starts = [](const std::string& found, const std::string& start) {
    EXPECT_EQ(found.substr(0, start.size()), start) << found;
  };
  const auto added = [](const std::string& constants) { return refusal({"constants={" + constants + "}"}); };
  const std::string rest = "slip: 0.2, v: 0.4, spin: 1, stiff: 1";
  const std::string at = "--set constants={" + rest + ", ";
  starts(added(rest + ", t: 1"), at + "t: 1}: constants.t: 't' is the time in expressions; choose another name");
  starts(added(rest + ", sin: 1"), at + "sin: 1}: constants.sin: 'sin' is a function in expressions");
  starts(added(rest + ", a: 2*t"), at + "a: 2*t}: constants.a: '2*t' depends on time or place");
  starts(added(rest + ", a: 3 mM"), at + "a: 3 mM}: constants.a: unknown unit 'mM'; did you mean 'mm'?");
  EXPECT_NE(added(rest + ", a: b"), "no error") << "b is not above it";
  // A slip of the name does not add a constant that nothing uses.
  starts(refusal({"constants.slp=0.3"}),
         "--set constants.slp=0.3: constants: the scene has no constant 'slp'; did you mean 'slip'?");
  EXPECT_NE(
      refusal({"rigid_bodies.wheel.motion.velocity=[\"2*slipp*t\", 0, 0]"})
          .find("unknown name 'slipp'; did you mean 'slip'? an expression may use t, x, y, z, pi, e and functions "
                "such as sin(...), and the scene's constants slip, v, spin, stiff"),
      std::string::npos);
  EXPECT_NE(refusal({"grid.cell=v"}).find("the constant 'v' is a velocity, but a length is expected"),
            std::string::npos);
  EXPECT_NE(refusal({"grid.cell=0.1*v*t"}).find("depends on time or place, and this is a number"), std::string::npos);
  EXPECT_NE(refusal({"grid.cell=slib"}).find("or an expression of the constants slip, v, spin, stiff"),
            std::string::npos);
  // One that is not used is said.
  const Scene unused = scene({"materials.soft.young=10 kPa"});
  ASSERT_EQ(build(unused).warnings.size(), 1U);
  EXPECT_EQ(build(unused).warnings[0], "constants.stiff: nothing in the scene uses it; use it, or leave it out");
  EXPECT_TRUE(build(scene()).warnings.empty());
}

// A block of 0.4 m on a smooth floor, and a ball that is pressed into it from above.
TEST(SceneMetrics, ForcesMassesMeansAndFormulas) {
  const Scene read = parse_scene(
      "grid: {cell: 0.1, min: [0, 0, 0], max: [1, 1, 1]}\n"
      "time: {end: 0.2, sync: 0.01}\n"
      "constants: {part: 0.5}\n"
      "materials: [{name: soft, density: 1000, law: neo_hookean, young: 100 kPa, poisson: 0.2}]\n"
      "bodies: [{name: block, material: soft, shape: {box: {min: [0.2, 0.2, 0], max: [0.6, 0.6, 0.4]}}}]\n"
      "rigid_bodies:\n"
      "  - {name: ball, shape: {sphere: {radius: 0.1}}, pose: {position: [0.4, 0.3, 0.51]},\n"
      "     motion: {velocity: [0, 0, -0.2]}}\n"
      "  - {name: stone, shape: {sphere: {radius: 0.1}}, pose: {position: [0.8, 0.8, 0.8]}, free: {mass: 3}}\n"
      "boundaries: {all: slip}\n"
      "metrics:\n"
      "  mass: {sum: mass, of: block}\n"
      "  half: {sum: mass, of: block, in: {min: [0, 0, 0], max: [0.4, 1, 1]}}\n"
      "  stone: {mean: mass, of: stone}\n"
      "  last: {mean: force_z, of: ball}\n"
      "  lift: {mean: force_z, of: ball, over: {from: 0.1, to: 0.2}}\n"
      "  at_15: {mean: force_z, of: ball, at: 0.15}\n"
      "  turn: {mean: torque_x, of: ball, over: {from: 0, to: 0.2}}\n"
      "  impulse: {mean: impulse_z, of: ball}\n"
      "  sum: lift + part*mass\n"
      "  none: lift/(mass - mass)\n",
      "test.yaml");
  Simulation run(read, {1});
  double lift = 0.0, last = 0.0, at_15 = 0.0;
  for (int period = 1; period <= 20; ++period) {
    run.advance();
    last = run.take_contact(0).mean.force.z();
    if (period > 10) lift += last / 10.0;
    if (period == 15) at_15 = last;
  }
  std::vector<double> values;
  for (const auto& [name, value] : run.metrics()) values.push_back(value);
  ASSERT_EQ(values.size(), 10U);
  EXPECT_NEAR(values[0], 64.0, 1e-9);
  EXPECT_NEAR(values[1], 32.0, 1e-9);
  EXPECT_EQ(values[2], 3.0);
  // Reports of contact have sums of their own.
  EXPECT_GT(lift, 1.0);
  EXPECT_NEAR(values[3], last, 1e-9 * lift);
  EXPECT_NEAR(values[4], lift, 1e-9 * lift);
  EXPECT_NEAR(values[5], at_15, 1e-9 * lift);
  // Smooth: forces on a ball go through its centre.
  EXPECT_NEAR(values[6], 0.0, 1e-9 * lift);
  EXPECT_NEAR(values[8], lift + 32.0, 1e-9 * lift);
  EXPECT_TRUE(std::isnan(values[9]));
}

TEST(SceneMetrics, BadOnesAreRefused) {
  const auto refused = [](const std::string& metrics) { return refusal({}, "metrics: {" + metrics + "}\n"); };
  EXPECT_EQ(refused("m: {mean: force_x, of: wheel}, twice: 2*m"), "no error");
  EXPECT_NE(refused("twice: 2*m, m: {mean: force_x, of: wheel}").find("unknown name 'm'"), std::string::npos);
  EXPECT_NE(refused("z: {mean: z, of: wheel}, a: 2*z").find("'z' is a place in expressions"), std::string::npos);
  EXPECT_NE(refused("a: 2*t").find("a metric has no time and place of its own"), std::string::npos);
  EXPECT_NE(refused("a: {mean: mass, of: wheel}").find("the motion of 'wheel' is prescribed, so it has no mass"),
            std::string::npos);
  EXPECT_NE(refused("a: {sum: force_x, of: wheel}").find("one number of a kind; write mean"), std::string::npos);
  EXPECT_NE(refused("a: {mean: x, of: wheel, over: {from: 0, to: 2}}").find("after the end of the run"),
            std::string::npos);
  EXPECT_NE(refused("a: {mean: x, of: wheel, over: {from: 0, to: 1}, at: 1}").find("leave one of the two out"),
            std::string::npos);
  // A number that the run has not is refused before it begins, not at its end.
  const Scene no_crack = parse_scene(std::string(kScene) + "metrics: {j: {number: crack 1 end j}}\n", "test.yaml");
  EXPECT_THROW(Simulation(no_crack, {1}), DefinitionError);
}

}  // namespace scene_constants_test
}  // namespace mpm
