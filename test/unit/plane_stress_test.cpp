// Plane stress of any law (material/plane_stress.hpp): closed forms, scalar equations solved here by bisection, and a
// solid with the strain found for the plate. For numbers of both precisions and for lanes.
#include "mpm/material/plane_stress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <type_traits>

#include "lanes.hpp"
#include "material_zoo.hpp"
#include "mpm/math/dimension.hpp"

namespace mpm::test {
namespace plane_stress_test {

constexpr double kDensity = 1000.0;
const Elasticity kElasticity{1e5, 0.3};
constexpr int kTerms = 12;  // terms of the exponential: all digits of a double

/// A particle of a plate.
template <class T, class LawType>
struct Plate {
  void advance(const LawType& law, const T (&du)[2][2], double dt = 1.0, int terms = kTerms) {
    MatrixPlane<T> now;
    T j;
    plane_stress_update(law, du, terms, f, T(dt), tau, history, now, determinant(f), j);
    f = now;
  }
  void advance(const LawType& law, double xx, double zz, double xz = 0.0, double zx = 0.0) {
    const T du[2][2] = {{T(xx), T(xz)}, {T(zx), T(zz)}};
    advance(law, du);
  }
  MatrixPlane<T> f = MatrixPlane<T>::identity();
  SymmetricPlane<T> tau = SymmetricPlane<T>::isotropic(T(0));
  T history[LawType::kHistory + 1] = {};
};

template <class T>
class PlaneStressTest : public testing::Test {
 public:
  static constexpr double kLastDigit = std::numeric_limits<ScalarOf<T>>::epsilon();
  /// Strain to which an increment determines F_yy, including the law's round-off.
  static constexpr double kStrain = kFreeStress<ScalarOf<T>> + 16.0 * kLastDigit;
};
using Numbers = testing::Types<double, float, Four<double>, Four<float>>;
TYPED_TEST_SUITE(PlaneStressTest, Numbers);

double bisect(const std::function<double(double)>& rising, double low, double high) {
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (rising(middle) < 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Kirchhoff stress of a neo-Hookean solid along a principal axis with stretch l; m and n are the other two stretches:
/// K/2 (J^2 - 1) + G J^(-2/3) (l^2 - I1/3), Nairn & Guilkey (2015) eq. (64).
double neo_hookean(double l, double m, double n) {
  const double j = l * m * n;
  return 0.5 * kElasticity.bulk() * (j * j - 1.0) +
         kElasticity.shear() * std::pow(j, -2.0 / 3.0) * (l * l - (l * l + m * m + n * n) / 3.0);
}

// sigma_xx = E / (1 - nu^2) (exx + nu ezz), sigma_xz = 2 G exz, eyy = -nu / (1 - nu) (exx + ezz).
TYPED_TEST(PlaneStressTest, OfALinearElasticPlateIsHookesLaw) {
  const LinearElastic law({kElasticity}, kDensity);
  const double size = 1e-4, exx = 1.0 * size, ezz = -0.4 * size, exz = 0.3 * size, nu = 0.3;
  Plate<TypeParam, LinearElastic> plate;
  plate.advance(law, exx, ezz, exz, exz);
  // The law is linear up to the order of the strain, and yy is zero up to the tolerance of the iteration.
  const double tolerance = 4.0 * size * size + 4.0 * this->kStrain, modulus = kElasticity.young / (1.0 - nu * nu);
  EXPECT_NEAR(lane(plate.tau.xx, 0) * kDensity, modulus * (exx + nu * ezz), tolerance * modulus);
  EXPECT_NEAR(lane(plate.tau.zz, 0) * kDensity, modulus * (ezz + nu * exx), tolerance * modulus);
  EXPECT_NEAR(lane(plate.tau.xz, 0) * kDensity, 2.0 * kElasticity.shear() * exz, tolerance * modulus);
  EXPECT_NEAR(lane(plate.tau.yy, 0) * kDensity, 0.0, 2.0 * this->kStrain * modulus);
  EXPECT_NEAR(lane(plate.f.yy, 0) - 1.0, -nu / (1.0 - nu) * (exx + ezz), tolerance);
}

// The result is the same in one increment and in many: the law is hyperelastic.
TYPED_TEST(PlaneStressTest, OfANeoHookeanPlateIsUniaxialStress) {
  const NeoHookean law({kElasticity}, kDensity);
  const double along = 1.5;
  const double across = bisect([&](double l) { return neo_hookean(l, l, along); }, 0.5, 1.5);
  for (const int steps : {1, 40}) {
    Plate<TypeParam, NeoHookean> plate;
    for (int i = 0; i < steps; ++i) plate.advance(law, std::log(along) / steps, std::log(across) / steps);
    // The tolerance of the last increment, and the round-off of the product of all.
    const double tolerance = 4.0 * this->kStrain + 4.0 * steps * this->kLastDigit;
    EXPECT_NEAR(lane(plate.f.yy, 0), across, tolerance) << steps;
    EXPECT_NEAR(lane(plate.tau.xx, 0) * kDensity, neo_hookean(along, across, across), tolerance * 1e6);
    EXPECT_NEAR(lane(plate.tau.zz, 0) * kDensity, 0.0, tolerance * 1e6);
  }
}

TYPED_TEST(PlaneStressTest, OfANeoHookeanPlateIsEquibiaxialStress) {
  const NeoHookean law({kElasticity}, kDensity);
  for (const double along : {1.3, 0.8}) {
    const double thickness = bisect([&](double l) { return neo_hookean(l, along, along); }, 0.3, 2.0);
    for (const int steps : {1, 40}) {
      Plate<TypeParam, NeoHookean> plate;
      for (int i = 0; i < steps; ++i) plate.advance(law, std::log(along) / steps, std::log(along) / steps);
      const double tolerance = 4.0 * this->kStrain + 4.0 * steps * this->kLastDigit;
      EXPECT_NEAR(lane(plate.f.yy, 0), thickness, tolerance) << along << ' ' << steps;
      EXPECT_NEAR(lane(plate.tau.xx, 0) * kDensity, neo_hookean(along, along, thickness), tolerance * 1e6);
    }
  }
}

/// Von Mises stress [Pa].
template <class T>
double mises(const SymmetricPlane<T>& tau) {
  const T mean = T(1.0 / 3.0) * trace(tau);
  return kDensity * std::sqrt(1.5 * lane(squared_norm(scale_shift(tau, T(1.0), -mean)), 0));
}

// Without hardening. Uniaxial: flow preserves volume, so a strain of -1/2 along z leaves no stress there while it goes
// on. Equibiaxial: yield is the same (von Mises). In shear the stress is yield / sqrt(3), up to the square of the
// elastic strain, 1e-6. The deviator approaches the direction of flow geometrically, by 3e-9 in 25 yield strains: 40
// are used.
TYPED_TEST(PlaneStressTest, OfMetalFlowsAtItsYieldStress) {
  const double yield = 100.0, strain = 40.0 * yield / kElasticity.young;
  const J2Plasticity law({kElasticity, yield, 0.0, 0.0, 0.0}, kDensity);
  const int steps = 320;
  const double tolerance = 1e-11 * yield + 4.0 * kElasticity.young * this->kStrain;
  Plate<TypeParam, J2Plasticity> uniaxial, equibiaxial, shear;
  for (int i = 0; i < steps; ++i) {
    uniaxial.advance(law, strain / steps, -0.5 * strain / steps);
    equibiaxial.advance(law, strain / steps, strain / steps);
    shear.advance(law, 0.0, 0.0, strain / steps, strain / steps);
  }
  EXPECT_NEAR(lane(uniaxial.tau.xx, 0) * kDensity, yield, tolerance);
  EXPECT_NEAR(lane(uniaxial.tau.zz, 0) * kDensity, 0.0, tolerance);
  EXPECT_NEAR(lane(equibiaxial.tau.xx, 0) * kDensity, yield, tolerance);
  EXPECT_NEAR(lane(equibiaxial.tau.zz, 0) * kDensity, yield, tolerance);
  EXPECT_NEAR(lane(shear.tau.xz, 0) * kDensity, yield / std::sqrt(3.0), 1e-6 * yield + tolerance);
  for (const auto& plate : {uniaxial, equibiaxial, shear}) {
    EXPECT_NEAR(mises(plate.tau), yield, tolerance);
    EXPECT_NEAR(lane(plate.tau.yy, 0) * kDensity, 0.0, 2.0 * kElasticity.young * this->kStrain);
  }
}

// The exponential has the same terms along y as in the plane: 1 + e (k = 1), 1 + e + e^2 / 2 (k = 2), where e is found
// so that there is no stress along y: F_yy is the same for any number of terms.
TYPED_TEST(PlaneStressTest, ThicknessDoesNotDependOnTheTermsAlongY) {
  const NeoHookean law({kElasticity}, kDensity);
  for (const int terms : {1, 2, 3}) {
    double series = 0.0, power = 1.0;
    for (int k = 0; k <= terms; ++k, power *= 0.2 / k) series += power;
    const double thickness = bisect([&](double l) { return neo_hookean(l, series, 1.0); }, 0.3, 2.0);
    Plate<TypeParam, NeoHookean> plate;
    const TypeParam du[2][2] = {{TypeParam(0.2), TypeParam(0.0)}, {TypeParam(0.0), TypeParam(0.0)}};
    plate.advance(law, du, 1.0, terms);
    EXPECT_NEAR(lane(plate.f.xx, 0), series, 4.0 * this->kLastDigit);
    EXPECT_NEAR(lane(plate.f.yy, 0), thickness, 4.0 * this->kStrain) << terms;
  }
}

/// Visits every law that plane stress is meant for.
template <class Visit>
void each_solid(Visit&& visit) {
  for (const paths::Specimen& specimen : paths::zoo()) {
    std::visit(
        [&](const auto& law) {
          if constexpr (!std::decay_t<decltype(law)>::kForgetsShape) visit(specimen, law);
        },
        make_law(specimen.material));
  }
}

/// The increment of a lane: hardly any strain, the path of the specimen, half of it, double.
MatrixPlane<double> increment(const paths::Specimen& specimen, std::mt19937& random, int i, int n) {
  const double size[4] = {1e-4, 1.0, 0.5, 2.0};
  const Matrix3<double> du = paths::random_gradient(random, size[i] * specimen.strain);
  const double pressing = n < 10 ? 0.1 * specimen.pressing : 0.0;
  return {du.xx + pressing, du.xz, du.zx, du.zz + pressing, 0.0};
}

/// tau_yy of an increment whose strain along y is `e`.
template <class LawType>
double stress_along_y(const LawType& law, Plate<double, LawType> plate, const double (&du)[2][2], double e, double dt) {
  const MatrixPlane<double> gradient{du[0][0], du[0][1], du[1][0], du[1][1], e};
  const MatrixPlane<double> df = exponential(gradient, kTerms), now = product(df, plate.f);
  law.update(Increment<double, MatrixPlane<double>>{gradient, df, now, determinant(plate.f), determinant(now), dt},
             plate.tau, plate.history);
  return plate.tau.yy;
}

// A solid with the strain found for the plate has no stress along y, and the plate's stress in the plane. The stress of
// soil jumps where an opening closes, since only closed soil dilates. An increment that ends at such a jump is not
// compared with the solid, because round-off may put the solid on the other side.
TEST(PlaneStress, IsTheSolidWithoutStressAlongY) {
  each_solid([](const paths::Specimen& specimen, const auto& law) {
    using LawType = std::decay_t<decltype(law)>;
    std::mt19937 random(3);
    Plate<double, LawType> plate;
    int jumps = 0;
    constexpr int kIncrements = 60;
    for (int n = 0; n < kIncrements; ++n) {
      const MatrixPlane<double> in_plane = increment(specimen, random, 1, n);
      const double du[2][2] = {{in_plane.xx, in_plane.xz}, {in_plane.zx, in_plane.zz}};
      const Plate<double, LawType> before = plate;
      const double speed = law.wave_speed(plate.f, plate.tau, determinant(plate.f)), stiffness = speed * speed;
      plate.advance(law, du, specimen.time);
      const double along_y = std::log(plate.f.yy / before.f.yy);
      if (std::abs(plate.tau.yy) > kFreeStress<double> * stiffness) {
        const double near = 1e-6;  // the bracket has been halved a dozen times by then
        EXPECT_LT(stress_along_y(law, before, du, along_y - near, specimen.time), 0.0) << specimen.material.name;
        EXPECT_GT(stress_along_y(law, before, du, along_y + near, specimen.time), 0.0) << specimen.material.name;
        ++jumps;
        continue;
      }
      const Matrix3<double> whole{du[0][0], 0, du[0][1], 0, along_y, 0, du[1][0], 0, du[1][1]};
      const Matrix3<double> df = exponential(whole, kTerms);
      const Matrix3<double> f{before.f.xx, 0, before.f.xz, 0, before.f.yy, 0, before.f.zx, 0, before.f.zz};
      const Matrix3<double> now = product(df, f);
      Symmetric3<double> s{before.tau.xx, before.tau.yy, before.tau.zz, 0, before.tau.xz, 0};
      double history[LawType::kHistory + 1];
      std::copy(std::begin(before.history), std::end(before.history), history);
      law.update(Increment<double, Matrix3<double>>{whole, df, now, determinant(f), determinant(now), specimen.time}, s,
                 history);
      // The logarithm above is off by its last digit, and the round-off of the law differs in a solid.
      const double tolerance = 1e-12 * stiffness;
      for (const double difference : {s.xx - plate.tau.xx, s.zz - plate.tau.zz, s.xz - plate.tau.xz}) {
        EXPECT_NEAR(difference, 0.0, tolerance) << specimen.material.name << ' ' << n;
      }
      EXPECT_NEAR(s.yy, 0.0, kFreeStress<double> * stiffness + tolerance) << specimen.material.name << ' ' << n;
    }
    EXPECT_LE(jumps, LawType::kHistory == 3 ? kIncrements / 10 : 0) << specimen.material.name;
  });
}

/// A law that counts its evaluations.
template <class LawType>
struct Counted : LawType {
  explicit Counted(const LawType& law) : LawType(law) {}
  template <class... Arguments>
  void update(Arguments&&... arguments) const {
    ++calls;
    LawType::update(std::forward<Arguments>(arguments)...);
  }
  mutable int calls = 0;
};

// The cost stated in the header, for increments as in steps: at most four evaluations where the law is elastic.
TEST(PlaneStress, AsksAnElasticLawAtMostFourTimes) {
  each_solid([](const paths::Specimen& specimen, const auto& law) {
    using LawType = std::decay_t<decltype(law)>;
    for (const double strain : {1e-6, 1e-5, 1e-4}) {
      const Counted<LawType> counted(law);
      Plate<double, Counted<LawType>> plate;
      plate.advance(counted, strain, -0.2 * strain, 0.3 * strain);
      const auto changed = [](double h) { return h != 0.0; };
      if (std::any_of(plate.history, plate.history + LawType::kHistory, changed)) continue;  // flows or opens
      EXPECT_LE(counted.calls, 4) << specimen.material.name << ' ' << strain;
    }
  });
}

TEST(PlaneStress, OfLanesIsAsOfNumbersAlone) {
  each_solid([](const paths::Specimen& specimen, const auto& law) {
    using LawType = std::decay_t<decltype(law)>;
    std::mt19937 random(4);
    Plate<double, LawType> alone[4];
    Plate<Four<double>, LawType> together;
    for (int n = 0; n < 60; ++n) {
      Four<double> du[2][2];
      for (int i = 0; i < 4; ++i) {
        const MatrixPlane<double> m = increment(specimen, random, i, n);
        const double number[2][2] = {{m.xx, m.xz}, {m.zx, m.zz}};
        alone[i].advance(law, number, specimen.time, 2);
        for (int r = 0; r < 2; ++r) {
          for (int c = 0; c < 2; ++c) set_lane(du[r][c], i, number[r][c]);
        }
      }
      together.advance(law, du, specimen.time, 2);
      for (int i = 0; i < 4; ++i) {
        // The same operations in the same order (nothing is contracted): the same bits.
        EXPECT_EQ(lane(together.f.yy, i), alone[i].f.yy) << specimen.material.name << " lane " << i << " step " << n;
        EXPECT_EQ(lane(together.tau.xx, i), alone[i].tau.xx) << specimen.material.name;
        EXPECT_EQ(lane(together.tau.yy, i), alone[i].tau.yy) << specimen.material.name;
        for (int h = 0; h < LawType::kHistory; ++h) EXPECT_EQ(lane(together.history[h], i), alone[i].history[h]);
      }
      if (testing::Test::HasFailure()) return;
    }
  });
}

// The empty lanes of a register contain zeros. F = 0 gives NaN there, which must neither keep the other lanes iterating
// nor change them.
TEST(PlaneStress, OfALaneThatIsNoNumberLeavesTheOthersAlone) {
  const NeoHookean law({kElasticity}, kDensity);
  Plate<Four<double>, NeoHookean> plate;
  set_lane(plate.f.xx, 3, 0.0), set_lane(plate.f.zz, 3, 0.0), set_lane(plate.f.yy, 3, 0.0);
  plate.advance(law, 0.01, 0.0);
  Plate<double, NeoHookean> alone;
  alone.advance(law, 0.01, 0.0);
  EXPECT_FALSE(determinant(plate.f).v[3] > 0.0);
  EXPECT_EQ(lane(plate.f.yy, 0), alone.f.yy);
}

}  // namespace plane_stress_test
}  // namespace mpm::test
