// Single elements along paths of strain and stress, against theory.
#include "mpm/material/path_driver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "mpm/math/constants.hpp"

namespace mpm {
namespace path_driver_test {

using mpm::kDegree;
const Elasticity kElasticity{10e6, 0.3};
constexpr int kXx = 0, kYy = 1, kZz = 2, kXz = 4;

MohrCoulombDefinition mohr_coulomb(double friction, double dilation, double cohesion) {
  return {kElasticity, friction * kDegree, dilation * kDegree, cohesion, -1.0};
}
DruckerPragerDefinition drucker_prager(double friction, double dilation, double cohesion, ConeMatch match) {
  return {kElasticity, friction * kDegree, dilation * kDegree, cohesion, -1.0, match};
}

PathDriver driven(const LawDefinition& law, const std::string& path, const PathDefinition& definition = {}) {
  PathDriver driver({"m", 1600.0, law});
  for (const Leg& leg : make_strain_path(path, definition)) driver.run(leg);
  return driver;
}

Components stress_of(const PathDriver& driver) { return components(driver.point().cauchy()); }

// Stresses are controlled to 1e-11 of the largest, which the slope Kp = 3 of the strength amplifies to 3e-11, plus
// round-off.
constexpr double kSolved = 1e-10;

// exact-solutions 24: axial strength Kp s3 + 2 c sqrt(Kp), Kp = 3 at 30 degrees: 300 kPa at 100 kPa without cohesion.
// This holds for any dilation angle and number of steps, and for both laws.
TEST(PathDriver, TriaxialCompressionReachesTheStrength) {
  for (const double cohesion : {0.0, 20e3}) {
    const double strength = 300e3 + 2.0 * cohesion * std::sqrt(3.0);
    for (const double dilation : {0.0, 10.0, 30.0}) {
      for (const LawDefinition& law : std::vector<LawDefinition>{
               mohr_coulomb(30, dilation, cohesion), drucker_prager(30, dilation, cohesion, ConeMatch::compression)}) {
        for (const int steps : {5, 200}) {
          PathDefinition definition;
          definition.strain = -0.08;
          definition.confining = 100e3;
          definition.steps = steps;
          const Components stress = stress_of(driven(law, "triaxial", definition));
          EXPECT_NEAR(stress[kXx], -100e3, kSolved * strength);
          EXPECT_NEAR(stress[kYy], -100e3, kSolved * strength);
          EXPECT_NEAR(stress[kZz], -strength, kSolved * strength);
        }
      }
    }
  }
}

// Soil so soft that the pressure alone shortens it by more than the test does is still compressed further: strain
// counts from the confined state. E = 0.5 MPa, nu = 0.3, hypoelastic: Cauchy stress follows logarithmic strain by
// Hooke's law, p (1 - 2 nu) / E = 8 % under 100 kPa, then E times 2 % more at constant lateral stress.
TEST(PathDriver, TriaxialStrainCountsFromTheConfinedState) {
  PathDriver driver({"m", 1600.0, LinearElasticDefinition{{500e3, 0.3}}});
  PathDefinition definition;
  definition.strain = -0.02;
  definition.confining = 100e3;
  const StrainPath path = make_strain_path("triaxial", definition);
  driver.run(path[0]);
  EXPECT_NEAR(driver.strain()[kZz], -0.08, kSolved);
  driver.run(path[1]);
  EXPECT_NEAR(driver.strain()[kZz], -0.10, kSolved);
  EXPECT_NEAR(stress_of(driver)[kZz], -110e3, kSolved * 110e3);
}

// In extension the roles are exchanged: axial stress is (100 - 2 c sqrt(Kp)) / 3.
TEST(PathDriver, TriaxialExtensionReachesTheStrength) {
  for (const double cohesion : {0.0, 20e3}) {
    const double strength = (100e3 - 2.0 * cohesion * std::sqrt(3.0)) / 3.0;
    for (const LawDefinition& law : std::vector<LawDefinition>{
             mohr_coulomb(30, 10, cohesion), drucker_prager(30, 10, cohesion, ConeMatch::extension)}) {
      PathDefinition definition;
      definition.strain = 0.08;
      const Components stress = stress_of(driven(law, "triaxial", definition));
      EXPECT_NEAR(stress[kXx], -100e3, kSolved * 100e3);
      EXPECT_NEAR(stress[kZz], -strength, kSolved * 100e3);
    }
  }
}

// Dense soil: once axial stress is constant there is no more elastic strain, and volume grows by the flow rule. Axial
// strain -d gives radial Kpsi d / 2 each with Kpsi = (1 + sin psi) / (1 - sin psi): de_v / de_axial = 1 - Kpsi.
TEST(PathDriver, MohrCoulombDilatesByTheFlowRule) {
  for (const double dilation : {0.0, 10.0, 30.0}) {
    PathDriver driver({"m", 1600.0, mohr_coulomb(30, dilation, 0.0)});
    PathDefinition definition;
    definition.strain = -0.05;
    const StrainPath path = make_strain_path("triaxial", definition);
    for (const Leg& leg : path) driver.run(leg);
    const Components before = driver.strain();
    Leg more = path.back();
    more.target[kZz] = -0.01;  // from the present state
    driver.run(more);
    const Components after = driver.strain();
    const double sine = std::sin(dilation * kDegree);
    const double volume = after[kXx] + after[kYy] + after[kZz] - before[kXx] - before[kYy] - before[kZz];
    // Stress is controlled to 1e-11 of 300 kPa, hence elastic strain to that over 10 MPa, relative to the driven 0.01.
    EXPECT_NEAR(volume / -0.01, 1.0 - (1.0 + sine) / (1.0 - sine), 1e-9) << dilation;
  }
}

// exact-solutions 24: s_h / s_v = nu / (1 - nu) until yield; with phi = 20 degrees and c = 5 kPa this meets the
// strength s_v = Kp s_h + 2 c sqrt(Kp) at s_v = 2 c sqrt(Kp) / (1 - Kp nu / (1 - nu)), and from then on the stress
// stays on that line.
TEST(PathDriver, OedometerIsElasticUntilYield) {
  const double kp = std::tan(55.0 * kDegree) * std::tan(55.0 * kDegree), ratio = 0.3 / 0.7, cohesion = 5e3;
  const double yields_at = 2.0 * cohesion * std::sqrt(kp) / (1.0 - kp * ratio);
  for (const LawDefinition& law : std::vector<LawDefinition>{mohr_coulomb(20, 0, cohesion),
                                                             drucker_prager(20, 0, cohesion, ConeMatch::compression)}) {
    PathDriver driver({"m", 1600.0, law});
    PathDefinition definition;
    definition.strain = -0.03;
    int elastic = 0, plastic = 0;
    for (const Leg& leg : make_strain_path("uniaxial_strain", definition)) {
      driver.run(leg, [&] {
        const Components stress = stress_of(driver);
        if (driver.point().plastic_strain() == 0.0) {
          ++elastic;
          EXPECT_LE(-stress[kZz], yields_at * (1.0 + 1e-12));
          EXPECT_NEAR(stress[kXx] / stress[kZz], ratio, 1e-12);
        } else {
          ++plastic;
          EXPECT_GE(-stress[kZz], yields_at * (1.0 - 1e-12));
          EXPECT_NEAR(-stress[kZz], -kp * stress[kXx] + 2.0 * cohesion * std::sqrt(kp), 1e-12 * 1e6);
        }
      });
    }
    EXPECT_GT(elastic, 10);
    EXPECT_GT(plastic, 10);
  }
}

// Rate form along axes that do not turn: Cauchy stress E times the logarithmic strain, sides -nu times it.
TEST(PathDriver, LinearElasticBarFollowsYoung) {
  PathDefinition definition;
  definition.strain = 0.2;
  definition.steps = 7;
  const PathDriver driver = driven(LinearElasticDefinition{kElasticity}, "uniaxial_stress", definition);
  EXPECT_NEAR(stress_of(driver)[kZz], 0.2 * 10e6, kSolved * 2e6);
  EXPECT_NEAR(driver.logarithmic_strain().xx, -0.3 * 0.2, 1e-10);
  EXPECT_NEAR(driver.logarithmic_strain().zz, 0.2, 1e-14);
  EXPECT_NEAR(driver.point().j(), std::exp(0.4 * 0.2), 1e-10);
  EXPECT_NEAR(driver.time(), 0.2, 1e-15);
}

// sigma = K/2 (J - 1/J) I + G J^(-5/3) dev B.
TEST(PathDriver, NeoHookeanFollowsItsClosedForms) {
  const double bulk = kElasticity.bulk(), shear = kElasticity.shear();
  const LawDefinition law = NeoHookeanDefinition{kElasticity};
  PathDefinition definition;
  definition.strain = -0.5;
  const double j = std::exp(-0.5);
  // Round-off of J - 1/J: 1e-16 of the bulk modulus a step, 100 steps.
  EXPECT_NEAR(stress_of(driven(law, "volumetric", definition))[kXx], 0.5 * bulk * (j - 1.0 / j), 1e-13 * bulk);
  const double b = j * j, lateral = shear * std::pow(j, -5.0 / 3.0) * (1.0 - b) / 3.0;
  EXPECT_NEAR(stress_of(driven(law, "uniaxial_strain", definition))[kXx], 0.5 * bulk * (j - 1.0 / j) + lateral,
              1e-13 * bulk);
  definition.strain = 0.8;  // simple shear: J = 1, B_xz = gamma
  const PathDriver sheared = driven(law, "simple_shear", definition);
  EXPECT_NEAR(stress_of(sheared)[kXz], 0.8 * shear, 1e-13 * bulk);
  EXPECT_NEAR(stress_of(sheared)[kXx], shear * 0.64 * 2.0 / 3.0, 1e-13 * bulk);
  EXPECT_NEAR(stress_of(sheared)[kZz], -shear * 0.64 / 3.0, 1e-13 * bulk);
}

// Work is summed by the trapezoidal rule: with twice the steps its difference from the elastic energy is a quarter.
TEST(PathDriver, WorkIsTheEnergyStored) {
  const auto error = [](int steps) {
    PathDefinition definition;
    definition.strain = 0.5;
    definition.steps = steps;
    const PathDriver driver = driven(NeoHookeanDefinition{kElasticity}, "uniaxial_stress", definition);
    return driver.work() / driver.point().elastic_energy() - 1.0;
  };
  const double coarse = error(20), fine = error(40);
  EXPECT_LT(std::abs(fine), 1e-3);
  EXPECT_NEAR(coarse / fine, 4.0, 0.05);  // the next order is (1/20)^2 of this, times about 10
}

// p V^ratio is constant in an adiabatic gas: p0 J^-1.4 in every direction, for any path.
TEST(PathDriver, GasIsCompressedAdiabatically) {
  IdealGasDefinition gas;
  gas.pressure = 1e5;
  gas.temperature = 300.0;
  PathDefinition definition;
  definition.strain = -0.7;
  definition.steps = 1000;
  const Components stress = stress_of(driven(gas, "uniaxial_strain", definition));
  for (const int k : {kXx, kYy, kZz}) EXPECT_NEAR(stress[k], -1e5 * std::exp(1.4 * 0.7), 1e-6 * 1e5);  // finite steps
}

// Metal: the axial stress of a bar is the yield stress plus H times the plastic strain, the total minus the elastic
// strain.
TEST(PathDriver, MetalBarHardens) {
  J2PlasticityDefinition metal;
  metal.elasticity = {200e9, 0.3};
  metal.yield_stress = 400e6;
  metal.hardening_modulus = 1e9;
  PathDefinition definition;
  definition.strain = 0.05;
  const PathDriver driver = driven(metal, "uniaxial_stress", definition);
  const double kirchhoff = stress_of(driver)[kZz] * driver.point().j();
  // t = Y + H (e - t / E), with the Kirchhoff stress t, would hold if the elastic strain were logarithmic. It is
  // neo-Hookean, which differs by its square, (450 MPa / 200 GPa)^2 = 5e-6, times a factor of a few that H turns into
  // stress.
  EXPECT_NEAR(kirchhoff, (400e6 + 1e9 * 0.05) / (1.0 + 1e9 / 200e9), 3.0 * 5e-6 * 1e9);
}

StandardLinearSolidDefinition foam() {
  StandardLinearSolidDefinition law;
  law.elasticity = {1e5, 0.2};
  law.branch_modulus = 3e4;
  law.relaxation_time = 0.2;
  return law;
}

// At a constant shear of 0.1 the stress G gamma stays and G1 gamma exp(-t/T) decays.
TEST(PathDriver, FoamRelaxesExponentially) {
  PathDefinition definition;
  definition.strain = 0.1;
  definition.shear = true;
  const StrainPath path = make_strain_path("relaxation", definition);
  PathDriver driver({"m", 50.0, foam()});
  driver.run(path[0]);
  const double stays = 0.1 * foam().elasticity.shear(), goes = 0.1 * 3e4;
  // The sudden step takes 1e-6 s; the relaxation time is 0.2 s.
  EXPECT_NEAR(stress_of(driver)[kXz], stays + goes, 5e-6 * goes);
  const double after_step = stress_of(driver)[kXz] - stays, begin = driver.time();
  driver.run(path[1], [&] {
    EXPECT_NEAR(stress_of(driver)[kXz] - stays, after_step * std::exp(-(driver.time() - begin) / 0.2), 1e-11 * goes);
  });
  EXPECT_NEAR(driver.time(), 1.0 + 1e-6, 1e-12);
}

// Under a constant small shear stress, gamma = s/G (1 - G1/(G + G1) exp(-t G / ((G + G1) T))).
TEST(PathDriver, FoamCreeps) {
  const double shear = foam().elasticity.shear(), stress = 1e-6 * shear;
  PathDefinition definition;
  definition.stress = stress;
  definition.shear = true;
  definition.steps = 400;
  PathDriver driver({"m", 50.0, foam()});
  for (const Leg& leg : make_strain_path("creep", definition)) driver.run(leg);
  const double branch = 3e4 / (shear + 3e4);
  const double expected = 1e-6 * (1.0 - branch * std::exp(-1.0 * (1.0 - branch) / 0.2));
  EXPECT_NEAR(stress_of(driver)[kXz], stress, 1e-8 * stress);
  // Steps of 1/80 of the relaxation time, second order: (1/80)^2 / 12 = 1.3e-5 of the creep.
  EXPECT_NEAR(2.0 * driver.strain()[kXz], expected, 2e-5 * 1e-6);
}

std::string failure(const LawDefinition& law, const std::string& path, const PathDefinition& definition) {
  try {
    driven(law, path, definition);
  } catch (const PathFailure& error) {
    return error.what();
  }
  return "carried";
}

// Stresses that cannot be carried: sand without confinement; a cohesive column above its strength of 2 c sqrt(Kp) =
// 34.64 kPa; suction on a gas.
TEST(PathDriver, SaysWhatCannotBeCarried) {
  PathDefinition definition;
  definition.stress = -35e3;
  EXPECT_EQ(failure(mohr_coulomb(30, 0, 0), "creep", definition).find("the material cannot carry s"), 0U);
  const std::string column = failure(mohr_coulomb(30, 0, 10e3), "creep", definition);
  EXPECT_EQ(column.find("the material cannot carry szz = -34"), 0U) << column;
  EXPECT_NE(column.find("control the strain ezz instead"), std::string::npos) << column;
  definition.stress = -34.6e3;
  EXPECT_EQ(failure(mohr_coulomb(30, 0, 10e3), "creep", definition), "carried");
  IdealGasDefinition gas;
  gas.pressure = 1e5;
  gas.temperature = 300.0;
  EXPECT_EQ(failure(gas, "creep", definition).find("the material cannot carry s"), 0U);
}

std::string refusal(const std::string& path, const PathDefinition& definition) {
  try {
    driven(NeoHookeanDefinition{kElasticity}, path, definition);
  } catch (const PathError& error) {
    return error.what();
  }
  return "";
}

TEST(PathDriver, RefusesPathsThatCannotBe) {
  const auto with = [](const std::function<void(PathDefinition&)>& change) {
    PathDefinition definition;
    change(definition);
    return definition;
  };
  EXPECT_EQ(refusal("shear", {}).find("'shear' is not a path; write one of uniaxial_strain, "), 0U);
  EXPECT_EQ(refusal("triaxial", with([](auto& d) { d.confining = -1.0; })),
            "the confining pressure is -1 Pa; it must be positive and finite");
  EXPECT_EQ(refusal("triaxial", with([](auto& d) { d.stress = 1.0; })), "triaxial has no stress to hold; leave it out");
  EXPECT_EQ(refusal("creep", {}), "creep needs the stress to hold; give it");
  EXPECT_EQ(refusal("volumetric", with([](auto& d) { d.strain = 0.0; })),
            "the strain is 0; it must be finite and not 0");
  EXPECT_EQ(refusal("volumetric", with([](auto& d) { d.strain = NAN; })),
            "the strain is nan; it must be finite and not 0");
  EXPECT_EQ(refusal("volumetric", with([](auto& d) { d.rate = 0.0; })),
            "the rate of strain is 0 1/s; it must be positive and finite");
  EXPECT_EQ(refusal("volumetric", with([](auto& d) { d.steps = 0; })), "0 steps; take at least one");
  EXPECT_EQ(refusal("uniaxial_strain", with([](auto& d) {
                      d.strain = 2.0;
                      d.steps = 5;
                    })),
            "zz is strained by 0.4 in one step, more than 0.3; take more steps");
}

}  // namespace path_driver_test
}  // namespace mpm
