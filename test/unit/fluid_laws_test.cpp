// Fluid and gas at a point against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "material_paths.hpp"

namespace fluid_laws_test {

using namespace mpm;
using namespace mpm::paths;

constexpr double kDensity = 1000.0;

MaterialPoint fluid(double bulk, double exponent, double viscosity, bool tension = true) {
  return MaterialPoint({"fluid", kDensity, NewtonianFluidDefinition{bulk, exponent, viscosity, tension}});
}

double pressure(const MaterialPoint& point) { return -trace(point.cauchy()) / 3.0; }

// Uniform change of volume to the ratio j, in equal steps of logarithmic strain.
void compress(MaterialPoint& point, double j, int steps, double dt = 1.0) {
  const double e = std::log(j / point.j()) / (3.0 * steps);
  for (int n = 0; n < steps; ++n) point.advance({e, 0, 0, 0, e, 0, 0, 0, e}, dt);
}

TEST(NewtonianFluid, FollowsTait) {
  MaterialPoint water = fluid(2.2e9, 7.0, 0.0);
  EXPECT_EQ(pressure(water), 0.0);
  compress(water, 0.99, 50);
  EXPECT_NEAR(pressure(water), 22907074.816, 1e-3);  // by hand: 2.2e9/7 (0.99^-7 - 1), as printed
  MaterialPoint linear = fluid(3e5, 1.0, 0.0);
  compress(linear, 0.5, 10);
  EXPECT_NEAR(pressure(linear), 3e5, 1e-12 * 3e5);  // 3e5 (2 - 1)
}

// Couette flow: shear stress mu gamma_dot and nothing else, at any shear.
TEST(NewtonianFluid, ShearsAsInCouetteFlow) {
  const double rate = 20.0, viscosity = 0.3, dt = 1e-3;
  MaterialPoint oil = fluid(1e6, 7.0, viscosity);
  for (int n = 0; n < 5000; ++n) oil.advance({0, rate * dt, 0, 0, 0, 0, 0, 0, 0}, dt);
  const auto s = oil.cauchy();
  EXPECT_NEAR(s.xy, viscosity * rate, 1e-12);
  for (const double other : {s.xx, s.yy, s.zz, s.yz, s.xz}) EXPECT_NEAR(other, 0.0, 1e-12 * 1e6);
  // mu gamma_dot^2 t; the sum of 5000 terms
  EXPECT_NEAR(kDensity * oil.plastic_work(), viscosity * rate * rate * 5.0, 1e-11 * 600.0);
}

// No viscous pressure (Stokes): 2 mu (e - e/3) along, -2 mu e/3 across, about the pressure.
TEST(NewtonianFluid, StretchesAsStokesSays) {
  const double viscosity = 2.0, dt = 1e-6, rate = 3.0;
  MaterialPoint fluid_point = fluid(1e3, 1.0, viscosity);
  fluid_point.advance({rate * dt, 0, 0, 0, 0, 0, 0, 0, 0}, dt);
  const auto s = fluid_point.cauchy();
  const double p = 1e3 * std::expm1(-rate * dt);
  EXPECT_NEAR(s.xx, 4.0 / 3.0 * viscosity * rate - p, 1e-12);
  EXPECT_NEAR(s.yy, -2.0 / 3.0 * viscosity * rate - p, 1e-12);
}

TEST(NewtonianFluid, PartsWithoutTension) {
  MaterialPoint spray = fluid(1e6, 7.0, 0.0, false), held = fluid(1e6, 7.0, 0.0, true);
  for (MaterialPoint* point : {&spray, &held}) compress(*point, 1.2, 10);
  EXPECT_EQ(pressure(spray), 0.0);
  EXPECT_EQ(spray.elastic_energy(), 0.0);
  EXPECT_LT(pressure(held), -1e4);
  compress(spray, 1.001, 10);
  EXPECT_EQ(pressure(spray), 0.0);
  compress(spray, 0.999, 10);
  EXPECT_NEAR(pressure(spray), 1e6 / 7.0 * (std::pow(0.999, -7.0) - 1.0), 1e-9 * 1e6);
}

// A fluid that has parted is liquid of its initial density in empty space: the mean shear stress falls with the
// liquid's part of the volume, 1 / J. With tension the fluid fills all of its volume, and the stress is mu gamma_dot.
TEST(NewtonianFluid, ResistsShearByTheVolumeOfTheLiquid) {
  const double rate = 20.0, viscosity = 0.3, dt = 1e-6;
  for (const bool tension : {false, true}) {
    MaterialPoint drop = fluid(1e6, 7.0, viscosity, tension);
    compress(drop, 4.0, 10);
    drop.advance({0, rate * dt, 0, 0, 0, 0, 0, 0, 0}, dt);
    EXPECT_NEAR(drop.cauchy().xy, viscosity * rate / (tension ? 1.0 : 4.0), 1e-9);
  }
}

// Small compression: p^2 / (2 K rho0), to third order in the strain.
TEST(NewtonianFluid, StoresTheEnergyOfAQuadraticSpring) {
  MaterialPoint water = fluid(2.2e9, 7.0, 0.0);
  compress(water, 1.0 - 1e-5, 1);
  const double p = pressure(water);
  EXPECT_NEAR(water.elastic_energy(), p * p / (2.0 * 2.2e9 * kDensity), 1e-4 * water.elastic_energy());
}

const IdealGasDefinition kAir{101325.0, 293.15, 1.4, GasProcess::adiabatic};
constexpr double kAirDensity = 1.2041;

TEST(IdealGas, IsUnderPressureFromTheStart) {
  const MaterialPoint air({"air", kAirDensity, kAir});
  EXPECT_NEAR(pressure(air), 101325.0, 1e-9);
  EXPECT_NEAR(air.elastic_energy(), 0.0, 1e-9);
  EXPECT_NEAR(air.wave_speed(), 343.2, 0.05);  // air at 20 C, as printed in tables of physics
}

// p V^g and T V^(g-1) are constant, there and back, for any steps.
TEST(IdealGas, IsAdiabatic) {
  MaterialPoint air({"air", kAirDensity, kAir});
  for (const double j : {0.1, 0.5, 3.0, 1.0}) {
    compress(air, j, 137);
    const double compression = 1.0 / air.j();
    EXPECT_NEAR(pressure(air), 101325.0 * std::pow(compression, 1.4), 1e-12 * pressure(air));
    const double temperature = 293.15 + air.history(IdealGas::kTemperature);
    EXPECT_NEAR(temperature, 293.15 * std::pow(compression, 0.4), 1e-12 * temperature);
    // Internal energy c_v (T - T0), c_v = p0 / (rho0 T0 (g - 1)) = 717.6 J/(kg K) to four digits.
    EXPECT_NEAR(air.elastic_energy(), 717.6 * (temperature - 293.15),
                1e-4 * 717.6 * std::abs(temperature - 293.15) + 1e-6);
  }
}

// Stress is the pressure above the ambient one; the speed of sound follows from the whole pressure, c^2 = g p / rho.
TEST(IdealGas, CountsFromTheAmbientPressure) {
  IdealGasDefinition definition = kAir;
  definition.ambient = 1e5;
  MaterialPoint air({"air", 1.2, definition});
  EXPECT_NEAR(air.cauchy().xx, -1325.0, 1e-9);
  EXPECT_NEAR(air.wave_speed(), std::sqrt(1.4 * 101325.0 / 1.2), 1e-9);
  EXPECT_EQ(air.elastic_energy(), 0.0);
  air.advance({-0.1, 0, 0, 0, 0, 0, 0, 0, 0}, 1.0);
  const double j = std::exp(-0.1), pressure = 101325.0 * std::pow(j, -1.4);
  EXPECT_NEAR(air.cauchy().xx, 1e5 - pressure, 1e-9 * pressure);
  // Work on the gas, (p V - p0 V0) / (g - 1), minus the work of the ambient pressure.
  EXPECT_NEAR(air.elastic_energy(), ((pressure * j - 101325.0) / 0.4 - 1e5 * (1.0 - j)) / 1.2, 1e-9 * pressure);
}

TEST(IdealGas, IsIsothermal) {
  IdealGasDefinition definition = kAir;
  definition.process = GasProcess::isothermal;
  MaterialPoint air({"air", kAirDensity, definition});
  for (const double j : {0.1, 3.0}) {
    compress(air, j, 137);
    EXPECT_NEAR(pressure(air) * air.j(), 101325.0, 1e-12 * 101325.0);
    EXPECT_EQ(air.history(IdealGas::kTemperature), 0.0);
    // Work of an isothermal compression: p0 V0 ln(V0/V).
    EXPECT_NEAR(kAirDensity * air.elastic_energy(), -101325.0 * std::log(j), 1e-12 * 101325.0 * 3.0);
  }
}

}  // namespace fluid_laws_test
