// The shipped scenes: the audit closes, for their first 300 steps or with MPM_FULL to their end, and one and two
// threads give the same bits. The demo's scene runs on a grid twice as coarse here, and unchanged in the suite of long
// tests.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <limits>

#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

namespace shipped_scenes_test {

constexpr std::uint64_t kAll = std::numeric_limits<std::uint64_t>::max();

mpm::SolverState run(const std::string& name, const std::vector<std::string>& overrides, int threads,
                     std::uint64_t* hash = nullptr, std::uint64_t most_steps = kAll) {
  const mpm::Scene scene = mpm::load_scene(name, overrides);
  mpm::Simulation simulation(mpm::build(scene), {threads});
  const auto end = static_cast<std::int64_t>(scene.definition.time.end * 1e9 + 0.5);
  EXPECT_GT(end, 0) << name << " has no end";
  double worst = 0.0;
  while (simulation.time() < end && simulation.state().step.steps < most_steps) {
    simulation.advance();
    if (most_steps < kAll || simulation.time() % (10 * simulation.sync_period()) == 0) {
      worst = std::max(worst, simulation.state().audit.residual);
    }
  }
  // Over the momentum exchanged, as README.md promises for every run.
  EXPECT_LT(worst, scene.definition.method.precision == mpm::Precision::float64 ? 1e-10 : 1e-7) << name;
  if (hash != nullptr) *hash = simulation.state_hash();
  return simulation.state();
}

double impulse(const mpm::SolverState& state, const std::string& name) {
  for (const mpm::NamedImpulse& entry : state.audit.impulses) {
    if (entry.name == name) return entry.impulse.norm();
  }
  return 0.0;
}

const std::vector<std::string> kCoarse = {"grid.cell=0.07"};

// Scenes that measure speed are large on purpose: on coarser cells they show the same motion with about 1,000
// particles.
std::vector<std::string> coarse(const std::string& name) {
  if (name == "blade_in_soil") return kCoarse;
  if (name == "cone_penetrometer") return {"grid.cell=0.008"};
  // Its probe waits for commands.
  if (name == "foam_probe") return {"time.end=0.6", R"(rigid_bodies.probe.motion={velocity: [0, "-0.03"]})"};
  if (name == "wheel_in_sand") return {"grid.cell=0.04"};
  if (name == "rover_wheel_terrain") return {"grid.cell=0.08"};
  if (name == "rod_penetration") return {"grid.cell=1"};
  if (name == "sphere_indentation") return {"grid.cell=[0.002, 0.0005]"};
  if (name == "probe_in_clay") {
    return {"grid.cell=0.009", "time.end=0.1", "metrics.pushing_force.rate={from: 0.05, to: 0.1}"};
  }
  if (name == "hot_tool") return {"grid.cell=0.001"};
  if (name == "swelling_strip") return {"grid.cell=1e-4"};
  // Cracks have their place in the grid: fewer steps in place of coarser cells.
  if (name == "double_cantilever") return {"time.end=0.001"};
  if (name == "wedge_block") return {"time.end=0.012"};
  if (name == "wedge_split") return {"time.end=0.003"};
  if (name == "speed_block_3d_million") return {"grid.cell=0.1"};
  if (name.rfind("speed_", 0) == 0) return {"grid.cell=0.04"};
  return {};
}

TEST(ShippedScenes, CloseTheAudit) {
  const std::uint64_t most_steps = std::getenv("MPM_FULL") == nullptr ? 300 : kAll;
  int scenes = 0;
  for (const auto& [name, about] : mpm::shipped_scenes()) {
    EXPECT_FALSE(about.empty()) << name << " does not say what it shows";
    run(name, coarse(name), 1, nullptr, most_steps);
    ++scenes;
  }
  EXPECT_GE(scenes, 5);
}

TEST(ShippedScenes, BladeHasTheSameBitsForTwoThreads) {
  std::uint64_t one = 0, two = 0;
  const mpm::SolverState state = run("blade_in_soil", kCoarse, 1, &one);
  run("blade_in_soil", kCoarse, 2, &two);
  EXPECT_EQ(one, two);
  EXPECT_GT(impulse(state, "contact/blade"), 50.0);  // [N s] the blade pushed the soil
}

TEST(FullShippedScenes, BladeClosesTheAuditAsShipped) { run("blade_in_soil", {}, 0); }

// A slow blade is resisted by strength and weight: half and twice the stiffness change its impulse by less than 10 %,
// the scatter of the heap's shape (doc/accuracy.md).
TEST(FullShippedScenes, StiffnessHardlyChangesTheForceOnTheBlade) {
  const double as_shipped = impulse(run("blade_in_soil", {}, 0), "contact/blade");
  for (const char* young : {"0.25 MPa", "1 MPa"}) {
    const double other =
        impulse(run("blade_in_soil", {std::string("materials.sand.young=") + young}, 0), "contact/blade");
    EXPECT_NEAR(other, as_shipped, 0.1 * as_shipped) << young;
  }
}

}  // namespace shipped_scenes_test
