// Balance of energy of the laws of soil: where a column collapses on a rough floor, and where a plate presses a bed and
// lets it go. Cost: 6 s.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "implicit_scene.hpp"

namespace soil_energy_test {

std::string column(const std::string& law) {
  return fmt::format(
      "geometry: plane_strain\ngravity: [0, -9.81]\ngrid: {{cell: 0.02, min: [0, 0], max: [1.2, 0.4]}}\n"
      "time: {{end: 1, sync: 0.01}}\nmaterials: [{{name: soil, density: 1500, law: {}}}]\n"
      "bodies: [{{name: column, material: soil, shape: {{box: {{min: [0, 0], max: [0.3, 0.3]}}}}}}]\n"
      "boundaries: {{all: slip, z_min: {{friction: 0.5}}}}\n",
      law);
}

/// A bed under which a plate moves down and up again, three times, deeper each time.
std::string pumped(const std::string& law) {
  return fmt::format(
      "geometry: plane_strain\ngravity: [0, -9.81]\nmethod: {{update: usavg}}\n"
      "grid: {{cell: 0.05, min: [0, 0], max: [1.6, 0.8]}}\ntime: {{end: 3, sync: 0.01}}\n"
      "materials: [{{name: soil, density: 1500, law: {}}}]\n"
      "bodies: [{{name: bed, material: soil, initial: geostatic, shape: {{box: {{min: [0, 0], max: [1.6, 0.5]}}}}}}]\n"
      "rigid_bodies: [{{name: plate, shape: {{box: {{size: [0.4, 0.2]}}}}, pose: {{position: [0.8, 0.601]}}, friction: "
      "0.3, motion: {{velocity: [0, \"-0.01 - 0.06 * cos(6.2832 * t)\"]}}}}]\n"
      "boundaries: {{all: slip, z_min: fixed, z_max: none}}\n",
      law);
}

const std::string kElastic = ", young: 2 MPa, poisson: 0.3";
const std::vector<std::string> kOfOwnStiffness = {
    "drucker_prager, friction_angle: 25 deg" + kElastic, "mohr_coulomb, friction_angle: 25 deg" + kElastic,
    "mu_i, mu_s: 0.38, mu_2: 0.64, I_0: 0.279, grain_diameter: 5 mm, grain_density: 2500" + kElastic};

// 1 % is the bound that reports have (report/report_check.hpp).
TEST(SoilEnergy, IsFoundAgainWhereAColumnCollapses) {
  for (const std::string& law : kOfOwnStiffness) {
    mpm::Simulation run = verification::start_text(column(law), {}, 2);
    const double start = run.state().energy.balance();
    verification::run_until(run, 1.0);
    const mpm::EnergyReport end = run.state().energy;
    EXPECT_TRUE(end.closed()) << law;
    EXPECT_NEAR(end.balance() / start, 1.0, 0.01) << law;
    EXPECT_GT(end.of("plastic"), 0.25 * start) << law;
    RecordProperty(law.substr(0, law.find(',')), fmt::format("{:.4f}", end.balance() / start));
  }
}

// Bound over the work of the plate, which is given and taken.
TEST(SoilEnergy, IsFoundAgainWhereAPlateMovesUpAndDown) {
  for (const std::string& law : kOfOwnStiffness) {
    mpm::Simulation run = verification::start_text(pumped(law), {}, 2);
    const double start = run.state().energy.balance();
    verification::run_until(run, 3.0);
    const mpm::EnergyReport end = run.state().energy;
    const double lost = end.balance() - start, work = end.of("contact_work");
    EXPECT_GT(work, 0.0) << law;
    EXPECT_NEAR(lost / work, 0.0, 0.01) << law;
    RecordProperty(law.substr(0, law.find(',')), fmt::format("{:.4f} {:.1f}", lost / work, work));
  }
}

TEST(SoilEnergy, IsLeftOpenWhereStiffnessFollowsPressure) {
  for (const char* law : {"norsand, gamma: 0.9, lambda: 0.03, M: 1.2, N: 0.3, chi: 3, H: 150, shear_modulus: 20 MPa, "
                          "poisson: 0.2, void_ratio: 0.7",
                          "cam_clay, lambda: 0.1, kappa: 0.02, M: 1.0, void_ratio: 1.2, poisson: 0.3, "
                          "preconsolidation_pressure: 5 kPa, least_pressure: 2 kPa"}) {
    EXPECT_FALSE(verification::start_text(column(law)).state().energy.closed()) << law;
  }
}

}  // namespace soil_energy_test
