// Laws and kinematics written for registers: every lane gives the same result as a single number, whatever the other
// lanes contain.
#include "lanes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <type_traits>

#include "material_zoo.hpp"
#include "mpm/math/dimension.hpp"
#include "mpm/math/exponential.hpp"
#include "mpm/shape/ugimp.hpp"

namespace mpm::test {
namespace lanes_test {

constexpr int kLanes = 4;
constexpr int kSteps = 60;

/// The part of an increment that exists in the geometry.
Matrix3<double> of_geometry(const Matrix3<double>& m, Solid) { return m; }
MatrixPlane<double> of_geometry(const Matrix3<double>& m, PlaneStrain) { return {m.xx, m.xz, m.zx, m.zz, 0.0}; }

Matrix3<float> single(const Matrix3<double>& m) {
  return {float(m.xx), float(m.xy), float(m.xz), float(m.yx), float(m.yy),
          float(m.yz), float(m.zx), float(m.zy), float(m.zz)};
}

/// The state of a particle, or of a register of particles, and its step.
template <class T, class Geometry, class LawType>
struct Element {
  using Matrix = typename Geometry::template Matrix<T>;
  using Symmetric = typename Geometry::template Symmetric<T>;

  void advance(const LawType& law, const Matrix& du, double dt) {
    const Matrix df = exponential(du, 6);
    const T j_old = determinant(f);
    f = LawType::kForgetsShape ? Geometry::dilatation(j_old * determinant(df)) : product(df, f);
    law.update(Increment<T, Matrix>{du, df, f, j_old, determinant(f), T(dt)}, tau, history);
  }
  /// All components of the state.
  std::vector<T> state() const {
    T* arrays[Geometry::kMatrix + Geometry::kSymmetric];
    std::vector<T> values(Geometry::kMatrix + Geometry::kSymmetric, T(0));
    for (std::size_t c = 0; c < values.size(); ++c) arrays[c] = &values[c];
    Geometry::store_matrix(f, arrays, 0);
    Geometry::store_symmetric(tau, arrays + Geometry::kMatrix, 0);
    values.insert(values.end(), history, history + LawType::kHistory);
    return values;
  }

