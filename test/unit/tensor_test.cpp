// Small tensors and the exponential against Eigen, an independent implementation.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>
#include <random>
#include <unsupported/Eigen/MatrixFunctions>

#include "mpm/math/exponential.hpp"
#include "mpm/math/principal.hpp"

namespace tensor_test {

using mpm::Matrix3;
using mpm::MatrixPlane;

Eigen::Matrix3d eigen(const Matrix3<double>& a) {
  Eigen::Matrix3d m;
  m << a.xx, a.xy, a.xz, a.yx, a.yy, a.yz, a.zx, a.zy, a.zz;
  return m;
}
Eigen::Matrix3d eigen(const MatrixPlane<double>& a) {
  Eigen::Matrix3d m = Eigen::Matrix3d::Zero();
  m(0, 0) = a.xx, m(0, 2) = a.xz, m(2, 0) = a.zx, m(2, 2) = a.zz, m(1, 1) = a.yy;
  return m;
}
Eigen::Matrix3d eigen(const mpm::Symmetric3<double>& s) {
  Eigen::Matrix3d m;
  m << s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz;
  return m;
}
Eigen::Matrix3d eigen(const mpm::SymmetricPlane<double>& s) {
  Eigen::Matrix3d m = Eigen::Matrix3d::Zero();
  m(0, 0) = s.xx, m(0, 2) = m(2, 0) = s.xz, m(2, 2) = s.zz, m(1, 1) = s.yy;
  return m;
}

template <class M>
class TensorTest : public testing::Test {
 protected:
  M random(double size) {
    std::uniform_real_distribution<double> u(-size, size);
    if constexpr (std::is_same_v<M, Matrix3<double>>) {
      return {u(engine_), u(engine_), u(engine_), u(engine_), u(engine_),
              u(engine_), u(engine_), u(engine_), u(engine_)};
    } else {
      return {u(engine_), u(engine_), u(engine_), u(engine_), u(engine_)};
    }
  }
  std::mt19937 engine_{7};
};
using Matrices = testing::Types<Matrix3<double>, MatrixPlane<double>>;
TYPED_TEST_SUITE(TensorTest, Matrices);

TYPED_TEST(TensorTest, AgreesWithEigen) {
  for (int i = 0; i < 100; ++i) {
    const TypeParam a = this->random(1.0), b = this->random(1.0);
    const Eigen::Matrix3d ea = eigen(a), eb = eigen(b);
    // 1e-14: some ten round-offs of numbers of order one.
    EXPECT_NEAR(determinant(a), ea.determinant(), 1e-14);
    EXPECT_LT((eigen(product(a, b)) - ea * eb).norm(), 1e-14);
    EXPECT_LT((eigen(left_cauchy_green(a)) - ea * ea.transpose()).norm(), 1e-14);
    EXPECT_LT((eigen(symmetric_part(a)) - 0.5 * (ea + ea.transpose())).norm(), 1e-14);
    EXPECT_NEAR(squared_norm(symmetric_part(a)), (0.5 * (ea + ea.transpose())).squaredNorm(), 1e-14);
  }
}

TYPED_TEST(TensorTest, RotatesByHughesAndWinget) {
  for (int i = 0; i < 100; ++i) {
    const TypeParam du = this->random(0.5);
    const auto stress = symmetric_part(this->random(1.0));
    const Eigen::Matrix3d e = eigen(du), w = 0.5 * (e - e.transpose()), one = Eigen::Matrix3d::Identity();
    const Eigen::Matrix3d q = (one - 0.5 * w).inverse() * (one + 0.5 * w);
    EXPECT_LT((eigen(rotate(stress, du)) - q * eigen(stress) * q.transpose()).norm(), 1e-14);
  }
}

TYPED_TEST(TensorTest, ExponentialIsTheTaylorSumToTheTermAskedFor) {
  for (int i = 0; i < 20; ++i) {
    const TypeParam a = this->random(0.3);
    const Eigen::Matrix3d e = eigen(a);
    Eigen::Matrix3d term = Eigen::Matrix3d::Identity(), sum = term;
    for (int k = 1; k <= 8; ++k) {
      term = term * e / k;
      sum += term;
      EXPECT_LT((eigen(exponential(a, k)) - sum).norm(), 1e-14) << k << " terms";
    }
    const Eigen::Matrix3d exact = e.exp();
    EXPECT_LT((eigen(exponential(a, 16)) - exact).norm(), 1e-14);
  }
}

// Jacobi rotations give the exact values; the errors of the bounds are as stated in the header. The tensors include
// ones with two equal or nearly equal values, where the third of an angle is sensitive to round-off.
template <class T>
void expect_bounds(double round_off, double loose) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int n = 0; n < 20000; ++n) {
    const double size = std::pow(10.0, 6.0 * u(engine));
    const Matrix3<double> l = {u(engine), u(engine), u(engine), u(engine), u(engine),
                               u(engine), u(engine), u(engine), u(engine)};
    mpm::Symmetric3<double> s = mpm::scale_shift(mpm::left_cauchy_green(l), size, size * u(engine));
    if (n % 2 == 0) {  // nearly a multiple of a (x) a, of either sign
      const double a = u(engine), b = u(engine), c = u(engine), off = std::pow(10.0, -16.0 * std::abs(u(engine)));
      const double sign = n % 4 == 0 ? 1.0 : -1.0;
      s = mpm::sum(mpm::scale_shift(s, off, 0.0), {sign * size * a * a, sign * size * b * b, sign * size * c * c,
                                                   sign * size * b * c, sign * size * a * c, sign * size * a * b});
    }
    const mpm::Symmetric3<T> held = {T(s.xx), T(s.yy), T(s.zz), T(s.yz), T(s.xz), T(s.xy)};
    s = {held.xx, held.yy, held.zz, held.yz, held.xz, held.xy};
    const mpm::Principal<double> exact = mpm::principal(s);
    const auto [largest, smallest] = mpm::principal_bounds(held);
    const double norm = std::sqrt(mpm::squared_norm(s));
    const double deviator = std::sqrt(mpm::squared_norm(mpm::scale_shift(s, 1.0, -mpm::trace(s) / 3.0)));
    ASSERT_GE(largest, exact.largest() - round_off * norm) << n;
    ASSERT_LE(smallest, exact.smallest() + round_off * norm) << n;
    ASSERT_LE(largest, exact.largest() + loose * deviator + round_off * norm) << n;
    ASSERT_GE(smallest, exact.smallest() - loose * deviator - round_off * norm) << n;
  }
}

