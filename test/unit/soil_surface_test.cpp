// The law that sweeps of the implicit step solve in a cell (kernel/soil_cells.hpp), against Mohr and Coulomb's surface
// in principal stresses, (s1 - s3) + (s1 + s3) sin(phi) = 2 c cos(phi), tension positive. 0.1 s.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "mpm/kernel/select.hpp"
#include "mpm/math/constants.hpp"

namespace soil_surface_test {

using Group = mpm_kernel::SoilGroup<double>;
constexpr int kLanes = mpm_kernel::kGroupCells;

/// Those of this build and machine.
std::vector<mpm::Isa> sets() {
  std::vector<mpm::Isa> list;
  for (const mpm::Isa isa : {mpm::Isa::plain, mpm::Isa::avx2, mpm::Isa::avx512}) {
    if (mpm::isa_available(isa)) list.push_back(isa);
  }
  return list;
}

/// Principal stresses of r, compression positive, as tension positive values in ascending order.
Eigen::Vector3d principal(const Group& group, int lane) {
  const auto r = [&](int k) { return group.stress[k][lane]; };
  const double p = r(0) / std::sqrt(3.0), d = r(1) / std::sqrt(2.0), q = r(2) / std::sqrt(6.0),
               s = 1.0 / std::sqrt(2.0);
  Eigen::Matrix3d m;
  m << p + d - q, s * r(5), s * r(4), s * r(5), p - d - q, s * r(3), s * r(4), s * r(3), p + 2.0 * q;
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(-m, Eigen::EigenvaluesOnly).eigenvalues();
}

TEST(SoilSurface, IsMohrAndCoulombsInEveryDirection) {
  constexpr double kFriction = 30.0 * mpm::kPi / 180.0, kCohesion = 2000.0;
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (const mpm::Isa isa : sets()) {
    int returned = 0;
    for (int draw = 0; draw < 200; ++draw) {
      Group group{};
      for (int l = 0; l < kLanes; ++l) {
        group.stress[0][l] = 1e4 * std::abs(normal(random));
        for (int k = 1; k < 6; ++k) group.stress[k][l] = 1e4 * normal(random);
        group.sine[l] = std::sin(kFriction);
        group.cohesion[l] = kCohesion * std::cos(kFriction);
        group.least[l] = -1e30;
        group.lode[l] = 1.0;
      }
      const Group before = group;
      mpm::sweep_table<double>(isa, mpm::GeometryKind::solid).project(group);
      for (int l = 0; l < kLanes; ++l) {
        const auto yield = [&](const Group& of) {
          const Eigen::Vector3d s = principal(of, l);
          return (s[2] - s[0]) + (s[2] + s[0]) * std::sin(kFriction) - 2.0 * kCohesion * std::cos(kFriction);
        };
        const double size = std::abs(before.stress[0][l]) + kCohesion;
        if (yield(before) <= 0.0) {
          EXPECT_NEAR(group.stress[1][l], before.stress[1][l], 1e-9 * size);
          continue;
        }
        ++returned;
        EXPECT_NEAR(yield(group), 0.0, 1e-5 * size);  // the polynomial of the Lode angle
        EXPECT_DOUBLE_EQ(group.stress[0][l], before.stress[0][l]);
      }
    }
    EXPECT_GT(returned, 100);
  }
}

// Beyond the apex, r_N = -sqrt(3) c cot(phi), nothing is left of the deviator; with a limit of tension it is that.
TEST(SoilSurface, PartsAtTheApexOrTheLimit) {
  for (const mpm::Isa isa : sets()) {
    for (const double limit : {1e30, 500.0}) {
      Group group{};
      for (int l = 0; l < kLanes; ++l) {
        group.stress[0][l] = -1e5;
        group.stress[3][l] = 10.0;
        group.sine[l] = 0.5;
        group.cohesion[l] = 1000.0;
        group.least[l] = -limit;
        group.lode[l] = 1.0;
      }
      mpm::sweep_table<double>(isa, mpm::GeometryKind::solid).project(group);
      EXPECT_NEAR(group.stress[0][0], -std::min(limit, std::sqrt(3.0) * 2000.0), 1e-6);
      if (limit > 1e6) {
        EXPECT_NEAR(group.stress[3][0], 0.0, 1e-6);
      }
    }
  }
}

}  // namespace soil_surface_test
