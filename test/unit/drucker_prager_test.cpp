// Drucker-Prager on a single element, driven by strain, against Mohr-Coulomb limits and the flow rule. Strength in
// every state is in soil_strength_test.cpp.
#include "mpm/material/drucker_prager.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mpm/math/constants.hpp"
#include "mpm/math/exponential.hpp"

namespace drucker_prager_test {

using mpm::ConeMatch;
using mpm::DruckerPrager;
using mpm::DruckerPragerDefinition;
using mpm::Matrix3;

using mpm::kDegree;

// One element: Cauchy stress and volume ratio under increments of strain along x, y, z and shear xz.
struct Element {
  explicit Element(const DruckerPragerDefinition& d, double density = 1600.0) : law(d, density), rho(density) {}

  void strain(double x, double y, double z, double xz = 0.0) {
    const Matrix3<double> du{x, 0.0, xz, 0.0, y, 0.0, xz, 0.0, z};
    const double j_old = determinant(f);
    const Matrix3<double> df = exponential(du, 4);
    f = product(df, f);
    law.update(mpm::Increment<double, Matrix3<double>>{du, df, f, j_old, determinant(f), 0.0}, tau, h);
  }
  mpm::Symmetric3<double> stress() const { return scale_shift(tau, rho / determinant(f), 0.0); }
  double mean() const { return trace(stress()) / 3.0; }
  double root_j2() const { return std::sqrt(0.5 * squared_norm(scale_shift(stress(), 1.0, -mean()))); }

