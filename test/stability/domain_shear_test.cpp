// The shear of CPDI's domains (shape/domain_shear.hpp): what its limit keeps, that steps of the size that is allowed
// are stable for a block that is sheared far, and not much shorter than they have to be. Cost: 1 s.
#include "mpm/shape/domain_shear.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <random>

#include "methods.hpp"
#include "probe.hpp"
#include "scenes.hpp"

namespace domain_shear_test {

using mpm::ShapeKind;
using stability::kCell;
using stability::kWaveSpeed;
using stability::Vec3;

template <int Dim>
using Matrix = Eigen::Matrix<double, Dim, Dim>;

/// The half vectors of F, times half a cell's edge, as the functions take them: d[k] is column k.
template <int Dim>
struct Domain {
  double d[Dim][Dim];
  explicit Domain(const Matrix<Dim>& f) {
    for (int k = 0; k < Dim; ++k) {
      for (int c = 0; c < Dim; ++c) d[k][c] = 0.25 * f(c, k);
    }
  }
  Matrix<Dim> matrix() const {
    Matrix<Dim> f;
    for (int k = 0; k < Dim; ++k) {
      for (int c = 0; c < Dim; ++c) f(c, k) = 4.0 * d[k][c];
    }
    return f;
  }
  Domain limited() const {
    Domain now = *this;
    mpm::set_up(now.d);
    return now;
  }
};

template <int Dim>
Matrix<Dim> random_matrix(std::mt19937& random) {
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  Matrix<Dim> f;
  do {
    for (int i = 0; i < Dim * Dim; ++i) f(i) = u(random);
    f.col(0) *= std::exp(3.0 * u(random));
  } while (f.determinant() < 1e-4);
  return f;
}

/// Product of the edges over the volume.
template <int Dim>
double defect(const Matrix<Dim>& f) {
  return f.colwise().norm().prod() / f.determinant();
}
const double kMost = std::sqrt(1.0 + mpm::kDomainShear * mpm::kDomainShear);

Matrix<2> simple_shear(double shear) {
  Matrix<2> f = Matrix<2>::Identity();
  f(0, 1) = shear;
  return f;
}

template <int Dim>
void expect_limited() {
  std::mt19937 random(5);
  int leaning = 0;
  for (int i = 0; i < 1000; ++i) {
    const Matrix<Dim> f = random_matrix<Dim>(random);
    const Domain<Dim> domain(f);
    ASSERT_EQ(mpm::leans_too_far(domain.d), defect<Dim>(f) > kMost);
    if (!mpm::leans_too_far(domain.d)) continue;
    ++leaning;
    const Matrix<Dim> now = domain.limited().matrix();
    ASSERT_NEAR(defect<Dim>(now), kMost, 1e-9 * kMost);
    ASSERT_NEAR(now.determinant(), f.determinant(), 1e-10 * f.colwise().norm().prod());
    Eigen::Index longest;
    f.colwise().norm().maxCoeff(&longest);
    ASSERT_LE((now.col(longest) - f.col(longest)).norm(), 1e-14 * f.norm());
    ASSERT_NEAR(now.colwise().norm().maxCoeff(), f.col(longest).norm(), 1e-12 * f.norm());
  }
  EXPECT_GT(leaning, 50);
  EXPECT_LT(leaning, 900);
}

TEST(DomainShear, KeepsTheLongestEdgeAndTheVolume) {
  expect_limited<2>();
  expect_limited<3>();
}

TEST(DomainShear, BeginsAtTheLimitAndContinuously) {
  for (const double sign : {-1.0, 1.0}) {
    const double limit = sign * mpm::kDomainShear;
    EXPECT_FALSE(mpm::leans_too_far(Domain<2>(simple_shear(limit * (1.0 - 1e-9))).d));
    const Domain<2> beyond(simple_shear(limit * (1.0 + 1e-9)));
    EXPECT_TRUE(mpm::leans_too_far(beyond.d));
    EXPECT_LE((beyond.limited().matrix() - beyond.matrix()).norm(), 1e-8);
  }
}

TEST(DomainShear, IsNotThatOfStretch) {
  for (const double stretch : {1e-3, 0.1, 10.0, 1e3}) {
    Matrix<3> f = Matrix<3>::Identity();
    f(0, 0) = stretch;
    f(2, 2) = 1.0 / stretch;
    const Eigen::AngleAxisd turn(0.7, Vec3(1.0, 2.0, 3.0).normalized());
    EXPECT_FALSE(mpm::leans_too_far(Domain<3>(turn.toRotationMatrix() * f).d)) << stretch;
  }
}

/// A free block of 6 x 6 cells without stress and with this deformation gradient, of volume ratio 1, off the grid's
/// lines, in random motion at 1e-11 of the wave speed.
class Block {
 public:
  Block(const Matrix<2>& f, mpm::MethodDefinition method) : probe_(definition(f, method)) {
    mpm::ParticleSet& set = probe_.set();
    for (int c = 0; c < 4; ++c) {
      for (int p = 0; p < set.size(); ++p) set.f[c].set(p, f(c / 2, c % 2));
    }
    probe_.sort();
  }
  /// True if velocities stay below a hundred times what they were in so many steps, in which a wave crosses `courant`
  /// cells each.
  bool stable(double courant, int steps) {
    const double start = probe_.motion();
    for (int i = 0; i < steps; ++i) {
      probe_.step(courant * kCell / kWaveSpeed);
      if (!(probe_.motion() < 1e4 * start)) return false;
    }
    return true;
  }
  /// Step that the solver takes in its third period [s]. It has seen the particles as they are before both the second
  /// and the third, so that it foresees no change.
  double step_of_solver() {
    for (int i = 0; i < 3; ++i) probe_.advance();
    return probe_.simulation().state().step.dt_last;
  }