  Matrix f = Matrix::identity();
  Symmetric tau = Symmetric::isotropic(T(0));
  T history[LawType::kHistory + 1] = {};
};

/// The increment of a lane: hardly any strain, the path of the specimen, opening and closing, or large random strain.
template <class Geometry>
auto increment(const paths::Specimen& specimen, std::mt19937& random, int i, int n) {
  const double size[kLanes] = {1e-4, 1.0, 0.5, 2.0};
  Matrix3<double> du = paths::random_gradient(random, size[i] * specimen.strain);
  double volume = 0.0;
  if (i == 2) volume = (n < kSteps / 2 ? 1.0 : -1.2) * specimen.strain;
  if ((i == 1 || i == 3) && n < 10) volume = 0.1 * specimen.pressing;
  du.xx += volume, du.yy += volume, du.zz += volume;
  return of_geometry(du, Geometry());
}

/// Four matrices combined into one of registers.
template <class Wide, class Matrix>
Wide gathered(const Matrix (&lanes)[kLanes]) {
  Wide wide;
  for (int i = 0; i < kLanes; ++i) {
    const Matrix& m = lanes[i];
    set_lane(wide.xx, i, m.xx), set_lane(wide.xz, i, m.xz), set_lane(wide.zx, i, m.zx), set_lane(wide.zz, i, m.zz);
    set_lane(wide.yy, i, m.yy);
    if constexpr (std::is_same_v<Matrix, Matrix3<double>>) {
      set_lane(wide.xy, i, m.xy), set_lane(wide.yx, i, m.yx), set_lane(wide.yz, i, m.yz), set_lane(wide.zy, i, m.zy);
    }
  }
  return wide;
}

/// Counts of differences between lanes, to prove that lanes differed in the test.
struct Seen {
  int apart = 0;        ///< steps in which some lanes flowed and others did not
  int open_apart = 0;   ///< steps in which some were open and others were not
  int loose_apart = 0;  ///< steps in which some were larger than at the start and others smaller
};

template <class Geometry, class LawType>
Seen compare(const paths::Specimen& specimen, const LawType& law) {
  Element<double, Geometry, LawType> alone[kLanes];
  Element<Four<double>, Geometry, LawType> together;
  using WideMatrix = typename Element<Four<double>, Geometry, LawType>::Matrix;
  std::mt19937 random(11);
  Seen seen;
  for (int n = 0; n < kSteps; ++n) {
    typename Geometry::template Matrix<double> du[kLanes];
    int flowed = 0, open = 0, loose = 0;
    for (int i = 0; i < kLanes; ++i) {
      du[i] = increment<Geometry>(specimen, random, i, n);
      const double before = law.kPlasticStrain < 0 ? 0.0 : alone[i].history[std::max(law.kPlasticStrain, 0)];
      alone[i].advance(law, du[i], specimen.time);
      if (law.kPlasticStrain >= 0 && alone[i].history[std::max(law.kPlasticStrain, 0)] > before) ++flowed;
      if constexpr (LawType::kHistory == 3) open += alone[i].history[LawType::kOpening] > 0.0 ? 1 : 0;
      loose += determinant(alone[i].f) > 1.0 ? 1 : 0;
    }
    together.advance(law, gathered<WideMatrix>(du), specimen.time);
    seen.apart += flowed > 0 && flowed < kLanes ? 1 : 0;
    seen.open_apart += open > 0 && open < kLanes ? 1 : 0;
    seen.loose_apart += loose > 0 && loose < kLanes ? 1 : 0;
    const auto wide = together.state();
    const auto wide_speed = law.wave_speed(together.f, together.tau, determinant(together.f));
    const auto wide_diffusivity = law.diffusivity(determinant(together.f));
    for (int i = 0; i < kLanes; ++i) {
      const auto expected = alone[i].state();
      for (std::size_t c = 0; c < expected.size(); ++c) {
        EXPECT_TRUE(std::isfinite(expected[c]));
        // The same operations in the same order (nothing is contracted): the same bits.
        EXPECT_EQ(lane(wide[c], i), expected[c])
            << specimen.material.name << " lane " << i << " step " << n << " component " << c;
      }
      const double j = determinant(alone[i].f);
      EXPECT_EQ(lane(wide_speed, i), law.wave_speed(alone[i].f, alone[i].tau, j)) << specimen.material.name;
      EXPECT_EQ(lane(wide_diffusivity, i), law.diffusivity(j)) << specimen.material.name;
      if (testing::Test::HasFailure()) return seen;
    }
  }
  return seen;
}

template <class Geometry>
void compare_every_law() {
  for (const paths::Specimen& specimen : paths::zoo()) {
    std::visit(
        [&](const auto& law) {
          using LawType = std::decay_t<decltype(law)>;
          const Seen seen = compare<Geometry>(specimen, law);
          EXPECT_GT(seen.loose_apart, 5) << specimen.material.name;
          if (LawType::kPlasticStrain >= 0) {
            EXPECT_GT(seen.apart, 5) << specimen.material.name;
          }
          if (LawType::kHistory == 3) {
            EXPECT_GT(seen.open_apart, 5) << specimen.material.name;
          }
        },
        make_law(specimen.material));
  }
}

TEST(Lanes, OfEveryLawInASolidAreAsNumbersAlone) { compare_every_law<Solid>(); }
TEST(Lanes, OfEveryLawInPlaneStrainAreAsNumbersAlone) { compare_every_law<PlaneStrain>(); }

// In single precision the law is the same up to round-off: of 20 steps, each of a hundred operations on quantities
// whose difference is the stress, as in TurnsWithItsPath (laws_test.cpp) for double. Round-off may decide whether
// opened soil has room left, and with it how it dilates, so the path compresses.
TEST(Lanes, OfSinglePrecisionFollowTheDouble) {
  for (const paths::Specimen& specimen : paths::zoo()) {
    std::visit(
        [&](const auto& law) {
          using LawType = std::decay_t<decltype(law)>;
          Element<double, Solid, LawType> fine;
          Element<float, Solid, LawType> coarse;
          std::mt19937 random(12);
          double stress = 0.0, stiffness = 0.0;
          for (int n = 0; n < 20; ++n) {
            Matrix3<double> du = paths::random_gradient(random, 0.3 * specimen.strain);
            du.xx -= specimen.strain, du.yy -= specimen.strain, du.zz -= specimen.strain;
            fine.advance(law, du, specimen.time);
            coarse.advance(law, single(du), specimen.time);
            const double speed = law.wave_speed(fine.f, fine.tau, determinant(fine.f));
            stiffness = std::max(stiffness, speed * speed);
            stress = std::max(stress, std::sqrt(squared_norm(fine.tau)));
          }
          const double round_off = 20 * 100 * std::numeric_limits<float>::epsilon() * (stress + stiffness);
          const auto expected = fine.state();
          const auto found = coarse.state();
          for (std::size_t c = Solid::kMatrix; c < Solid::kMatrix + Solid::kSymmetric; ++c) {
            EXPECT_NEAR(found[c], expected[c], round_off) << specimen.material.name << ' ' << c;
          }
        },
        make_law(specimen.material));
  }
}

// Particles at -0.4, -0.1, 0.2 and 0.5 cells from their node.
TEST(Lanes, OfAShapeFunctionAreAsNumbersAlone) {
  Four<double> offset;
  for (int i = 0; i < kLanes; ++i) set_lane(offset, i, -0.4 + 0.3 * i);
  const Ugimp<Four<double>> together(offset, {0.25, 10.0});
  for (int i = 0; i < kLanes; ++i) {
    const Ugimp<double> alone(lane(offset, i), {0.25, 10.0});
    for (int n = 0; n < 3; ++n) {
      EXPECT_EQ(lane(together.s[n], i), alone.s[n]);
      EXPECT_EQ(lane(together.g[n], i), alone.g[n]);
    }
  }
}

TEST(Lanes, WholePowersAreProducts) {
  EXPECT_EQ(whole_power(3.0, 1), 3.0);
  EXPECT_EQ(whole_power(3.0, 2), 9.0);
  EXPECT_EQ(whole_power(3.0, 6), 729.0);
  EXPECT_EQ(whole_power(3.0, 7), 2187.0);
  EXPECT_EQ(whole_power(-2.0, 31), -2147483648.0);
}

}  // namespace lanes_test
}  // namespace mpm::test
