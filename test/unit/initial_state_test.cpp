// Particles that start under a stress: the same Cauchy stress in every law, checked with the formulas of each law.
#include "mpm/material/initial_state.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "mpm/math/geometry.hpp"

namespace mpm {
namespace initial_state_test {

constexpr double kDensity = 1200.0;

Mat3 full(const Symmetric3<double>& s) {
  Mat3 m;
  m << s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz;
  return m;
}

Mat3 full(const Matrix3<double>& f) {
  Mat3 m;
  m << f.xx, f.xy, f.xz, f.yx, f.yy, f.yz, f.zx, f.zy, f.zz;
  return m;
}

/// Cauchy stress of a state, by definition.
Mat3 cauchy(const InitialState& state) { return full(state.tau) * kDensity / state.j(); }

InitialState under(const LawDefinition& law, const Symmetric3<double>& stress,
                   GeometryKind geometry = GeometryKind::solid, bool yy_follows = false) {
  return InitialStates({"m", kDensity, law}, geometry).find({stress, yy_follows, std::nullopt});
}

std::string refusal(const LawDefinition& law, const InitialRequest& request,
                    GeometryKind geometry = GeometryKind::solid) {
  try {
    InitialStates({"m", kDensity, law}, geometry).find(request);
  } catch (const InitialStateError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "no error";
}

/// Nairn & Guilkey (2015) eq. (64).
Mat3 neo_hookean(const Mat3& f, double bulk, double shear) {
  const double j = f.determinant();
  const Mat3 b = f * f.transpose();
  return 0.5 * bulk * (j - 1.0 / j) * Mat3::Identity() +
         shear * std::pow(j, -5.0 / 3.0) * (b - b.trace() / 3.0 * Mat3::Identity());
}

const Elasticity kElasticity{1e5, 0.3};
const Symmetric3<double> kOblique{-3e4, 1e4, -5e4, 8e3, -1.5e4, 6e3};

TEST(InitialState, RateFormLawsTakeTheStressAsItIs) {
  const Symmetric3<double> s{-900.0, -800.0, -1500.0, 50.0, 30.0, -40.0};
  const std::vector<LawDefinition> laws = {LinearElasticDefinition{kElasticity},
                                           DruckerPragerDefinition{kElasticity, 0.6, 0.1, 500.0},
                                           MohrCoulombDefinition{kElasticity, 0.6, 0.1, 500.0}};
  for (const LawDefinition& law : laws) {
    const InitialState state = under(law, s);
    EXPECT_EQ(full(state.f), Mat3(Mat3::Identity()));
    EXPECT_LT((cauchy(state) - full(s)).norm(), 1e-12 * full(s).norm());
  }
}

TEST(InitialState, NeoHookeanIsStretchedAsItsFormulaSays) {
  const double k = kElasticity.bulk(), g = kElasticity.shear();
  const InitialState state = under(NeoHookeanDefinition{kElasticity}, kOblique);
  const Mat3 f = full(state.f);
  EXPECT_LT((f - f.transpose()).norm(), 1e-12);  // a pure stretch
  EXPECT_LT((neo_hookean(f, k, g) - full(kOblique)).norm(), 1e-8 * full(kOblique).norm());
  EXPECT_LT((cauchy(state) - full(kOblique)).norm(), 1e-8 * full(kOblique).norm());
  // Under pressure alone K/2 (J - 1/J) = sigma: J = s + sqrt(s^2 + 1), s = sigma/K.
  const double s = -2e4 / k;
  EXPECT_NEAR(under(NeoHookeanDefinition{kElasticity}, {-2e4, -2e4, -2e4, 0, 0, 0}).j(), s + std::sqrt(s * s + 1.0),
              1e-9);
}

TEST(InitialState, PlaneStrainDecidesTheStressAlongY) {
  const double k = kElasticity.bulk(), g = kElasticity.shear();
  const Symmetric3<double> asked{-3e4, 0.0, -5e4, 0.0, 1e4, 0.0};
  const InitialState state = under(NeoHookeanDefinition{kElasticity}, asked, GeometryKind::plane_strain, true);
  const Mat3 f = full(state.f), s = neo_hookean(f, k, g);
  EXPECT_EQ(f(1, 1), 1.0);
  EXPECT_NEAR(s(0, 0), -3e4, 1e-4);
  EXPECT_NEAR(s(2, 2), -5e4, 1e-4);
  EXPECT_NEAR(s(0, 2), 1e4, 1e-4);
  EXPECT_NEAR(cauchy(state)(1, 1), s(1, 1), 1e-4);
  // Stress where the strain is small: nu (sxx + szz), to the order of the strain, 5e-4.
  const InitialState slight =
      under(NeoHookeanDefinition{kElasticity}, {-30.0, 0, -50.0, 0, 10.0, 0}, GeometryKind::plane_strain, true);
  EXPECT_NEAR(cauchy(slight)(1, 1), -24.0, 1e-3 * 24.0);
  Symmetric3<double> whole = asked;
  whole.yy = s(1, 1);
  EXPECT_EQ(refusal(NeoHookeanDefinition{kElasticity}, {whole, false, std::nullopt}, GeometryKind::plane_strain),
            "no error");
  whole.yy = -1e4;
  EXPECT_NE(refusal(NeoHookeanDefinition{kElasticity}, {whole, false, std::nullopt}, GeometryKind::plane_strain)
                .find("material 'm' (neo_hookean) cannot have yy = -10000 Pa in plane strain"),
            std::string::npos);
  // Elastic laws in rate form: nu (sxx + szz).
  EXPECT_NEAR(cauchy(under(LinearElasticDefinition{kElasticity}, asked, GeometryKind::plane_strain, true))(1, 1),
              -2.4e4, 1e-9);
}

// F_yy is free: under uniaxial stress it equals F_zz.
TEST(InitialState, PlaneStressHasNoStressAlongY) {
  const double k = kElasticity.bulk(), g = kElasticity.shear();
  const Symmetric3<double> asked{-3e4, 0.0, -5e4, 0.0, 1e4, 0.0}, along_x{4e4, 0, 0, 0, 0, 0};
  const Mat3 f = full(under(NeoHookeanDefinition{kElasticity}, asked, GeometryKind::plane_stress).f);
  EXPECT_LT((neo_hookean(f, k, g) - full(asked)).norm(), 1e-8 * full(asked).norm());
  const InitialState uniaxial = under(NeoHookeanDefinition{kElasticity}, along_x, GeometryKind::plane_stress);
  EXPECT_NEAR(uniaxial.f.yy, uniaxial.f.zz, 1e-9);
  EXPECT_LT(uniaxial.f.yy, 1.0);
  EXPECT_NE(refusal(NeoHookeanDefinition{kElasticity}, {{{0, 1e3, 0, 0, 0, 0}}, false, std::nullopt},
                    GeometryKind::plane_stress)
                .find("material 'm' (neo_hookean) cannot have yy = 1000 Pa in plane stress"),
            std::string::npos);
}

// About an axis all three normal stresses are free: F_yy, along the hoop, is found with the others.
TEST(InitialState, HoopStressIsFreeAboutAnAxis) {
  const double k = kElasticity.bulk(), g = kElasticity.shear();
  const Symmetric3<double> asked{-3e4, -1e4, -5e4, 0.0, 1e4, 0.0};
  const InitialState state = under(NeoHookeanDefinition{kElasticity}, asked, GeometryKind::axisymmetric);
  EXPECT_LT((neo_hookean(full(state.f), k, g) - full(asked)).norm(), 1e-8 * full(asked).norm());
  EXPECT_LT((cauchy(state) - full(asked)).norm(), 1e-8 * full(asked).norm());
  // Under pressure alone a ring is compressed equally in all directions: F_yy = J^(1/3).
  const InitialState pressed =
      under(J2PlasticityDefinition{kElasticity, 1e6}, {-2e4, -2e4, -2e4, 0, 0, 0}, GeometryKind::axisymmetric);
  EXPECT_NEAR(pressed.f.yy, std::cbrt(pressed.j()), 1e-12);
}

// Uniaxial strain: F = diag(l, 1, 1), with stress of eq. (64) for neo-Hookean and nu / (1 - nu) across for small
// strain.
TEST(InitialState, ALineHasNoStrainAcrossIt) {
  const double k = kElasticity.bulk(), g = kElasticity.shear(), ratio = 0.3 / 0.7;
  const Symmetric3<double> asked{-3e4, 0, 0, 0, 0, 0};
  const InitialState state = under(NeoHookeanDefinition{kElasticity}, asked, GeometryKind::line);
  EXPECT_EQ(state.f.yy, 1.0);
  EXPECT_EQ(state.f.zz, 1.0);
  const Mat3 s = neo_hookean(full(state.f), k, g);
  EXPECT_NEAR(s(0, 0), -3e4, 1e-4);
  EXPECT_NEAR(cauchy(state)(2, 2), s(2, 2), 1e-4);
  const InitialState rate = under(LinearElasticDefinition{kElasticity}, asked, GeometryKind::line);
  EXPECT_NEAR(cauchy(rate)(1, 1), -3e4 * ratio, 1e-9);
  EXPECT_NEAR(cauchy(rate)(2, 2), -3e4 * ratio, 1e-9);
  J2PlasticityDefinition metal;
  metal.elasticity = kElasticity;
  metal.yield_stress = 5e4;
  const InitialState squeezed = under(metal, asked, GeometryKind::line);
  EXPECT_EQ(squeezed.f.zz, 1.0);
  EXPECT_NEAR(squeezed.f.xx, squeezed.j(), 1e-14);
  EXPECT_NEAR(cauchy(squeezed)(0, 0), -3e4, 1e-3);
  const InitialState fluid = under(NewtonianFluidDefinition{2e6, 7.0, 0.0, true}, asked, GeometryKind::line);
  EXPECT_LT((cauchy(fluid) + 3e4 * Mat3::Identity()).norm(), 1e-4);
  EXPECT_NEAR(fluid.f.xx, std::pow(1.0 + 7.0 * 3e4 / 2e6, -1.0 / 7.0), 1e-10);  // Tait
}

TEST(InitialState, ViscoelasticSolidsStartRelaxed) {
  StandardLinearSolidDefinition law{kElasticity, 3e5, 0.2};
  const InitialState state = under(law, kOblique);
  // The long-term spring alone carries the stress.
  EXPECT_LT((neo_hookean(full(state.f), kElasticity.bulk(), kElasticity.shear()) - full(kOblique)).norm(),
            1e-8 * full(kOblique).norm());
  EXPECT_LT((cauchy(state) - full(kOblique)).norm(), 1e-8 * full(kOblique).norm());
}

TEST(InitialState, MetalCarriesTheDeviatorAndItsVolumeThePressure) {
  const double k = kElasticity.bulk();
  J2PlasticityDefinition law;
  law.elasticity = kElasticity;
  law.yield_stress = 5e4;
  for (const GeometryKind geometry : {GeometryKind::solid, GeometryKind::plane_strain}) {
    const Symmetric3<double> s{-2e4, 1e4, -2e4, 0.0, 5e3, 0.0};
    const InitialState state = under(law, s, geometry);
    const double mean = -1e4 / k;
    EXPECT_NEAR(state.j(), mean + std::sqrt(mean * mean + 1.0), 1e-9) << geometry_name(geometry);
    EXPECT_LT((cauchy(state) - full(s)).norm(), 1e-8 * full(s).norm()) << geometry_name(geometry);
    if (geometry == GeometryKind::plane_strain) {
      EXPECT_EQ(state.f.yy, 1.0);
    }
  }
  // Uniaxial -9e4: J = 0.703 as above, Kirchhoff Mises stress 6.3e4 beyond yield.
  const std::string text = refusal(law, {Symmetric3<double>{0, 0, -9e4, 0, 0, 0}, false, std::nullopt});
  EXPECT_NE(text.find("material 'm' (j2_plasticity) cannot carry the stress xx 0, yy 0, zz -9e+04"), std::string::npos)
      << text;
}

// J is that of the pressure at zero internal energy, rho0 C0^2 eta (1 - gamma0 eta/2) / (1 - S eta)^2; the strength
// limits Cauchy stress.
TEST(InitialState, MetalUnderImpactCarriesTheDeviatorAndItsVolumeThePressure) {
  JohnsonCookDefinition law;
  law.shear_modulus = 4e4;
  law.pressure = {10.0, 1.9, 1.7};  // 10 m/s: rho0 C0^2 = 1.2e5 Pa
  law.yield_stress = 5e4;
  law.heat_capacity = 1.0;
  for (const GeometryKind geometry : {GeometryKind::solid, GeometryKind::plane_strain, GeometryKind::line}) {
    const bool line = geometry == GeometryKind::line;
    const Symmetric3<double> s =
        line ? Symmetric3<double>{-2e4, -2e4, -2e4, 0, 0, 0} : Symmetric3<double>{-3e4, 0.0, -3e4, 0.0, 5e3, 0.0};
    const InitialState state = under(law, s, geometry);
    const double eta = 1.0 - state.j();
    EXPECT_NEAR(1.2e5 * eta * (1.0 - 0.85 * eta) / std::pow(1.0 - 1.9 * eta, 2.0), 2e4, 1e-3)
        << geometry_name(geometry);
    EXPECT_LT((cauchy(state) - full(s)).norm(), 1e-8 * full(s).norm()) << geometry_name(geometry);
  }
  EXPECT_NE(refusal(law, {Symmetric3<double>{0, 0, -6e4, 0, 0, 0}, false, std::nullopt}).find("cannot carry"),
            std::string::npos);
  const InitialState warm = InitialStates({"m", kDensity, law}, GeometryKind::solid).find({std::nullopt, false, 400.0});
  EXPECT_EQ(warm.temperature_excess, 107.0);
  EXPECT_EQ(warm.j(), 1.0);  // free of stress at its initial temperature
}

TEST(InitialState, FluidsTakeAPressure) {
  NewtonianFluidDefinition law;
  law.bulk_modulus = 2e6;
  law.exponent = 7.0;
  law.viscosity = 0.5;
  for (const GeometryKind geometry : {GeometryKind::solid, GeometryKind::plane_strain}) {
    const InitialState state = under(law, {-5e4, -5e4, -5e4, 0, 0, 0}, geometry);
    // Tait: J = (1 + n p / K)^(-1/n).
    EXPECT_NEAR(state.j(), std::pow(1.0 + 7.0 * 5e4 / 2e6, -1.0 / 7.0), 1e-10) << geometry_name(geometry);
    EXPECT_LT((cauchy(state) + 5e4 * Mat3::Identity()).norm(), 1e-4) << geometry_name(geometry);
  }
  EXPECT_NE(refusal(law, {Symmetric3<double>{-5e4, -5e4, -4e4, 0, 0, 0}, false, std::nullopt})
                .find("is a fluid and carries pressure alone"),
            std::string::npos);
  EXPECT_NE(refusal(law, {Symmetric3<double>{5e4, 5e4, 5e4, 0, 0, 0}, false, std::nullopt})
                .find("has no volume at which its mean stress is 5e+04 Pa"),
            std::string::npos);
}

TEST(InitialState, GasesTakeATemperature) {
  IdealGasDefinition law;
  law.pressure = 1e5;
  law.temperature = 300.0;
  const InitialStates states({"m", kDensity, law}, GeometryKind::solid);
  // p = p0 (T/T0) / J
  EXPECT_LT((cauchy(states.find({})) + 1e5 * Mat3::Identity()).norm(), 1e-6);
  EXPECT_LT((cauchy(states.find({std::nullopt, false, 450.0})) + 1.5e5 * Mat3::Identity()).norm(), 1e-6);
  EXPECT_EQ(states.find({std::nullopt, false, 450.0}).temperature_excess, 150.0);
  EXPECT_NEAR(states.find({Symmetric3<double>{-3e5, -3e5, -3e5, 0, 0, 0}, false, 450.0}).j(), 0.5, 1e-9);
  EXPECT_NE(refusal(law, {std::nullopt, false, -10.0}).find("cannot start at -10 K"), std::string::npos);
  EXPECT_NE(refusal(NeoHookeanDefinition{kElasticity}, {std::nullopt, false, 300.0}).find("has no temperature"),
            std::string::npos);
}

TEST(InitialState, RefusesWhatYieldsAndWhatIsNotFinite) {
  const DruckerPragerDefinition sand{kElasticity, 0.6, 0.0, 0.0};
  const std::string text = refusal(sand, {Symmetric3<double>{0, 0, -1e3, 0, 0, 0}, false, std::nullopt});
  EXPECT_NE(
      text.find("material 'm' (drucker_prager) cannot carry the stress xx 0, yy 0, zz -1000, yz 0, xz 0, xy 0 Pa: it "
                "is outside its yield surface"),
      std::string::npos)
      << text;
  EXPECT_NE(refusal(sand, {Symmetric3<double>{100, 100, 100, 0, 0, 0}, false, std::nullopt}).find("outside its yield"),
            std::string::npos);
  EXPECT_NE(refusal(sand, {Symmetric3<double>{std::nan(""), 0, 0, 0, 0, 0}, false, std::nullopt}).find("not finite"),
            std::string::npos);
  // In every law but a gas, zero stress means no deformation.
  EXPECT_EQ(full(under(NeoHookeanDefinition{kElasticity}, {}).f), Mat3(Mat3::Identity()));
}

// A stress far below the stiffness is still found, to the last digits of the stretch.
TEST(InitialState, SmallStressInStiffMaterial) {
  J2PlasticityDefinition steel;
  steel.elasticity = {2e11, 0.3};
  steel.yield_stress = 2e8;
  const Symmetric3<double> s{-10.0, -10.0, -30.0, 0.0, 0.0, 0.0};
  // Round-off of J, 2e-16, times the bulk modulus, 1.7e11 Pa.
  EXPECT_LT((cauchy(under(steel, s)) - full(s)).norm(), 1e-3);
}

TEST(InitialState, PressureAtRest) {
  EXPECT_NEAR(*pressure_at_rest(DruckerPragerDefinition{kElasticity, M_PI / 6.0}), 0.5, 1e-15);  // Jaky: 1 - sin 30 deg
  EXPECT_NEAR(*pressure_at_rest(MohrCoulombDefinition{kElasticity, M_PI / 6.0}), 0.5, 1e-15);
  EXPECT_NEAR(*pressure_at_rest(LinearElasticDefinition{kElasticity}), 3.0 / 7.0, 1e-15);
  EXPECT_EQ(*pressure_at_rest(NewtonianFluidDefinition{}), 1.0);
  EXPECT_FALSE(pressure_at_rest(IdealGasDefinition{}));
}

}  // namespace initial_state_test
}  // namespace mpm
