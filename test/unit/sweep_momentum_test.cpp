// The momentum of sweeps: what it resolves, how many sweeps that takes, and when it begins anew.
#include "mpm/implicit/sweep_momentum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace sweep_momentum_test {

// A chain of n masses between two walls, under an even force: forward and backward Gauss-Seidel on its equations, with
// momentum as sweeps have it, leaves after n sweeps what modulus_of(n) says that it leaves of the slowest part.
double left_after(int sweeps, bool momentum) {
  constexpr int kMasses = 60;
  std::vector<double> x(kMasses + 2, 0.0), before = x;
  mpm::MomentumRestart restart;
  restart.begin();
  double change = 0.0;
  for (int k = 0; k < sweeps; ++k) {
    if (k % 2 == 0) {
      const double factor = momentum ? restart.factor(change) : 0.0;
      for (int i = 1; i <= kMasses; ++i) {
        const double was = x[i];
        x[i] += factor * (was - before[i]);
        before[i] = was;
      }
    }
    change = 0.0;
    for (int j = 1; j <= kMasses; ++j) {
      const int i = k % 2 == 0 ? j : kMasses + 1 - j;
      const double found = 0.5 * (x[i - 1] + x[i + 1] + 1.0);
      change += (found - x[i]) * (found - x[i]);
      x[i] = found;
    }
  }
  const double middle = 0.5 * (kMasses + 1), exact = 0.5 * middle * middle;
  return 1.0 - x[kMasses / 2] / exact;
}

TEST(SweepMomentum, IsWorthTheSweepsThatItSays) {
  for (const int sweeps : {10, 20, 40}) {
    const int plain = static_cast<int>(std::round(mpm::modulus_of(sweeps)));
    EXPECT_GT(plain, 2 * sweeps);
    EXPECT_NEAR(left_after(sweeps, true), left_after(plain, false), 0.06) << sweeps;
    EXPECT_GT(left_after(sweeps, false), left_after(sweeps, true) + 0.02) << sweeps;
  }
}

TEST(SweepMomentum, CountsSweepsForAModulus) {
  EXPECT_EQ(mpm::modulus_of(0), 0.0);
  EXPECT_EQ(mpm::modulus_of(1), 1.0);
  EXPECT_EQ(mpm::modulus_of(2), 2.0);
  EXPECT_DOUBLE_EQ(mpm::modulus_of(4), 2.0 + 3.8);
  for (const double modulus : {0.5, 10.0, 300.0}) {
    const int sweeps = mpm::sweeps_for(modulus, 1000);
    EXPECT_GE(mpm::modulus_of(sweeps), modulus);
    EXPECT_LT(mpm::modulus_of(sweeps - 1), modulus);
  }
  EXPECT_EQ(mpm::sweeps_for(1e9, 200), 200);
}

TEST(SweepMomentum, BeginsAnewWhereChangesGrow) {
  mpm::MomentumRestart restart;
  restart.begin();
  EXPECT_EQ(restart.factor(0.0), 0.0);  // nothing has changed yet
  EXPECT_EQ(restart.factor(1.0), mpm::kMomentum);
  EXPECT_EQ(restart.factor(0.5), mpm::kMomentum);
  EXPECT_EQ(restart.factor(1.9), mpm::kMomentum);
  EXPECT_EQ(restart.factor(2.1), 0.0);
  EXPECT_EQ(restart.factor(2.2), mpm::kMomentum);
  restart.begin();
  EXPECT_EQ(restart.factor(9.0), 0.0);
}

}  // namespace sweep_momentum_test
