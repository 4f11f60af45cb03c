// Constants outside their range are refused, each with its value and range.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "mpm/material/definition.hpp"
#include "mpm/math/constants.hpp"

namespace mpm {
namespace material_definition_test {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
using mpm::kDegree;

MaterialDefinition soil() {
  DruckerPragerDefinition law;
  law.elasticity = {1e6, 0.3};
  law.friction_angle = 30.0 * kDegree;
  law.dilation_angle = 5.0 * kDegree;
  law.cohesion = 1000.0;
  return {"soil", 1600.0, law};
}

std::string refusal(const MaterialDefinition& material) {
  try {
    check(material);
  } catch (const MaterialError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "";
}

std::string soil_with(double DruckerPragerDefinition::*constant, double value) {
  MaterialDefinition material = soil();
  std::get<DruckerPragerDefinition>(material.law).*constant = value;
  return refusal(material);
}

TEST(MaterialDefinition, SoundMaterialsPass) {
  EXPECT_EQ(refusal(soil()), "");
  EXPECT_EQ(refusal({"rubber", 1100.0, NeoHookeanDefinition{{1e6, 0.499}}}), "");
  EXPECT_EQ(refusal({"foam", 30.0, LinearElasticDefinition{{1e4, -0.9}}}), "");
}

TEST(MaterialDefinition, Density) {
  for (const double bad : {0.0, -1.0, kNan, kInfinity}) {
    MaterialDefinition material = soil();
    material.density = bad;
    EXPECT_NE(refusal(material), "") << bad;
  }
  MaterialDefinition material = soil();
  material.density = -1.0;
  EXPECT_EQ(refusal(material), "material 'soil': density: -1 kg/m^3 is not greater than 0");
}

TEST(MaterialDefinition, SoilNeedsSomeStrength) {
  DruckerPragerDefinition law;
  law.elasticity = {1e6, 0.3};
  EXPECT_NE(refusal({"m", 1600.0, law}).find("soil without any strength; give one of them"), std::string::npos);
  law.friction_angle = 0.1;
  EXPECT_EQ(refusal({"m", 1600.0, law}), "");
  law.friction_angle = 0.0;
  law.cohesion = 1e3;
  EXPECT_EQ(refusal({"m", 1600.0, law}), "");
}

TEST(MaterialDefinition, ElasticConstantsOfEveryLaw) {
  const std::vector<std::function<LawDefinition(Elasticity)>> laws = {
      [](Elasticity e) { return LinearElasticDefinition{e}; },
      [](Elasticity e) { return NeoHookeanDefinition{e}; },
      [](Elasticity e) {
        return J2PlasticityDefinition{e, 1.0};
      },
      [](Elasticity e) {
        return StandardLinearSolidDefinition{e, 1.0, 1.0};
      },
      [](Elasticity e) {
        DruckerPragerDefinition law;
        law.elasticity = e;
        law.cohesion = 1.0;
        return law;
      },
  };
  for (const auto& law : laws) {
    EXPECT_EQ(refusal({"m", 1.0, law({1.0, 0.0})}), "");
    for (const double young : {0.0, -1.0, kNan, kInfinity}) EXPECT_NE(refusal({"m", 1.0, law({young, 0.3})}), "");
    for (const double poisson : {-1.0, -2.0, 0.5, 0.6, kNan}) EXPECT_NE(refusal({"m", 1.0, law({1.0, poisson})}), "");
  }
  EXPECT_EQ(refusal({"m", 1.0, NeoHookeanDefinition{{1.0, 0.5}}}), "material 'm': poisson: 0.5 is not below 0.5");
  EXPECT_EQ(refusal({"m", 1.0, NeoHookeanDefinition{{0.0, 0.3}}}), "material 'm': young: 0 is not greater than 0");
}

TEST(MaterialDefinition, SoilAngles) {
  using Law = DruckerPragerDefinition;
  EXPECT_EQ(soil_with(&Law::dilation_angle, 30.0 * kDegree), "");  // associated
  EXPECT_EQ(soil_with(&Law::dilation_angle, 0.0), "");
  EXPECT_EQ(soil_with(&Law::dilation_angle, 31.0 * kDegree),
            "material 'soil': dilation_angle: 31 deg is more than friction_angle, 30 deg");
  EXPECT_EQ(soil_with(&Law::friction_angle, 90.0 * kDegree),
            "material 'soil': friction_angle: 90 deg is not below 90 deg");
  for (const double bad : {-1.0 * kDegree, 30.0, kNan}) EXPECT_NE(soil_with(&Law::friction_angle, bad), "") << bad;
  for (const double bad : {-1.0 * kDegree, kNan}) EXPECT_NE(soil_with(&Law::dilation_angle, bad), "") << bad;
}

TEST(MaterialDefinition, DilationLimitCohesionAndTensionCutoff) {
  using Law = DruckerPragerDefinition;
  EXPECT_EQ(soil_with(&Law::dilation_limit, kInfinity), "");  // none
  EXPECT_EQ(soil_with(&Law::dilation_limit, 0.0), "material 'soil': dilation_limit: 0 is not greater than 0");
  for (const double bad : {-1.0, kNan}) EXPECT_NE(soil_with(&Law::dilation_limit, bad), "") << bad;
  EXPECT_EQ(soil_with(&Law::cohesion, 0.0), "");
  for (const double bad : {-1.0, kNan, kInfinity}) EXPECT_NE(soil_with(&Law::cohesion, bad), "") << bad;
  // Apex by hand: 1000 Pa / tan(30 degrees) = 1000 sqrt(3) Pa.
  EXPECT_EQ(soil_with(&Law::tension_cutoff, 1000.0 * std::sqrt(3.0)), "");
  EXPECT_EQ(soil_with(&Law::tension_cutoff, 0.0), "");
  EXPECT_EQ(
      soil_with(&Law::tension_cutoff, 1733.0),
      "material 'soil': tension_cutoff: 1733 Pa is more than the apex, cohesion / tan(friction_angle), 1732.05 Pa");
  for (const double bad : {kNan, kInfinity, -kInfinity}) EXPECT_NE(soil_with(&Law::tension_cutoff, bad), "") << bad;
  // Clay without friction has no apex: any finite cut-off stands.
  MaterialDefinition clay = soil();
  auto& law = std::get<Law>(clay.law);
  law.friction_angle = law.dilation_angle = 0.0;
  law.tension_cutoff = 1e9;
  EXPECT_EQ(refusal(clay), "");
}

TEST(MaterialDefinition, Softening) {
  const auto with = [](const SoilSoftening& fall) {
    MaterialDefinition material = soil();
    std::get<DruckerPragerDefinition>(material.law).softening = fall;
    return refusal(material);
  };
  const double friction = 30.0 * kDegree;
  EXPECT_EQ(with({0.01, 0.05, 20.0 * kDegree, 0.0}), "");
  EXPECT_EQ(with({0.01, 0.05, friction, 1000.0}), "");  // dilation alone
  EXPECT_EQ(with({0.01, 0.0, 20.0 * kDegree, 0.0}),
            "material 'soil': shear_band: strength that falls over a slip and dilation that ends at a rise need the "
            "width of a shear band as the grid resolves it: write the edge of a cell");
  EXPECT_EQ(with({0.01, 0.05, 31.0 * kDegree, 0.0}),
            "material 'soil': residual_friction_angle: 31 deg is more than friction_angle, 30 deg");
  EXPECT_EQ(with({0.01, 0.05, friction, 1001.0}),
            "material 'soil': residual_cohesion: 1001 Pa is more than cohesion, 1000 Pa");
  EXPECT_NE(with({0.01, 0.05, 0.0, 0.0}).find("ends without any strength"), std::string::npos);
  // (1000 cos 30 - 0) / G = 866 Pa / 384.6 kPa of 1 m.
  EXPECT_EQ(with({0.002, 1.0, 20.0 * kDegree, 0.0}),
            "material 'soil': softening_slip: over 0.002 m and a band of 1 m cohesion falls faster than the soil can "
            "unload: write more than 0.00225 m, or use smaller cells");
  for (const double bad : {-1.0, kNan, kInfinity}) {
    EXPECT_NE(with({bad, 0.05, 20.0 * kDegree, 0.0}), "") << bad;
    EXPECT_NE(with({0.01, bad, 20.0 * kDegree, 0.0}), "") << bad;
    EXPECT_NE(with({0.01, 0.05, bad, 0.0}), "") << bad;
    EXPECT_NE(with({0.01, 0.05, 20.0 * kDegree, bad}), "") << bad;
  }
  MaterialDefinition sand = soil();
  auto& law = std::get<DruckerPragerDefinition>(sand.law);
  law.dilation_angle = 0.0;
  law.softening = {0.01, 0.05, friction, 1000.0};
  EXPECT_NE(refusal(sand).find("nothing falls over the"), std::string::npos);
}

// Dilation ends at the rise over the width of the band on the grid, or at the limit of the soil.
TEST(MaterialDefinition, DilationRise) {
  const auto with = [](double rise, double band) {
    MaterialDefinition material = soil();
    SoilSoftening& softening = std::get<DruckerPragerDefinition>(material.law).softening;
    softening.rise = rise;
    softening.band = band;
    return refusal(material);
  };
  EXPECT_EQ(with(1e-3, 0.05), "");
  EXPECT_EQ(with(kInfinity, 0.0), "");  // none
  EXPECT_EQ(with(0.0, 0.05), "material 'soil': dilation_rise: 0 is not greater than 0");
  for (const double bad : {-1e-3, kNan}) EXPECT_NE(with(bad, 0.05), "") << bad;
  EXPECT_NE(with(1e-3, 0.0).find("shear_band: "), std::string::npos);
  SoilSoftening softening;
  EXPECT_EQ(softening.dilation_limit(0.1), 0.1);
  softening.rise = 1e-3;
  for (const auto& [band, limit] : {std::pair{0.05, 0.02}, {0.025, 0.04}, {0.005, 0.1}}) {
    softening.band = band;
    EXPECT_DOUBLE_EQ(softening.dilation_limit(0.1), limit) << band;
  }
}

TEST(MaterialDefinition, Metal) {
  const auto metal = [](double yield, double hardening, double saturation, double rate) {
    return refusal({"m", 7800.0, J2PlasticityDefinition{{200e9, 0.3}, yield, hardening, saturation, rate}});
  };
  EXPECT_EQ(metal(1e8, 0.0, 0.0, 0.0), "");
  EXPECT_EQ(metal(1e8, 1e9, 1e8, 5.0), "");  // saturated from the start
  EXPECT_EQ(metal(0.0, 0.0, 0.0, 0.0), "material 'm': yield_stress: 0 is not greater than 0");
  EXPECT_EQ(metal(1e8, 0.0, 9e7, 5.0), "material 'm': saturation_stress: 9e+07 Pa is less than yield_stress, 1e+08 Pa");
  EXPECT_EQ(metal(1e8, -1.0, 0.0, 0.0), "material 'm': hardening_modulus: -1 Pa is less than 0");
  for (const double bad : {-1.0, kNan, kInfinity}) {
    EXPECT_NE(metal(bad, 0.0, 0.0, 0.0), "") << bad;
    EXPECT_NE(metal(1e8, bad, 0.0, 0.0), "") << bad;
    EXPECT_NE(metal(1e8, 0.0, bad, 5.0), "") << bad;
    EXPECT_NE(metal(1e8, 0.0, 2e8, bad), "") << bad;
  }
}

TEST(MaterialDefinition, Fluid) {
  const auto fluid = [](double bulk, double exponent, double viscosity) {
    return refusal({"m", 1000.0, NewtonianFluidDefinition{bulk, exponent, viscosity, false}});
  };
  EXPECT_EQ(fluid(2e9, 7.0, 1e-3), "");
  EXPECT_EQ(fluid(2e9, 1.0, 0.0), "");
  EXPECT_EQ(fluid(2e9, 0.5, 0.0), "material 'm': exponent: 0.5 is less than 1");
  EXPECT_EQ(fluid(2e9, 7.0, -1.0), "material 'm': viscosity: -1 Pa s is less than 0");
  EXPECT_EQ(fluid(0.0, 7.0, 0.0), "material 'm': bulk_modulus: 0 is not greater than 0");
  for (const double bad : {-1.0, kNan, kInfinity}) {
    EXPECT_NE(fluid(bad, 7.0, 0.0), "") << bad;
    EXPECT_NE(fluid(2e9, bad, 0.0), "") << bad;
    EXPECT_NE(fluid(2e9, 7.0, bad), "") << bad;
  }
}

TEST(MaterialDefinition, Gas) {
  const auto gas = [](double pressure, double temperature, double ratio) {
    return refusal({"m", 1.2, IdealGasDefinition{pressure, temperature, ratio, GasProcess::adiabatic}});
  };
  EXPECT_EQ(gas(1e5, 293.0, 1.4), "");
  EXPECT_EQ(gas(1e5, -20.0, 1.4), "material 'm': temperature: -20 K is not greater than 0");
  EXPECT_EQ(gas(1e5, 293.0, 1.0), "material 'm': heat_capacity_ratio: 1 is not greater than 1");
  for (const double bad : {0.0, -1.0, kNan, kInfinity}) {
    EXPECT_NE(gas(bad, 293.0, 1.4), "") << bad;
    EXPECT_NE(gas(1e5, bad, 1.4), "") << bad;
    EXPECT_NE(gas(1e5, 293.0, bad), "") << bad;
  }
}

TEST(MaterialDefinition, ViscoelasticSolid) {
  const auto solid = [](double modulus, double time) {
    return refusal({"m", 100.0, StandardLinearSolidDefinition{{1e4, 0.3}, modulus, time}});
  };
  EXPECT_EQ(solid(1e4, 0.1), "");
  EXPECT_EQ(solid(0.0, 0.1), "material 'm': branch_modulus: 0 is not greater than 0");
  EXPECT_EQ(solid(1e4, 0.0), "material 'm': relaxation_time: 0 is not greater than 0");
  for (const double bad : {-1.0, kNan, kInfinity}) {
    EXPECT_NE(solid(bad, 0.1), "") << bad;
    EXPECT_NE(solid(1e4, bad), "") << bad;
  }
}

TEST(MaterialDefinition, MetalUnderImpact) {
  JohnsonCookDefinition steel;
  steel.shear_modulus = 77e9;
  steel.pressure = {3574.0, 1.92, 1.69};
  steel.yield_stress = 1.5e9;
  steel.heat_capacity = 477.0;
  EXPECT_EQ(refusal({"m", 7850.0, steel}), "");
  const auto with = [&](double JohnsonCookDefinition::*constant, double value) {
    JohnsonCookDefinition changed = steel;
    changed.*constant = value;
    return refusal({"m", 7850.0, changed});
  };
  using Law = JohnsonCookDefinition;
  for (const auto constant : {&Law::shear_modulus, &Law::yield_stress, &Law::hardening_exponent, &Law::reference_rate,
                              &Law::softening_exponent, &Law::reference_temperature, &Law::heat_capacity}) {
    for (const double bad : {0.0, -1.0, kNan, kInfinity}) EXPECT_NE(with(constant, bad), "") << bad;
  }
  for (const auto constant :
       {&Law::hardening, &Law::rate_sensitivity, &Law::melting_temperature, &Law::heat_fraction}) {
    EXPECT_EQ(with(constant, 0.0), "");
    for (const double bad : {-1.0, kNan, kInfinity}) EXPECT_NE(with(constant, bad), "") << bad;
  }
  EXPECT_EQ(with(&Law::hardening_exponent, 1.0), "");
  EXPECT_EQ(with(&Law::hardening_exponent, 1.1), "material 'm': n: 1.1 is more than 1");
  EXPECT_EQ(with(&Law::heat_fraction, 1.1), "material 'm': heat_fraction: 1.1 is more than 1");
  EXPECT_EQ(with(&Law::melting_temperature, 293.0),
            "material 'm': melting_temperature: 293 K is not above reference_temperature, 293 K");
  for (const auto constant : {&MieGrueneisenDefinition::sound_speed, &MieGrueneisenDefinition::hugoniot_slope,
                              &MieGrueneisenDefinition::gamma0}) {
    for (const double bad : {-1.0, kNan, kInfinity}) {
      JohnsonCookDefinition changed = steel;
      changed.pressure.*constant = bad;
      EXPECT_NE(refusal({"m", 7850.0, changed}), "") << bad;
    }
  }
}

TEST(MaterialDefinition, Names) {
  EXPECT_EQ(law_name(LinearElasticDefinition{}), "linear_elastic");
  EXPECT_EQ(law_name(NeoHookeanDefinition{}), "neo_hookean");
  EXPECT_EQ(law_name(DruckerPragerDefinition{}), "drucker_prager");
  EXPECT_EQ(law_name(J2PlasticityDefinition{}), "j2_plasticity");
  EXPECT_EQ(law_name(NewtonianFluidDefinition{}), "newtonian_fluid");
  EXPECT_EQ(law_name(IdealGasDefinition{}), "ideal_gas");
  EXPECT_EQ(law_name(StandardLinearSolidDefinition{}), "viscoelastic");
  EXPECT_EQ(law_name(JohnsonCookDefinition{}), "johnson_cook");
  MaterialDefinition nameless = soil();
  nameless.name.clear();
  EXPECT_NE(refusal(nameless), "");
}

}  // namespace material_definition_test
}  // namespace mpm
