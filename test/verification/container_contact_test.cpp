// A closed container moves material to and fro, ever faster, up to 0.02 cells a step, and none may leave it. In a plane
// it consists of four plates that move together; in three dimensions it is a mesh with a cavity.
#include <algorithm>
#include <array>

#include "mpm/rigid/mesh_topology.hpp"
#include "rigid_contact_cases.hpp"

namespace verification {
namespace container_contact_test {

constexpr int kThreads = 1;
constexpr double kCell = 0.01, kInner = 0.1, kWall = 0.04, kStep = 1e-4, kMost = 0.02;  // [cells a step]
constexpr int kSteps = 10000, kStepsASync = 5;

/// Bottom, top and sides, in the container's frame.
struct Container {
  std::array<mpm::Pose, 4> places;
  Container() {
    const double out = 0.5 * (kInner + kWall);
    places = {mpm::Pose{{0.0, 0.0, -out}, mpm::Quat::Identity()}, mpm::Pose{{0.0, 0.0, out}, mpm::Quat::Identity()},
              mpm::Pose{{-out, 0.0, 0.0}, mpm::Quat::Identity()}, mpm::Pose{{out, 0.0, 0.0}, mpm::Quat::Identity()}};
  }
  static std::unique_ptr<mpm::Surface> surface(int i) {
    const double length = kInner + 2.0 * kWall;
    return i < 2 ? mpm::make_box({length, kEndless, kWall}) : mpm::make_box({kWall, kEndless, length});
  }
};

enum class Motion { translation, rotation };

/// Pose of the container. It swings along x and z, or turns to and fro; its largest speed grows in proportion to time,
/// up to kMost.
mpm::Pose pose_at(Motion motion, double time) {
  const double end = kSteps * kStep, speed = kMost * kCell / kStep;
  // amplitude * (t / end) has the speed `speed` at the end, where the phase turns at `rate`.
  const double rate = 2.0 * kPi / 0.2;
  mpm::Pose pose;
  if (motion == Motion::translation) {
    const double amplitude = speed / rate * time / end;
    pose.position = amplitude * mpm::Vec3(std::sin(rate * time), 0.0, 1.0 - std::cos(rate * time));
  } else {
    // The inner corner has that speed.
    const double amplitude = speed / (std::sqrt(0.5) * kInner) / rate * time / end;
    pose.orientation = mpm::Quat(Eigen::AngleAxisd(amplitude * std::sin(rate * time), mpm::Vec3::UnitY()));
  }
  return pose;
}

struct Leak {
  double deepest = 0.0;  ///< largest depth of a particle's centre in a wall, at any sync point [cells]
  int escaped = 0;       ///< particles beyond the middle of a wall at the end
  double fastest = 0.0;  ///< largest speed of the walls [cells a step]
};

Leak carry(const ContactMethod& method, Motion motion) {
  mpm::SimulationDefinition d = rubber_scene(method, kCell, 5e4, kStepsASync * kStep);
  d.time.step = kStep;
  d.gravity = {0.0, 0.0, -kGravity};
  const double spacing = 0.5 * kCell;
  std::vector<mpm::Vec3> places = turned_lattice(Slope{}, kInner, 0.6 * kInner, spacing);
  for (mpm::Vec3& place : places) place -= 0.5 * kInner * mpm::Vec3(1.0, 0.0, 1.0);
  add_particles(d, "load", places, spacing * spacing);
  const Container container;
  for (int i = 0; i < 4; ++i) {
    mpm::RigidBodyDefinition wall;
    wall.name = fmt::format("wall_{}", i);
    wall.surface = Container::surface(i);
    wall.pose = container.places[i];
    wall.friction.coefficient = 0.2;
    d.rigid_bodies.push_back(wall);
  }
  const mpm::Vec3 around = mpm::Vec3(0.4, 0.0, 0.4);
  set_domain(d, -around - kCell * mpm::Vec3(0.37, 0.0, 0.61), around);
  mpm::Simulation simulation(d, {kThreads});
  Leak leak;
  mpm::Pose before;
  const auto worst = [&](const mpm::Pose& pose, double beyond) {
    const std::vector<double> x = field(simulation, "x"), z = field(simulation, "z");
    int count = 0;
    for (std::size_t p = 0; p < x.size(); ++p) {
      const mpm::Vec3 inside = pose.to_body({x[p], 0.0, z[p]});
      const double behind = std::max(std::abs(inside.x()), std::abs(inside.z())) - 0.5 * kInner;
      leak.deepest = std::max(leak.deepest, behind / kCell);
      count += behind > beyond ? 1 : 0;
    }
    return count;
  };
  for (int sync = 0; sync < kSteps / kStepsASync; ++sync) {
    const mpm::Pose pose = pose_at(motion, (sync + 1) * kStepsASync * kStep);
    for (int i = 0; i < 4; ++i) {
      simulation.command_pose(i, {pose.to_world(container.places[i].position), pose.orientation},
                              simulation.time() + simulation.sync_period());
    }
    simulation.advance();
    const mpm::Vec3 corner(0.5 * kInner, 0.0, 0.5 * kInner);
    leak.fastest =
        std::max(leak.fastest, (pose.to_world(corner) - before.to_world(corner)).norm() / kCell / kStepsASync);
    before = pose;
    if (sync % 20 == 19) leak.escaped = worst(pose, 0.5 * kWall);
  }
  EXPECT_GE(simulation.state().step.steps, static_cast<std::uint64_t>(kSteps));
  return leak;
}

TEST(RigidContact, ContainerLeaksNothing) {
  Page page("contact", "rigid_container", "A container that is shaken");
  page.problem(
          "Rubber (E = 50 kPa) fills 6/10 of a closed container of 10 x 10 cells with walls of 4 cells, friction "
          "0.2, under gravity. The container swings along a circle, or turns to and fro, five times a second with "
          "growing amplitude, until its inner corner moves at 0.02 cells a step, in 10,000 steps.")
      .exact("no particle leaves", "mass");
  for (const ContactMethod& method : contact_methods()) {
    for (const Motion motion : {Motion::translation, Motion::rotation}) {
      const std::string name =
          fmt::format("{}, {}", method.name, motion == Motion::translation ? "translation" : "rotation");
      const Leak leak = carry(method, motion);
      page.above("fastest wall, " + name, leak.fastest, 0.95 * kMost, "cells a step");
      page.below("particles beyond the middle of a wall, " + name, leak.escaped, 0.0, "");
      // A particle's box ends a quarter of a cell from its centre; a node at most a cell away holds it.
      page.below("deepest centre of a particle in a wall, " + name, leak.deepest, 1.0, "cells");
      say("fastest wall, " + name, leak.fastest, kMost, "cells a step");
      say("particles beyond the middle of a wall, " + name, leak.escaped, 0.0, "");
      say("deepest centre in a wall, " + name, leak.deepest, -0.25, "cells");
    }
  }
}

/// Adds the triangles of a box of edge `side`; those of a cavity face inwards.
void add_box(mpm::TriangleMesh& mesh, double side, bool cavity) {
  for (auto triangle : mpm::make_box(mpm::Vec3::Constant(side))->triangles()) {
    if (cavity) std::swap(triangle[1], triangle[2]);
    const int n = static_cast<int>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), triangle.begin(), triangle.end());
    mesh.triangles.push_back({n, n + 1, n + 2});
  }
}

