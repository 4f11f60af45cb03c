// Mohr-Coulomb: the return of principal stresses against the surface, the flow rule and the closest-point property, and
// single elements driven by strain.
#include "mpm/material/mohr_coulomb.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <vector>

#include "material_paths.hpp"
#include "mpm/material/path_driver.hpp"
#include "mpm/math/constants.hpp"
#include "mpm/math/exponential.hpp"

namespace mpm {
namespace mohr_coulomb_test {

using mpm::kDegree;
using Region = MohrCoulomb::Region;
using Stresses = std::array<double, 3>;

double cot(double angle) { return 1.0 / std::tan(angle); }

/// Principal strains of principal stresses, by isotropic elasticity.
Stresses compliance(const Stresses& s, const Elasticity& e) {
  const double trace = s[0] + s[1] + s[2];
  Stresses strain;
  for (int k = 0; k < 3; ++k) strain[k] = ((1.0 + e.poisson) * s[k] - e.poisson * trace) / e.young;
  return strain;
}

double dot(const Stresses& a, const Stresses& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// A soil, and random trial stresses about its surface.
struct RandomSoil {
  explicit RandomSoil(std::mt19937& random, bool associated) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    soil.elasticity = {1e6, -0.3 + 0.79 * unit(random)};
    soil.friction_angle = unit(random) < 0.1 ? 0.0 : 60.0 * kDegree * unit(random);
    soil.dilation_angle = associated ? soil.friction_angle : soil.friction_angle * unit(random);
    soil.cohesion = unit(random) < 0.2 ? 0.0 : 100.0 * unit(random);
    const double apex = soil.friction_angle > 0.0 ? soil.cohesion * cot(soil.friction_angle) : 200.0;
    if (unit(random) < 0.5) soil.tension_cutoff = std::min(apex, 200.0) * unit(random);
  }
  static Stresses trial(std::mt19937& random) {
    std::normal_distribution<double> normal(0.0, 300.0);
    Stresses s{normal(random) - 100.0, normal(random) - 100.0, normal(random) - 100.0};
    std::sort(s.rbegin(), s.rend());
    return s;
  }
  MohrCoulombDefinition soil;
};

// 1e5 random trial states: in order, on or inside the surface to round-off of the trial stress (300 to 1500 Pa), and
// the plastic strain is a non-negative combination of the flow vectors of the planes on which the stress lies.
TEST(MohrCoulomb, ReturnsEveryStateToTheSurfaceByTheFlowRule) {
  std::mt19937 random(1);
  std::map<Region, int> seen;
  constexpr double kRoundOff = 1e-11;  // 1e-14 of the stress, times the amplification by the soils' constants
  for (int trial = 0; trial < 100000; ++trial) {
    const MohrCoulombDefinition soil = RandomSoil(random, false).soil;
    const MohrCoulomb law(soil, 1600.0);
    const double q = std::sin(soil.dilation_angle), s = std::sin(soil.friction_angle);
    const Stresses before = RandomSoil::trial(random);
    Stresses after = before;
    const Region region = law.return_to_surface(after.data(), q);
    ++seen[region];
    ASSERT_GE(after[0], after[1]);
    ASSERT_GE(after[1], after[2]);
    const double scale = 1000.0 / (1.0 - s);
    // f = (s1 - s3) + (s1 + s3) sin(phi) - 2 c cos(phi), in independent form.
    const double f =
        after[0] - after[2] + (after[0] + after[2]) * s - 2.0 * soil.cohesion * std::cos(soil.friction_angle);
    ASSERT_LE(f, kRoundOff * scale);
    if (soil.tension_cutoff >= 0.0) {
      ASSERT_LE(after[0], soil.tension_cutoff + kRoundOff * scale);
    }
    if (region == Region::elastic) {
      ASSERT_EQ(before, after);
      continue;
    }
    Stresses lost;
    for (int k = 0; k < 3; ++k) lost[k] = before[k] - after[k];
    const Stresses strain = compliance(lost, soil.elasticity);
    const double small = 1e-10 * scale / soil.elasticity.young;
    const double volume = strain[0] + strain[1] + strain[2];
    // Multipliers follow from components that only one flow vector has; the other components must agree.
    switch (region) {
      case Region::plane:
        ASSERT_NEAR(f, 0.0, kRoundOff * scale);
        ASSERT_NEAR(strain[1], 0.0, small);
        ASSERT_NEAR(strain[0] * (1.0 - q), -strain[2] * (1.0 + q), small);
        ASSERT_GT(strain[0], 0.0);
        break;
      case Region::extension_edge:  // (1 + q, 0, -1 + q) and (1 + q, -1 + q, 0)
        ASSERT_EQ(after[1], after[2]);
        ASSERT_NEAR(f, 0.0, kRoundOff * scale);
        ASSERT_LE(strain[1], small);
        ASSERT_LE(strain[2], small);
        ASSERT_NEAR(strain[0] * (1.0 - q), -(strain[1] + strain[2]) * (1.0 + q), small);
        break;
      case Region::compression_edge:  // (1 + q, 0, -1 + q) and (0, 1 + q, -1 + q)
        ASSERT_EQ(after[0], after[1]);
        ASSERT_NEAR(f, 0.0, kRoundOff * scale);
        ASSERT_GE(strain[0], -small);
        ASSERT_GE(strain[1], -small);
        ASSERT_NEAR((strain[0] + strain[1]) * (1.0 - q), -strain[2] * (1.0 + q), small);
        break;
      case Region::apex:
        for (const double stress : after) ASSERT_NEAR(stress, soil.cohesion * cot(soil.friction_angle), 1e-9);
        ASSERT_GE(volume, -small);
        break;
      case Region::tension:
        ASSERT_EQ(after[0], soil.tension_cutoff);
        for (int k = 0; k < 3; ++k) {
          if (after[k] < soil.tension_cutoff) {
            ASSERT_NEAR(strain[k], 0.0, small);
          } else {
            ASSERT_GE(strain[k], -small);
          }
        }
        break;
      default:  // (1 + q, 0, -1 + q) and (1, 0, 0), with more planes at the two ends of the line
        ASSERT_EQ(after[0], soil.tension_cutoff);
        ASSERT_NEAR(f, 0.0, kRoundOff * scale);
        if (after[1] < after[0] && after[1] > after[2]) {
          ASSERT_NEAR(strain[1], 0.0, small);
          ASSERT_LE(strain[2], small);
          ASSERT_GE(strain[0] * (1.0 - q), -strain[2] * (1.0 + q) - small);
        }
    }
  }
  EXPECT_EQ(seen.size(), 7U);
  for (const auto& [region, count] : seen) EXPECT_GT(count, 300) << static_cast<int>(region);
}

// States that wide registers leave at their elastic stress without computing principal values are elastic: 1e5 random
// states about the surface.
TEST(MohrCoulomb, WhatMayNotFlowIsElastic) {
  std::mt19937 random(9);
  int elastic = 0;
  for (int trial = 0; trial < 100000; ++trial) {
    const MohrCoulomb law(RandomSoil(random, false).soil, 1600.0);
    Stresses s = RandomSoil::trial(random);
    for (double& stress : s) stress *= 0.3;
    const double mean = (s[0] + s[1] + s[2]) / 3.0;
    double j2 = 0.0;
    for (const double stress : s) j2 += 0.5 * (stress - mean) * (stress - mean);
    if (law.may_flow(mean, j2)) continue;
    ++elastic;
    ASSERT_EQ(law.return_to_surface(s.data(), law.sin_dilation()), Region::elastic);
  }
  EXPECT_GT(elastic, 10000);
}

// The cone is the largest possible: it touches the surface at the nearest of all third invariants (6000 Lode angles).
// The cone keeps a distance of 5e-7, and the sampled angles miss the nearest by 1e-8.
TEST(MohrCoulomb, WhatMayNotFlowIsAsMuchAsCanBe) {
  for (const double friction : {0.0, 20.0, 40.0, 60.0}) {
    for (const double cutoff : {-1.0, 10.0}) {
      const MohrCoulombDefinition soil{{1e6, 0.3}, friction * kDegree, 0.0, 100.0, cutoff};
      const MohrCoulomb law(soil, 1600.0);
      const double mean = -20.0, s = std::sin(soil.friction_angle), limit = cutoff < 0.0 ? 1e9 : cutoff;
      double nearest = 1e9;  // sqrt(J2)
      for (int k = 0; k <= 6000; ++k) {
        const double lode = k * 0.01 * kDegree;
        const double s1 = 2.0 / std::sqrt(3.0) * std::cos(lode);
        const double s3 = 2.0 / std::sqrt(3.0) * std::cos(lode + 120.0 * kDegree);
        nearest = std::min(nearest, (2.0 * soil.cohesion * std::cos(soil.friction_angle) - 2.0 * mean * s) /
                                        ((s1 - s3) + (s1 + s3) * s));
        nearest = std::min(nearest, (limit - mean) / s1);
      }
      EXPECT_FALSE(law.may_flow(mean, std::pow(nearest * (1.0 - 1e-6), 2.0))) << friction << ' ' << cutoff;
      EXPECT_TRUE(law.may_flow(mean, std::pow(nearest, 2.0))) << friction << ' ' << cutoff;
    }
  }
}

// With associated flow the return is the closest point of a convex set in the energy norm, which is the only point with
// (trial - returned) : C^-1 : (admissible - returned) <= 0 for every admissible stress.
TEST(MohrCoulomb, AssociatedReturnIsTheClosestPoint) {
  std::mt19937 random(2);
  for (int n = 0; n < 500; ++n) {
    const MohrCoulombDefinition soil = RandomSoil(random, true).soil;
    const MohrCoulomb law(soil, 1600.0);
    std::vector<Stresses> trials, returned;
    for (int k = 0; k < 60; ++k) {
      trials.push_back(RandomSoil::trial(random));
      returned.push_back(trials.back());
      law.return_to_surface(returned.back().data(), law.sin_dilation());
    }
    for (std::size_t k = 0; k < trials.size(); ++k) {
      Stresses lost;
      for (int i = 0; i < 3; ++i) lost[i] = trials[k][i] - returned[k][i];
      const Stresses strain = compliance(lost, soil.elasticity);
      for (Stresses other : returned) {
        std::sort(other.begin(), other.end());  // the set contains every order of the three
        do {
          Stresses way;
          for (int i = 0; i < 3; ++i) way[i] = other[i] - returned[k][i];
          // Energies of 1e6 Pa^2 / 1e6 Pa; 1e-10 of that is round-off amplified by 1 / (1 - sin 60).
          ASSERT_LE(dot(strain, way), 1e-10);
        } while (std::next_permutation(other.begin(), other.end()));
      }
    }
  }
}

// The state of a particle: stress, F and history.
template <class Matrix, class Symmetric>
struct Element {
  void advance(const MohrCoulomb& law, const Matrix& du) {
    const Matrix df = exponential(du, 8);
    const double j_old = determinant(f);
    f = product(df, f);
    law.update(Increment<double, Matrix>{du, df, f, j_old, determinant(f), 1.0}, tau, h);
  }
  Matrix f = Matrix::identity();
  Symmetric tau{};
  double h[3] = {};
};
using SolidElement = Element<Matrix3<double>, Symmetric3<double>>;
using PlaneElement = Element<MatrixPlane<double>, SymmetricPlane<double>>;

MohrCoulombDefinition clay(double cohesion, double cutoff = -1.0) {
  return {{10e6, 0.3}, 30.0 * kDegree, 10.0 * kDegree, cohesion, cutoff};
}

/// Increments that load, shear, rotate, pull apart and compress again.
std::vector<MatrixPlane<double>> wandering() {
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0.0, 1e-3);
  std::vector<MatrixPlane<double>> path(400);
  for (MatrixPlane<double>& du : path) du = {normal(random), normal(random), normal(random), normal(random), 0.0};
  return path;
}

// The return depends on principal values only, so a planar element behaves as a solid one under the same strain; 10 MPa
// moduli, 400 increments.
TEST(MohrCoulomb, PlaneIsASolidInPlaneStrain) {
  for (const double cutoff : {-1.0, 2e3}) {
    const MohrCoulomb law(clay(5e3, cutoff), 1600.0);
    PlaneElement plane;
    SolidElement solid;
    for (const MatrixPlane<double>& du : wandering()) {
      plane.advance(law, du);
      solid.advance(law, {du.xx, 0.0, du.xz, 0.0, du.yy, 0.0, du.zx, 0.0, du.zz});
      ASSERT_NEAR(plane.tau.xx, solid.tau.xx, 1e-11 * 10e6 / 1600.0);
      ASSERT_NEAR(plane.tau.zz, solid.tau.zz, 1e-11 * 10e6 / 1600.0);
      ASSERT_NEAR(plane.tau.xz, solid.tau.xz, 1e-11 * 10e6 / 1600.0);
      ASSERT_NEAR(plane.tau.yy, solid.tau.yy, 1e-11 * 10e6 / 1600.0);
      for (int k = 0; k < 3; ++k) ASSERT_NEAR(plane.h[k], solid.h[k], 1e-11);
    }
    EXPECT_GT(plane.h[MohrCoulomb::kPlasticStrain], 0.1);
    EXPECT_GT(plane.h[MohrCoulomb::kPlasticWork], 0.0);
  }
}

// The same strain in other axes gives the same stress in these axes: x, y, z to y, z, x, and a turn by 30 degrees.
TEST(MohrCoulomb, HasNoAxesOfItsOwn) {
  const MohrCoulomb law(clay(5e3), 1600.0);
  const double c = std::cos(0.5), s = std::sin(0.5);
  const Matrix3<double> turn = product(Matrix3<double>{c, -s, 0, s, c, 0, 0, 0, 1}, {0, 0, 1, 1, 0, 0, 0, 1, 0});
  const Matrix3<double> back{turn.xx, turn.yx, turn.zx, turn.xy, turn.yy, turn.zy, turn.xz, turn.yz, turn.zz};
  SolidElement here, there;
  for (const MatrixPlane<double>& du : wandering()) {
    const Matrix3<double> solid{du.xx, 0.0, du.xz, 0.0, du.yy, 0.0, du.zx, 0.0, du.zz};
    here.advance(law, solid);
    there.advance(law, product(turn, product(solid, back)));
  }
  const Matrix3<double> tau{here.tau.xx, here.tau.xy, here.tau.xz, here.tau.xy, here.tau.yy,
                            here.tau.yz, here.tau.xz, here.tau.yz, here.tau.zz};
  const Matrix3<double> expected = product(turn, product(tau, back));
  const double round_off = 1e-11 * 10e6 / 1600.0;
  EXPECT_NEAR(there.tau.xx, expected.xx, round_off);
  EXPECT_NEAR(there.tau.yy, expected.yy, round_off);
  EXPECT_NEAR(there.tau.zz, expected.zz, round_off);
  EXPECT_NEAR(there.tau.yz, expected.yz, round_off);
  EXPECT_NEAR(there.tau.xz, expected.xz, round_off);
  EXPECT_NEAR(there.tau.xy, expected.xy, round_off);
  EXPECT_NEAR(there.h[0], here.h[0], 1e-11);
}

// A rigid turn of 90 degrees about y in 100 increments: xx and zz change places, and nothing flows. Hughes and Winget's
// rotation is by 2 atan(w/2) a step: for 90 degrees after 100 steps, w = 2 tan(pi/400).
TEST(MohrCoulomb, TurnsWithTheMaterial) {
  const MohrCoulomb law(clay(5e3), 1600.0);
  PlaneElement element;
  for (int n = 0; n < 100; ++n) element.advance(law, {1e-4, 0.0, 0.0, -3e-4, 0.0});
  const PlaneElement before = element;
  EXPECT_GT(before.h[MohrCoulomb::kPlasticStrain], 1e-3);
  const double w = 2.0 * std::tan(mpm::kPi / 400.0);
  const double volume = determinant(element.f);
  for (int n = 0; n < 100; ++n) element.advance(law, {0.0, w, -w, 0.0, 0.0});
  const double round_off = 1e-11 * 10e6 / 1600.0;
  EXPECT_NEAR(determinant(element.f), volume, 1e-12);
  EXPECT_NEAR(element.tau.xx, before.tau.zz, round_off);
  EXPECT_NEAR(element.tau.zz, before.tau.xx, round_off);
  EXPECT_NEAR(element.tau.xz, 0.0, round_off);
  EXPECT_NEAR(element.h[MohrCoulomb::kPlasticStrain], before.h[MohrCoulomb::kPlasticStrain], 1e-13);
}

// Below the strength the law equals linear_elastic to the bit.
TEST(MohrCoulomb, IsElasticInside) {
  const MohrCoulomb soil(clay(1e9), 1600.0);
  const LinearElastic elastic({{10e6, 0.3}}, 1600.0);
  PlaneElement element;
  MatrixPlane<double> f = MatrixPlane<double>::identity();
  SymmetricPlane<double> tau{};
  for (const MatrixPlane<double>& du : wandering()) {
    element.advance(soil, du);
    const MatrixPlane<double> df = exponential(du, 8);
    const double j_old = determinant(f);
    f = product(df, f);
    elastic.update(Increment<double, MatrixPlane<double>>{du, df, f, j_old, determinant(f), 1.0}, tau,
                   static_cast<double*>(nullptr));
  }
  EXPECT_EQ(element.tau.xx, tau.xx);
  EXPECT_EQ(element.tau.zz, tau.zz);
  EXPECT_EQ(element.tau.xz, tau.xz);
  EXPECT_EQ(element.tau.yy, tau.yy);
  EXPECT_EQ(element.h[MohrCoulomb::kPlasticStrain], 0.0);
}

// Opened soil carries no stress until it is as dense as before (as in the test of Drucker-Prager).
TEST(MohrCoulomb, ClosesItsOpeningBeforeItCarriesPressure) {
  MaterialPoint point({"sand", 1600.0, clay(0.0)});
  const auto swell = [&point](double e, int times) {
    for (int n = 0; n < times; ++n) point.advance({e, 0, 0, 0, e, 0, 0, 0, e}, 1.0);
  };
  swell(1e-4, 100);
  EXPECT_EQ(trace(point.cauchy()), 0.0);
  EXPECT_NEAR(point.history(MohrCoulomb::kOpening), 0.03, 1e-14);
  swell(-1e-4, 99);
  EXPECT_EQ(trace(point.cauchy()), 0.0);
  swell(-1e-4, 2);
  EXPECT_NEAR(point.cauchy().zz, -3e-4 * clay(0.0).elasticity.bulk(), 1e-7);  // round-off of 0.03 of the modulus
}

// After any path, stress changes only with strain, and soil with room to close carries no pressure. 40 paths through
// the cut-off; round-off of the 1 MPa modulus.
TEST(MohrCoulomb, OpenedSoilIsAtRestWithoutStrain) {
  std::mt19937 random(8);
  for (const double cutoff : {0.0, 500.0}) {
    int opened = 0;
    for (int path = 0; path < 20; ++path) {
      MaterialPoint point({"soil", 1600.0, MohrCoulombDefinition{{1e6, 0.3}, 0.6, 0.2, 2000.0, cutoff}});
      point.advance({0.02, 0, 0, 0, 0.02, 0, 0, 0, 0.02}, 1.0);
      for (int n = 0; n < 50; ++n) {
        point.advance(paths::random_gradient(random, 0.01), 1.0);
        const Symmetric3<double> before = point.cauchy();
        point.advance({}, 1.0);
        ASSERT_LE(paths::distance(point.cauchy(), before), 1e-12 * 1e6);
        if (!(point.history(MohrCoulomb::kOpening) > 0.0)) continue;
        ++opened;
        ASSERT_GE(trace(point.cauchy()), -1e-12 * 1e6);
      }
    }
    EXPECT_GT(opened, 100);
  }
}

/// Vertical stress -100 kPa, no strain along y, compressed along x: the passive limit.
double passive_limit(const LawDefinition& law) {
  PathDriver driver({"soil", 1600.0, law});
  Leg confine{1.0, 10, {}, {}};
  for (const int k : {0, 1, 2}) {
    confine.control[k] = Control::stress;
    confine.target[k] = -100e3;
  }
  driver.run(confine);
  Leg press{1.0, 2000, {}, {}};
  press.control[2] = Control::stress;
  press.target = {driver.strain()[0] - 0.2, driver.strain()[1], -100e3, 0.0, 0.0, 0.0};
  driver.run(press);
  return -driver.point().cauchy().xx;
}

// Rankine: Kp s3 + 2 c sqrt(Kp) for any flow rule, also where dilation has ended (strains of 0.2 are far beyond); and
// Drucker-Prager matched for plane strain has the same limit, for the dilation of its match (exact-solutions 31).
// Stress is controlled to 1e-11; the cone approaches its limit gradually, and the strain is far beyond that.
TEST(MohrCoulomb, HasRankinesPassiveLimitInPlaneStrain) {
  const double rankine = 300e3 + 2.0 * 5e3 * std::sqrt(3.0);
  MohrCoulombDefinition soil = clay(5e3);
  EXPECT_NEAR(passive_limit(soil), rankine, 1e-10 * rankine);
  soil.dilation_angle = soil.friction_angle;
  EXPECT_NEAR(passive_limit(soil), rankine, 1e-10 * rankine);
  const DruckerPragerDefinition cone{soil.elasticity,
                                     soil.friction_angle,
                                     soil.dilation_angle,
                                     soil.cohesion,
                                     -1.0,
                                     ConeMatch::plane_strain,
                                     std::numeric_limits<double>::infinity()};
  EXPECT_NEAR(passive_limit(cone), rankine, 1e-9 * rankine);
}

}  // namespace mohr_coulomb_test
}  // namespace mpm
