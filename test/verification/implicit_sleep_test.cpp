// Material asleep beside implicit steps: it holds its nodes, wakes when a tool comes, changes no force and no bit.
// Cost: 2 s.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "implicit_scene.hpp"

namespace implicit_sleep_test {

/// A bed of sand of 3.2 m, through which a blade is drawn from 0.4 s on.
std::string bed(const std::string& sleep) {
  return fmt::format(
      "geometry: plane_strain\ngravity: [0, -9.81]\nmethod: {{update: implicit}}\n"
      "grid: {{cell: 0.05, min: [0, 0], max: [3.2, 0.6]}}\ntime: {{end: 2, sync: 0.02, step: 0.01}}\n"
      "materials: [{{name: sand, law: mohr_coulomb, density: 1600, young: 2 MPa, poisson: 0.3, friction_angle: 30 deg, "
      "cohesion: 0}}]\n"
      "bodies: [{{name: sand, material: sand, initial: geostatic, "
      "shape: {{box: {{min: [0, 0], max: [3.2, 0.4]}}}}, cut_out: [blade]}}]\n"
      "rigid_bodies: [{{name: blade, shape: {{box: {{size: [0.1, 0.5]}}}}, pose: {{position: [0.4, 0.5]}}, "
      "friction: 0.3, motion: {{velocity: [\"0.3 * max(0, min(1, (t - 0.4) / 0.1))\", 0]}}}}]\n"
      "boundaries: {{x_min: slip, x_max: slip, z_min: {{friction: 0.577}}}}\nsleep: {}\n",
      sleep);
}

constexpr const char* kFromStart = "{from_start: true}";

using verification::start_text;

double asleep(const mpm::Simulation& run) { return verification::number(run, "asleep"); }

struct Drawn {
  double force;           ///< on the blade along its way, mean of the last second [N]
  double sleeping[3];     ///< part of the particles asleep before the blade moves, in the middle and at the end
  double residual = 0.0;  ///< residual of momentum
};
Drawn draw(const std::string& sleep) {
  mpm::Simulation run = start_text(bed(sleep));
  const auto particles = static_cast<double>(run.particles());
  Drawn drawn{};
  verification::run_until(run, 0.4);
  drawn.sleeping[0] = asleep(run) / particles;
  verification::run_until(run, 1.0);
  drawn.sleeping[1] = asleep(run) / particles;
  run.take_contact(0);
  verification::run_until(run, 2.0);
  drawn.force = run.take_contact(0).mean.force.x();
  drawn.sleeping[2] = asleep(run) / particles;
  drawn.residual = run.state().audit.residual;
  return drawn;
}

// The force is that of a run in which nothing sleeps, and momentum is exact with what the border of sleep takes.
TEST(ImplicitSleep, ChangesNoForce) {
  const Drawn awake = draw("off"), sleeps = draw(kFromStart);
  EXPECT_NEAR(sleeps.force / awake.force, 1.0, 0.02);
  EXPECT_LT(sleeps.residual, 1e-12);
  for (int i = 0; i < 3; ++i) RecordProperty(fmt::format("asleep_{}", i), fmt::format("{:.3f}", sleeps.sleeping[i]));
  RecordProperty("force", fmt::format("{:.2f} {:.2f}", awake.force, sleeps.force));
}

// Before the blade moves all sleeps that is 4 cells from it, 2.4 m of 3.2 m; what its wedge of 0.7 m does not reach
// goes on to sleep.
TEST(ImplicitSleep, LeavesOutWhatIsAtRest) {
  const Drawn sleeps = draw(kFromStart);
  EXPECT_GT(sleeps.sleeping[0], 0.65);
  EXPECT_LT(sleeps.sleeping[0], 0.85);
  EXPECT_GT(sleeps.sleeping[1], 0.3);
  EXPECT_LT(sleeps.sleeping[1], sleeps.sleeping[0]);
}

// Any number of threads, and a checkpoint while some sleep, leave every bit.
TEST(ImplicitSleep, KeepsItsBits) { verification::expect_kept_bits(bed(kFromStart), 0.8, 1.2); }

}  // namespace implicit_sleep_test
