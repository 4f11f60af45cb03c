// Particles of bodies: number, position, volume and velocity, counted by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "mpm/advice/explain.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm {
namespace scene_build_test {

std::string solid(const std::string& shape, const std::string& rest = "") {
  return "grid: {cell: 0.1, min: [-1, -1, -1], max: [1, 1, 1]}\n"
         "materials: [{name: soft, density: 1000, law: neo_hookean, young: 1000, poisson: 0.25}]\n"
         "bodies: [{name: body, material: soft, shape: " +
         shape + rest + "}]\n";
}

SimulationDefinition built(const std::string& text) { return build(parse_scene(text, "test.yaml")); }

TEST(SceneBuild, FillsABoxOnTheGridsLattice) {
  const auto d = built(solid("{box: {min: [0, 0, 0], max: [0.2, 0.3, 0.4]}}"));
  const DeformableBody& body = d.bodies.at(0);
  EXPECT_EQ(body.positions.size(), 4U * 6U * 8U);
  EXPECT_NEAR(body.particle_volume, 0.05 * 0.05 * 0.05, 1e-18);
  EXPECT_TRUE(body.velocities.empty());
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : body.positions) {
    sum += p;
    // Centres at odd multiples of 0.025 from the grid's corner.
    for (int axis = 0; axis < 3; ++axis) {
      const double half_spacings = (p[axis] + 1.0) / 0.025;
      EXPECT_NEAR(std::fmod(half_spacings, 2.0), 1.0, 1e-9);
    }
  }
  // Round-off of a sum of 192 numbers below 1.
  EXPECT_NEAR((sum / 192.0 - Vec3(0.1, 0.15, 0.2)).norm(), 0.0, 1e-13);
}

