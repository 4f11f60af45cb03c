// The energy of soil that a tool pushes, or that falls and spreads: what is stored and what plastic flow, friction on
// tools and walls and the transfer between particles and grid have taken is the work done on it. Each term is counted
// by itself. USL is left out: it loses energy by itself, which has no account. Source: balance of energy. 5 s.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "pair_scene.hpp"

namespace verification {
namespace energy_balance_test {

constexpr double kOpen = 0.01;  // part of the energy spent that may have no account

/// Energy of this kind that came or went since the start [J].
double since(const mpm::EnergyReport& before, const mpm::EnergyReport& after, const std::string& name) {
  return after.of(name) - before.of(name);
}

void expect_closed(const mpm::EnergyReport& before, const mpm::EnergyReport& after) {
  ASSERT_TRUE(after.closed());
  const double spent =
      std::max(since(before, after, "contact_work"), 0.0) + std::max(-since(before, after, "potential"), 0.0);
  EXPECT_GT(spent, 0.0);
  EXPECT_NEAR(after.balance() - before.balance(), 0.0, kOpen * spent);
}

/// A blade as deep as it cuts, 0.1 m, in sand of 30 degrees without dilation.
std::string blade(const std::string& contact, const std::string& update, double friction, const std::string& transfer) {
  return fmt::format(
      "geometry: plane_strain\ngravity: [0, -9.81]\n"
      "grid: {{cell: 0.0166666666666666667, min: [-0.15, -0.2], max: [0.5, 0.2]}}\ntime: {{end: 0.5, sync: 5 ms}}\n"
      "method: {{update: {}, transfer: {{flip: {}}}}}\ncontact: {{method: {}}}\n"
      "materials: [{{name: sand, density: 1600, young: 1 MPa, poisson: 0.3, law: drucker_prager, friction_angle: 30 "
      "deg}}]\n"
      "bodies:\n"
      "  - {{name: bed, material: sand, initial: geostatic, shape: {{box: {{min: [0, -0.2], max: [0.5, 0]}}}}}}\n"
      "  - {{name: cut, material: sand, initial: geostatic, shape: {{box: {{min: [-0.15, -0.2], max: [0, -0.1]}}}}}}\n"
      "rigid_bodies:\n  - {{name: blade, shape: {{polygon: {{points: [[0, 0], [0, 0.3], [-0.08, 0.3], [-0.08, "
      "0.02]]}}}}, "
      "pose: {{position: [0, -0.1]}}, friction: {}, motion: {{velocity: [\"0.1 * min(1, t / 0.05)\", 0]}}}}\n"
      "boundaries: {{x_min: slip, x_max: slip, z_min: {{friction: 0.5}}}}\n",
      update, transfer, contact, friction);
}

struct Way {
  const char *contact, *update;
};
void PrintTo(const Way& way, std::ostream* out) { *out << way.contact << '_' << way.update; }

class EnergyBalance : public testing::TestWithParam<Way> {};
INSTANTIATE_TEST_SUITE_P(Contact, EnergyBalance,
                         testing::Values(Way{"points", "usf"}, Way{"points", "usavg"}, Way{"nodes", "usf"},
                                         Way{"nodes", "usavg"}),
                         testing::PrintToStringParamName());

/// Expects the balance of the blade's run to close, and this energy to be larger than what may be missing.
void expect_balance(const Way& way, const std::string& transfer, const std::string& energy) {
  mpm::Simulation simulation = from_text(blade(way.contact, way.update, 0.2, transfer));
  const mpm::EnergyReport before = simulation.state().energy;
  run_until(simulation, 0.5);
  const mpm::EnergyReport after = simulation.state().energy;
  expect_closed(before, after);
  EXPECT_GT(after.of(energy), kOpen * after.of("contact_work")) << "the test would not see it";
}

TEST_P(EnergyBalance, OfSandBeforeABlade) { expect_balance(GetParam(), "1", "friction"); }

// The transfer takes a part of the particles' velocity that the grid does not see, which is the energy of sand that
// flies as well as of its noise.
TEST_P(EnergyBalance, WithWhatTheTransferTakes) { expect_balance(GetParam(), "0.9", "transfer"); }

// The transfer that soil has by default, which gives back a part of what PIC takes.
TEST_P(EnergyBalance, WithWhatXpicGivesBack) { expect_balance(GetParam(), "0.6, xpic: 2, every: 5", "transfer"); }

// A column of sand falls on a fixed floor and flows into the corners of a box whose sides are fixed, too.
TEST(EnergyBalanceOfWalls, OfSandThatFallsIntoABox) {
  for (const char* update : {"usf", "usavg"}) {
    mpm::Simulation simulation = from_text(fmt::format(
        "geometry: plane_strain\ngravity: [0, -9.81]\n"
        "grid: {{cell: 0.02, min: [0, 0], max: [0.4, 0.4]}}\ntime: {{end: 0.5, sync: 5 ms}}\n"
        "method: {{update: {}}}\n"
        "materials: [{{name: sand, density: 1600, young: 1 MPa, poisson: 0.3, law: drucker_prager, friction_angle: 30 "
        "deg}}]\n"
        "bodies: [{{name: column, material: sand, shape: {{box: {{min: [0.04, 0.04], max: [0.2, 0.32]}}}}}}]\n"
        "boundaries: {{x_min: fixed, x_max: fixed, z_min: fixed}}\n",
        update));
    const mpm::EnergyReport before = simulation.state().energy;
    run_until(simulation, 0.5);
    const mpm::EnergyReport after = simulation.state().energy;
    expect_closed(before, after);
    EXPECT_GT(after.of("wall_loss"), -kOpen * since(before, after, "potential")) << "the test would not see it";
  }
}

}  // namespace energy_balance_test
}  // namespace verification
