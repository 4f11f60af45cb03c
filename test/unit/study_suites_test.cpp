// The suites of the work-precision study: their motions solve the equation of motion with the body force of their
// definitions and have the initial state of the particles, and their measures find no error in the exact motion.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>

#include "mpm/choice/method_costs.hpp"
#include "study/measures.hpp"
#include "study/problems.hpp"

namespace mpm::study {
namespace study_suites_test {

constexpr double kStep = 1e-4;  // step of differences [m] and [s]

/// First derivative of a field by differences of fourth order.
template <class Value, class Field>
Value slope(const Field& field, double step = kStep) {
  return (8.0 * (Value(field(step)) - Value(field(-step))) - (Value(field(2.0 * step)) - Value(field(-2.0 * step)))) /
         (12.0 * step);
}

Mat3 deformation(const Suite& suite, double time, const Vec3& X) {
  Mat3 f = Mat3::Identity();
  for (const int axis : axes_of(suite.geometry)) {
    f.col(axis) = slope<Vec3>([&](double d) { return suite.motion(time, X + d * Vec3::Unit(axis)); });
  }
  return f;
}

/// First Piola-Kirchhoff stress: neo-Hookean, Nairn & Guilkey (2015) eq. (64), P = J sigma F^-T; or small-strain
/// elasticity for a bar of linear material.
Mat3 piola(const MaterialDefinition& material, const Mat3& f) {
  if (const auto* linear = std::get_if<LinearElasticDefinition>(&material.law)) {
    return linear->elasticity.young * (f - Mat3::Identity());  // Poisson's ratio is 0: stress along the axis alone
  }
  const Elasticity e = std::get<NeoHookeanDefinition>(material.law).elasticity;
  const double j = f.determinant();
  const Mat3 b = f * f.transpose(), deviator = b - b.trace() / 3.0 * Mat3::Identity();
  const Mat3 cauchy =
      0.5 * e.bulk() * (j - 1.0 / j) * Mat3::Identity() + e.shear() * std::pow(j, -5.0 / 3.0) * deviator;
  return j * cauchy * f.inverse().transpose();
}

Vec3 body_force(const SimulationDefinition& definition, double time, const Vec3& place, const Vec3& start) {
  Vec3 force = Vec3::Zero();
  for (const BodyForceDefinition& load : definition.body_forces) {
    for (int axis = 0; axis < 3; ++axis) force[axis] += load.acceleration[axis](time, place, start);
  }
  return force;
}

class Motions : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Suites, Motions,
                         ::testing::Values("bar_small", "bar_crossing", "square_small", "square_large", "cube_small",
                                           "cube_large", "vortex", "rotation"),
                         [](const auto& info) { return std::string(info.param); });

// rho0 u'' = Div P + rho0 b. The tolerance of 1e-4 of the largest term covers the truncation of the differences at the
// scale of the vortex, kStep over 0.05 m to the fourth power; that of 3e-5 Pa/m covers the round-off of a position of
// 1 m in differences of differences, 1e-16 m / kStep^2 times 1000 Pa and the sum of the weights.
TEST_P(Motions, SolveTheEquationOfMotion) {
  const Suite& suite = find_suite(GetParam());
  const SimulationDefinition definition = suite.definition({}, {16});
  const MaterialDefinition& material = definition.materials.front();
  const std::vector<Vec3>& places = definition.bodies.front().positions;
  int checked = 0;
  for (std::size_t p = 0; p < places.size(); p += 1 + places.size() / 23) {
    const Vec3& X = places[p];
    if (suite.name == "vortex" && std::abs(std::abs(X.norm() - 1.0) - 0.25) < 4.0 * kStep)
      continue;  // b has a kink there
    for (const double time : {0.13, 0.41, 0.77}) {
      const auto velocity = [&](double t) {
        return slope<Vec3>([&](double d) { return suite.motion(t + d, X); }, 1e-3);
      };
      const Vec3 inertia = material.density * slope<Vec3>([&](double d) { return velocity(time + d); }, 1e-3);
      Vec3 divergence = Vec3::Zero();
      double largest = inertia.norm();
      for (const int axis : axes_of(suite.geometry)) {
        const Vec3 term = slope<Vec3>([&](double d) {
          return Vec3(piola(material, deformation(suite, time, X + d * Vec3::Unit(axis))).col(axis));
        });
        divergence += term;
        largest = std::max(largest, term.norm());
      }
      const Vec3 load = material.density * body_force(definition, time, suite.motion(time, X), X);
      largest = std::max(largest, load.norm());
      EXPECT_LT((inertia - divergence - load).norm(), 1e-4 * largest + 3e-5)
          << suite.name << " at " << X.transpose() << " and " << time << " s: " << inertia.transpose() << " against "
          << divergence.transpose() << " + " << load.transpose();
      ++checked;
    }
  }
  EXPECT_GT(checked, 20);
}

// Particles start with the position and velocity of the motion: differences of fourth order leave 1e-9 of 1 m/s.
TEST_P(Motions, BeginAsTheParticlesDo) {
  const Suite& suite = find_suite(GetParam());
  const SimulationDefinition definition = suite.definition({}, {8});
  const DeformableBody& body = definition.bodies.front();
  for (std::size_t p = 0; p < body.positions.size(); ++p) {
    const Vec3& X = body.positions[p];
    EXPECT_LT((suite.motion(0.0, X) - X).norm(), 1e-15);
    const Vec3 exact = slope<Vec3>([&](double d) { return suite.motion(d, X); });
    const Vec3 given = body.velocities.empty() ? Vec3(Vec3::Zero()) : body.velocities[p];
    EXPECT_LT((exact - given).norm(), 1e-9) << X.transpose();
  }
}

// Walls of the grid fix the normal component only, and so does the motion on them.
TEST(Suites, MotionKeepsToTheWalls) {
  for (const char* name : {"bar_crossing", "square_large", "cube_large"}) {
    const Suite& suite = find_suite(name);
    const SimulationDefinition definition = suite.definition({}, {8});
    for (int face = 0; face < 6; ++face) {
      const int axis = face / 2;
      EXPECT_EQ(definition.walls[face].kind, WallKind::slip);
      Vec3 X(0.3, 0.4, 0.2);
      X[axis] = (face % 2 == 0 ? definition.grid.min : definition.grid.max)[axis];
      if (suite.geometry == GeometryKind::line && axis > 0) continue;
      if (axis == 1 && planar(suite.geometry)) continue;
      // sin(pi) is 1.2e-16 in double precision.
      EXPECT_NEAR(suite.motion(0.37, X)[axis], X[axis], 1e-16) << name << " face " << face;
    }
  }
}

// A square at rest has no error if the exact motion is rest; otherwise its error is the exact displacement.
TEST(Suites, DisplacementErrorOfTheExactMotionIsZero) {
  SimulationDefinition definition = find_suite("square_small").definition({}, {8});
  definition.body_forces.clear();
  definition.bodies.front().velocities.clear();
  const auto still = displacement_error(
      GeometryKind::plane_strain, [](double, const Vec3& X) { return X; }, 1.0);
  const auto moved = displacement_error(
      GeometryKind::plane_strain, [](double t, const Vec3& X) { return Vec3(X + t * Vec3(0.3, 0.0, 0.4)); }, 2.0);
  Simulation simulation(definition, SimulationOptions{1});
  for (int i = 0; i < 3; ++i) {
    still->look(simulation);
    moved->look(simulation);
    simulation.advance();
  }
  EXPECT_EQ(still->error(), 0.0);
  // 0.5 m/s, over 2 m, at the last sample after two periods of 0.1 s; round-off of positions of 1 m.
  EXPECT_NEAR(moved->error(), 0.5 * 0.2 / 2.0, 1e-15);
}

TEST(Suites, EnergyDriftOfABodyAtRestInItsFlightIsRoundOff) {
  SimulationDefinition definition = find_suite("colliding_disks").definition({}, {8});
  const auto drift = energy_drift();
  Simulation simulation(definition, SimulationOptions{1});
  for (int i = 0; i < 5; ++i) {  // particles far from each other
    drift->look(simulation);
    simulation.advance();
  }
  EXPECT_LT(drift->error(), 1e-12);  // a uniform velocity is constant: round-off of 15 steps
}

// A choice of method reads figures of these problems by name, and knows them no other way.
TEST(Suites, AreThoseThatAChoiceOfMethodKnows) {
  std::vector<std::string> names;
  for (const Suite& suite : suites()) names.push_back(suite.name);
  EXPECT_EQ(names, choice::suite_names());
}

TEST(Suites, HaveNamesOfTheirOwnAndRefuseOthers) {
  for (const Suite& suite : suites()) EXPECT_EQ(find_suite(suite.name).title, suite.title);
  try {
    find_suite("square");
    FAIL();
  } catch (const StudyError& error) {
    EXPECT_NE(std::string(error.what()).find("no suite is called 'square'; there are bar_small, "), std::string::npos);
    EXPECT_NE(std::string(error.what()).find(", and tool_force, which is run alone"), std::string::npos);
  }
}

}  // namespace study_suites_test
}  // namespace mpm::study
