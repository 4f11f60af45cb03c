// Requirements on every law: it turns with the material, gives the same in two and three dimensions, and accounts for
// its work.
#include <gtest/gtest.h>

#include "material_zoo.hpp"
#include "mpm/math/dimension.hpp"
#include "mpm/math/exponential.hpp"

namespace laws_test {

using namespace mpm;
using namespace mpm::paths;

Matrix3<double> transposed(const Matrix3<double>& m) { return {m.xx, m.yx, m.zx, m.xy, m.yy, m.zy, m.xz, m.yz, m.zz}; }

/// Rotation by the vector (a, b, c), to round-off.
Matrix3<double> rotation(double a, double b, double c) {
  Matrix3<double> q = Matrix3<double>::identity();
  const Matrix3<double> part = exponential(scaled(Matrix3<double>{0, -c, b, c, 0, -a, -b, a, 0}, 0.1), 12);
  for (int n = 0; n < 10; ++n) q = product(part, q);
  return q;
}

// A path that is turned as a whole gives the turned stress and the same scalars.
TEST(EveryLaw, TurnsWithItsPath) {
  const Matrix3<double> q = rotation(0.3, -1.1, 0.7);
  for (const Specimen& specimen : zoo()) {
    std::mt19937 random(4);
    MaterialPoint straight = worked(specimen, random, 0), turned = straight;
    double scale = 0.0;
    for (int n = 0; n < 40; ++n) {
      const Matrix3<double> du = random_gradient(random, specimen.strain);
      straight.advance(du, specimen.time);
      turned.advance(product(product(q, du), transposed(q)), specimen.time);
      scale = std::max(scale, std::sqrt(squared_norm(straight.cauchy())));
    }
    EXPECT_GT(scale, 0.0);
    // Round-off of 40 steps; stress is a small difference where the material is stiff for the strain it is under.
    const double stiffness = std::pow(straight.wave_speed(), 2.0) * specimen.material.density;
    const double round_off = 40 * 1e-14 * (scale + stiffness);
    EXPECT_LE(distance(congruence(q, straight.cauchy()), turned.cauchy()), round_off) << specimen.material.name;
    EXPECT_NEAR(straight.plastic_strain(), turned.plastic_strain(), 1e-11) << specimen.material.name;
    EXPECT_NEAR(straight.elastic_energy(), turned.elastic_energy(), round_off / specimen.material.density)
        << specimen.material.name;
  }
}

// The stress of a material that turns as a rigid body turns with it, and no energy is stored or lost.
TEST(EveryLaw, FollowsARigidRotation) {
  for (const Specimen& specimen : zoo()) {
    std::mt19937 random(5);
    MaterialPoint point = worked(specimen, random, 12);
    constexpr double instant = 1e-20, long_time = 1e12;
    const bool fluid = std::holds_alternative<NewtonianFluidDefinition>(specimen.material.law);
    const double dt = fluid ? long_time : instant;
    point.advance({}, dt);
    catch_up(point, specimen, dt);
    const MaterialPoint before = point;
    const int steps = 1000;
    const double angle = 1.0 / steps;
    const Matrix3<double> spin{0, -0.6 * angle,  0.48 * angle,  0.6 * angle,
                               0, -0.64 * angle, -0.48 * angle, 0.64 * angle,
                               0};  // about (0.64, 0.48, 0.6), a unit vector
    for (int n = 0; n < steps; ++n) point.advance(spin, dt);
    const auto expected = congruence(rotation(0.64, 0.48, 0.6), before.cauchy());
    // Laws in rate form turn by the Cayley transform, 2 atan(angle/2) = angle - angle^3/12: 1e-7 of the stress over the
    // path of one radian. The others are exact: round-off of 1000 steps.
    const double scale = std::sqrt(squared_norm(expected));
    const double stiffness = std::pow(point.wave_speed(), 2.0) * specimen.material.density;
    EXPECT_LE(distance(point.cauchy(), expected), 2.5e-7 * scale + 1e-13 * stiffness) << specimen.material.name;
    EXPECT_NEAR(point.plastic_strain(), before.plastic_strain(), 1e-9) << specimen.material.name;
    EXPECT_NEAR(point.elastic_energy(), before.elastic_energy(), 1e-12 * stiffness / specimen.material.density)
        << specimen.material.name;
  }
}

/// A point of a planar body, advanced as in the kernels.
struct PlanarPoint {
  explicit PlanarPoint(const MaterialDefinition& material)
      : law(make_law(material)), density(material.density), history(history_size(law)) {
    const Symmetric3<double> start = MaterialPoint(material).tau();
    tau = {start.xx, start.zz, start.xz, start.yy};
  }
  void advance(const MatrixPlane<double>& du, double dt) {
    std::visit(
        [&](const auto& kind) {
          const MatrixPlane<double> df = exponential(du, 12), old = f;
          const double j_old = determinant(old);
          f = kind.kForgetsShape ? PlaneStrain::dilatation(j_old * determinant(df)) : product(df, old);
          kind.update(Increment<double, MatrixPlane<double>>{du, df, f, j_old, determinant(f), dt}, tau,
                      history.data());
        },
        law);
  }
  SymmetricPlane<double> cauchy() const { return scale_shift(tau, density / determinant(f), 0.0); }