TEST(PrincipalBounds, HoldAndAreTight) {
  // Round-off of a sum of a few terms.
  expect_bounds<double>(4.0 * std::numeric_limits<double>::epsilon(), 1e-4);
  expect_bounds<float>(4.0 * std::numeric_limits<float>::epsilon(), 2e-3);
}

// The closed form, to the error of its polynomial, where two values are nearly equal too.
TEST(PrincipalExtremes, AreExactToTheirPolynomial) {
  std::mt19937 engine(8);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int n = 0; n < 20000; ++n) {
    Matrix3<double> l = {u(engine), u(engine), u(engine), u(engine), u(engine), u(engine), u(engine), u(engine), 1.0};
    if (n % 2 == 0) l.xy = l.xx = l.xz = l.yx = l.yy = l.yz = 1e-9 * u(engine);  // two values nearly equal
    mpm::Symmetric3<double> s = mpm::left_cauchy_green(l);
    if (n % 4 >= 2) s = mpm::scale_shift(s, -1.0, 0.0);
    const mpm::Principal<double> exact = mpm::principal(s);
    const auto [largest, smallest] = mpm::principal_extremes(s);
    const double deviator = std::sqrt(mpm::squared_norm(mpm::scale_shift(s, 1.0, -mpm::trace(s) / 3.0)));
    ASSERT_NEAR(largest, exact.largest(), 2e-10 * deviator) << n;
    ASSERT_NEAR(smallest, exact.smallest(), 2e-10 * deviator) << n;
    // In single precision the error of the deviator, a difference, comes to that of the angle.
    const mpm::Symmetric3<float> single = {float(s.xx), float(s.yy), float(s.zz),
                                           float(s.yz), float(s.xz), float(s.xy)};
    const auto [most, least] = mpm::principal_extremes(single);
    const double error = 1e-6 * deviator + 4.0 * std::numeric_limits<float>::epsilon() * std::sqrt(squared_norm(s));
    ASSERT_NEAR(most, exact.largest(), error) << n;
    ASSERT_NEAR(least, exact.smallest(), error) << n;
  }
  for (int k = 0; k <= 1000; ++k) {
    const double x = 0.001 * k;
    ASSERT_NEAR(mpm::cosine_of_third_by_half(x), std::cos(2.0 / 3.0 * std::acos(x)), 1e-10) << x;
  }
  const auto [largest, smallest] = mpm::principal_extremes(mpm::Symmetric3<double>::isotropic(3.0));
  EXPECT_EQ(largest, 3.0);
  EXPECT_EQ(smallest, 3.0);
}

TEST(PrincipalBounds, OfEqualValuesAreExact) {
  const auto [largest, smallest] = mpm::principal_bounds(mpm::Symmetric3<double>::isotropic(3.0));
  EXPECT_EQ(largest, 3.0);
  EXPECT_EQ(smallest, 3.0);
}

// The values of a planar tensor are those of the solid one.
TEST(PrincipalBounds, OfAPlaneAreItsValues) {
  std::mt19937 engine(8);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int n = 0; n < 1000; ++n) {
    const mpm::SymmetricPlane<double> s = {u(engine), u(engine), u(engine), u(engine)};
    const mpm::Principal<double> exact = mpm::principal(mpm::Symmetric3<double>{s.xx, s.yy, s.zz, 0.0, s.xz, 0.0});
    const auto [largest, smallest] = mpm::principal_bounds(s);
    EXPECT_NEAR(largest, exact.largest(), 1e-14);  // round-off of numbers below 3
    EXPECT_NEAR(smallest, exact.smallest(), 1e-14);
  }
}

// Method reference 7: a pure rotation by theta per step raises J by theta^2 (k = 1) or theta^4 / 4 (k = 2).
TEST(Exponential, GrowsVolumeUnderRotationAsTheorySays) {
  const double theta = 0.1;
  MatrixPlane<double> spin{0.0, theta, -theta, 0.0, 0.0};
  EXPECT_NEAR(determinant(exponential(spin, 1)), 1.0 + theta * theta, 1e-15);
  EXPECT_NEAR(determinant(exponential(spin, 2)), 1.0 + std::pow(theta, 4) / 4.0, 1e-15);
}

}  // namespace tensor_test
