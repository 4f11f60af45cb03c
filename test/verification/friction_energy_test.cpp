// The energy that friction takes where a rigid body touches, at points and at nodes: the force of friction times the
// way that the surfaces slide on each other, and so nothing where they stick. Source: Coulomb's law and statics. 5 s.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <numeric>
#include <string>

#include "mpm/math/constants.hpp"
#include "pair_scene.hpp"

namespace verification {
namespace friction_energy_test {

constexpr double kMass = 500.0 * 0.4 * 0.2;  // mass of the block of block_on_plate [kg/m]

double place_of(const mpm::Simulation& simulation) { return mean_of(simulation, "x", "block"); }

// A plate swings under the block with 0.1 m/s at 5 Hz: 3.1 m/s^2, where friction bears 8. In ten periods m v^2 / 2 goes
// through the surface 40 times, and friction takes none of it but for what edges slide in turning. Counted with the
// slip that a step begins with, which points that stick have too when particles have given their momentum to nodes
// again, it would be 1.2 % of that.
class FrictionEnergyIn : public testing::TestWithParam<const char*> {
 protected:
  /// At nodes a part of friction's work shakes the block, since each node sticks and slides by itself.
  bool at_nodes() const { return std::string(GetParam()) == "nodes"; }
  std::string contact() const { return fmt::format("contact={{method: {}}}", GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(Contact, FrictionEnergyIn, testing::Values("points", "nodes"),
                         [](const auto& info) { return std::string(info.param); });

TEST_P(FrictionEnergyIn, ABlockThatSticksTakesNone) {
  constexpr double kSpeed = 0.1, kRate = 10.0 * mpm::kPi, kUntil = 2.0;
  mpm::Simulation simulation =
      start("block_on_plate",
            {contact(), "rigid_bodies.plate.friction=0.8",
             "rigid_bodies.plate.motion={velocity: [\"0.1*sin(10*pi*t)\", 0]}", "time.end=2.1"},
            1);
  const double from = place_of(simulation);
  run_until(simulation, kUntil);
  const double energy = simulation.take_contact(0).friction_energy, exchanged = 40.0 * 0.5 * kMass * kSpeed * kSpeed;
  EXPECT_NEAR(energy, 0.0, (at_nodes() ? 2e-3 : 1e-3) * exchanged);
  run_until(simulation, kUntil + 0.1);
  const double way = 2.0 * kSpeed / kRate;
  EXPECT_NEAR(place_of(simulation) - from, way, 0.01 * way) << "it has slid";
}

TEST_P(FrictionEnergyIn, OfASlidingBlockIsForceTimesWay) {
  constexpr double kFriction = 0.3, kAcross = 8.0;  // gravity on the plate [m/s^2]
  mpm::Simulation simulation =
      start("block_on_plate", {contact(), "rigid_bodies.plate.friction=0.3", "gravity=[6, -8]", "time.end=0.6"}, 1);
  const double balance = simulation.state().energy.balance();
  run_until(simulation, 0.1);
  const double from = place_of(simulation), before = simulation.take_contact(0).friction_energy;
  run_until(simulation, 0.5);
  const double way = place_of(simulation) - from, energy = simulation.take_contact(0).friction_energy - before;
  const double exact = kFriction * kMass * kAcross * way;
  EXPECT_NEAR(energy, exact, (at_nodes() ? 0.03 : 0.01) * exact);
  EXPECT_NEAR(simulation.state().energy.balance(), balance, 1e-3 * exact) << "it is nowhere else";
}

/// Ground under a wheel of 0.15 m radius.
std::string wheel(const std::string& law, const std::string& friction, const std::string& motion) {
  return fmt::format(
      "geometry: plane_strain\nthickness: 0.2\ngravity: [0, -9.81]\n"
      "grid: {{cell: 0.02, min: [0, 0], max: [1.2, 0.6]}}\ntime: {{end: 1.5, sync: 10 ms}}\n"
      "method: {{transfer: {{flip: 0.998}}}}\n"
      "materials: [{{name: ground, density: 1500, young: 0.5 MPa, poisson: 0.3, {}}}]\n"
      "bodies:\n  - {{name: ground, material: ground, initial: geostatic, "
      "shape: {{box: {{min: [0, 0], max: [1.2, 0.24]}}}}}}\n"
      "rigid_bodies:\n  - {{name: wheel, shape: {{sphere: {{radius: 0.15}}}}, pose: {{position: [0.25, 0.42]}}, "
      "friction: {}, motion: {{{}}}}}\n"
      "boundaries: {{all: slip, z_min: fixed, z_max: none}}\n",
      law, friction, motion);
}

// A wheel that spins where it stands slides on all that it touches, with the speed of its rim, while its ground rests.
TEST(FrictionEnergy, OfASpinningWheelIsForceTimesWayOfTheRim) {
  constexpr double kRim = 0.15 * 20.0, kFriction = 0.2;  // [m/s]
  mpm::Simulation simulation =
      from_text(wheel("law: linear_elastic", "0.2", "velocity: [0, \"t < 0.5 ? -0.08 : 0\"], rotation_rate: 20"));
  run_until(simulation, 0.6);
  const double before = simulation.take_contact(0).friction_energy;
  double pressed = 0.0;
  while (seconds(simulation) < 1.0 - 1e-9) {
    simulation.advance();
    const mpm::ContactReport report = simulation.take_contact(0);
    pressed += report.pressing * report.interval;
  }
  const double energy = simulation.take_contact(0).friction_energy - before;
  EXPECT_NEAR(energy, kFriction * kRim * pressed, 0.01 * kFriction * kRim * pressed);
}

// The wheel of README.md, which sinks into sand and rolls through it with a slip of a tenth: most of its points stick
// most of the time. Friction gives no energy over any tenth of a second, and takes no more than if all points slid all
// the time, as fast as the rim against the ground (while it sinks, as fast as it sinks).
TEST(FrictionEnergy, OfAWheelInSandGrows) {
  constexpr double kSinking = 0.14, kRim = 0.15 * 2.93, kHub = 0.4, kFriction = 0.6;  // [m/s]
  mpm::Simulation simulation = from_text(wheel("law: drucker_prager, friction_angle: 35 deg", "0.6",
                                               "velocity: [\"t > 0.5 && t < 1.5 ? 0.4 : 0\", \"t < 0.5 ? -0.14 : 0\"], "
                                               "rotation_rate: \"t > 0.5 && t < 1.5 ? 2.93 : 0\""));
  double last = 0.0, most = 0.0;
  for (int i = 1; i <= 15; ++i) {
    run_until(simulation, 0.1 * i);
    const mpm::ContactReport report = simulation.take_contact(0);
    const double slip = i <= 5 ? kSinking : kRim + kHub;
    most += kFriction * report.pressing * report.interval * slip;
    EXPECT_GE(report.friction_energy, last) << 0.1 * i << " s";
    last = report.friction_energy;
  }
  EXPECT_GT(last, 0.0);
  EXPECT_LT(last, most);
}

}  // namespace friction_energy_test
}  // namespace verification