 private:
  static mpm::SimulationDefinition definition(const Matrix<2>& f, const mpm::MethodDefinition& method) {
    mpm::SimulationDefinition d = stability::domain(method, {-120.0, 0.0, -60.0}, {120.0, 0.0, 60.0}, 2e-3);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    const double speed = 1e-11 * kWaveSpeed;
    stability::add_body(d, "block", {-3.0, 0.0, -3.0}, {3.0, 0.0, 3.0}, stability::linear_elastic(0.3),
                        [&](const Vec3&) { return Vec3(speed * u(random), 0.0, speed * u(random)); });
    for (Vec3& x : d.bodies[0].positions) {
      const Eigen::Vector2d at = f * Eigen::Vector2d(x.x(), x.z()) + kCell * Eigen::Vector2d(0.23, 0.41);
      x = {at.x(), 0.0, at.y()};
    }
    return d;
  }
  stability::Probe probe_;
};

mpm::MethodDefinition method(ShapeKind shape, mpm::Precision precision) {
  mpm::MethodDefinition m;
  m.shape = shape;
  m.precision = precision;
  return m;
}

Matrix<2> thread() {  // run that tore rubber with a tool; without the limit its step is stable up to 0.15 cells
  Matrix<2> f;
  f << 12.8, 5.9, -3.6, -1.53;
  return f / std::sqrt(f.determinant());
}

/// A step may exceed its limit by so much before it is shortened (simulation/advance.cpp).
double allowed(double shear) {
  return std::sqrt(2.0) * mpm::courant_of_shear(0.5, std::min(std::abs(shear), mpm::kDomainShear));
}

TEST(DomainShear, AllowsStepsThatAreStable) {
  for (const ShapeKind shape : {ShapeKind::cpdi, ShapeKind::qcpdi}) {
    for (const mpm::Precision precision : {mpm::Precision::float64, mpm::Precision::float32}) {
      const mpm::MethodDefinition m = method(shape, precision);
      for (const double shear : {0.0, 2.0, 3.0, 4.0, -6.0, 10.0}) {
        EXPECT_TRUE(Block(simple_shear(shear), m).stable(allowed(shear), 100))
            << shear << " " << mpm::shape_name(shape);
      }
      EXPECT_TRUE(Block(thread(), m).stable(allowed(mpm::kDomainShear), 100)) << mpm::shape_name(shape);
    }
  }
}

TEST(DomainShear, AllowsAThirdOfWhatIsUnstable) {
  const mpm::MethodDefinition m = method(ShapeKind::cpdi, mpm::Precision::float64);
  for (const double shear : {4.0, 6.0, 10.0}) {
    EXPECT_FALSE(Block(simple_shear(shear), m).stable(3.0 * allowed(shear), 300)) << shear;
  }
  EXPECT_FALSE(Block(thread(), m).stable(3.0 * allowed(mpm::kDomainShear), 300));
}

/// The solver divides a period into equal steps, so a step is less than its limit, by less than a step a period.
void expect_steps(const Matrix<2>& f, ShapeKind shape, double courant) {
  const double step = Block(f, method(shape, mpm::Precision::float64)).step_of_solver() * kWaveSpeed / kCell;
  EXPECT_LE(step, courant * (1.0 + 1e-6));
  EXPECT_GE(step, courant * 0.85);
}

TEST(DomainShear, ShortensTheStepsOfTheSolverForCpdi) {
  expect_steps(simple_shear(2.5), ShapeKind::cpdi, 0.5);
  expect_steps(simple_shear(4.0), ShapeKind::cpdi, mpm::courant_of_shear(0.5, 4.0));
  expect_steps(thread(), ShapeKind::cpdi, mpm::courant_of_shear(0.5, mpm::kDomainShear));
  expect_steps(thread(), ShapeKind::qcpdi, 0.5);
  expect_steps(thread(), ShapeKind::ugimp, 0.5);
}

}  // namespace domain_shear_test
