// Parts of the strain of material that has grown by heat or moisture: what grows freely has neither elastic nor plastic
// strain, whatever its law; what is held has the elastic strain of its stress. Cost: 1 s.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm::test {
namespace warm_strain_test {

constexpr double kYoung = 1e6, kPoisson = 0.3, kFree = 2e-3;  // [Pa], and 1e-4 /K times 20 K
constexpr double kSecondOrder = 4 * kFree * kFree;            // logarithms, and stress by Cauchy or Kirchhoff

const char* const kCube = R"yaml(geometry: solid
grid: {cell: 0.1, min: [-0.1,-0.1,-0.1], max: [0.3,0.3,0.3]}
method: {damping: {grid: 60}, transfer: apic}
time: {end: 0.4, sync: 0.02}
bodies: [{name: b, material: m, shape: {box: {min: [0,0,0], max: [0.2,0.2,0.2]}}}]
transport: {temperature: {reference: 280, initial: 300, compression_heat: off}}
)yaml";

struct OneLaw {
  const char* name;
  const char* keys;
};

// Soil that holds together: grains without cohesion part as they swing, which is a plastic strain.
const OneLaw kLaws[] = {{"linear_elastic", "young: 1e6, poisson: 0.3"},
                        {"neo_hookean", "young: 1e6, poisson: 0.3"},
                        {"j2_plasticity", "young: 1e6, poisson: 0.3, yield_stress: 1e5"},
                        {"drucker_prager", "young: 1e6, poisson: 0.3, friction_angle: 30 deg, cohesion: 1e5"},
                        {"mohr_coulomb", "young: 1e6, poisson: 0.3, friction_angle: 30 deg, cohesion: 1e5"},
                        {"viscoelastic", "young: 1e6, poisson: 0.3, branch_modulus: 1e-3, relaxation_time: 0.1"}};

Simulation cube(const std::string& law, std::vector<std::string> changes = {}) {
  const std::string material =
      "materials: [{name: m, density: 1000, heat_capacity: 100, thermal_expansion: 1e-4, " + law + "}]\n";
  Simulation run(parse_scene(material + kCube, "warm.yaml", std::move(changes)), {1});
  while (static_cast<double>(run.time()) < 0.4e9) run.advance();
  return run;
}