  Law law;
  double density;
  std::vector<double> history;
  MatrixPlane<double> f = MatrixPlane<double>::identity();
  SymmetricPlane<double> tau{};
};

TEST(EveryLaw, IsTheSameInPlaneStrainAndInThreeDimensions) {
  for (const Specimen& specimen : zoo()) {
    std::mt19937 random(6);
    MaterialPoint solid(specimen.material);
    PlanarPoint planar(specimen.material);
    double scale = 0.0;
    for (int n = 0; n < 60; ++n) {
      Matrix3<double> du = random_gradient(random, specimen.strain);
      du.xy = du.yx = du.yy = du.yz = du.zy = 0.0;
      if (n < 10) du.xx += 0.1 * specimen.pressing, du.zz += 0.1 * specimen.pressing;
      solid.advance(du, specimen.time);
      planar.advance({du.xx, du.xz, du.zx, du.zz, 0.0}, specimen.time);
      const double stiffness = std::pow(solid.wave_speed(), 2.0) * specimen.material.density;
      scale = std::max({scale, std::sqrt(squared_norm(solid.cauchy())), stiffness});
    }
    const auto s = solid.cauchy();
    const auto p = planar.cauchy();
    for (const double difference : {s.xx - p.xx, s.yy - p.yy, s.zz - p.zz, s.xz - p.xz, s.xy, s.yz}) {
      EXPECT_NEAR(difference, 0.0, 1e-12 * scale) << specimen.material.name;
    }
    for (std::size_t k = 0; k < planar.history.size(); ++k) {
      const double value = solid.history(static_cast<int>(k));
      EXPECT_NEAR(planar.history[k], value, 1e-11 * std::abs(value)) << specimen.material.name;
    }
  }
}

/// Work done minus stored and dissipated energy, relative to the work, along a smooth turning path in `steps` steps.
/// `lost_part`: dissipated energy over work.
double energy_gap(const Specimen& specimen, int steps, double* lost_part = nullptr) {
  std::mt19937 random(7);
  MaterialPoint point = worked(specimen, random, 3);  // metals yield already, since a kink would hide the order
  point.advance(scaled({0.4, 0.3, 0, 0.2, -0.1, 0.1, 0, 0, -0.2}, specimen.strain), specimen.time);
  // Viscous stress belongs to a step: the path begins with its own, and does not turn.
  const bool fluid = std::holds_alternative<NewtonianFluidDefinition>(specimen.material.law);
  const double dt = 10.0 * specimen.time / steps;
  const auto gradient = [&](double t) {
    const double turn = fluid ? 0.0 : 1.5 * t, c = std::cos(turn), s = std::sin(turn);
    return scaled({1.0 + 0.3 * c, 0.5 * c, 0.1, 0.2 * s, -0.6, 0.2, 0.1 * c, 0.3 * s, -0.5},
                  3.0 * specimen.strain / steps);
  };
  point.advance(gradient(0.0), dt);
  const double stored = point.elastic_energy(), lost = point.plastic_work();
  double work = 0.0;
  for (int n = 0; n < steps; ++n) work += advance_with_work(point, gradient((n + 0.5) / steps), dt);
  const double gained = point.elastic_energy() - stored, dissipated = point.plastic_work() - lost;
  EXPECT_GT(std::abs(work), 0.0);
  if (lost_part != nullptr) *lost_part = dissipated / work;
  return std::abs(work - gained - dissipated) / (std::abs(gained) + std::abs(dissipated));
}

// Work = stored + dissipated, to second order in the step. The laws in rate form are left out: they have no energy of
// their own at finite strain, as their headers state.
TEST(EveryLaw, AccountsForItsWork) {
  for (const Specimen& specimen : zoo()) {
    const LawDefinition& law = specimen.material.law;
    if (std::holds_alternative<LinearElasticDefinition>(law) || std::holds_alternative<DruckerPragerDefinition>(law) ||
        std::holds_alternative<MohrCoulombDefinition>(law) || std::holds_alternative<MuIDefinition>(law) ||
        std::holds_alternative<CamClayDefinition>(law) || std::holds_alternative<NorSandDefinition>(law)) {
      continue;
    }
    const double coarse = energy_gap(specimen, 400), fine = energy_gap(specimen, 800);
    if (fine < 1e-11) continue;  // round-off, since the work of an isothermal gas is the same for any steps
    // The return of a metal whose yield strain is large (here 0.3) takes its modulus at the end of the step.
    // The strength of the other soft one changes so much with strain and heat that its 400 steps give 1.8, 1600 give
    // 1.9.
    const double order = specimen.material.name == "soft_j2_plasticity"  ? 0.85
                         : specimen.material.name == "soft_johnson_cook" ? 1.75
                                                                         : 1.9;
    EXPECT_GT(std::log2(coarse / fine), order) << specimen.material.name;
    EXPECT_LT(fine, 1e-5) << specimen.material.name;
  }
}

/// NorSand as stiff for its strength as the others; G hardly follows the pressure, since G(p) keeps no energy.
NorSandDefinition small_sand() {
  NorSandDefinition sand = some_sand(0.9, 0.0);
  sand.shear_modulus = 4e5;
  sand.shear_exponent = 0.0;
  sand.hardening = 1e4;
  sand.hardening_of_state = 0.0;
  sand.least_pressure = 10.0;
  return sand;
}

// Soil has an energy at small strain: the gap is of the order of the path's strain, 3e-5 along an axis, and of the
// step, 1/1600 of it.
TEST(EveryLaw, OfSoilAccountsForItsWorkAtSmallStrain) {
  const Elasticity soil{1e6, 0.3};
  const double strain = 1e-5;
  for (const double dilation : {0.0, 0.2, 0.6}) {
    for (const Specimen& specimen : std::vector<Specimen>{
             {{"cone", 1600.0, DruckerPragerDefinition{soil, 0.6, dilation, 2.0, -1.0, ConeMatch::compression}},
              strain,
              -strain,
              1.0},
             {{"grain", 1600.0, MuIDefinition{soil, 0.5, 0.7, 0.3, 1e-3, 2500.0}}, strain, -strain, 1.0},
             {{"clay", 1600.0, CamClayDefinition{4e-5, 1e-5, 1.0, 1.0, 4e5, 0.0, 20.0, 0.0, 10.0}},
              strain,
              -strain,
              1.0},
             {{"sand", 1600.0, small_sand()}, strain, -strain, 1.0},
             {{"by Lode angle", 1600.0, DruckerPragerDefinition{soil, 0.6, dilation, 2.0}}, strain, -strain, 1.0},
             {{"pyramid", 1600.0, MohrCoulombDefinition{soil, 0.6, dilation, 2.0, -1.0}}, strain, -strain, 1.0},
             {{"cut off", 1600.0, MohrCoulombDefinition{soil, 0.6, dilation, 10.0, 2.0}}, strain, strain, 1.0}}) {
      double lost = 0.0;
      EXPECT_LT(energy_gap(specimen, 1600, &lost), 6e-5) << specimen.material.name << ' ' << dilation;
      EXPECT_GT(lost, 0.02) << specimen.material.name;  // it flowed: 0.3 % of the loss would be seen above
    }
  }
}

}  // namespace laws_test