TEST(SceneBuild, ABoxBesideTheGridsLatticeHasItsOwn) {
  // It begins a fifth of a spacing after a plane of the lattice along x; the other axes keep the grid's.
  const auto d = built(solid("{box: {min: [0.01, 0, 0], max: [0.21, 0.2, 0.2]}}"));
  EXPECT_EQ(d.bodies[0].positions.size(), 4U * 4U * 4U);
  EXPECT_NEAR((d.bodies[0].positions.front() - Vec3(0.035, 0.025, 0.025)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((d.bodies[0].positions.back() - Vec3(0.185, 0.175, 0.175)).norm(), 0.0, 1e-12);
}

TEST(SceneBuild, JitterMovesParticlesEvenlyWithinTheBody) {
  const std::string box = "{box: {min: [-0.8, -0.8, -0.8], max: [0.8, 0.8, 0.8]}}";
  const DeformableBody regular = built(solid(box)).bodies[0], moved = built(solid(box, ", jitter: 0.6")).bodies[0];
  ASSERT_EQ(moved.positions.size(), regular.positions.size());
  EXPECT_EQ(moved.particle_volume, regular.particle_volume);
  double square = 0.0, farthest = 0.0;
  int inner = 0;
  for (std::size_t i = 0; i < moved.positions.size(); ++i) {
    const Vec3 by = moved.positions[i] - regular.positions[i];
    for (int axis = 0; axis < 3; ++axis) EXPECT_LT(std::abs(moved.positions[i][axis]), 0.8 + 1e-15);
    farthest = std::max(farthest, by.cwiseAbs().maxCoeff());
    if (regular.positions[i].cwiseAbs().maxCoeff() > 0.74) continue;  // drawn again at the faces
    square += by.squaredNorm() / 3.0;
    ++inner;
  }
  EXPECT_LE(farthest, 0.06 + 1e-15);
  EXPECT_GT(farthest, 0.059);
  // For an even distribution in [-a, a] the mean square is a^2 / 3, with a standard deviation of a^2 sqrt(4 / 45) per
  // number; four of them.
  const double a2 = 0.06 * 0.06;
  EXPECT_NEAR(square / inner, a2 / 3.0, 4.0 * a2 * std::sqrt(4.0 / 45.0 / (3.0 * inner)));
  EXPECT_EQ(built(solid(box, ", jitter: 0.6")).bodies[0].positions, moved.positions);
}

TEST(SceneBuild, ASeedGivesOtherPlacesAndTheSameAgain) {
  const auto places = [](const std::string& rest) {
    return built(solid("{box: {min: [0, 0, 0], max: [0.2, 0.2, 0.2]}}", ", jitter: 0.3" + rest)).bodies[0].positions;
  };
  EXPECT_EQ(places(", seed: 2"), places(", seed: 2"));
  EXPECT_NE(places(", seed: 2"), places(", seed: 3"));
  EXPECT_NE(places(", seed: 2"), places(""));
  const auto refused = [](const std::string& rest) {
    try {
      built(solid("{box: {min: [0, 0, 0], max: [0.2, 0.2, 0.2]}}", rest));
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_NE(refused(", seed: 2").find("bodies.body.seed: is that of jitter"), std::string::npos);
  EXPECT_NE(
      refused(", jitter: 0.3, seed: 0").find("bodies.body.seed: 0 is less than 1; write a whole number of 1 or more"),
      std::string::npos);
}

TEST(SceneBuild, AJitteredPlanarBodyStaysInItsPlane) {
  const auto d = built(
      "geometry: plane_strain\n"
      "grid: {cell: 0.1, min: [0, 0], max: [1, 1]}\n"
      "materials: [{name: soft, density: 1000, law: neo_hookean, young: 1000, poisson: 0.25}]\n"
      "bodies: [{name: body, material: soft, shape: {box: {min: [0, 0], max: [1, 1]}}, jitter: 1}]\n");
  for (const Vec3& p : d.bodies[0].positions) EXPECT_EQ(p.y(), 0.0);
}

TEST(SceneBuild, SpheresAndCylindersHaveTheirVolume) {
  const auto volume = [](const SimulationDefinition& d) {
    const std::vector<double>& parts = d.bodies[0].parts;  // the surface cuts some of the places
    EXPECT_EQ(parts.size(), d.bodies[0].positions.size());
    return std::accumulate(parts.begin(), parts.end(), 0.0) * d.bodies[0].particle_volume;
  };
  const double sphere = 4.0 / 3.0 * M_PI * 0.064;
  EXPECT_NEAR(volume(built(solid("{sphere: {center: [0, 0, 0], radius: 0.4}}"))), sphere, 1e-12 * sphere);
  const double cylinder = M_PI * 0.16 * 0.5;
  for (const int axis : {0, 1, 2}) {
    const std::string name(1, "xyz"[axis]);
    const auto d = built(solid("{cylinder: {center: [0, 0, 0], radius: 0.4, height: 0.5, axis: " + name + "}}"));
    EXPECT_NEAR(volume(d), cylinder, 1e-12 * cylinder) << name;
    double reach = 0.0;
    for (const Vec3& p : d.bodies[0].positions) reach = std::max(reach, std::abs(p[axis]));
    EXPECT_NEAR(reach, 0.225, 1e-12) << name;
  }
}

TEST(SceneBuild, VelocitiesAreFunctionsOfPlace) {
  const auto d =
      built(solid("{box: {min: [0, 0, 0], max: [0.2, 0.2, 0.2]}}", ", initial: {velocity: [\"2*y\", 3, 0]}"));
  const DeformableBody& body = d.bodies[0];
  ASSERT_EQ(body.velocities.size(), body.positions.size());
  for (std::size_t i = 0; i < body.positions.size(); ++i) {
    EXPECT_EQ(body.velocities[i], Vec3(2.0 * body.positions[i].y(), 3.0, 0.0));
  }
}

TEST(SceneBuild, AVelocityThatIsNotFiniteIsRefused) {
  try {
    built(solid("{box: {min: [0, 0, 0], max: [0.2, 0.2, 0.2]}}", ", initial: {velocity: [\"1/(x-x)\", 0, 0]}"));
    FAIL() << "not refused";
  } catch (const SceneError& error) {
    EXPECT_EQ(std::string(error.what()).find("test.yaml:3: bodies.body.initial: initial velocity of body 'body': "), 0U)
        << error.what();
  }
}

TEST(SceneBuild, PlanarBodiesHaveTheScenesThickness) {
  const auto d = built(
      "geometry: plane_strain\n"
      "thickness: 0.5\n"
      "method: {particles_per_cell: 9}\n"
      "grid: {cell: [0.1, 0.2], min: [0, 0], max: [1, 1]}\n"
      "materials: [{name: soft, density: 1000, law: neo_hookean, young: 1000, poisson: 0.25}]\n"
      "bodies: [{name: body, material: soft, shape: {box: {min: [0.2, 0.2], max: [0.5, 0.6]}}}]\n");
  EXPECT_EQ(d.bodies[0].positions.size(), 9U * 6U);
  EXPECT_NEAR(d.bodies[0].particle_volume, 0.1 / 3.0 * 0.2 / 3.0 * 0.5, 1e-17);
  for (const Vec3& p : d.bodies[0].positions) EXPECT_EQ(p.y(), 0.0);
}

TEST(SceneBuild, AGridOfTooManyParticlesIsRefused) {
  EXPECT_THROW(built("grid: {cell: 1e-5, min: [0, 0, 0], max: [1, 1, 1]}\n"
                     "materials: [{name: soft, density: 1000, law: neo_hookean, young: 1000, poisson: 0.25}]\n"
                     "bodies: [{name: body, material: soft, shape: {box: {min: [0, 0, 0], max: [1, 1, 1]}}}]\n"),
               SceneError);
}

TEST(SceneBuild, ExplainsWhatFollows) {
  const Scene scene = parse_scene(
      "time: {end: 1, sync: 0.01}\nmethod: {shape: ugimp}\n" + solid("{box: {min: [0, 0, 0], max: [0.2, 0.2, 0.2]}}"),
      "test.yaml");
  const std::string text = explain(scene, build(scene));
  // c = sqrt(E (1 - nu) / ((1 + nu)(1 - 2 nu) rho)) = sqrt(1.2) m/s; dt = 0.5 x 0.1 / c = 0.04564 s; sync is shorter.
  EXPECT_NE(text.find("64 particles of soft (neo_hookean), 8 kg"), std::string::npos) << text;
  EXPECT_NE(text.find("total: 64 particles in 8 cells"), std::string::npos) << text;
  EXPECT_NE(text.find("time step: at most 0.01 s, set by the sync period"), std::string::npos) << text;
  EXPECT_NE(text.find("run: to 1 s in about 100 steps"), std::string::npos) << text;
  EXPECT_NE(text.find("method: solid, ugimp, usavg, flip"), std::string::npos) << text;
  EXPECT_NE(text.find(", double precision,"), std::string::npos) << text;
}

TEST(SceneBuild, ASimulationCanBeMadeOfTheSceneItself) {
  const Scene scene = parse_scene(
      "gravity: [0, 0, -10]\nmethod: {shape: ugimp}\n" + solid("{box: {min: [0, 0, 0], max: [0.2, 0.2, 0.2]}}"),
      "test.yaml");
  Simulation of_scene(scene, {1}), of_definition(build(scene), {1});
  of_scene.advance();
  of_definition.advance();
  EXPECT_EQ(of_scene.state_hash(), of_definition.state_hash());
  EXPECT_EQ(of_scene.particles(), 64U);
}

}  // namespace scene_build_test
}  // namespace mpm
