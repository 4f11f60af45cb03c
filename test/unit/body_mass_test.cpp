// The mass of bodies whose faces do not lie on the lattice of particles: density times the volume of the shape, with
// faces where the scene has them. A filling that takes or leaves whole particles misses it by 16 to 25 % here.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "mpm/advice/explain.hpp"
#include "mpm/math/constants.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm {
namespace body_mass_test {

std::string scene_of(const std::string& geometry, const std::string& grid, const std::string& shape,
                     const std::string& rest = "", const std::string& of_body = "") {
  return "geometry: " + geometry + "\ntime: {end: 0.1, sync: 0.005}\nmethod: {shape: ugimp}\ngrid: {" + grid +
         "}\nmaterials: [{name: m, law: linear_elastic, density: 1000, young: 1e5, poisson: 0.25}]\n"
         "bodies: [{name: b, material: m, shape: {" +
         shape + "}" + of_body + "}]\n" + rest;
}

double mass_of(const std::string& text) {
  std::vector<double> masses;
  SimulationOptions options;
  options.threads = 1;
  options.settle = false;
  Simulation(build(parse_scene(text, "mass.yaml")), options).particle_field("mass", masses);
  return std::accumulate(masses.begin(), masses.end(), 0.0);
}

const std::string kLayerGrid = "cell: 0.01, min: [0, 0], max: [0.2, 0.3]";

std::string layer(const std::string& low, const std::string& high) {
  return scene_of("plane_strain", kLayerGrid, "box: {min: [0, " + low + "], max: [0.2, " + high + "]}");
}

TEST(BodyMass, OfBoxesIsThatOfTheirVolume) {
  // 0.2 m by the thickness of 1 m by the height, of 1000 kg/m3.
  EXPECT_NEAR(mass_of(layer("0", "0.0125")), 2.5, 1e-9);
  EXPECT_NEAR(mass_of(layer("0.1025", "0.1125")), 2.0, 1e-9);
  // Both faces on centres of the grid's lattice, where the last digit once decided between 4 kg and 5 kg.
  EXPECT_NEAR(mass_of(layer("0.1025", "0.1225")), 4.0, 1e-9);
  EXPECT_NEAR(mass_of(layer("0.1025", "0.12250000000000001")), 4.0, 1e-9);
  const std::string block = "box: {min: [0, 0, 0], max: [0.1, 0.1, 0.1]}";
  EXPECT_NEAR(mass_of(scene_of("solid", "cell: 0.03, min: [0, 0, 0], max: [0.3, 0.3, 0.3]", block)), 1.0, 1e-9);
  // A ring from 3.1 to 7.7 mm, 5.3 mm high: the sections' mean radius is the ring's.
  const std::string ring = "box: {min: [0.0031, 0], max: [0.0077, 0.0053]}";
  EXPECT_NEAR(mass_of(scene_of("axisymmetric", "cell: 0.001, min: [0, 0], max: [0.02, 0.02]", ring)),
              1000 * kPi * (0.0077 * 0.0077 - 0.0031 * 0.0031) * 0.0053, 1e-9);
}

TEST(BodyMass, OfRoundAndUnevenBodiesIsThatOfTheirVolume) {
  const std::string cube = "cell: 0.02, min: [-0.1, -0.1, -0.1], max: [0.1, 0.1, 0.1]";
  EXPECT_NEAR(mass_of(scene_of("solid", cube, "sphere: {center: [0.003, 0, 0.001], radius: 0.033}")),
              1000 * 4.0 / 3.0 * kPi * std::pow(0.033, 3), 1e-9);
  EXPECT_NEAR(mass_of(scene_of("solid", cube, "cylinder: {center: [0, 0, 0], radius: 0.041, height: 0.025}")),
              1000 * kPi * 0.041 * 0.041 * 0.025, 1e-9);
  EXPECT_NEAR(mass_of(scene_of("plane_strain", "cell: 0.02, min: [-0.1, -0.1], max: [0.1, 0.1]",
                               "sphere: {center: [0, 0], radius: 0.05}")),
              1000 * kPi * 0.05 * 0.05, 1e-9);
  EXPECT_NEAR(mass_of(scene_of("axisymmetric", "cell: 0.01, min: [0, 0], max: [0.1, 0.2]",
                               "sphere: {center: [0, 0.1], radius: 0.047}")),
              1000 * 4.0 / 3.0 * kPi * std::pow(0.047, 3), 1e-9);
  // Ground 0.0525 m deep, and a wedge from 0.021 m to 0.077 m along the 0.2 m of its grid.
  EXPECT_NEAR(mass_of(scene_of("plane_strain", kLayerGrid, "height_field: {heights: 0.0525}")), 10.5, 1e-9);
  EXPECT_NEAR(mass_of(scene_of("plane_strain", kLayerGrid, "height_field: {heights: 0.021 + 0.28*x}")), 9.8, 0.005);
}

TEST(BodyMass, IsThatOfWhatIsLeftWhereAToolIsCutOut) {
  // A bed of 0.2 m by 0.1 m without a quarter of a disk of 0.043 m in its corner; the mass of what is left is kept
  // as it comes out where it is right to 0.2 %.
  const std::string tool =
      "rigid_bodies: [{name: t, shape: {sphere: {radius: 0.043}}, pose: {position: [0.2, 0.1]}}]\n";
  const std::string bed = "box: {min: [0, 0], max: [0.2, 0.1]}";
  const double whole = 20.0, quarter = 1000 * kPi * 0.043 * 0.043 / 4.0;
  EXPECT_NEAR(mass_of(scene_of("plane_strain", kLayerGrid, bed, tool, ", cut_out: all")), whole - quarter,
              0.002 * (whole - quarter));
}

TEST(BodyMass, LeavesWhatLiesOnTheGridsLatticeAsItIs) {
  for (const std::string& text : {layer("0.1", "0.115"), layer("0.005", "0.3")}) {
    const DeformableBody body = build(parse_scene(text, "mass.yaml")).bodies.at(0);
    EXPECT_FALSE(body.lattice);
    EXPECT_TRUE(body.filling.empty()) << body.filling;
    EXPECT_EQ(body.particle_volume, 0.01 / 2 * (0.01 / 2) * 1.0);
  }
  const Scene scene = parse_scene(layer("0", "0.0125"), "mass.yaml");
  const std::string text = explain(scene, build(scene));
  EXPECT_NE(text.find("particles of m (linear_elastic), 2.5 kg: particles 0.004167 m along z for the grid's 0.005 m"),
            std::string::npos)
      << text;
}

// With one particle a cell its domain, of half a spacing to either side, may not be wider than a cell: bodies of 1.45
// and 10.4 cells get 2 and 11 particles, where the nearest numbers are 1 and 10.
TEST(BodyMass, OfOneParticleACellIsInDomainsThatFit) {
  const std::vector<std::pair<std::string, double>> heights = {{"0.0145", 0.0145 / 2}, {"0.104", 0.104 / 11}};
  for (const auto& [height, spacing] : heights) {
    const Scene scene = parse_scene(layer("0", height), "mass.yaml", {"method.particles_per_cell=1"});
    const SimulationDefinition built = build(scene);
    ASSERT_TRUE(built.bodies[0].lattice);
    EXPECT_NEAR(built.bodies[0].lattice->spacing.z(), spacing, 1e-12);
    SimulationOptions options;
    options.threads = 1;
    std::vector<double> masses;
    Simulation(built, options).particle_field("mass", masses);
    EXPECT_NEAR(std::accumulate(masses.begin(), masses.end(), 0.0), 1000 * 0.2 * std::stod(height), 1e-9);
  }
}

// Columns of 0.1426 m in 29 parts are none of the bed's, of 0.005 m: the run tells that the start leaves their weight
// out. A body on the same columns is of no concern, nor one in the air.
TEST(BodyMass, OfOtherColumnsIsLeftOutOfAGeostaticStartAloud) {
  const auto warnings = [](const std::string& low, const std::string& high) {
    const std::string upper = ", initial: geostatic}, {name: top, material: m, shape: {box: {min: [" + low +
                              "], max: [" + high + "]}}, initial: geostatic";
    const std::string rest = "gravity: [0, -10]\nboundaries: {z_min: slip, x_min: slip, x_max: slip}\n";
    const std::string text = scene_of("plane_strain", kLayerGrid, "box: {min: [0, 0], max: [0.2, 0.1]}", rest, upper);
    SimulationOptions options;
    options.threads = 1;
    options.settle = false;
    std::vector<std::string> found;
    for (const std::string& warning : Simulation(build(parse_scene(text, "mass.yaml")), options).warnings()) {
      if (warning.find("columns") != std::string::npos) found.push_back(warning);
    }
    return found;
  };
  const std::vector<std::string> found = warnings("0.0312, 0.1", "0.1738, 0.15");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].find("body 'top' starts geostatic on body 'b', "), 0U) << found[0];
  EXPECT_TRUE(warnings("0.03, 0.1", "0.175, 0.15").empty());
  EXPECT_TRUE(warnings("0.0312, 0.2", "0.1738, 0.25").empty());
}