  DruckerPrager law;
  double rho;
  Matrix3<double> f = Matrix3<double>::identity();
  mpm::Symmetric3<double> tau{};
  double h[3] = {};
};

// Triaxial test: compresses along z and keeps the stress along x and y at -confining by a secant on the lateral strain.
double axial_limit(Element& element, double confining, double axial_strain, int steps) {
  const double k = 1e6 / (3.0 * 0.4), first = -confining / (3.0 * k);
  for (int i = 0; i < 100; ++i) element.strain(first / 100, first / 100, first / 100);
  double lateral = 0.0;
  for (int i = 0; i < steps; ++i) {
    auto lateral_error = [&](double e, Element& trial) {
      trial = element;
      trial.strain(e, e, -axial_strain / steps);
      return trial.stress().xx + confining;
    };
    Element trial = element;
    double a = lateral, fa = lateral_error(a, trial), b = lateral + 1e-7, fb = lateral_error(b, trial);
    for (int n = 0; n < 50 && std::abs(fb) > 1e-9 * confining && fb != fa; ++n) {
      const double c = b - fb * (b - a) / (fb - fa);
      a = b, fa = fb, b = c, fb = lateral_error(b, trial);
    }
    element = trial;
    lateral = b;
  }
  return -element.stress().zz;
}

// exact-solutions 24: phi = 30 degrees, confining 100 -> axial 300 (Kp = 3); with cohesion Kp s3 + 2 c sqrt(Kp).
TEST(DruckerPrager, ReachesMohrCoulombInTriaxialCompression) {
  for (const double cohesion : {0.0, 20.0}) {
    DruckerPragerDefinition d{{1e6, 0.3}, 30.0 * kDegree, 0.0, cohesion, -1.0, ConeMatch::compression};
    Element element(d);
    // 1e-6: the secant keeps the confining stress within 1e-9 of its value.
    EXPECT_NEAR(axial_limit(element, 100.0, 2e-3, 200), 300.0 + 2.0 * cohesion * std::sqrt(3.0), 300e-6);
  }
}

// exact-solutions 24: oedometer, sigma_h / sigma_v = nu / (1 - nu) while elastic.
TEST(DruckerPrager, IsElasticInTheOedometerUntilYield) {
  DruckerPragerDefinition d{{1e6, 0.3}, 40.0 * kDegree, 0.0, 1000.0};
  Element element(d);
  for (int i = 0; i < 100; ++i) element.strain(0.0, 0.0, -1e-6);
  EXPECT_NEAR(element.stress().xx / element.stress().zz, 0.3 / 0.7, 1e-12);
  EXPECT_EQ(element.h[DruckerPrager::kPlasticStrain], 0.0);
}

// exact-solutions 24: plastic volume strain over plastic shear is eta_bar; at yield the stress lies on the cone.
TEST(DruckerPrager, DilatesByTheFlowRuleAndStaysOnTheCone) {
  DruckerPragerDefinition d{{1e6, 0.3}, 35.0 * kDegree, 10.0 * kDegree, 50.0, -1.0, ConeMatch::compression};
  Element element(d);
  for (int i = 0; i < 100; ++i) element.strain(-1e-5, -1e-5, -1e-5);
  const double bulk = d.elasticity.bulk();
  for (int i = 0; i < 2000; ++i) element.strain(0.0, 0.0, 0.0, 1e-5);  // yields: isochoric shear
  const double volume_before = -element.mean() / bulk, shear_before = element.h[0];
  EXPECT_GT(shear_before, 1e-3);
  element.strain(0.0, 0.0, 0.0, 1e-5);
  EXPECT_NEAR(element.root_j2() + element.law.eta() * element.mean(), element.law.strength(), 1e-9 * 1e4);
  // Total volume is fixed, so plastic dilation is the elastic compression gained.
  const double dilation = -element.mean() / bulk - volume_before, shear = element.h[0] - shear_before;
  EXPECT_NEAR(dilation / shear, element.law.eta_bar(), 1e-9);
}

// Opened soil carries no stress until it is as dense as before; then it carries the volume strain beyond the start.
TEST(DruckerPrager, ClosesItsOpeningBeforeItCarriesPressure) {
  DruckerPragerDefinition d{{1e6, 0.3}, 35.0 * kDegree, 0.0, 0.0};
  Element element(d);
  for (int i = 0; i < 100; ++i) element.strain(1e-4, 1e-4, 1e-4);
  EXPECT_EQ(element.mean(), 0.0);
  EXPECT_NEAR(element.h[DruckerPrager::kOpening], 0.03, 1e-14);
  for (int i = 0; i < 99; ++i) element.strain(-1e-4, -1e-4, -1e-4);
  EXPECT_EQ(element.mean(), 0.0);
  for (int i = 0; i < 2; ++i) element.strain(-1e-4, -1e-4, -1e-4);
  EXPECT_NEAR(element.mean(), -3e-4 * d.elasticity.bulk(), 1e-9);
}

// Opened soil has room to dilate into: shear at constant volume builds no pressure while it is open, for any dilation
// angle.
TEST(DruckerPrager, OpenedSoilDilatesWithoutPressure) {
  DruckerPragerDefinition d{{1e6, 0.3}, 35.0 * kDegree, 10.0 * kDegree, 0.0};
  Element element(d);
  for (int i = 0; i < 100; ++i) element.strain(1e-4, 1e-4, 1e-4);
  for (int i = 0; i < 1000; ++i) element.strain(0.0, 0.0, 0.0, 1e-4);
  EXPECT_EQ(element.mean(), 0.0);
  EXPECT_EQ(element.root_j2(), 0.0);
}

// Part left of the trial deviator and mean stress say as much as the stresses themselves.
TEST(DruckerPrager, TakesTheWorkOfAReturnFromItsDeviator) {
  std::mt19937 engine(4);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int n = 0; n < 1000; ++n) {
    const mpm::Symmetric3<double> start{u(engine), u(engine), u(engine), u(engine), u(engine), u(engine)};
    const mpm::Symmetric3<double> trial{u(engine), u(engine), u(engine), u(engine), u(engine), u(engine)};
    const double trial_mean = trace(trial) / 3.0, mean = u(engine), kept = 0.5 + 0.5 * u(engine);
    const mpm::Symmetric3<double> deviator = scale_shift(trial, 1.0, -trial_mean);
    const double work =
        mpm::radially_returned_work(start, deviator, 0.5 * squared_norm(deviator), kept, trial_mean, mean, 3.0, 2.0);
    // Some tens of numbers of order 1.
    EXPECT_NEAR(work, mpm::returned_work(start, trial, scale_shift(deviator, kept, mean), 3.0, 2.0), 1e-14) << n;
  }
}

TEST(DruckerPrager, CutsTensionWhereAsked) {
  DruckerPragerDefinition d{{1e6, 0.3}, 30.0 * kDegree, 0.0, 100.0, 30.0};
  Element element(d);
  for (int i = 0; i < 100; ++i) element.strain(1e-4, 1e-4, 1e-4);
  EXPECT_NEAR(element.mean(), 30.0, 1e-9);
  d.tension_cutoff = -1.0;
  Element uncut(d);
  for (int i = 0; i < 100; ++i) uncut.strain(1e-4, 1e-4, 1e-4);
  EXPECT_NEAR(uncut.mean(), 100.0 / std::tan(30.0 * kDegree), 1e-9);  // apex of Mohr-Coulomb: c cot(phi)
}

}  // namespace drucker_prager_test
