// Scenes of implicit steps as text, their runs, and whether these have the same bits for any number of threads and from
// a checkpoint.
#pragma once

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "mpm/checkpoint/checkpoint.hpp"
#include "scene_run.hpp"

namespace verification {

/// Sand of 30 degrees without dilation, from (0, 0) to `width` and `height` [m]. `rest`: its other sections.
inline std::string sand(const std::string& geometry, double width, double height, const std::string& rest) {
  return fmt::format(
      "geometry: {}\ngravity: [0, -9.81]\nmethod: {{update: implicit}}\n"
      "materials: [{{name: sand, law: mohr_coulomb, density: 1600, young: 2 MPa, poisson: 0.3, friction_angle: 30 deg, "
      "cohesion: 0}}]\n"
      "bodies: [{{name: sand, material: sand, shape: {{box: {{min: [0, 0], max: [{}, {}]}}}}}}]\n{}",
      geometry, width, height, rest);
}

inline mpm::Simulation start_text(const std::string& text, const std::vector<std::string>& overrides = {},
                                  int threads = 1) {
  return mpm::Simulation(mpm::build(mpm::parse_scene(text, "scene", overrides)), {threads});
}

/// Impulse on the material since the start [N s].
inline mpm::Vec3 given(const mpm::Simulation& run, const std::string& name) {
  for (const mpm::NamedImpulse& one : run.state().audit.impulses) {
    if (one.name == name) return one.impulse;
  }
  return mpm::Vec3::Zero();
}

/// Expects the same state at `end` [s] on 1, 2 and 3 threads, and of a run that goes on from a checkpoint at `part`
/// [s].
inline void expect_kept_bits(const std::string& text, double part, double end) {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 3}) {
    mpm::Simulation run = start_text(text, {}, threads);
    run_until(run, end);
    hashes.push_back(run.memory_hash());
  }
  EXPECT_EQ(hashes[1], hashes[0]);
  EXPECT_EQ(hashes[2], hashes[0]);
  const std::string name = ::testing::UnitTest::GetInstance()->current_test_info()->test_suite_name();
  const std::string file = (std::filesystem::temp_directory_path() / (name + "_bits.h5")).string();
  mpm::Simulation whole = start_text(text);
  run_until(whole, part);
  mpm::save_checkpoint(file, whole, {"", text, {}});
  mpm::Simulation resumed = start_text(text);
  mpm::load_checkpoint(file, resumed, text);
  run_until(resumed, end);
  EXPECT_EQ(resumed.memory_hash(), hashes[0]);
  std::filesystem::remove(file);
}

}  // namespace verification
