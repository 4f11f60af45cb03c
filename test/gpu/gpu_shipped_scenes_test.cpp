// Shipped scenes that a device takes, a few steps of each, against the processor. Cost: 17 s.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

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

/// The scene, with sync periods of a few steps; without particles if a device refuses it.
mpm::SimulationDefinition part_of(const std::string& name) {
  mpm::Scene scene = mpm::load_scene(name, kExplicit);
  if (mpm::feature_fault(scene.definition, {1, true})) return {};
  // Contact at nodes moves no body.
  if (!mpm::find_feature(mpm::Feature::free_bodies, scene.definition)) scene = mpm::load_scene(name, kAtNodes);
  mpm::SimulationDefinition d = mpm::build(scene);
  std::uint64_t particles = 0;
  for (const mpm::DeformableBody& body : d.bodies) particles += body.positions.size();
  if (particles > kMostParticles) return {};
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
    expect_sums_alike(here, there, d.method.precision == mpm::Precision::float32 ? 1e-5 : kRoundOff);
  }
  std::sort(run.begin(), run.end());
  const std::vector<std::string> expected = {"blade_in_soil",  "column_collapse", "compressed_block",
                                             "elastic_block",  "falling_block",   "sliding_block",
                                             "speed_block_2d", "speed_block_3d",  "speed_block_3d_irregular",
                                             "speed_soil_3d",  "speed_tool_3d",   "wheel_in_sand"};
  EXPECT_EQ(run, expected);
}

// Scenes of soil as they are shipped, but awake.
TEST(GpuShippedScenes, SolveStepsAsOnTheProcessor) {
  std::vector<std::string> run;
  for (const auto& [name, title] : mpm::shipped_scenes()) {
    SCOPED_TRACE(name);
    const mpm::Scene scene = mpm::load_scene(name, {"sleep=off"});
    if (scene.definition.method.update != mpm::UpdateScheme::implicit) continue;
    if (mpm::feature_fault(scene.definition, {1, true})) continue;
    mpm::SimulationDefinition d = mpm::build(scene);
    run.push_back(name);
    Simulation here(d, options(false)), there(d, options(true));
    for (int i = 0; i < 2; ++i) {
    advance(here, 1);
    advance(there, 1);
    for (const auto& n : here.numbers()) if (n.name == "sweeps") std::cout << name << " sweeps " << n.value;
    for (const auto& n : there.numbers()) if (n.name == "sweeps") std::cout << " " << n.value << "\n";
    }
    for (const char* f : {"x","z","vx","vz","j"}) std::cout << f << " " << difference(here, there, f) << "\n";
    if (!d.rigid_bodies.empty()) std::cout << here.take_contact(0).impulse.transpose() << " | " << there.take_contact(0).impulse.transpose() << "\n";
    expect_sums_alike(here, there, d.method.precision == mpm::Precision::float32 ? 1e-5 : kRoundOff);
  }
  std::sort(run.begin(), run.end());
  const std::vector<std::string> expected = {"blade_in_soil"};
  EXPECT_EQ(run, expected);
}

}  // namespace gpu_shipped_scenes_test
