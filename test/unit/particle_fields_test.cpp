// Particle fields against closed forms of uniform motion.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "observed_block.hpp"

namespace mpm {
namespace particle_fields_test {

using test::inside;
using test::kBlockStep;
using test::observed_block;

constexpr double kYoung = 1e5, kPoisson = 0.25;
constexpr Elasticity kElasticity{kYoung, kPoisson};
// exp(L dt) is computed to second order (gradient_terms: 2), with an error of (1e-3)^3 / 6. Strain near the surface of
// the block adds as much at most, since it spreads by little in one step.
constexpr double kThirdOrder = 1e-9;

Eigen::Matrix3d diagonal(double x, double y, double z) { return Vec3(x, y, z).asDiagonal(); }

double sum_of(const Simulation& simulation, const std::string& field) {
  std::vector<double> values;
  simulation.particle_field(field, values);
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(ParticleFields, StrainIsTheLogarithmOfTheStretch) {
  Simulation run(observed_block(NeoHookeanDefinition{kElasticity}, diagonal(1000.0, -500.0, 200.0)));
  run.advance();
  EXPECT_NEAR(inside(run, "exx"), 1e-3, kThirdOrder);
  EXPECT_NEAR(inside(run, "eyy"), -5e-4, kThirdOrder);
  EXPECT_NEAR(inside(run, "ezz"), 2e-4, kThirdOrder);
  for (const char* shear : {"exy", "exz", "eyz", "rotation"})
    EXPECT_NEAR(inside(run, shear), 0.0, kThirdOrder) << shear;
  EXPECT_NEAR(inside(run, "j"), std::exp(7e-4), kThirdOrder);
  // With a law without plastic strain all strain is elastic.
  EXPECT_EQ(inside(run, "exxe"), inside(run, "exx"));
  EXPECT_EQ(inside(run, "exxp"), 0.0);
}

TEST(ParticleFields, ShearStrainIsHalfOfTheShear) {
  Eigen::Matrix3d shear = Eigen::Matrix3d::Zero();
  shear(0, 2) = 1000.0;  // v_x = 1000 z: a shear of 1e-3, half of it strain and half of it rotation about y
  Simulation run(observed_block(NeoHookeanDefinition{kElasticity}, shear));
  run.advance();
  EXPECT_NEAR(inside(run, "exz"), 5e-4, kThirdOrder);
  EXPECT_NEAR(inside(run, "ry"), std::atan(5e-4), kThirdOrder);  // its tangent is half of the shear
  EXPECT_NEAR(inside(run, "rotation"), std::atan(5e-4), kThirdOrder);
}

TEST(ParticleFields, RotationIsThatOfTheMotion) {
  const Vec3 spin(300.0, -600.0, 200.0);  // [rad/s]
  Eigen::Matrix3d rate;
  rate << 0.0, -spin.z(), spin.y(), spin.z(), 0.0, -spin.x(), -spin.y(), spin.x(), 0.0;
  Simulation run(observed_block(NeoHookeanDefinition{kElasticity}, rate));
  run.advance();
  EXPECT_NEAR(inside(run, "rx"), 3e-4, kThirdOrder);
  EXPECT_NEAR(inside(run, "ry"), -6e-4, kThirdOrder);
  EXPECT_NEAR(inside(run, "rz"), 2e-4, kThirdOrder);
  EXPECT_NEAR(inside(run, "rotation"), 7e-4, kThirdOrder);
  EXPECT_NEAR(inside(run, "exx"), 0.0, kThirdOrder);
}

TEST(ParticleFields, PlasticStrainIsWhatTheStressDoesNotExplain) {
  // Isochoric strain far beyond a yield stress of 20 Pa: an elastic strain of 20 Pa / 3 G is left.
  J2PlasticityDefinition law{kElasticity, 20.0};
  Simulation run(observed_block(law, diagonal(1000.0, -500.0, -500.0)));
  run.advance();
  const double elastic = 20.0 / (3.0 * kElasticity.shear());  // 1.7e-4; the law is exact to second order in it
  EXPECT_NEAR(inside(run, "exxe"), elastic, 1e-3 * elastic);
  EXPECT_NEAR(inside(run, "eyye"), -0.5 * elastic, 1e-3 * elastic);
  EXPECT_NEAR(inside(run, "exxp"), 1e-3 - elastic, 1e-3 * elastic);
  // In uniaxial strain the equivalent plastic strain is that along the axis, to first order in the elastic strain.
  EXPECT_NEAR(inside(run, "ep"), inside(run, "exxp"), 2.0 * elastic * inside(run, "ep"));
  EXPECT_EQ(inside(run, "h0"), inside(run, "ep"));
  EXPECT_EQ(inside(run, "h3"), 0.0);  // the law has no such history
}

TEST(ParticleFields, ElasticStrainOfARateLawIsHookesOfTheStress) {
  SimulationDefinition d = observed_block(DruckerPragerDefinition{kElasticity, 0.5}, Eigen::Matrix3d::Zero());
  const Symmetric3<double> stress{-30.0, -20.0, -40.0, 0.0, 5.0, 0.0};
  d.bodies[0].stresses.assign(d.bodies[0].positions.size(), stress);
  const Simulation run(std::move(d));
  EXPECT_NEAR(inside(run, "exxe"), (-30.0 + kPoisson * 60.0) / kYoung, 1e-15);
  EXPECT_NEAR(inside(run, "eyye"), (-20.0 + kPoisson * 70.0) / kYoung, 1e-15);
  EXPECT_NEAR(inside(run, "exze"), 5.0 / (2.0 * kElasticity.shear()), 1e-15);
  // With an initial stress the plastic strain is smaller by the elastic strain of that stress.
  EXPECT_EQ(inside(run, "exxp"), -inside(run, "exxe"));
}

TEST(ParticleFields, DisplacementIsFromWhereTheParticleWas) {
  const Vec3 drift(10.0, -20.0, 5.0);
  Simulation run(observed_block(NeoHookeanDefinition{kElasticity}, Eigen::Matrix3d::Zero(), drift));
  EXPECT_TRUE(Simulation::needs_start({"p", "ux"}));
  EXPECT_FALSE(Simulation::needs_start({"p", "x"}));
  std::vector<float> values;
  EXPECT_THROW(run.particle_field("ux", values), DefinitionError);
  run.keep_start();
  const double start = inside(run, "x");
  for (int i = 0; i < 100; ++i) run.advance();
  constexpr double kRoundings = 100 * 1.2e-16;  // one rounding a step, of positions of 1 m
  EXPECT_NEAR(inside(run, "ux"), 100 * kBlockStep * drift.x(), kRoundings);
  EXPECT_NEAR(inside(run, "uz"), 100 * kBlockStep * drift.z(), kRoundings);
  EXPECT_NEAR(inside(run, "displacement"), 100 * kBlockStep * drift.norm(), 2.0 * kRoundings);
  EXPECT_EQ(inside(run, "x0"), start);
  EXPECT_NO_THROW(run.keep_start());  // the start is kept already
  Simulation late(observed_block(NeoHookeanDefinition{kElasticity}, Eigen::Matrix3d::Zero(), drift));
  late.advance();
  EXPECT_THROW(late.keep_start(), DefinitionError);
}

TEST(ParticleFields, EnergiesAddUpToThoseOfTheSolver) {
  // Sums of 4096 numbers in another order differ by round-off of the sum of their magnitudes.
  Simulation run(observed_block(J2PlasticityDefinition{kElasticity, 20.0}, diagonal(1000.0, -500.0, -500.0)));
  run.advance();
  const EnergyReport energy = run.state().energy;
  EXPECT_NEAR(sum_of(run, "kinetic_energy"), energy.of("kinetic"), 1e-12 * energy.of("kinetic"));
  EXPECT_NEAR(sum_of(run, "strain_energy"), energy.of("elastic"), 1e-12 * energy.of("elastic"));
  EXPECT_NEAR(sum_of(run, "plastic_energy"), energy.of("plastic"), 1e-12 * energy.of("plastic"));
  EXPECT_GT(energy.of("plastic"), 0.0);
  EXPECT_EQ(sum_of(run, "heat_energy"), 0.0);
  EXPECT_NEAR(sum_of(run, "mass"), test::kBlockDensity * std::pow(test::kSide, 3), 1e-9);
  EXPECT_NEAR(inside(run, "volume"), inside(run, "mass") / inside(run, "density"), 1e-18);
}

TEST(ParticleFields, HeatOfAGasIsThatOfItsTemperature) {
  // Adiabatic, J = exp(-3e-3): T = T0 J^-(g-1); c_v = p0 / (rho0 T0 (g-1)) = 0.8333 J/(kg K)
  IdealGasDefinition gas;
  gas.pressure = 1e5;
  gas.temperature = 300.0;
  Simulation run(observed_block(gas, diagonal(-1000.0, -1000.0, -1000.0)));
  run.advance();
  const double rise = 300.0 * (std::exp(0.4 * 3e-3) - 1.0);
  EXPECT_NEAR(inside(run, "temperature"), 300.0 + rise, 1e-6);
  const double capacity = 1e5 / (test::kBlockDensity * 300.0 * 0.4);
  const double energy = inside(run, "mass") * capacity * rise * rise / 600.0;
  EXPECT_NEAR(inside(run, "thermal_energy"), energy, 1e-5 * energy);
}

TEST(ParticleFields, AChoiceIsTheSameParticlesInTheSameOrder) {
  Simulation run(observed_block(NeoHookeanDefinition{kElasticity}, diagonal(100.0, 0.0, 0.0)));
  run.advance();
  ParticleColumns all, third, part;
  const std::vector<std::string> fields = {"x", "z", "vx", "p"};
  run.read_particles(fields, {}, all);
  ASSERT_EQ(all.ids.size(), 4096U);
  ParticleChoice choice;
  choice.stride = 3;
  run.read_particles(fields, choice, third);
  ASSERT_EQ(third.ids.size(), 1366U);  // 0, 3, … 4095
  for (std::size_t i = 0; i < third.ids.size(); ++i) {
    EXPECT_EQ(third.ids[i], 3 * i);
    for (std::size_t k = 0; k < fields.size(); ++k) EXPECT_EQ(third.values[k][i], all.values[k][3 * i]);
  }
  choice.region = Box{{0.0, 0.0, 1.0}, {1.0, 2.0, 2.0}};
  run.read_particles(fields, choice, part);
  std::size_t next = 0;
  for (std::size_t i = 0; i < all.ids.size(); i += 3) {
    if (all.values[0][i] > 1.0F || all.values[1][i] < 1.0F) continue;
    ASSERT_LT(next, part.ids.size());
    EXPECT_EQ(part.ids[next], i);
    EXPECT_EQ(part.values[3][next], all.values[3][i]);
    ++next;
  }
  EXPECT_EQ(next, part.ids.size());
  EXPECT_GT(next, 0U);
  choice.region = Box{Vec3::Constant(5.0), Vec3::Constant(6.0)};
  run.read_particles(fields, choice, part);
  EXPECT_TRUE(part.ids.empty());
  EXPECT_TRUE(part.values[0].empty());
}

}  // namespace particle_fields_test
}  // namespace mpm