TEST(FullRigidContact, ContainerInThreeDimensionsLeaksNothing) {
  Page page("contact", "rigid_container_solid", "A container that is shaken, in three dimensions");
  page.problem(
          "Rubber (E = 50 kPa) fills 6/10 of a cubic container of 10 cells, a mesh with walls of 4 cells, friction "
          "0.2. The container turns to and fro about an oblique axis and ever wider, until its inner corner goes at "
          "0.02 cells a step, in 10,000 steps.")
      .exact("no particle leaves", "mass");
  for (const ContactMethod& method : contact_methods()) {
    mpm::SimulationDefinition d = rubber_scene(method, kCell, 5e4, kStepsASync * kStep);
    d.geometry = mpm::GeometryKind::solid;
    d.time.step = kStep;
    d.gravity = {0.0, 0.0, -kGravity};
    const double spacing = 0.5 * kCell;
    std::vector<mpm::Vec3> places;
    for (double x = 0.5 * spacing; x < kInner; x += spacing) {
      for (double y = 0.5 * spacing; y < kInner; y += spacing) {
        for (double z = 0.5 * spacing; z < 0.6 * kInner; z += spacing) {
          places.emplace_back(mpm::Vec3(x, y, z) - mpm::Vec3::Constant(0.5 * kInner));
        }
      }
    }
    add_particles(d, "load", places, spacing * spacing * spacing / d.thickness);
    mpm::TriangleMesh mesh;
    add_box(mesh, kInner + 2.0 * kWall, false);
    add_box(mesh, kInner, true);
    mpm::RigidBodyDefinition wall;
    wall.name = "container";
    wall.surface = mpm::make_mesh(mpm::join_equal_vertices(mesh));
    wall.friction.coefficient = 0.2;
    d.rigid_bodies = {wall};
    const mpm::Vec3 around = mpm::Vec3::Constant(0.2);
    set_domain(d, -around - kCell * mpm::Vec3(0.37, 0.13, 0.61), around);
    mpm::Simulation simulation(d, {kThreads});
    const double speed = kMost * kCell / kStep, rate = 2.0 * kPi / 0.2, end = kSteps * kStep;
    double deepest = 0.0;
    int escaped = 0;
    for (int sync = 0; sync < kSteps / kStepsASync; ++sync) {
      const double time = (sync + 1) * kStepsASync * kStep;
      const double angle = speed / (std::sqrt(0.75) * kInner) / rate * time / end * std::sin(rate * time);
      const mpm::Pose pose{mpm::Vec3::Zero(),
                           mpm::Quat(Eigen::AngleAxisd(angle, mpm::Vec3(1.0, 2.0, 0.5).normalized()))};
      simulation.command_pose(0, pose, simulation.time() + simulation.sync_period());
      simulation.advance();
      if (sync % 100 != 99) continue;
      const std::vector<double> x = field(simulation, "x"), y = field(simulation, "y"), z = field(simulation, "z");
      escaped = 0;
      for (std::size_t p = 0; p < x.size(); ++p) {
        const double behind = pose.to_body({x[p], y[p], z[p]}).cwiseAbs().maxCoeff() - 0.5 * kInner;
        deepest = std::max(deepest, behind / kCell);
        escaped += behind > 0.5 * kWall ? 1 : 0;
      }
    }
    page.below("particles beyond the middle of a wall, " + method.name, escaped, 0.0, "");
    page.below("deepest centre of a particle in a wall, " + method.name, deepest, 1.0, "cells");
    say("particles beyond the middle of a wall, " + method.name, escaped, 0.0, "");
    say("deepest centre in a wall, " + method.name, deepest, -0.25, "cells");
  }
}

}  // namespace container_contact_test
}  // namespace verification
