// Mohr-Coulomb: the return of principal stresses against the surface, the flow rule and the closest-point property, and
// single elements driven by strain.
#include "mpm/material/mohr_coulomb.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <vector>

#include "mpm/material/material_point.hpp"
#include "mpm/math/exponential.hpp"

namespace mpm {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
using Region = MohrCoulomb::Region;
using Stresses = std::array<double, 3>;

double cot(double angle) { return 1.0 / std::tan(angle); }

/// Strain of a principal stress: isotropic elasticity.
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
// the plastic strain is a non-negative sum of the flow vectors of the planes that the stress lies on.
TEST(MohrCoulomb, ReturnsEveryStateToTheSurfaceByTheFlowRule) {
  std::mt19937 random(1);
  std::map<Region, int> seen;
  constexpr double kRoundOff = 1e-11;  // 1e-14 of the stress, times what the soils' numbers may magnify
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
    // f = (s1 - s3) + (s1 + s3) sin(phi) - 2 c cos(phi), written anew.
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
    // Multipliers by the components that one flow vector alone has; the rest must follow.
    switch (region) {
      case Region::plane:
        ASSERT_NEAR(f, 0.0, kRoundOff * scale);
        ASSERT_NEAR(strain[1], 0.0, small);
        ASSERT_NEAR(strain[0] * (1.0 - q), -strain[2] * (1.0 + q), small);
        ASSERT_GT(strain[0], 0.0);
        break;
      case Region::compression_edge:  // (1 + q, 0, -1 + q) and (1 + q, -1 + q, 0)
        ASSERT_EQ(after[1], after[2]);
        ASSERT_NEAR(f, 0.0, kRoundOff * scale);
        ASSERT_LE(strain[1], small);
        ASSERT_LE(strain[2], small);
        ASSERT_NEAR(strain[0] * (1.0 - q), -(strain[1] + strain[2]) * (1.0 + q), small);
        break;
      case Region::extension_edge:  // (1 + q, 0, -1 + q) and (0, 1 + q, -1 + q)
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

// With associated flow the return is the closest point of a convex set in the energy norm, which is the one point with
// (trial - returned) : C^-1 : (admissible - returned) <= 0 for everything admissible.
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
        std::sort(other.begin(), other.end());  // the set holds every order of the three
        do {
          Stresses way;
          for (int i = 0; i < 3; ++i) way[i] = other[i] - returned[k][i];
          // Energies of 1e6 Pa^2 / 1e6 Pa; 1e-10 of that is round-off magnified by 1 / (1 - sin 60).
          ASSERT_LE(dot(strain, way), 1e-10);
        } while (std::next_permutation(other.begin(), other.end()));
      }
    }
  }
}

}  // namespace
}  // namespace mpm
