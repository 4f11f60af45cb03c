// Implicit steps along periodic axes: an infinite layer on a slope, at rest and sliding, and soil that lies across the
// faces. Cost: 1 s.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "implicit_scene.hpp"
#include "mpm/math/constants.hpp"

namespace implicit_periodic_test {

constexpr double kGravity = 9.81, kFriction = 0.3;

using verification::start_text;

/// A layer of 0.4 m of sand of 40 degrees on a bottom with friction, turned by an angle [deg].
std::string layer(const std::string& geometry, double angle) {
  const bool solid = geometry == "solid";
  const double slope = angle * mpm::kPi / 180.0;
  const std::string across = solid ? "0, " : "", wide = solid ? "0.4, " : "";
  return fmt::format(
      "geometry: {}\ngravity: [{}, {}{}]\nmethod: {{update: implicit}}\ntime: {{end: 2, sync: 0.01}}\n"
      "grid: {{cell: 0.05, min: [0, {}0], max: [0.8, {}0.8]}}\n"
      "materials: [{{name: sand, law: mohr_coulomb, density: 1600, young: 2 MPa, poisson: 0.3, friction_angle: 40 deg, "
      "cohesion: 0}}]\n"
      "bodies: [{{name: sand, material: sand, shape: {{box: {{min: [0, {}0], max: [0.8, {}0.4]}}}}}}]\n"
      "boundaries: {{x: periodic, {}z_min: {{friction: {}}}}}\n",
      geometry, kGravity * std::sin(slope), across, -kGravity * std::cos(slope), across, wide, across, wide,
      solid ? "y: periodic, " : "", kFriction);
}

// A layer slides with g (sin a - mu cos a), to 1 %, or rests below the angle of friction, 16.7 degrees; all of a row
// moves as one, whether faces are beside it or not.
TEST(ImplicitPeriodic, ALayerSlidesOnItsBottom) {
  for (const char* geometry : {"plane_strain", "solid"}) {
    for (const double angle : {15.0, 20.0, 30.0}) {
      const bool coarse = std::string(geometry) == "solid";
      if (coarse && angle < 30.0) continue;
      mpm::Simulation run = start_text(layer(geometry, angle), {}, 2);
      const auto velocity = [&] {
        const std::vector<double> v = verification::field(run, "vx");
        double sum = 0.0;
        for (const double one : v) sum += one;
        return sum / static_cast<double>(v.size());
      };
      const double slope = angle * mpm::kPi / 180.0;
      const double exact = std::max(0.0, kGravity * (std::sin(slope) - kFriction * std::cos(slope)));
      // A layer that rests comes to rest from where it was set down without stress.
      const double from = exact > 0.0 ? 0.3 : 1.5;
      verification::run_until(run, from);
      const double before = velocity();
      verification::run_until(run, from + 0.5);
      const double found = (velocity() - before) / 0.5;
      EXPECT_NEAR(found, exact, 0.01 * exact + 1e-4) << geometry << angle;
      RecordProperty(fmt::format("{}_{}", geometry, angle), fmt::format("{:.5f} {:.5f}", found, exact));
      if (exact == 0.0) {
        EXPECT_LT(std::abs(velocity()), 1e-4);
        RecordProperty("at_rest", fmt::format("{:.2g}", velocity()));
      }
      EXPECT_LT(run.state().audit.residual, 1e-12);
      // Rows of particles lie at one height.
      const std::vector<double> x = verification::field(run, "x"), z = verification::field(run, "z");
      const std::vector<double> v = verification::field(run, "vx");
      const double cell = 0.05;
      double least = 1e9, most = -1e9;
      for (std::size_t i = 0; i < v.size(); ++i) {
        if (std::abs(z[i] - 0.2) > 0.5 * cell) continue;
        least = std::min(least, v[i]);
        most = std::max(most, v[i]);
      }
      EXPECT_LT(most - least, 0.01 * std::max(most, 0.1)) << geometry << angle;
    }
  }
}

/// A heap that collapses, in the middle of the domain or across its faces; the same grid under it in both.
std::string heap(bool across) {
  const std::string sand = across
                               ? "  - {name: left, material: sand, shape: {box: {min: [0, 0], max: [0.2, 0.4]}}}\n"
                                 "  - {name: right, material: sand, shape: {box: {min: [1.4, 0], max: [1.6, 0.4]}}}\n"
                               : "  - {name: heap, material: sand, shape: {box: {min: [0.6, 0], max: [1, 0.4]}}}\n";
  return "geometry: plane_strain\ngravity: [0, -9.81]\nmethod: {update: implicit, sweeps: 100}\n"
         "time: {end: 1, sync: 0.01}\ngrid: {cell: 0.05, min: [0, 0], max: [1.6, 0.6]}\n"
         "materials: [{name: sand, law: mohr_coulomb, density: 1600, young: 2 MPa, poisson: 0.3, friction_angle: 30 "
         "deg, cohesion: 0}]\nbodies:\n" +
         sand + "boundaries: {x: periodic, z_min: {friction: 0.577}}\n";
}

// The faces are nowhere: a heap across them collapses as one in the middle does, to what sweeps in another order leave.
TEST(ImplicitPeriodic, AHeapAcrossTheFaces) {
  double potential[2], kinetic[2];
  for (const bool across : {false, true}) {
    mpm::Simulation run = start_text(heap(across));
    verification::run_until(run, 0.3);
    kinetic[across] = run.state().energy.of("kinetic");
    verification::run_until(run, 1.0);
    potential[across] = run.state().energy.of("potential");
    EXPECT_LT(run.state().audit.residual, 1e-12);
  }
  EXPECT_NEAR(kinetic[1] / kinetic[0], 1.0, 0.02);
  EXPECT_NEAR(potential[1] / potential[0], 1.0, 0.005);
  RecordProperty("kinetic", fmt::format("{:.4f}", kinetic[1] / kinetic[0]));
  RecordProperty("potential", fmt::format("{:.4f}", potential[1] / potential[0]));
}

// The same bits for any number of threads and from a checkpoint, with two blocks along the axis, where each is on both
// sides of the other.
TEST(ImplicitPeriodic, KeepsItsBits) {
  for (const std::string& text : {heap(true), layer("solid", 30.0)}) verification::expect_kept_bits(text, 0.1, 0.2);
}

}  // namespace implicit_periodic_test
