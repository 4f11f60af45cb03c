// The particles of round bodies: volume, centre and second moments of the shape, a surface that contact sees where the
// shape has it, and forces of an even pressure. A filling by whole places has second moments within a few hundredths,
// a surface within a place's half diagonal, and forces that miss by a fifth of the pressure's.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "mpm/math/constants.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm {
namespace cut_cells_test {

/// With cells of 0.1 m, hence places of 0.05 m.
DeformableBody filled(const std::string& geometry, const std::string& shape, const std::string& of_body = "") {
  const std::string grid = geometry == "solid"          ? "min: [-1.2, -1.2, -1.2], max: [1.2, 1.2, 1.2]"
                           : geometry == "axisymmetric" ? "min: [0, -1.2], max: [1.2, 1.2]"
                                                        : "min: [-1.2, -1.2], max: [1.2, 1.2]";
  return build(parse_scene("geometry: " + geometry + "\ngrid: {cell: 0.1, " + grid +
                               "}\nmaterials: [{name: m, law: linear_elastic, density: 1, young: 1e5, poisson: 0.25}]\n"
                               "bodies: [{name: b, material: m, shape: {" +
                               shape + "}" + of_body + "}]\n",
                           "cut.yaml"))
      .bodies.at(0);
}

constexpr double kPlace = 0.05;  ///< width of a place [m]

struct Moments {
  double volume = 0.0;
  Vec3 centre = Vec3::Zero(), second = Vec3::Zero();  ///< second: of the volume about the centre, along each axis
};

/// Each particle has the second moment of a whole place of its own.
Moments moments(const DeformableBody& body, bool about_axis = false) {
  Moments sum;
  const auto volume = [&](std::size_t p) {
    return body.particle_volume * body.parts[p] * (about_axis ? 2.0 * kPi * body.positions[p].x() : 1.0);
  };
  for (std::size_t p = 0; p < body.positions.size(); ++p) {
    sum.volume += volume(p);
    sum.centre += volume(p) * body.positions[p];
  }
  sum.centre /= sum.volume;
  for (std::size_t p = 0; p < body.positions.size(); ++p) {
    const Vec3 arm = body.positions[p] - sum.centre;
    sum.second += volume(p) * (arm.cwiseAbs2() + Vec3::Constant(kPlace * kPlace / 12.0));
  }
  return sum;
}

// Centres anywhere between the nodes.
const std::array<Vec3, 4> kCentres{Vec3(0, 0, 0), Vec3(0.05, 0.05, 0.05), Vec3(0.013, 0.021, -0.007),
                                   Vec3(-0.031, 0.049, 0.024)};

TEST(CutCells, ADiskHasItsMoments) {
  const double r = 0.8;
  for (const Vec3& c : kCentres) {
    const Moments m =
        moments(filled("plane_strain", fmt::format("sphere: {{center: [{}, {}], radius: {}}}", c.x(), c.z(), r)));
    EXPECT_NEAR(m.volume, kPi * r * r, 1e-9);
    EXPECT_NEAR(m.centre.x(), c.x(), 1e-4 * r);
    EXPECT_NEAR(m.centre.z(), c.z(), 1e-4 * r);
    EXPECT_NEAR(m.second.x(), 0.25 * kPi * std::pow(r, 4), 1e-3 * 0.25 * kPi * std::pow(r, 4));
    EXPECT_NEAR(m.second.z(), 0.25 * kPi * std::pow(r, 4), 1e-3 * 0.25 * kPi * std::pow(r, 4));
  }
}

TEST(CutCells, ASphereAndACylinderHaveTheirMoments) {
  const double r = 0.55, sphere = 4.0 / 3.0 * kPi * r * r * r, h = 0.6, cylinder = kPi * r * r * h;
  for (const Vec3& c : kCentres) {
    const std::string centre = fmt::format("center: [{}, {}, {}], radius: {}", c.x(), c.y(), c.z(), r);
    const Moments ball = moments(filled("solid", "sphere: {" + centre + "}"));
    EXPECT_NEAR(ball.volume, sphere, 1e-9);
    EXPECT_LT((ball.centre - c).norm(), 2e-4 * r);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(ball.second[k], 0.2 * sphere * r * r, 2e-3 * 0.2 * sphere * r * r);
    const Moments rod = moments(filled("solid", "cylinder: {" + centre + fmt::format(", height: {}, axis: y}}", h)));
    EXPECT_NEAR(rod.volume, cylinder, 1e-9);
    EXPECT_LT((rod.centre - c).norm(), 2e-4 * r);
    EXPECT_NEAR(rod.second.x(), 0.25 * cylinder * r * r, 2e-3 * 0.25 * cylinder * r * r);
    EXPECT_NEAR(rod.second.z(), 0.25 * cylinder * r * r, 2e-3 * 0.25 * cylinder * r * r);
    EXPECT_NEAR(rod.second.y(), cylinder * h * h / 12.0, 2e-3 * cylinder * h * h / 12.0);
  }
}

TEST(CutCells, ASphereAboutItsAxisHasItsMoments) {
  const double r = 0.8, sphere = 4.0 / 3.0 * kPi * r * r * r;
  for (const double z : {0.0, 0.05, 0.013}) {
    const Moments m =
        moments(filled("axisymmetric", fmt::format("sphere: {{center: [0, {}], radius: {}}}", z, r)), true);
    EXPECT_NEAR(m.volume, sphere, 2e-4 * sphere);  // about the axis itself a ring's volume is not 2 pi r
    EXPECT_NEAR(m.centre.z(), z, 1e-4 * r);
    EXPECT_NEAR(m.second.z(), 0.2 * sphere * r * r, 2e-3 * 0.2 * sphere * r * r);
  }
}

// A point of contact lies at its particle's centre plus the reach of a whole place, by the factor that is kept.
TEST(CutCells, TheSurfaceOfADiskIsWhereTheShapeHasIt) {
  const double r = 0.8;
  for (const Vec3& c : kCentres) {
    const DeformableBody body =
        filled("plane_strain", fmt::format("sphere: {{center: [{}, {}], radius: {}}}", c.x(), c.z(), r));
    std::map<int, double> farthest;  // distance of what lies within a degree
    for (std::size_t p = 0; p < body.positions.size(); ++p) {
      const Vec3 arm = body.positions[p] - Vec3(c.x(), 0.0, c.z());
      const double outer = arm.norm() + 0.5 * kPlace * body.surfaces[p];
      EXPECT_LT(outer, r + 1e-9);
      double& found = farthest[static_cast<int>(std::floor(std::atan2(arm.z(), arm.x()) * 180.0 / kPi / 6.0))];
      found = std::max(found, outer);
    }
    EXPECT_EQ(farthest.size(), 60U);
    for (const auto& [sixth, outer] : farthest) EXPECT_NEAR(outer, r, 1e-9) << sixth;
  }
}

/// Share of a hat function in a particle's box along an axis, and its slope, in cells; `u` from the node.
std::pair<double, double> averaged_hat(double u, double half) {
  const auto integral = [](double t) {
    const double at = std::clamp(t, -1.0, 1.0);
    return at < 0.0 ? at + 0.5 * at * at + 0.5 : 0.5 + at - 0.5 * at * at;
  };
  const auto hat = [](double t) { return std::max(0.0, 1.0 - std::abs(t)); };
  return {(integral(u + half) - integral(u - half)) / (2.0 * half), (hat(u + half) - hat(u - half)) / (2.0 * half)};
}

using Nodes = std::map<std::pair<int, int>, std::array<double, 2>>;

/// Forces of a pressure of 1 Pa in a disk's particles, by the gradients of uGIMP, and those of the same pressure on its
/// edge, by hat functions, as contact at points spreads them: the sum of what is not in balance over the whole [1].
double unbalanced(const DeformableBody& body, const Vec3& c, double r) {
  const double cell = 0.1, half = 0.25;
  Nodes left;
  for (std::size_t p = 0; p < body.positions.size(); ++p) {
    const double x = body.positions[p].x() / cell, z = body.positions[p].z() / cell;
    const double volume = body.particle_volume * (body.parts.empty() ? 1.0 : body.parts[p]);
    for (int i = static_cast<int>(std::floor(x)) - 1; i <= std::floor(x) + 2; ++i) {
      for (int k = static_cast<int>(std::floor(z)) - 1; k <= std::floor(z) + 2; ++k) {
        const auto [of_x, slope_x] = averaged_hat(x - i, half);
        const auto [of_z, slope_z] = averaged_hat(z - k, half);
        left[{i, k}][0] += volume * slope_x * of_z / cell;
        left[{i, k}][1] += volume * of_x * slope_z / cell;
      }
    }
  }
  const int pieces = 20000;
  const double length = 2.0 * kPi * r / pieces;
  for (int n = 0; n < pieces; ++n) {
    const double angle = 2.0 * kPi * (n + 0.5) / pieces;
    const double x = (c.x() + r * std::cos(angle)) / cell, z = (c.z() + r * std::sin(angle)) / cell;
    for (int i = static_cast<int>(std::floor(x)); i <= std::floor(x) + 1; ++i) {
      for (int k = static_cast<int>(std::floor(z)); k <= std::floor(z) + 1; ++k) {
        const double weight = (1.0 - std::abs(x - i)) * (1.0 - std::abs(z - k)) * length;
        left[{i, k}][0] -= weight * std::cos(angle);
        left[{i, k}][1] -= weight * std::sin(angle);
      }
    }
  }
  double sum = 0.0;
  for (const auto& [node, force] : left) sum += std::hypot(force[0], force[1]);
  return sum / (2.0 * kPi * r);
}

// Jitter of next to nothing leaves places whole: the staircase that a filling without cut places is.
TEST(CutCells, AnEvenPressureInADiskIsNearerToBalance) {
  const double r = 0.8;
  for (const Vec3& c : kCentres) {
    const std::string disk = fmt::format("sphere: {{center: [{}, {}], radius: {}}}", c.x(), c.z(), r);
    const double cut = unbalanced(filled("plane_strain", disk), c, r);
    const double stairs = unbalanced(filled("plane_strain", disk, ", jitter: 1e-9"), c, r);
    EXPECT_LT(cut, 0.1);
    EXPECT_LT(cut, 0.7 * stairs) << stairs;
  }
}

TEST(CutCells, LeavesWhatMeetsTheLatticeAsItIs) {
  for (const char* shape : {"box: {min: [-0.8, -0.4], max: [0.8, 0.43]}", "height_field: {heights: 0.25}"}) {
    const DeformableBody body = filled("plane_strain", shape);
    EXPECT_TRUE(body.parts.empty()) << shape;
    EXPECT_TRUE(body.surfaces.empty()) << shape;
  }
  EXPECT_TRUE(filled("axisymmetric", "cylinder: {center: [0, 0], radius: 0.43, height: 0.5}").parts.empty());
}

// At a flat end the whole boxes of a cylinder's particles meet a tool, and a pressure on it presses with its area: the
// side that cuts them there is not what acts.
TEST(CutCells, CylindersHaveFlatEnds) {
  const DeformableBody body = filled("solid", "cylinder: {center: [0.013, 0.021, 0], radius: 0.4, height: 0.6}");
  double share = 0.0;
  for (std::size_t p = 0; p < body.positions.size(); ++p) {
    if (std::abs(body.positions[p].z()) < 0.25) continue;
    EXPECT_EQ(body.surfaces[p], 1.0);
    if (body.positions[p].z() > 0.0) share += body.parts[p];
  }
  EXPECT_NEAR(share * kPlace * kPlace, kPi * 0.4 * 0.4, 2e-3 * kPi * 0.4 * 0.4);

  Simulation simulation(
      build(parse_scene("geometry: solid\ngrid: {cell: 0.1, min: [-0.6, -0.6, -0.6], max: [0.6, 0.6, 0.6]}\n"
                        "time: {end: 1, sync: 1 ms}\n"
                        "materials: [{name: m, law: linear_elastic, density: 1000, young: 1e5, poisson: 0.25}]\n"
                        "bodies: [{name: b, material: m, shape: {cylinder: {center: [0.013, 0.021, 0], radius: 0.4, "
                        "height: 0.6}}}]\n"
                        "loads: [{pressure: {body: b, edge: z_max, value: 10}}]\n",
                        "pressed.yaml", {})),
      {1});
  for (int n = 0; n < 5; ++n) simulation.advance();
  const double force = simulation.state().audit.momentum.z() / 5e-3;
  EXPECT_NEAR(force, -10.0 * kPi * 0.4 * 0.4, 2e-3 * 10.0 * kPi * 0.4 * 0.4);
}

// At the foot of a notch what lies in the ground of a place may have its centre above the surface, from where contact
// has to have a reach all the same.
TEST(CutCells, ContactReachesFromTheFootOfANotch) {
  for (const double foot : {0.11, 0.117, 0.125, 0.135, 0.14}) {
    const std::string ground =
        fmt::format("height_field: {{x: [-1, 1], heights: [{}, {}, {}]}}", foot + 1, foot, foot + 1);
    const DeformableBody body = filled("plane_strain", ground);
    for (const double surface : body.surfaces) EXPECT_GT(surface, 0.0) << foot;
    Simulation simulation(
        build(parse_scene("geometry: plane_strain\ngrid: {cell: 0.1, min: [-1.2, -1.2], max: [1.2, 1.2]}\n"
                          "time: {end: 1, sync: 1 ms}\n"
                          "materials: [{name: m, law: linear_elastic, density: 1000, young: 1e5, poisson: 0.25}]\n"
                          "bodies: [{name: b, material: m, shape: {" +
                              ground +
                              "}}]\n"
                              "rigid_bodies: [{name: tool, shape: {sphere: {radius: 0.2}}, pose: {position: [0, " +
                              std::to_string(foot + 0.24) + "]}, motion: {velocity: [0, -0.5]}}]\n",
                          "notch.yaml", {})),
        {1});
    for (int n = 0; n < 20; ++n) simulation.advance();
    EXPECT_TRUE(std::isfinite(simulation.take_contact(0).mean.force.z())) << foot;
  }
}

TEST(CutCells, SymmetricBodiesAreFilledSymmetrically) {
  const DeformableBody body = filled("plane_strain", "sphere: {center: [0, 0], radius: 0.77}");
  for (std::size_t p = 0; p < body.positions.size(); ++p) {
    const Vec3 mirrored(-body.positions[p].x(), 0.0, body.positions[p].z());
    const auto same = std::find_if(body.positions.begin(), body.positions.end(),
                                   [&](const Vec3& at) { return (at - mirrored).norm() < 1e-9; });
    ASSERT_NE(same, body.positions.end());
    EXPECT_NEAR(body.parts[static_cast<std::size_t>(same - body.positions.begin())], body.parts[p], 1e-9);
  }
}

}  // namespace cut_cells_test
}  // namespace mpm
