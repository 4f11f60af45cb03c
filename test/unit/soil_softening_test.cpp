// Soil whose strength falls over a slip: single elements against closed forms; verification/softening_band_test.cpp has
// a shear band.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "mpm/material/path_driver.hpp"
#include "mpm/math/constants.hpp"

namespace mpm {
namespace soil_softening_test {

constexpr double kDegree = kPi / 180.0;
constexpr int kXx = 0, kYy = 1, kZz = 2, kXz = 4;
constexpr double kConfining = 100e3;  // [Pa]
const Elasticity kElasticity{200e6, 0.3};

/// 40 degrees to 30, 10 kPa to 2 kPa; over 1 mm in a band of 50 mm.
constexpr double kPeak = 40.0 * kDegree, kResidual = 30.0 * kDegree;
const SoilSoftening kFall{1e-3, 0.05, kResidual, 2e3};
constexpr double kStrain = 0.02;

std::vector<LawDefinition> soils(double dilation) {
  return {DruckerPragerDefinition{kElasticity, kPeak, dilation, 10e3, -1.0, ConeMatch::mohr_coulomb, kInfinity, kFall},
          DruckerPragerDefinition{kElasticity, kPeak, dilation, 10e3, -1.0, ConeMatch::plane_strain, kInfinity, kFall},
          MohrCoulombDefinition{kElasticity, kPeak, dilation, 10e3, -1.0, kInfinity, kFall}};
}

PathDriver confined(const LawDefinition& law) {
  PathDriver driver({"soil", 1600.0, law});
  Leg leg;
  leg.duration = 1.0;
  leg.steps = 20;
  for (const int k : {kXx, kYy, kZz}) {
    leg.control[k] = Control::stress;
    leg.target[k] = -kConfining;
  }
  driver.run(leg);
  return driver;
}

/// Shears by `shear` under the confining pressure along z, in plane strain.
void shear(PathDriver& driver, double shear, int steps) {
  Leg leg;
  leg.duration = 1.0;
  leg.steps = steps;
  leg.from_start = true;
  leg.control[kZz] = Control::stress;
  leg.target[kZz] = -kConfining;
  leg.control[kXz] = Control::simple_shear;
  leg.target[kXz] = shear;
  driver.run(leg);
}

// Without dilation simple shear leaves the normal stresses equal, so that tau = p sin(phi) + c cos(phi), which falls in
// a straight line over the plastic shear kStrain; the total shear is tau / G + plastic shear. By hand: at a plastic
// shear of x kStrain, tau = residual + (peak - residual) (1 - x). Tolerance: the soil is stiff, since the elastic part
// of the shear, 1e-3, turns with it and takes half of that off the normal stress; and strength is that at the start of
// a step, a thousandth of the fall.
TEST(SoilSoftening, FallsOverThePlasticShear) {
  const double g = kElasticity.shear();
  const double peak = kConfining * std::sin(kPeak) + 10e3 * std::cos(kPeak);
  const double residual = kConfining * std::sin(kResidual) + 2e3 * std::cos(kResidual);
  for (const LawDefinition& law : soils(0.0)) {
    for (const double part : {0.25, 0.5, 0.75, 2.0}) {
      const double expected = residual + (peak - residual) * std::max(1.0 - part, 0.0);
      PathDriver driver = confined(law);
      shear(driver, expected / g + part * kStrain, 2000);
      EXPECT_NEAR(driver.point().cauchy().xz, expected, 1e-3 * expected) << law.index() << ' ' << part;
      EXPECT_NEAR(driver.point().plastic_strain(), part * kStrain, 0.01 * kStrain) << law.index() << ' ' << part;
    }
  }
}

// Triaxial compression ends at the residual constants, Kp s3 + 2 c sqrt(Kp) with Kp = 3 at 30 degrees, for any
// dilation, and without any rest of volume change (closed form and control of stress: 1e-8).
TEST(SoilSoftening, EndsInTheCriticalState) {
  const double expected = 3.0 * kConfining + 2.0 * 2e3 * std::sqrt(3.0);
  for (const double dilation : {0.0, 15.0 * kDegree}) {
    for (const LawDefinition& law : {soils(dilation)[0], soils(dilation)[2]}) {
      PathDriver driver = confined(law);
      Leg leg;
      leg.duration = 1.0;
      leg.steps = 2000;
      leg.from_start = true;
      for (const int k : {kXx, kYy}) {
        leg.control[k] = Control::stress;
        leg.target[k] = -kConfining;
      }
      leg.target[kZz] = -0.2;
      driver.run(leg);
      EXPECT_NEAR(-driver.point().cauchy().zz, expected, 1e-8 * expected);
      const double before = driver.point().j();
      leg.target[kZz] = -0.1;
      driver.run(leg);
      EXPECT_NEAR(driver.point().j(), before, 1e-8) << law.index();
    }
  }
}

// All dilation of a fall: sin(psi) falls in a straight line with the plastic shear, of which Mohr-Coulomb's main plane
// gains the volume q / sqrt(1 + q^2 / 3), q = sin(psi): 3 (sqrt(1 + q^2/3) - 1) / q of kStrain in all. Elastic volume
// follows from the mean stress. 0.1 %: strength and dilation are those at the start of a step.
TEST(SoilSoftening, DilationEndsByItself) {
  const double q = std::sin(15.0 * kDegree);
  const double gained = 3.0 * (std::sqrt(1.0 + q * q / 3.0) - 1.0) / q * kStrain;
  PathDriver driver = confined(soils(15.0 * kDegree)[2]);
  const auto plastic_volume = [&] {
    return std::log(driver.point().j()) - trace(driver.point().cauchy()) / (3.0 * kElasticity.bulk());
  };
  const double before = plastic_volume();
  shear(driver, 0.1, 8000);
  EXPECT_NEAR(plastic_volume() - before, gained, 1e-3 * gained);
}

/// The same soil as one that keeps its strength and whose dilation ends at `rise` over `band`.
LawDefinition rising(LawDefinition law, double rise, double band) {
  auto* pyramid = std::get_if<MohrCoulombDefinition>(&law);
  SoilSoftening& softening = pyramid ? pyramid->softening : std::get<DruckerPragerDefinition>(law).softening;
  softening = {};
  softening.rise = rise;
  softening.band = band;
  return law;
}

// Dilation that ends at a rise ends after the same slip of a band, and the band has gained the same thickness, however
// wide the band on the grid is. A band is one piece of soil in simple shear under a pressure, held along x and y, whose
// width is 50 or 25 mm: it rises by tan(psi) of its slip until nine tenths of the rise, and then nears the end. 0.1 %:
// the end of an exponential; 2 %: elastic shear, 0.03 mm in the wider one.
TEST(SoilSoftening, DilationEndsAtTheSameSlipInBandsOfTwoWidths) {
  constexpr double kRise = 1e-3, kStep = 1e-4, kDilation = 15.0 * kDegree;
  for (const LawDefinition& soil : soils(kDilation)) {
    for (const double band : {0.05, 0.025}) {
      PathDriver driver = confined(rising(soil, kRise, band));
      const auto thickness = [&] {  // without elastic strain
        return band * driver.point().j() * std::exp(-trace(driver.point().cauchy()) / (3.0 * kElasticity.bulk()));
      };
      const double start = thickness();
      double slip = 0.0, before = 0.0, now = 0.0;
      while (now < 0.9 * kRise && slip < 20.0 * kRise) {
        before = now;
        shear(driver, kStep / band, 20);
        slip += kStep;
        now = thickness() - start;
      }
      slip -= kStep * (now - 0.9 * kRise) / (now - before);
      const double expected = 0.9 * kRise / std::tan(kDilation);
      EXPECT_NEAR(slip, expected, 0.02 * expected) << soil.index() << ' ' << band;
      shear(driver, 10.0 * kRise / band, 2000);
      EXPECT_NEAR(band * (driver.point().j() - 1.0), kRise, 1e-3 * kRise) << soil.index() << ' ' << band;
    }
  }
}

// Cohesive soil that has lost its cohesion carries no tension: stretched beyond its peak it falls apart.
TEST(SoilSoftening, TensionGoesWithTheCohesion) {
  for (const LawDefinition& law :
       {LawDefinition(DruckerPragerDefinition{kElasticity, kPeak, 0.0, 10e3, -1.0, ConeMatch::mohr_coulomb, kInfinity,
                                              SoilSoftening{1e-3, 0.05, kResidual, 0.0}}),
        LawDefinition(MohrCoulombDefinition{kElasticity, kPeak, 0.0, 10e3, 1e3, kInfinity,
                                            SoilSoftening{1e-3, 0.05, kResidual, 0.0}})}) {
    PathDriver driver = confined(law);
    shear(driver, 0.1, 500);
    Leg stretch;
    stretch.duration = 1.0;
    stretch.steps = 500;
    stretch.from_start = true;
    stretch.target[kXx] = stretch.target[kYy] = stretch.target[kZz] = 0.05;
    driver.run(stretch);
    const Symmetric3<double> s = driver.point().cauchy();
    EXPECT_NEAR(std::sqrt(squared_norm(s)), 0.0, 1e-6) << law.index();
  }
}

}  // namespace soil_softening_test
}  // namespace mpm
