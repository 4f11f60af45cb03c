// The speed of a tip from the balance of energy (crack reference 5.2.1), and the heat of growth (5.6).
#include <gtest/gtest.h>

#include <vector>

#include "kept_numbers.hpp"
#include "mpm/crack/energy_balance.hpp"
#include "mpm/crack/tip_heat.hpp"

namespace mpm::test {
namespace crack_energy_test {

// --- balance of energy
// ------------------------------------------------------------------------------------------------

FractureConstants balance_constants() {
  FractureConstants constants;
  constants.j_ic = 100.0;
  constants.speed = 0.1;  // part of 1000 m/s
  constants.gain = 0.5;
  return constants;
}

/// Grows by 1 mm at each entry with that energy released a unit of area; the speeds that the tip then has. A last look
/// follows the last growth.
std::vector<EnergyBalance::Speed> speeds_for(const std::vector<double>& released, const FractureConstants& constants,
                                             double plastic_share = 0.0) {
  EnergyBalance balance;
  double length = 0.01;
  BodyEnergies energies{5.0, 1.0};
  std::vector<EnergyBalance::Speed> speeds;
  for (const double release : released) {
    speeds.push_back(balance.look(length, energies, constants, 1000.0));
    balance.grown(length, energies);
    length += 1e-3;
    energies.potential -= release * 1e-3;
    energies.plastic += plastic_share * release * 1e-3;
  }
  speeds.push_back(balance.look(length, energies, constants, 1000.0));
  return speeds;
}

TEST(CrackEnergyBalance, FollowsWhatIsReleased) {
  // b = 0 keeps the speed of the start, 0.1 x 1000 m/s; the faces take 2 gamma = j_ic.
  for (const EnergyBalance::Speed& now : speeds_for({100.0, 100.0, 100.0, 100.0}, balance_constants())) {
    EXPECT_NEAR(now.speed, 100.0, 1e-9);
  }
  // 20 J/m^2 too much over two lengths: 0.5 x 20 m/s more at each look, from the third on.
  const auto rising = speeds_for({120.0, 120.0, 120.0}, balance_constants());
  EXPECT_NEAR(rising[1].speed, 100.0, 1e-9);
  EXPECT_NEAR(rising[2].excess, 20.0, 1e-9);
  EXPECT_NEAR(rising[2].speed, 110.0, 1e-9);
  EXPECT_NEAR(rising[3].speed, 120.0, 1e-9);
  // The mean of the last two lengths counts: (110 + 140) / 2 - 100.
  EXPECT_NEAR(speeds_for({500.0, 110.0, 140.0}, balance_constants())[3].excess, 25.0, 1e-9);
}

TEST(CrackEnergyBalance, PlasticWorkAndSurfaceEnergy) {
  FractureConstants constants = balance_constants();
  // -(-150 + (1 + p) 0.1 x 150) - 100 with p = 1, then p = 0.
  EXPECT_NEAR(speeds_for({150.0, 150.0}, constants, 0.1)[2].excess, 20.0, 1e-9);
  constants.plastic_part = 0.0;
  EXPECT_NEAR(speeds_for({150.0, 150.0}, constants, 0.1)[2].excess, 35.0, 1e-9);
  constants.surface_energy = 30.0;
  EXPECT_NEAR(speeds_for({150.0, 150.0}, constants)[2].excess, 90.0, 1e-9);
  constants.surface_energy = 60.0;  // above j_ic / 2, which then counts
  EXPECT_NEAR(speeds_for({150.0, 150.0}, constants)[2].excess, 50.0, 1e-9);
}

TEST(CrackEnergyBalance, HasLimits) {
  EXPECT_EQ(speeds_for({1e5, 1e5}, balance_constants())[2].speed, 1000.0);  // the wave speed
  // Never below half the start's speed; there it does not grow while too little is released.
  const EnergyBalance::Speed slow = speeds_for({0.0, 0.0}, balance_constants())[2];
  EXPECT_EQ(slow.speed, 50.0);
  EXPECT_FALSE(slow.grows);
  // From 1000 m/s by half at most: (3000 + 0) / 2 - 100 keeps the speed high, then 0 - 100 would take 50 m/s; a gain of
  // 100 would take more than all.
  FractureConstants eager = balance_constants();
  eager.gain = 100.0;
  const auto halved = speeds_for({3000.0, 3000.0, 0.0, 0.0}, eager);
  EXPECT_EQ(halved[3].speed, 1000.0);
  EXPECT_EQ(halved[4].speed, 500.0);
  EXPECT_TRUE(halved[4].grows);
}

// --- heat of growth
// ---------------------------------------------------------------------------------------------------

TEST(CrackTipHeat, Steps) {
  EXPECT_EQ(heated_steps(5e-4, 2000.0, 1e-8), 25);  // reference 5.6: 0.5 mm over 20 um a step
  EXPECT_EQ(heated_steps(5.1e-4, 2000.0, 1e-8), 25);
  EXPECT_EQ(heated_steps(1e-6, 2000.0, 1e-8), 1);
  EXPECT_EQ(heated_steps(0.5, 1.0, 0.1), 5);
}

TEST(CrackTipHeat, TotalIsWhatWasReleased) {
  // f G t da = 0.9 x 200 J/m^2 x 0.01 m x 0.5 mm = 0.9 mJ in 25 steps of 10 ns: 3600 W.
  TipHeat heat;
  heat.add(0.9, 200.0, 0.01, 5e-4, 25);
  double given = 0.0;
  for (int i = 0; i < 25; ++i) {
    const double power = heat.take(1e-8);
    EXPECT_NEAR(power, 3600.0, 1e-9);
    given += power * 1e-8;
  }
  EXPECT_NEAR(given, 9e-4, 1e-18);
  EXPECT_EQ(heat.take(1e-8), 0.0);
  EXPECT_EQ(heat.left(), 0.0);
}

TEST(CrackTipHeat, TotalHoldsWithOtherStepsGrowthBetweenAndAStop) {
  TipHeat heat, resumed;
  heat.add(1.0, 100.0, 1.0, 1e-3, 10);
  double given = 0.0;
  for (int i = 0; i < 4; ++i) given += heat.take(1e-8 * (i + 1)) * 1e-8 * (i + 1);
  EXPECT_NEAR(given, 0.04, 1e-15);
  heat.add(1.0, 300.0, 1.0, 1e-3, 5);
  EXPECT_EQ(heat.steps(), 6);  // those that were left are more
  KeptNumbers kept;
  heat.serialise(kept);
  kept.read();
  resumed.serialise(kept);
  while (resumed.steps() > 0) given += resumed.take(2e-8) * 2e-8;
  EXPECT_NEAR(given, 0.4, 1e-15);
}

}  // namespace crack_energy_test
}  // namespace mpm::test
