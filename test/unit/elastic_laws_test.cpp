// Elastic laws at a material point against the numbers of exact-solutions 4 and 6 (E = 2300, nu = 0.33).
#include <gtest/gtest.h>

#include <cmath>

#include "mpm/material/law.hpp"
#include "mpm/math/exponential.hpp"

namespace elastic_laws_test {

using mpm::Matrix3;

const mpm::Elasticity kElasticity{2300.0, 0.33};

mpm::Symmetric3<double> neo_hookean(const Matrix3<double>& f, double density = 7.0) {
  const mpm::NeoHookean law({kElasticity}, density);
  mpm::Symmetric3<double> tau{};
  const double j = determinant(f);
  law.update(mpm::Increment<double, Matrix3<double>>{{}, f, f, 1.0, j, 0.0}, tau, static_cast<double*>(nullptr));
  return scale_shift(tau, density / j, 0.0);
}

// Round-off of the reference, which prints six significant digits.
constexpr double kPrinted = 5e-4;

TEST(NeoHookean, MatchesThePrintedStresses) {
  const auto stretched = neo_hookean({1.2, 0, 0, 0, 1, 0, 0, 0, 1});
  EXPECT_NEAR(stretched.xx, 600.570, kPrinted);
  EXPECT_NEAR(stretched.yy, 319.813, kPrinted);
  const auto sheared = neo_hookean({1, 1, 0, 0, 1, 0, 0, 0, 1});
  EXPECT_NEAR(sheared.xx, 576.441, kPrinted);
  EXPECT_NEAR(sheared.yy, -288.221, kPrinted);
  EXPECT_NEAR(sheared.xy, 864.662, kPrinted);
  for (const auto& [j, rr, zz] :
       {std::tuple{0.9, -272.37, -169.31}, {0.5, -2148.70, -776.13}, {0.16, -12000.35, 3402.18}}) {
    const double r = std::sqrt(j);
    const auto s = neo_hookean({r, 0, 0, 0, r, 0, 0, 0, 1});  // Nairn & Guilkey (2015) (66), (67)
    EXPECT_NEAR(s.xx, rr, 5e-3);
    EXPECT_NEAR(s.zz, zz, 5e-3);
  }
}

// The stress is the derivative of the energy: tau/rho0 : D dt = dW for a small increment in any direction.
TEST(NeoHookean, StressIsTheDerivativeOfTheEnergy) {
  const mpm::NeoHookean law({kElasticity}, 7.0);
  const Matrix3<double> f{1.1, 0.2, -0.1, 0.05, 0.9, 0.3, 0.0, -0.2, 1.2};
  const double e = 1e-5;
  const Matrix3<double> direction{0.3, -0.2, 0.5, 0.1, 0.7, 0.2, -0.4, 0.6, -0.1};
  auto moved = [&](double a) {
    const Matrix3<double> du{a * direction.xx, a * direction.xy, a * direction.xz, a * direction.yx, a * direction.yy,
                             a * direction.yz, a * direction.zx, a * direction.zy, a * direction.zz};
    return product(exponential(du, 6), f);
  };
  auto energy = [&](const Matrix3<double>& m) {
    return law.elastic_energy(m, mpm::Symmetric3<double>{}, determinant(m));
  };
  const auto tau = scale_shift(neo_hookean(f), determinant(f) / 7.0, 0.0);
  const auto d = symmetric_part(direction);
  const double power =
      tau.xx * d.xx + tau.yy * d.yy + tau.zz * d.zz + 2 * (tau.yz * d.yz + tau.xz * d.xz + tau.xy * d.xy);
  // Central difference: error of order e^2 = 1e-10 relative, round-off 1e-16 / e = 1e-11.
  EXPECT_NEAR((energy(moved(e)) - energy(moved(-e))) / (2 * e), power, 1e-8 * std::abs(power));
}

// exact-solutions 4: hypoelastic Jaumann shear, sigma_xy = G sin(gamma), sigma_xx = G (1 - cos(gamma)); 1e-4 at 2000
// steps.
TEST(LinearElastic, FollowsTheJaumannSolutionInSimpleShear) {
  const double density = 5.0, shear = kElasticity.shear(), gamma = 1.0;
  const mpm::LinearElastic law({kElasticity}, density);
  mpm::Symmetric3<double> tau{};
  Matrix3<double> f = Matrix3<double>::identity();
  const int steps = 2000;
  for (int i = 0; i < steps; ++i) {
    const Matrix3<double> du{0, gamma / steps, 0, 0, 0, 0, 0, 0, 0};
    const Matrix3<double> df = exponential(du, 2);
    f = product(df, f);
    law.update(mpm::Increment<double, Matrix3<double>>{du, df, f, 1.0, 1.0, 0.0}, tau, static_cast<double*>(nullptr));
  }
  EXPECT_NEAR(density * tau.xy, shear * std::sin(gamma), 1e-4 * shear);
  EXPECT_NEAR(density * tau.xx, shear * (1.0 - std::cos(gamma)), 1e-4 * shear);
  EXPECT_NEAR(f.xy, gamma, 1e-12);
}

}  // namespace elastic_laws_test
