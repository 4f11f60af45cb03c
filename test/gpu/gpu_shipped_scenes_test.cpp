// Shipped scenes that a device takes, a few steps of each, against the processor. Cost: 25 s.
#include <gtest/gtest.h>

#include <algorithm>

#include "gpu_runs.hpp"
#include "mpm/rules/feature_rules.hpp"
#include "mpm/scene/scene.hpp"

namespace gpu_shipped_scenes_test {

using namespace gpu_runs;

/// Steps of a scene, of two sync periods each.
constexpr int kSteps = 3;
constexpr std::uint64_t kMostParticles = 70'000;

// Explicit steps, as a device takes them; contact that does not depend on the order of points.
const std::vector<std::string> kExplicit = {"method.update=usavg"};
const std::vector<std::string> kAtNodes = {"method.update=usavg", "contact.method=nodes"};

std::uint64_t particles_of(const mpm::SimulationDefinition& d) {
  std::uint64_t particles = 0;
  for (const mpm::DeformableBody& body : d.bodies) particles += body.positions.size();
  return particles;
}
double bound_of(const mpm::SimulationDefinition& d) {
  return d.method.precision == mpm::Precision::float32 ? 1e-5 : kRoundOff;
}

/// The scene, with sync periods of a few steps; without particles if a device refuses it.
mpm::SimulationDefinition part_of(const std::string& name) {
  mpm::Scene scene = mpm::load_scene(name, kExplicit);
  if (mpm::feature_fault(scene.definition, {1, true})) return {};
  // Contact at nodes moves no body.
  if (!mpm::find_feature(mpm::Feature::free_bodies, scene.definition)) scene = mpm::load_scene(name, kAtNodes);
  mpm::SimulationDefinition d = mpm::build(scene);
  if (particles_of(d) > kMostParticles) return {};
  Simulation probe(d, options(false));
  probe.advance();
  d.time.sync = static_cast<std::int64_t>(1e9 * kSteps * probe.state().step.dt_last);
  return d;
}

TEST(GpuShippedScenes, RunAsOnTheProcessor) {
  std::vector<std::string> run;
  for (const auto& [name, title] : mpm::shipped_scenes()) {
    SCOPED_TRACE(name);
    const mpm::SimulationDefinition d = part_of(name);
    if (d.bodies.empty()) continue;
    run.push_back(name);
    Simulation here(d, options(false)), there(d, options(true));
    advance(here, 2);
    advance(there, 2);
    expect_sums_alike(here, there, bound_of(d));
  }
  std::sort(run.begin(), run.end());
  const std::vector<std::string> expected = {"blade_in_soil",  "column_collapse", "compressed_block",
                                             "elastic_block",  "falling_block",   "sliding_block",
                                             "speed_block_2d", "speed_block_3d",  "speed_block_3d_irregular",
                                             "speed_soil_3d",  "speed_tool_3d",   "wheel_in_sand"};
  EXPECT_EQ(run, expected);
}

// As they are shipped: soil takes implicit steps there, too, and sleeps. Those of explicit steps are above.
TEST(GpuShippedScenes, RunAsTheyAreShipped) {
  std::vector<std::string> taken;
  for (const auto& [name, title] : mpm::shipped_scenes()) {
    SCOPED_TRACE(name);
    const mpm::Scene scene = mpm::load_scene(name);
    if (mpm::feature_fault(scene.definition, {1, true})) continue;
    taken.push_back(name);
    const mpm::SimulationDefinition d = mpm::build(scene);
    if (d.method.update != mpm::UpdateScheme::implicit || particles_of(d) > kMostParticles) continue;
    Simulation here(d, options(false)), there(d, options(true));
    const int periods = particles_of(d) < 10'000 ? 8 : 2;
    advance(here, periods);
    advance(there, periods);
    EXPECT_EQ(number(here, "sweeps"), number(there, "sweeps"));
    expect_sums_alike(here, there, bound_of(d));
    for (std::size_t b = 0; b < d.rigid_bodies.size(); ++b) {
      const mpm::Vec3 impulse = here.take_contact(static_cast<int>(b)).impulse;
      EXPECT_LE((there.take_contact(static_cast<int>(b)).impulse - impulse).norm(), bound_of(d) * impulse.norm());
    }
  }
  std::sort(taken.begin(), taken.end());
  const std::vector<std::string> expected = {
      "blade_in_soil",          "column_collapse", "compressed_block", "elastic_block",  "falling_block",
      "rover_wheel_terrain",    "sliding_block",   "speed_block_2d",   "speed_block_3d", "speed_block_3d_irregular",
      "speed_block_3d_million", "speed_soil_3d",   "speed_tool_3d",    "wheel_in_sand"};
  EXPECT_EQ(taken, expected);
}

// The blade reaches soil that has slept and pushes it for 0.1 s: the same steps and sweeps, and the force on it. Cost:
// 80 s.
TEST(GpuShippedScenes, BladePushesAsOnTheProcessor) {
  const mpm::SimulationDefinition d = mpm::build(mpm::load_scene("blade_in_soil"));
  Simulation here(d, options(false)), there(d, options(true));
  double most = 0.0;
  while (here.time() < 600'000'000) {
    here.advance();
    there.advance();
    for (const char* name : {"sweeps", "asleep"}) EXPECT_EQ(number(here, name), number(there, name)) << here.time();
    most = std::max(most, number(here, "asleep"));
  }
  EXPECT_GT(most, 10'000.0);
  EXPECT_EQ(here.state().step.steps, there.state().step.steps);
  const mpm::Vec3 impulse = here.take_contact(0).impulse;
  EXPECT_GT(impulse.norm(), 10.0);
  EXPECT_LT((there.take_contact(0).impulse - impulse).norm(), 1e-6 * impulse.norm());
}

}  // namespace gpu_shipped_scenes_test
