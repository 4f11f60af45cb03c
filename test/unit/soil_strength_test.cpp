// Friction angle of each law of soil in each state, on single elements driven to where the stress no longer
// changes. Mohr-Coulomb asks for the same in all of them: s1 - s3 = (s1 + s3) sin(phi) + 2 c cos(phi), pressure
// positive.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <string>
#include <vector>

#include "mpm/material/drucker_prager.hpp"
#include "mpm/material/path_driver.hpp"
#include "mpm/math/constants.hpp"

namespace mpm {
namespace soil_strength_test {

constexpr double kDegree = kPi / 180.0;
constexpr int kXx = 0, kYy = 1, kZz = 2, kXz = 4;
constexpr double kConfining = 100e3;  // [Pa]
const Elasticity kElasticity{10e6, 0.3};

/// An element test at `kConfining`: triaxial compression and extension hold both sides at that pressure, plane
/// strain holds xx at it and yy in place, simple shear holds zz at it and xx and yy in place.
enum class State { compression, extension, plane_strain, simple_shear };

PathDriver driven(const LawDefinition& law, State state) {
  PathDriver driver({"soil", 1600.0, law});
  Leg confine;
  confine.duration = 1.0;
  confine.steps = 20;
  for (const int k : {kXx, kYy, kZz}) {
    confine.control[k] = Control::stress;
    confine.target[k] = -kConfining;
  }
  driver.run(confine);
  Leg leg;
  leg.duration = 1.0;
  leg.steps = 2000;
  leg.from_start = true;
  const auto hold = [&leg](int k) {
    leg.control[k] = Control::stress;
    leg.target[k] = -kConfining;
  };
  // The stress nears its end as exp(-strain G / sqrt(J2)): within 1e-9 after a strain of 0.6.
  switch (state) {
    case State::compression:
    case State::extension:
      hold(kXx);
      hold(kYy);
      leg.target[kZz] = state == State::compression ? -0.6 : 0.6;
      break;
    case State::plane_strain:
      hold(kXx);
      leg.target[kZz] = -0.6;
      break;
    case State::simple_shear:
      hold(kZz);
      leg.control[kXz] = Control::simple_shear;
      leg.target[kXz] = 1.5;
      break;
  }
  driver.run(leg);
  return driver;
}

/// sin of the friction angle that a material with this cohesion shows: of the largest and the smallest stress.
double friction(const PathDriver& driver) {
  const Symmetric3<double> s = driver.point().cauchy();
  Eigen::Matrix3d full;
  full << s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz;
  const Eigen::Vector3d principal = full.selfadjointView<Eigen::Lower>().eigenvalues();  // ascending
  return (principal[2] - principal[0]) / -(principal[2] + principal[0]);
}

DruckerPragerDefinition cone(double phi, double psi, ConeMatch match) {
  return {kElasticity, phi * kDegree, psi * kDegree, 0.0, -1.0, match, kInfinity};
}
MohrCoulombDefinition pyramid(double phi, double psi) {
  return {kElasticity, phi * kDegree, psi * kDegree, 0.0, -1.0, kInfinity};
}

// The closed form of principal values is exact to 1e-10, and the stress nears its end to 1e-9.
constexpr double kClosedForm = 1e-8;

// exact-solutions 24 and 31: both laws have the angle of the scene in every state, for any dilation.
TEST(SoilStrength, IsMohrCoulombsInEveryState) {
  for (const double phi : {20.0, 30.0, 40.0}) {
    for (const double psi : {0.0, 10.0}) {
      for (const LawDefinition& law :
           std::vector<LawDefinition>{cone(phi, psi, ConeMatch::mohr_coulomb), pyramid(phi, psi)}) {
        for (const State state : {State::compression, State::extension, State::plane_strain, State::simple_shear}) {
          EXPECT_NEAR(friction(driven(law, state)), std::sin(phi * kDegree), kClosedForm)
              << phi << ' ' << psi << ' ' << static_cast<int>(state) << ' ' << law.index();
        }
      }
    }
  }
}

// With cohesion: s1 = Kp s3 + 2 c sqrt(Kp) in every state.
TEST(SoilStrength, WithCohesionIsMohrCoulombs) {
  const double kp = 3.0, cohesion = 20e3;  // 30 degrees
  DruckerPragerDefinition law = cone(30.0, 10.0, ConeMatch::mohr_coulomb);
  law.cohesion = cohesion;
  for (const State state : {State::compression, State::plane_strain}) {
    const double axial = -driven(law, state).point().cauchy().zz;
    EXPECT_NEAR(axial, kp * kConfining + 2.0 * cohesion * std::sqrt(kp), kClosedForm * axial);
  }
  const double pulled = -driven(law, State::extension).point().cauchy().zz;
  EXPECT_NEAR(pulled, (kConfining - 2.0 * cohesion * std::sqrt(kp)) / kp, kClosedForm * kConfining);
}

// exact-solutions 31: the match in plane strain has the angle of the scene there for any dilation, and in triaxial
// compression a smaller one: q = M p with M = sqrt(3) eta and sin = 3 M / (6 + M), 22.2 degrees for 30 without
// dilation.
TEST(SoilStrength, OfTheMatchInPlaneStrain) {
  for (const double phi : {20.0, 30.0, 40.0}) {
    for (const double psi : {0.0, 10.0, phi}) {
      const DruckerPragerDefinition law = cone(phi, psi, ConeMatch::plane_strain);
      for (const State state : {State::plane_strain, State::simple_shear}) {
        EXPECT_NEAR(friction(driven(law, state)), std::sin(phi * kDegree), kClosedForm) << phi << ' ' << psi;
      }
      const double m = std::sqrt(3.0) * DruckerPrager(law, 1600.0).eta();
      EXPECT_NEAR(friction(driven(law, State::compression)), 3.0 * m / (6.0 + m), kClosedForm);
    }
  }
  // Slopes q / p of exact-solutions 31, to its digits; 0 and friction: sqrt(3) sin(phi) and the usual associated match.
  const struct {
    double phi, psi, slope;
  } table[] = {{30, 0, 0.86603},  {30, 10, 0.84589}, {30, 30, 0.83205}, {34, 0, 0.96855}, {34, 10, 0.94289},
               {34, 34, 0.92171}, {40, 0, 1.11334},  {40, 10, 1.07878}, {40, 40, 1.04378}};
  for (const auto& [phi, psi, slope] : table) {
    const DruckerPrager law(cone(phi, psi, ConeMatch::plane_strain), 1600.0);
    EXPECT_NEAR(std::sqrt(3.0) * law.eta(), slope, 5e-6) << phi << ' ' << psi;
  }
}

// exact-solutions 31: matched in triaxial compression, sand that does not dilate acts in plane strain as one of
// sin = 2 sqrt(3) sin(phi) / (3 - sin(phi)): 34.6, 43.9, 52.5, 55.0, 70.8 degrees for 25, 30, 34, 35, 40.
TEST(SoilStrength, OfTheMatchInCompressionIsTooLargeInPlaneStrain) {
  const struct { double phi, acts_as; } table[] = {{25, 34.6}, {30, 43.9}, {34, 52.5}, {35, 55.0}, {40, 70.8}};
  for (const auto& [phi, acts_as] : table) {
    const DruckerPragerDefinition law = cone(phi, 0.0, ConeMatch::compression);
    EXPECT_NEAR(std::asin(friction_in_plane_strain(law)) / kDegree, acts_as, 0.05) << phi;
    if (phi > 35.0) continue;  // too near to no limit to be reached by a strain of 0.6
    const double s = std::sin(phi * kDegree), exact = 2.0 * std::sqrt(3.0) * s / (3.0 - s);
    EXPECT_NEAR(friction(driven(law, State::plane_strain)), exact, 5e-4) << phi;  // 35 degrees: 1 MPa, still growing
    EXPECT_NEAR(friction(driven(law, State::compression)), std::sin(phi * kDegree), kClosedForm) << phi;
  }
  // No limit above asin(3 / (1 + 2 sqrt(3))) = 42.2 degrees.
  const double last = std::asin(3.0 / (1.0 + 2.0 * std::sqrt(3.0))) / kDegree;
  EXPECT_LT(friction_in_plane_strain(cone(last - 1e-6, 0.0, ConeMatch::compression)), 1.0);
  EXPECT_GT(friction_in_plane_strain(cone(last + 1e-6, 0.0, ConeMatch::compression)), 1.0);
}

/// Part by which the volume grows of the difference of the principal strains in the plane, once stress is constant:
/// sin(psi) in plane strain.
double dilation(const LawDefinition& law) {
  PathDriver driver = driven(law, State::plane_strain);
  const Components before = driver.strain();
  Leg more;
  more.duration = 1.0;
  more.steps = 10;
  more.from_start = true;
  more.control[kXx] = Control::stress;
  more.target[kXx] = -kConfining;
  more.target[kZz] = -0.01;
  driver.run(more);
  const double along = driver.strain()[kZz] - before[kZz], across = driver.strain()[kXx] - before[kXx];
  return (along + across) / (across - along);
}

TEST(SoilStrength, DilatesByItsAngleInPlaneStrain) {
  for (const double phi : {20.0, 35.0}) {
    for (const double psi : {0.0, 10.0, 20.0}) {
      for (const LawDefinition& law : std::vector<LawDefinition>{
               cone(phi, psi, ConeMatch::mohr_coulomb), cone(phi, psi, ConeMatch::plane_strain), pyramid(phi, psi)}) {
        EXPECT_NEAR(dilation(law), std::sin(psi * kDegree), kClosedForm) << phi << ' ' << psi << ' ' << law.index();
      }
    }
  }
}

// In triaxial compression, dv / d(axial) = 1 - Kpsi, Kpsi = (1 + sin psi) / (1 - sin psi), as Mohr-Coulomb's planes.
TEST(SoilStrength, DilatesByItsAngleInTriaxialCompression) {
  for (const double psi : {0.0, 10.0, 30.0}) {
    PathDriver driver = driven(cone(30.0, psi, ConeMatch::mohr_coulomb), State::compression);
    const Components before = driver.strain();
    Leg more;
    more.duration = 1.0;
    more.steps = 10;
    more.from_start = true;
    for (const int k : {kXx, kYy}) {
      more.control[k] = Control::stress;
      more.target[k] = -kConfining;
    }
    more.target[kZz] = -0.01;
    driver.run(more);
    double volume = 0.0;
    for (const int k : {kXx, kYy, kZz}) volume += driver.strain()[k] - before[k];
    const double sine = std::sin(psi * kDegree);
    EXPECT_NEAR(volume / -0.01, 1.0 - (1.0 + sine) / (1.0 - sine), kClosedForm) << psi;
  }
}

// Dilation ends where the volume has grown by the limit, which it nears as exp(-shear sin(psi) / (limit / 10)); the
// strength stays. Without a limit the volume grows to 1.29 here: the strain across, e, is such that e - 0.6 = sin(psi)
// (e + 0.6).
TEST(SoilStrength, DilationEndsAtItsLimit) {
  for (const double limit : {0.02, 0.1}) {
    DruckerPragerDefinition cone_law = cone(35.0, 10.0, ConeMatch::mohr_coulomb);
    MohrCoulombDefinition pyramid_law = pyramid(35.0, 10.0);
    cone_law.dilation_limit = pyramid_law.dilation_limit = limit;
    for (const LawDefinition& law : std::vector<LawDefinition>{cone_law, pyramid_law}) {
      const PathDriver driver = driven(law, State::plane_strain);
      // 1e-3: elastic strain, as yy still changes when the dilation has ended.
      EXPECT_NEAR(driver.point().j(), 1.0 + limit, 1e-3) << law.index();
      EXPECT_NEAR(friction(driver), std::sin(35.0 * kDegree), kClosedForm) << law.index();
    }
    // 5 %: pressure changes the volume too.
    EXPECT_NEAR(driven(cone(35.0, 10.0, ConeMatch::mohr_coulomb), State::plane_strain).point().j(), 1.286, 0.05);
  }
}

}  // namespace soil_strength_test
}  // namespace mpm
