// Global quantities: means and sums by name, against closed forms and against other reports of the solver.
#include "mpm/simulation/global_quantity.hpp"

#include <gtest/gtest.h>

#include "mpm/rigid/surface.hpp"
#include "mpm/scene/scene.hpp"
#include "observed_block.hpp"

namespace mpm {
namespace global_quantity_test {

using test::observed_block;

constexpr Elasticity kElasticity{1e5, 0.25};

TEST(GlobalQuantities, MeansCountEveryParticleAlike) {
  const Vec3 drift(10.0, -20.0, 5.0);
  Simulation run(observed_block(NeoHookeanDefinition{kElasticity}, Eigen::Matrix3d::Zero(), drift));
  GlobalQuantities global(run, {{"velx", "block"}, {"velZ", ""}, {"dispx", ""}, {"sRR", "block"}, {"temp", ""}});
  EXPECT_EQ(global.names(), (std::vector<std::string>{"velx of block", "velZ", "dispx", "sRR of block", "temp"}));
  EXPECT_EQ(global.units(), (std::vector<std::string>{"m/s", "m/s", "m", "Pa", "K"}));
  for (int i = 0; i < 10; ++i) run.advance();
  const std::vector<double> values = global.read();
  EXPECT_NEAR(values[0], 10.0, 1e-12);  // sums of 4096 numbers of 10
  EXPECT_NEAR(values[1], 5.0, 1e-12);
  EXPECT_NEAR(values[2], 1e-4, 1e-14);  // 10 steps of 1 us, round-off of positions of 1 m
  EXPECT_NEAR(values[3], 0.0, 1e-6);    // round-off of the strain times 1e5 Pa
  EXPECT_EQ(values[4], 0.0);            // zero without a temperature, as for a particle
}

TEST(GlobalQuantities, EnergiesAndCountersAreTheSolvers) {
  Eigen::Matrix3d rate = Eigen::Matrix3d::Zero();
  rate(0, 0) = 1000.0;
  Simulation run(observed_block(J2PlasticityDefinition{kElasticity, 20.0}, rate));
  GlobalQuantities global(run, {{"Kinetic Energy", ""},
                                {"strain energy", "block"},
                                {"Plastic Energy", ""},
                                {"Energy", ""},
                                {"Potential Energy", ""},
                                {"External Work", ""},
                                {"Step number", ""},
                                {"Elapsed time", ""},
                                {"alpha", ""},
                                {"Interface Energy", ""}});
  run.advance();
  const std::vector<double> values = global.read();
  const SolverState state = run.state();
  const double round_off = 1e-12 * state.energy.of("kinetic");
  EXPECT_NEAR(values[0], state.energy.of("kinetic"), round_off);
  EXPECT_NEAR(values[1], state.energy.of("elastic"), round_off);
  EXPECT_NEAR(values[2], state.energy.of("plastic"), round_off);
  EXPECT_NEAR(values[3], state.energy.of("kinetic") + state.energy.of("elastic"), round_off);
  EXPECT_NEAR(values[4], values[3], round_off);  // there is no external work
  EXPECT_EQ(values[5], 0.0);
  EXPECT_EQ(values[6], 1.0);
  EXPECT_EQ(values[7], state.wall_seconds);
  EXPECT_EQ(values[8], 0.0);
  EXPECT_EQ(values[9], 0.0);
}

TEST(GlobalQuantities, ContactForceIsTheMeanSinceTheLastCall) {
  // The ball is in contact from the start. Cells of 2 mm are enough, since only sums are compared.
  const Scene scene = load_scene("sphere_indentation", {"grid.cell=0.002"});
  Simulation run(build(scene));
  GlobalQuantities global(run, {{"contactz", "sphere"}, {"contactz", ""}});
  EXPECT_EQ(global.read(), (std::vector<double>{0.0, 0.0}));
  double impulse = 0.0, time = 0.0;
  for (int period = 0; period < 6; ++period) {
    for (int i = 0; i < 5; ++i) {
      run.advance();
      const ContactReport report = run.take_contact(0);
      impulse += report.mean.force.z() * report.interval;
      time += report.interval;
    }
    const std::vector<double> values = global.read();
    // Differences of one impulse, which grows with the run: their error is its round-off.
    EXPECT_NEAR(values[0], impulse / time, 1e-9 * std::max(1.0, std::abs(impulse / time)));
    EXPECT_EQ(values[0], values[1]);
    if (period > 0) {
      EXPECT_GT(values[0], 0.0);  // otherwise nothing would be compared
    }
    impulse = time = 0.0;
  }
}

TEST(GlobalQuantities, SayWhatIsNotThere) {
  EXPECT_EQ(problem_of({"sxx", "soil"}), "");
  EXPECT_NE(problem_of({"sxq", ""}).find("no global quantity 'sxq'; did you mean"), std::string::npos);
  EXPECT_EQ(problem_of({"concentration", ""}), "");
  EXPECT_NE(problem_of({"alpha", "soil"}).find("of the whole run"), std::string::npos);
  EXPECT_TRUE(of_rigid_body({"contactx", ""}));
  Simulation run(observed_block(NeoHookeanDefinition{kElasticity}, Eigen::Matrix3d::Zero()));
  EXPECT_THROW(GlobalQuantities(run, {{"sxx", "sole"}}), DefinitionError);
  EXPECT_THROW(GlobalQuantities(run, {{"contactx", "tool"}}), DefinitionError);
}

std::string error_of(const std::string& output) {
  const std::string scene =
      "geometry: solid\n"
      "grid: {cell: 0.1, min: [0, 0, 0], max: [1, 1, 1]}\n"
      "time: {end: 0.1, sync: 0.001}\n"
      "materials: [{name: clay, law: neo_hookean, density: 1000, young: 1e5, poisson: 0.3}]\n"
      "bodies: [{name: soil, material: clay, shape: {box: {min: [0, 0, 0], max: [1, 1, 0.5]}}}]\n"
      "output: {";
  try {
    const Scene read = parse_scene(scene + output + "}\n", "test.yaml");
    return {};
  } catch (const SceneError& error) {
    return error.what();
  }
}

TEST(GlobalQuantities, AreAskedForInTheScene) {
  EXPECT_EQ(error_of("global: [{quantity: sxx, body: soil}, Kinetic Energy], global_period: 0.002"), "");
  EXPECT_NE(error_of("global: [sxq]").find("no global quantity 'sxq'"), std::string::npos) << error_of("global: [sxq]");
  EXPECT_NE(error_of("global: [{quantity: sxx, body: soul}]").find("no deformable body 'soul'"), std::string::npos);
  EXPECT_NE(error_of("global: [{quantity: contactx, body: soil}]").find("no rigid body 'soil'"), std::string::npos);
  EXPECT_NE(error_of("global: [sxx], global_period: 0.0015").find("whole number of sync periods"), std::string::npos);
  EXPECT_NE(error_of("global_period: 0.002").find("no output.global"), std::string::npos);
  EXPECT_EQ(error_of("particle_region: {min: [0, 0, 0], max: [0.5, 1, 1]}"), "");
  EXPECT_NE(error_of("particle_region: {min: [0, 0, 0], max: [0.5, -1, 1]}").find("max is below min"),
            std::string::npos);
}

}  // namespace global_quantity_test
}  // namespace mpm
