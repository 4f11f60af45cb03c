// One material of each law, for the tests that every law must pass.
#pragma once

#include <functional>
#include <random>
#include <string>
#include <vector>

#include "material_paths.hpp"
#include "mpm/material/definition.hpp"
#include "mpm/math/constants.hpp"

namespace mpm::paths {

struct Specimen {
  MaterialDefinition material;
  double strain;    ///< size of an increment's components on a path that exercises the law: metals yield, soil shears
  double pressing;  ///< logarithmic volume strain at the beginning of a path
  double time;      ///< duration of an increment [s]
};

/// Nairn & Guilkey (2015), Table I, with a specific heat and reference values of steel.
inline JohnsonCookDefinition armor_steel() {
  JohnsonCookDefinition steel;
  steel.shear_modulus = 77.3e9;
  steel.pressure = {3574.0, 1.92, 1.69};
  steel.yield_stress = 1.5e9;
  steel.hardening = 0.569e9;
  steel.hardening_exponent = 0.22;
  steel.rate_sensitivity = 0.003;
  steel.softening_exponent = 1.17;
  steel.melting_temperature = 1777.0;
  steel.heat_capacity = 450.0;
  return steel;
}

/// A weaker metal that softens early: m < 1, n > 1/2 and a strong rate.
inline JohnsonCookDefinition hot_steel() {
  JohnsonCookDefinition steel = armor_steel();
  steel.yield_stress = 0.3e9;
  steel.hardening = 0.9e9;
  steel.hardening_exponent = 0.7;
  steel.rate_sensitivity = 0.05;
  steel.reference_rate = 100.0;
  steel.softening_exponent = 0.8;
  steel.melting_temperature = 900.0;
  steel.heat_fraction = 0.6;
  return steel;
}

/// Loose or dense sand, soft for its strength so that paths of large steps do not only flow.
inline NorSandDefinition some_sand(double voids, double curve) {
  NorSandDefinition sand;
  sand.gamma = curve > 0.0 ? 0.934 : 0.9;
  sand.lambda = 0.02;
  sand.critical_exponent = curve;
  sand.slope = 1.25;
  sand.coupling = 0.3;
  sand.dilatancy = 3.5;
  sand.hardening = 100.0;
  sand.hardening_of_state = 300.0;
  sand.shear_modulus = 1e6;
  sand.void_ratio = voids;
  sand.overconsolidation = 1.2;
  sand.least_pressure = 1e3;
  return sand;
}

/// Much of the strength goes on a path of the zoo.
inline const SoilSoftening kFall{0.005, 0.1, 0.4, 500.0};

inline std::vector<Specimen> zoo() {
  const Elasticity soft{1e5, 0.3}, metal{70e9, 0.33}, soil{1e6, 0.3};
  IdealGasDefinition air{101325.0, 293.15, 1.4, GasProcess::adiabatic};
  IdealGasDefinition slow_air = air;
  slow_air.process = GasProcess::isothermal;
  return {
      {{"linear_elastic", 1000.0, LinearElasticDefinition{soft}}, 0.1, 0.0, 1.0},
      {{"auxetic", 1000.0, LinearElasticDefinition{{1e5, -0.6}}}, 0.1, 0.0, 1.0},
      {{"neo_hookean", 1000.0, NeoHookeanDefinition{soft}}, 0.1, 0.0, 1.0},
      {{"drucker_prager", 1600.0, DruckerPragerDefinition{soil, 0.6, 0.2, 2000.0, -1.0, ConeMatch::compression}},
       1e-3,
       -0.02,
       1.0},
      {{"dilated_drucker_prager", 1600.0,
        DruckerPragerDefinition{soil, 0.6, 0.2, 2000.0, 500.0, ConeMatch::compression}},
       0.01,
       0.0,
       1.0},
      {{"mohr_coulomb", 1600.0, MohrCoulombDefinition{soil, 0.6, 0.2, 2000.0, -1.0}}, 1e-3, -0.02, 1.0},
      {{"dilated_mohr_coulomb", 1600.0, MohrCoulombDefinition{soil, 0.6, 0.2, 2000.0, 500.0}}, 0.01, 0.0, 1.0},
      {{"j2_plasticity", 2700.0, J2PlasticityDefinition{metal, 200e6, 500e6, 300e6, 20.0}}, 0.01, 0.0, 1.0},
      {{"soft_j2_plasticity", 1500.0, J2PlasticityDefinition{soft, 30e3, 5e3, 0.0, 0.0}}, 0.1, 0.0, 1.0},
      {{"newtonian_fluid", 1000.0, NewtonianFluidDefinition{1e6, 7.0, 50.0, true}}, 0.02, -0.05, 0.01},
      {{"free_surface_fluid", 1000.0, NewtonianFluidDefinition{1e6, 7.0, 0.0, false}}, 0.02, -0.1, 0.01},
      {{"ideal_gas", 1.2, air}, 0.1, 0.0, 1.0},
      {{"isothermal_gas", 1.2, slow_air}, 0.1, 0.0, 1.0},
      {{"viscoelastic", 100.0, StandardLinearSolidDefinition{soft, 50e3, 0.5}}, 0.1, 0.0, 0.1},
      {{"johnson_cook", 7850.0, armor_steel()}, 0.02, -0.1, 1e-6},
      {{"soft_johnson_cook", 7850.0, hot_steel()}, 0.03, 0.0, 1e-3},
      {{"softening_drucker_prager", 1600.0,
        DruckerPragerDefinition{soil, 0.6, 0.2, 2000.0, -1.0, ConeMatch::compression, kInfinity, kFall}},
       5e-3,
       -0.02,
       1.0},
      {{"softening_mohr_coulomb", 1600.0, MohrCoulombDefinition{soil, 0.6, 0.2, 2000.0, 500.0, kInfinity, kFall}},
       5e-3,
       -0.02,
       1.0},
      {{"lode_drucker_prager", 1600.0, DruckerPragerDefinition{soil, 0.6, 0.2, 2000.0}}, 1e-3, -0.02, 1.0},
      {{"mu_i", 1500.0, MuIDefinition{soil, 0.38, 0.64, 0.279, 1e-3, 2500.0}}, 1e-3, -0.02, 1e-4},
      {{"dilated_mu_i", 1500.0, MuIDefinition{soil, 0.38, 0.64, 0.279, 1e-3, 2500.0}}, 0.01, 0.0, 1e-4},
      {{"cam_clay", 1700.0, CamClayDefinition{0.2, 0.05, 1.0, 1.0, 1e6, 0.0, 20e3, 0.0, 1e3}}, 0.01, -0.1, 1.0},
      {{"dilated_cam_clay", 1700.0, CamClayDefinition{0.2, 0.05, 1.0, 1.0, 0.0, 0.3, 20e3, 0.0, 1e3}}, 0.02, 0.0, 1.0},
      {{"norsand", 1500.0, some_sand(0.9, 0.0)}, 2e-3, -0.1, 1.0},
      {{"dense_norsand", 1500.0, some_sand(0.65, 0.7)}, 2e-3, -0.05, 1.0},
      {{"dilated_norsand", 1500.0, some_sand(0.75, 0.0)}, 0.01, 0.0, 1.0},
      {{"dilated_lode_drucker_prager", 1600.0, DruckerPragerDefinition{soil, 0.6, 0.2, 2000.0, 500.0}}, 0.01, 0.0, 1.0},
  };
}

/// Lets soil that softens, which has the strength of the start of its last step, reach that of its plastic strain.
inline void catch_up(MaterialPoint& point, const Specimen& specimen, double dt) {
  if (specimen.material.name.rfind("softening", 0) != 0) return;
  for (int n = 0; n < 40; ++n) point.advance({}, dt);
}

/// A specimen after a path of random increments.
inline MaterialPoint worked(const Specimen& specimen, std::mt19937& random, int steps) {
  MaterialPoint point(specimen.material);
  const double e = specimen.pressing / 30.0;
  for (int n = 0; n < 10; ++n) point.advance({e, 0, 0, 0, e, 0, 0, 0, e}, specimen.time);
  for (int n = 0; n < steps; ++n) point.advance(random_gradient(random, specimen.strain), specimen.time);
  return point;
}

}  // namespace mpm::paths