double mean_of(const Simulation& run, const std::string& field) {
  std::vector<double> values;
  run.particle_field(field, values);
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double largest_of(const Simulation& run, const std::string& field) {
  std::vector<double> values;
  run.particle_field(field, values);
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

// 1 % of the free strain: what is left of the swinging, and of faces that lie in other cells than at the start.
TEST(WarmStrain, OfAFreeBodyIsNeitherElasticNorPlastic) {
  for (const OneLaw& law : kLaws) {
    const Simulation run = cube(std::string("law: ") + law.name + ", " + law.keys);
    for (const std::string axes : {"xx", "yy", "zz"}) {
      EXPECT_NEAR(mean_of(run, "e" + axes), std::log1p(kFree), 0.01 * kFree) << law.name;
      EXPECT_LT(largest_of(run, "e" + axes + "e"), 0.01 * kFree) << law.name;
      EXPECT_LT(largest_of(run, "e" + axes + "p"), 0.01 * kFree) << law.name;
    }
  }
}

// In plane strain the free strain across the plane is held: an elastic strain of as much, and no plastic one.
TEST(WarmStrain, OfPlanesIsHeldAcrossThemOrFree) {
  const std::vector<std::string> flat = {"grid.min=[-0.1, -0.1]", "grid.max=[0.3, 0.3]",
                                         "bodies.b.shape.box={min: [0, 0], max: [0.2, 0.2]}"};
  for (const OneLaw& law : kLaws) {
    for (const std::string geometry : {"plane_strain", "plane_stress"}) {
      const bool held = geometry == "plane_strain";
      if (!held && std::string(law.name) != "linear_elastic" && std::string(law.name) != "neo_hookean") continue;
      std::vector<std::string> changes = flat;
      changes.push_back("geometry=" + geometry);
      const Simulation run = cube(std::string("law: ") + law.name + ", " + law.keys, changes);
      EXPECT_NEAR(mean_of(run, "eyy"), held ? 0.0 : std::log1p(kFree), 0.01 * kFree) << law.name;
      EXPECT_NEAR(mean_of(run, "eyye"), held ? -kFree : 0.0, 0.01 * kFree) << law.name;
      EXPECT_NEAR(mean_of(run, "exxe"), held ? kPoisson * kFree : 0.0, 0.01 * kFree) << law.name;
      for (const char* plastic : {"exxp", "eyyp", "ezzp"})
        EXPECT_LT(largest_of(run, plastic), 0.01 * kFree) << law.name;
    }
  }
}

// Held along x alone: a stress of -E alpha dT there, and none across. The cube's elastic strain is that of the stress
// by Hooke's law, and what it has in all is that and the free strain.
TEST(WarmStrain, OfAHeldBodyIsElasticByItsStress) {
  const std::vector<std::string> held = {"grid.min=[0, -0.1, -0.1]", "grid.max=[0.2, 0.3, 0.3]",
                                         "boundaries={x_min: slip, x_max: slip}"};
  for (const OneLaw& law : kLaws) {
    const Simulation run = cube(std::string("law: ") + law.name + ", " + law.keys, held);
    const double sxx = mean_of(run, "sxx"), syy = mean_of(run, "syy"), szz = mean_of(run, "szz");
    EXPECT_NEAR(sxx, -kYoung * kFree, 0.01 * kYoung * kFree) << law.name;
    EXPECT_NEAR(mean_of(run, "exxe"), (sxx - kPoisson * (syy + szz)) / kYoung, kSecondOrder) << law.name;
    EXPECT_NEAR(mean_of(run, "eyye"), (syy - kPoisson * (szz + sxx)) / kYoung, kSecondOrder) << law.name;
    EXPECT_NEAR(mean_of(run, "exx"), 0.0, 1e-6 * kFree) << law.name;
    EXPECT_NEAR(mean_of(run, "eyye"), kPoisson * kFree, 0.01 * kFree) << law.name;
    EXPECT_NEAR(mean_of(run, "eyy"), (1.0 + kPoisson) * kFree, 0.01 * kFree) << law.name;
    for (const std::string axes : {"xx", "yy", "zz"}) {
      EXPECT_LT(largest_of(run, "e" + axes + "p"), 0.01 * kFree) << law.name;
    }
  }
}

// Yield stress of half of what the heat would bring: Mises' flow keeps the volume, so that half of the free strain
// has flowed along x, and a quarter of it the other way along y and z.
TEST(WarmStrain, OfAHeldBodyThatYieldsIsPlasticByWhatItHasFlowed) {
  const Simulation run =
      cube("law: j2_plasticity, young: 1e6, poisson: 0.3, yield_stress: 1e3",
           {"grid.min=[0, -0.1, -0.1]", "grid.max=[0.2, 0.3, 0.3]", "boundaries={x_min: slip, x_max: slip}",
            "transport.temperature.initial=280", "transport.temperature.sources=[{ramp: '280 + 20*min(1, t/0.3)'}]"});
  EXPECT_NEAR(mean_of(run, "exxe"), -0.5 * kFree, 0.01 * kFree);
  EXPECT_NEAR(mean_of(run, "exxp"), -0.5 * kFree, 0.01 * kFree);
  EXPECT_NEAR(mean_of(run, "eyyp"), 0.25 * kFree, 0.01 * kFree);
  EXPECT_NEAR(mean_of(run, "ep"), 0.5 * kFree, 0.01 * kFree);
}

}  // namespace warm_strain_test
}  // namespace mpm::test
