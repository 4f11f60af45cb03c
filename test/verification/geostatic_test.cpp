// Soil at rest at the start. On the grid's lattice the weight of the particles above is exactly in balance with the
// nodal forces, so a level bed is at rest to round-off immediately. Where no such stress exists (free sides, slopes),
// the bed settles to the required residual.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

namespace geostatic_test {

constexpr double kG = 9.81;

mpm::Simulation simulation(const std::string& text, const std::vector<std::string>& overrides = {}, int threads = 1) {
  return mpm::Simulation(mpm::build(mpm::parse_scene(text, "bed.yaml", overrides)), {threads});
}

std::vector<double> field(const mpm::Simulation& run, const char* name) {
  std::vector<double> values;
  run.particle_field(name, values);
  return values;
}

/// Largest speed of any particle at any sync point [m/s].
double largest_speed(mpm::Simulation& run, double end) {
  double most = 0.0;
  while (1e-9 * static_cast<double>(run.time()) < end - 1e-12) {
    run.advance();
    const std::vector<double> speed = field(run, "speed");
    most = std::max(most, *std::max_element(speed.begin(), speed.end()));
  }
  return most;
}

std::string level_bed(const std::string& law, const std::string& geometry = "plane_strain") {
  const std::string inner = geometry == "plane_strain" ? "x_min: slip, " : "";  // or the axis
  return "geometry: " + geometry +
         "\n"
         "grid: {cell: 0.05, min: [0, 0], max: [0.6, 0.8]}\n"
         "time: {end: 1, sync: 0.01}\n"
         "method: {shape: ugimp, update: usavg, transfer: flip}\n"
         "gravity: [0, -9.81]\n"
         "materials: [{name: ground, density: 1600, " +
         law +
         "}]\n"
         "bodies: [{name: bed, material: ground, shape: {box: {min: [0, 0], max: [0.6, 0.5]}}, initial: geostatic}]\n"
         "boundaries: {" +
         inner + "x_max: slip, z_min: {friction: 0.6}}\n";
}

const std::string kSand = "law: drucker_prager, young: 1 MPa, poisson: 0.3, friction_angle: 34 deg";

// Vertical stress rho g times depth, horizontal stress k0 of it; nothing moves for a second without damping. This
// includes the first cell: its nodes beyond the surface carry little mass and little weight.
TEST(Geostatic, LevelBedRestsExactly) {
  const struct {
    std::string law;
    double k0;
    std::string geometry = "plane_strain";
  } cases[] = {
      {kSand, 1.0 - std::sin(34.0 * M_PI / 180.0)},  // Jaky (1944)
      {kSand, 1.0 - std::sin(34.0 * M_PI / 180.0), "axisymmetric"},
      {"law: mohr_coulomb, young: 1 MPa, poisson: 0.3, friction_angle: 34 deg", 1.0 - std::sin(34.0 * M_PI / 180.0)},
      {"law: linear_elastic, young: 1 MPa, poisson: 0.3", 3.0 / 7.0},  // nu / (1 - nu)
  };
  for (const auto& [law, k0, geometry] : cases) {
    mpm::Simulation run = simulation(level_bed(law, geometry));
    EXPECT_EQ(run.warnings().size(), 0u);
    ASSERT_EQ(run.notes().size(), 1u);
    EXPECT_EQ(run.notes()[0].find("geostatic start of 'bed': unbalanced force "), 0u) << run.notes()[0];
    const std::vector<double> z = field(run, "z"), x = field(run, "x");
    for (const double end : {0.0, 1.0}) {
      // A wave crosses the bed in 0.02 s: round-off of g over that, many times over.
      EXPECT_LT(largest_speed(run, end), 1e-12) << law;
      const std::vector<double> szz = field(run, "szz"), sxx = field(run, "sxx"), syy = field(run, "syy");
      for (std::size_t p = 0; p < z.size(); ++p) {
        const double exact = -1600.0 * kG * (0.5 - z[p]);
        EXPECT_NEAR(szz[p], exact, 1e-9 * 1600.0 * kG * 0.5) << law;
        EXPECT_NEAR(sxx[p], k0 * exact, 1e-9 * 1600.0 * kG * 0.5) << law;
        EXPECT_NEAR(syy[p], k0 * exact, 1e-9 * 1600.0 * kG * 0.5) << law;
      }
    }
    EXPECT_LT(run.state().audit.residual, 1e-10);
    EXPECT_EQ(run.state().energy.of("plastic"), 0.0);
  }
}

// The same bed without a geostatic start: its weight acts suddenly and it bounces. The first swing of a column under
// its weight reaches the speed g H / c with the wave speed c (a wave of speed -g t runs down from the free surface):
// 0.17 m/s here.
TEST(Geostatic, WithoutItTheBedBounces) {
  mpm::Simulation run = simulation(level_bed(kSand), {"bodies.bed.initial={velocity: [0, 0]}"});
  const double c = std::sqrt(1e6 * 0.7 / (1.3 * 0.4) / 1600.0);
  EXPECT_GT(largest_speed(run, 0.2), 0.5 * kG * 0.5 / c);
}

// Layers: heavy over light over heavy, each with its own k0; every particle carries the weight above it.
TEST(Geostatic, LayersCarryEachOther) {
  const std::string scene =
      "grid: {cell: 0.1, min: [0, 0, 0], max: [0.4, 0.4, 1]}\n"
      "time: {end: 1, sync: 0.01}\n"
      "method: {shape: ugimp, update: usavg, transfer: flip}\n"
      "gravity: [0, 0, -9.81]\n"
      "materials:\n"
      "  - {name: sand, density: 1500, law: drucker_prager, young: 2 MPa, poisson: 0.3, friction_angle: 30 deg}\n"
      "  - {name: clay, density: 2000, law: mohr_coulomb, young: 1 MPa, poisson: 0.3, friction_angle: 0, cohesion: 50 "
      "kPa}\n"
      "bodies:\n"
      "  - {name: top, material: clay, shape: {box: {min: [0, 0, 0.5], max: [0.4, 0.4, 0.7]}}, initial: geostatic}\n"
      "  - {name: low, material: clay, shape: {box: {min: [0, 0, 0], max: [0.4, 0.4, 0.2]}}, initial: {geostatic: {k0: "
      "0.8}}}\n"
      "  - {name: mid, material: sand, shape: {box: {min: [0, 0, 0.2], max: [0.4, 0.4, 0.5]}}, initial: geostatic}\n"
      "boundaries: {x_min: slip, x_max: slip, y_min: slip, y_max: slip, z_min: slip}\n";
  mpm::Simulation run = simulation(scene);
  EXPECT_LT(largest_speed(run, 0.5), 1e-12);
  const std::vector<double> z = field(run, "z"), szz = field(run, "szz"), sxx = field(run, "sxx"),
                            syy = field(run, "syy");
  for (std::size_t p = 0; p < z.size(); ++p) {
    double weight = 2000.0 * std::min(0.2, 0.7 - z[p]), k0 = 1.0;  // frictionless clay: 1 - sin 0
    if (z[p] < 0.5) weight += 1500.0 * std::min(0.3, 0.5 - z[p]), k0 = 0.5;
    if (z[p] < 0.2) weight += 2000.0 * (0.2 - z[p]), k0 = 0.8;
    EXPECT_NEAR(szz[p], -kG * weight, 1e-5);  // 1e-9 of the stress at the base, 12 kPa
    EXPECT_NEAR(sxx[p], -k0 * kG * weight, 1e-5);
    EXPECT_NEAR(syy[p], -k0 * kG * weight, 1e-5);
  }
}

// Water in a basin: k0 is 1, and the weight compresses the water, so the initial stress has to settle, because all
// particles have the same mass.
TEST(Geostatic, WaterRestsInItsBasin) {
  mpm::Simulation run =
      simulation(level_bed("law: newtonian_fluid, bulk_modulus: 2 MPa, viscosity: 0.001"), {"boundaries.z_min=slip"});
  // Required: a residual of 1e-3 of the weight, which an oscillation of the column turns into 1e-3 g H / c, c = 35 m/s;
  // three times that for several modes together.
  EXPECT_LT(largest_speed(run, 0.5), 3.0 * 1e-3 * kG * 0.5 / 35.0);
  const std::vector<double> z = field(run, "z"), p = field(run, "p");
  for (std::size_t i = 0; i < z.size(); ++i) {
    EXPECT_NEAR(p[i], 1600.0 * kG * (0.5 - z[i]), 0.01 * 1600.0 * kG * 0.5);
  }
}

// A soft block with free sides cannot carry the horizontal stress of a bed, and settles.
TEST(Geostatic, AFreeBlockSettlesToTheResidualAskedFor) {
  const std::string scene =
      "geometry: plane_strain\n"
      "grid: {cell: 0.05, min: [0, 0], max: [1, 1]}\n"
      "time: {end: 1, sync: 0.01}\n"
      "method: {shape: ugimp, update: usavg, transfer: flip}\n"
      "gravity: [0, -9.81]\n"
      "materials: [{name: rubber, density: 1000, law: neo_hookean, young: 0.2 MPa, poisson: 0.3}]\n"
      "bodies: [{name: block, material: rubber, shape: {box: {min: [0.3, 0], max: [0.7, 0.4]}}, initial: geostatic}]\n"
      "boundaries: {z_min: slip}\n";
  mpm::Simulation bouncing = simulation(scene, {"bodies.block.initial={velocity: [0, 0]}"});
  const double before = largest_speed(bouncing, 0.3);
  for (const char* residual : {"1e-3", "1e-4"}) {
    mpm::Simulation run =
        simulation(scene, {std::string("bodies.block.initial={geostatic: {residual: ") + residual + "}}"});
    ASSERT_EQ(run.notes().size(), 1u) << residual;
    EXPECT_EQ(run.time(), 0);
    EXPECT_EQ(run.state().energy.of("kinetic"), 0.0);
    EXPECT_GT(run.state().energy.of("elastic"), 0.0);
    // The unbalanced part of gravity causes the same oscillation as all of it, scaled; ten times that for several
    // modes.
    EXPECT_LT(largest_speed(run, 0.3), 10.0 * std::stod(residual) * before) << residual;
    // Mean vertical stress: half of the weight above the base.
    const std::vector<double> szz = field(run, "szz");
    double mean = 0.0;
    for (const double s : szz) mean += s / static_cast<double>(szz.size());
    EXPECT_NEAR(mean, -0.5 * 1000.0 * kG * 0.4, 0.01 * 0.5 * 1000.0 * kG * 0.4);
    EXPECT_LT(run.state().audit.residual, 1e-10);
  }
}

// A pile that is steeper than the sand can stand slides down before the run begins; and a tool that will move is kept
// at rest until then.
TEST(Geostatic, ToolsAreHeldAndAPileSlidesFirst) {
  const std::string scene =
      "geometry: plane_strain\n"
      "grid: {cell: 0.05, min: [0, 0], max: [2, 1]}\n"
      "time: {end: 1, sync: 0.01}\n"
      "method: {shape: ugimp, update: usavg, transfer: flip}\n"
      "gravity: [0, -9.81]\n"
      "materials: [{name: sand, density: 1600, " +
      kSand +
      "}]\n"
      "bodies: [{name: pile, material: sand, shape: {box: {min: [0.5, 0], max: [1, 0.3]}},\n"
      "          initial: {geostatic: {residual: 0.02}}}]\n"
      "rigid_bodies: [{name: plate, shape: {box: {size: [0.2, 0.6]}}, pose: {position: [0.4, 0.3]},\n"
      "                motion: {velocity: [-1, 0]}, friction: 0.4}]\n"
      "boundaries: {z_min: {friction: 0.6}}\n";
  mpm::Simulation run = simulation(scene);
  EXPECT_EQ(run.bodies()[0].pose.position.x(), 0.4);
  const std::vector<double> x = field(run, "x"), z = field(run, "z");
  EXPECT_GT(*std::max_element(x.begin(), x.end()), 1.05);  // the sand slid to the right, away from the plate
  EXPECT_GT(*std::min_element(x.begin(), x.end()), 0.45);
  ASSERT_EQ(run.state().audit.impulses.size(), 3u);
  for (const mpm::NamedImpulse& impulse : run.state().audit.impulses) EXPECT_EQ(impulse.impulse.norm(), 0.0);
  run.advance();
  EXPECT_LT(run.bodies()[0].pose.position.x(), 0.4);
  EXPECT_LT(run.state().audit.residual, 1e-10);
}

TEST(Geostatic, SameBitsForAnyNumberOfThreads) {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2}) {
    mpm::Simulation run = simulation(level_bed(kSand),
                                     {"bodies.bed.shape.box.max=[0.4, 0.3]", "boundaries.x_max=none",
                                      "grid.max=[1, 0.8]", "bodies.bed.initial={geostatic: {residual: 0.05}}"},
                                     threads);
    run.advance();
    hashes.push_back(run.state_hash());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace geostatic_test