// The floor carries the weight, and a traction on the top the force of its whole width: the particles' domains reach
// from face to face of the body. It starts geostatic, and so stands still.
TEST(BodyMass, WeighsOnTheFloorWhatItIs) {
  const std::string loads =
      "gravity: [0, -10]\nboundaries: {z_min: slip, x_min: slip, x_max: slip}\n"
      "loads: [{pressure: {body: b, edge: z_max, value: 40}}]\n";
  const std::string text =
      scene_of("plane_strain", kLayerGrid, "box: {min: [0, 0], max: [0.2, 0.0325]}", loads, ", initial: geostatic");
  Simulation run(build(parse_scene(text, "mass.yaml")), {1});
  while (run.time() < 100'000'000) run.advance();
  const double weight = 0.2 * 0.0325 * 1000 * 10, pressed = 40 * 0.2, seconds = 0.1;
  double floor = 0.0, load = 0.0, gravity = 0.0;
  for (const NamedImpulse& impulse : run.state().audit.impulses) {
    if (impulse.name == "wall/z_min") floor = impulse.impulse.z();
    if (impulse.name == "gravity") gravity = impulse.impulse.z();
    if (impulse.name.find("traction") != std::string::npos || impulse.name.find("pressure") != std::string::npos) {
      load = impulse.impulse.z();
    }
  }
  EXPECT_NEAR(gravity, -weight * seconds, 1e-9);
  EXPECT_NEAR(load, -pressed * seconds, 1e-3 * pressed * seconds);  // its face hardly widens
  EXPECT_NEAR(floor, (weight + pressed) * seconds, 0.01 * weight * seconds);
}

}  // namespace body_mass_test
}  // namespace mpm
