// Contact with rigid bodies through the public interface: reported forces against stress, weight and Coulomb's law.
//
// Rows of nodes lie on the surfaces of block and tool at the start. A tool that then moves by less than a cell keeps
// the same row of nodes in contact, so the position of the contact on the grid is wrong by that part of a cell.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "mpm/math/constants.hpp"
#include "mpm/rigid/mesh_topology.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm {
namespace contact_test {

using mpm::kPi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kGravity = 9.81;  // [m/s^2]
// Round-off, over the momentum exchanged.
constexpr double kAuditTolerance = 1e-10;

SimulationDefinition empty_scene(UpdateScheme update, double cell, const Vec3& low, const Vec3& high, double sync) {
  SimulationDefinition d;
  d.name = "contact test";
  d.geometry = GeometryKind::plane_strain;
  d.grid = {Vec3::Constant(cell), low, high};
  d.time.sync = std::llround(sync * 1e9);
  d.method.update = update;
  return d;
}

/// Neo-Hookean body "block" from `low` to `high`, two particles along a cell's edge.
void add_block(SimulationDefinition& d, const Vec3& low, const Vec3& high, double density, double young) {
  d.materials = {{"rubber", density, NeoHookeanDefinition{{young, 0.3}}}};
  DeformableBody block;
  block.name = "block";
  block.material = "rubber";
  const double spacing = d.grid.cell.x() / 2.0;
  const bool solid = d.geometry == GeometryKind::solid;
  const Vec3 counts = ((high - low) / spacing).array().round();
  for (int i = 0; i < counts.x(); ++i) {
    for (int j = 0; j < (solid ? counts.y() : 1); ++j) {
      for (int k = 0; k < counts.z(); ++k) {
        block.positions.push_back(low + spacing * Vec3(i + 0.5, solid ? j + 0.5 : 0.0, k + 0.5));
      }
    }
  }
  block.particle_volume = spacing * spacing * (solid ? spacing : d.thickness);
  d.bodies = {block};
}

RigidBodyDefinition plate(const std::string& name, double width, double thickness, const Vec3& centre,
                          double friction) {
  RigidBodyDefinition body;
  body.name = name;
  body.surface = make_box({width, kInfinity, thickness});
  body.pose.position = centre;
  body.friction.coefficient = friction;
  return body;
}

std::vector<double> field(const Simulation& simulation, const std::string& name) {
  std::vector<double> values;
  simulation.particle_field(name, values);
  return values;
}

double mean(const Simulation& simulation, const std::string& name) {
  const std::vector<double> values = field(simulation, name);
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Width of a body that has `count` particles along `axis` [m]: their centres lie half a spacing inside its faces.
double width(const Simulation& simulation, const std::string& axis, int count) {
  const std::vector<double> values = field(simulation, axis);
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return (*high - *low) * count / (count - 1.0);
}

void advance(Simulation& simulation, int syncs) {
  for (int i = 0; i < syncs; ++i) simulation.advance();
}

void expect_audit_closed(const Simulation& simulation) {
  EXPECT_LT(simulation.state().audit.residual, kAuditTolerance);
  EXPECT_GT(simulation.state().audit.exchanged, 0.0);
}

std::string scheme_name(const ::testing::TestParamInfo<UpdateScheme>& info) {
  return info.param == UpdateScheme::usf ? "usf" : "usavg";
}

class Contact : public ::testing::TestWithParam<UpdateScheme> {};
INSTANTIATE_TEST_SUITE_P(Schemes, Contact, ::testing::Values(UpdateScheme::usf, UpdateScheme::usavg), scheme_name);

TEST_P(Contact, UniaxialCompression) {
  // 0.1 x 0.1 m between plates without friction, pressed together by 1 % in 0.1 s and held.
  SimulationDefinition d = empty_scene(GetParam(), 0.01, {-0.2, 0.0, -0.2}, {0.3, 0.0, 0.3}, 1e-3);
  d.method.damping = 200.0;
  add_block(d, Vec3::Zero(), {0.1, 0.0, 0.1}, 1000.0, 1e6);
  d.rigid_bodies = {plate("low", 0.2, 0.04, {0.05, 0.0, -0.02}, 0.0), plate("high", 0.2, 0.04, {0.05, 0.0, 0.12}, 0.0)};
  Simulation simulation(d, {1});
  simulation.command_velocity(0, {{0.0, 0.0, 0.005}, Vec3::Zero()});
  simulation.command_velocity(1, {{0.0, 0.0, -0.005}, Vec3::Zero()});
  advance(simulation, 100);
  simulation.command_velocity(0, {});
  simulation.command_velocity(1, {});
  advance(simulation, 100);
  simulation.take_contact(0);
  simulation.take_contact(1);
  advance(simulation, 20);
  const double low = -simulation.take_contact(0).mean.force.z(), high = simulation.take_contact(1).mean.force.z();
  // The thickness along y is 1 m. 2 %: a row of nodes stays in contact while the plate moves on by 0.5 % of the height.
  const double expected = -mean(simulation, "szz") * width(simulation, "x", 20);
  EXPECT_NEAR(low, expected, 0.02 * expected);
  EXPECT_NEAR(high, expected, 0.02 * expected);
  // Linear elasticity in plane strain, E / (1 - nu^2) strain area, at 1 % strain: 3 % for terms of second order.
  const double linear = 1e6 / (1.0 - 0.09) * 0.01 * 0.1;
  EXPECT_NEAR(low, linear, 0.03 * linear);
  RecordProperty("force_low_over_stress_area", std::to_string(low / expected));
  RecordProperty("force_high_over_stress_area", std::to_string(high / expected));
  expect_audit_closed(simulation);

  // The plates retreat by five cells. They are never pulled, and once clear of the block's nodes the force is zero.
  simulation.command_velocity(0, {{0.0, 0.0, -1.0}, Vec3::Zero()});
  simulation.command_velocity(1, {{0.0, 0.0, 1.0}, Vec3::Zero()});
  for (int i = 0; i < 50; ++i) {
    simulation.advance();
    EXPECT_LE(simulation.take_contact(0).mean.force.z(), 0.0);
    EXPECT_GE(simulation.take_contact(1).mean.force.z(), 0.0);
  }
  advance(simulation, 20);
  for (const int body : {0, 1}) {
    const ContactReport report = simulation.take_contact(body);
    EXPECT_EQ(report.mean.force, Vec3::Zero());
    EXPECT_EQ(report.mean.torque, Vec3::Zero());
    EXPECT_EQ(report.peak.force, Vec3::Zero());
    EXPECT_EQ(report.nodes, 0);
  }
  expect_audit_closed(simulation);
}

TEST_P(Contact, WeightAtRest) {
  SimulationDefinition d = empty_scene(GetParam(), 0.01, {-0.1, 0.0, -0.1}, {0.3, 0.0, 0.2}, 1e-2);
  d.method.damping = 100.0;
  d.gravity = {0.0, 0.0, -kGravity};
  add_block(d, Vec3::Zero(), {0.1, 0.0, 0.1}, 1000.0, 1e6);
  d.rigid_bodies = {plate("floor", 0.4, 0.05, {0.15, 0.0, -0.025}, 0.3)};
  Simulation simulation(d, {1});
  advance(simulation, 50);
  simulation.take_contact(0);
  advance(simulation, 10);
  const ContactReport report = simulation.take_contact(0);
  const double weight = 1000.0 * 0.1 * 0.1 * kGravity;
  EXPECT_NEAR(report.mean.force.z(), -weight, 0.01 * weight);
  EXPECT_NEAR(report.mean.force.x(), 0.0, 0.01 * weight);
  // The block's centre is 0.1 m to the left of the floor's origin: r x F = (-0.1, 0, .) x (0, 0, -W) = -0.1 W along y.
  EXPECT_NEAR(report.mean.torque.y(), -0.1 * weight, 0.01 * 0.1 * weight);
  RecordProperty("force_over_weight", std::to_string(-report.mean.force.z() / weight));
  expect_audit_closed(simulation);
}

TEST(ContactSolid, WeightOnAMesh) {
  // In three dimensions on a floor of triangles, turned by 90 degrees about z so that body axes are not world axes.
  SimulationDefinition d = empty_scene(UpdateScheme::usavg, 0.01, {-0.05, -0.05, -0.05}, {0.11, 0.11, 0.11}, 1e-2);
  d.geometry = GeometryKind::solid;
  d.method.damping = 100.0;
  d.gravity = {0.0, 0.0, -kGravity};
  add_block(d, Vec3::Zero(), {0.06, 0.04, 0.06}, 1000.0, 1e5);
  TriangleMesh mesh;
  for (const auto& triangle : make_box({0.08, 0.12, 0.04})->triangles()) {
    for (const Vec3& corner : triangle) mesh.vertices.push_back(corner);
    const int n = static_cast<int>(mesh.vertices.size());
    mesh.triangles.push_back({n - 3, n - 2, n - 1});
  }
  RigidBodyDefinition floor;
  floor.name = "floor";
  floor.surface = make_mesh(join_equal_vertices(mesh));
  floor.pose = {{0.05, 0.03, -0.02}, Quat(Eigen::AngleAxisd(0.5 * kPi, Vec3::UnitZ()))};
  floor.friction.coefficient = 0.3;
  d.rigid_bodies = {floor};
  Simulation simulation(d, {1});
  advance(simulation, 30);
  simulation.take_contact(0);
  advance(simulation, 10);
  const ContactReport report = simulation.take_contact(0);
  const double weight = 1000.0 * 0.06 * 0.04 * 0.06 * kGravity;
  EXPECT_NEAR(report.mean.force.z(), -weight, 0.01 * weight);
  // The block's centre is at (-0.02, -0.01) from the floor's origin: r x F = (0.01 W, -0.02 W, 0), in world axes.
  EXPECT_NEAR(report.mean.torque.x(), 0.01 * weight, 0.01 * 0.02 * weight);
  EXPECT_NEAR(report.mean.torque.y(), -0.02 * weight, 0.01 * 0.02 * weight);
  RecordProperty("force_over_weight", std::to_string(-report.mean.force.z() / weight));
  expect_audit_closed(simulation);
}

/// A block of 0.2 x 0.1 m on a floor, gravity tilted by 30 degrees towards +x.
SimulationDefinition incline(UpdateScheme update, double friction, double young) {
  SimulationDefinition d = empty_scene(update, 0.02, {-0.2, 0.0, -0.1}, {1.2, 0.0, 0.3}, 2e-3);
  d.gravity = kGravity * Vec3(std::sin(kPi / 6.0), 0.0, -std::cos(kPi / 6.0));
  add_block(d, Vec3::Zero(), {0.2, 0.0, 0.1}, 2000.0, young);
  d.rigid_bodies = {plate("floor", 1.6, 0.1, {0.5, 0.0, -0.05}, friction)};
  return d;
}

TEST_P(Contact, SlidesDownAnIncline) {
  // There is no damping, which would brake the slide. The block bounces a little on its own elasticity, so the
  // acceleration is the slope of a straight line through its velocity over 0.4 s, about twenty bounces.
  Simulation simulation(incline(GetParam(), 0.3, 1e7), {1});
  advance(simulation, 50);
  simulation.take_contact(0);
  double n = 0, st = 0, sv = 0, stt = 0, stv = 0;
  for (int i = 0; i < 200; ++i) {
    simulation.advance();
    const double t = 1e-9 * static_cast<double>(simulation.time()), v = mean(simulation, "vx");
    n += 1, st += t, sv += v, stt += t * t, stv += t * v;
  }
  const double slope = (n * stv - st * sv) / (n * stt - st * st);
  // g (sin 30 - 0.3 cos 30) = 2.35629 m/s^2.
  const double expected = kGravity * (std::sin(kPi / 6.0) - 0.3 * std::cos(kPi / 6.0));
  EXPECT_NEAR(slope, expected, 0.02 * expected);
  // The force lies on Coulomb's cone, since the block slides everywhere.
  const ContactReport report = simulation.take_contact(0);
  EXPECT_NEAR(report.mean.force.x(), -0.3 * report.mean.force.z(), 0.01 * 0.3 * std::abs(report.mean.force.z()));
  RecordProperty("acceleration_over_exact", std::to_string(slope / expected));
  expect_audit_closed(simulation);
}

TEST_P(Contact, SticksOnAnIncline) {
  // tan 30 = 0.577 < 0.6: the block sticks. Damping ends the bounce that the sudden start of gravity causes.
  SimulationDefinition d = incline(GetParam(), 0.6, 1e6);
  d.method.damping = 200.0;
  Simulation simulation(d, {1});
  advance(simulation, 250);
  simulation.take_contact(0);
  const double before = mean(simulation, "x");
  advance(simulation, 250);
  const double creep = (mean(simulation, "x") - before) / 0.5 / 0.02;  // cells a second
  EXPECT_LT(std::abs(creep), 1e-3);
  // The contact carries the whole weight: normal W cos 30, tangential W sin 30.
  const ContactReport report = simulation.take_contact(0);
  const double weight = 2000.0 * 0.2 * 0.1 * kGravity;
  EXPECT_NEAR(report.mean.force.x(), weight * std::sin(kPi / 6.0), 0.01 * weight);
  EXPECT_NEAR(report.mean.force.z(), -weight * std::cos(kPi / 6.0), 0.01 * weight);
  RecordProperty("creep_cells_per_second", std::to_string(creep));
  expect_audit_closed(simulation);
}

TEST_P(Contact, PosesCarryAsVelocitiesDo) {
  // A platform swings to the side, lifts and tilts. It is commanded anew at each sync point: once by velocities, and
  // once by the poses that these lead to.
  const double sync = 2e-3;
  SimulationDefinition d = empty_scene(GetParam(), 0.02, {-0.3, 0.0, -0.2}, {0.7, 0.0, 0.5}, sync);
  d.gravity = {0.0, 0.0, -kGravity};
  add_block(d, Vec3::Zero(), {0.2, 0.0, 0.1}, 1000.0, 1e6);
  d.rigid_bodies = {plate("platform", 0.6, 0.1, {0.1, 0.0, -0.05}, 0.5)};
  Simulation by_velocity(d, {1}), by_pose(d, {1});
  Pose pose = d.rigid_bodies[0].pose;
  for (int i = 0; i < 200; ++i) {
    const double t = i * sync;
    const Twist twist{{0.3 * std::sin(4.0 * t) + 0.1, 0.0, 0.1 * (1.0 - std::cos(10.0 * t))},
                      {0.0, 0.1 * std::sin(12.0 * t), 0.0}};
    pose = integrate(pose, twist, sync);
    by_velocity.command_velocity(0, twist);
    by_pose.command_pose(0, pose, by_pose.time() + by_pose.sync_period());
    by_velocity.advance();
    by_pose.advance();
    // A body that is commanded by poses has exactly these poses.
    ASSERT_EQ(by_pose.rigid_body(0).pose().position, pose.position);
  }
  EXPECT_EQ(by_pose.state().step.steps, by_velocity.state().step.steps);
  for (const char* name : {"x", "z"}) {
    const std::vector<double> a = field(by_velocity, name), b = field(by_pose, name);
    double worst = 0.0;
    for (std::size_t p = 0; p < a.size(); ++p) worst = std::max(worst, std::abs(a[p] - b[p]));
    EXPECT_LT(worst, 1e-12) << name;  // round-off of the twist over a thousand steps, for coordinates of size one
    RecordProperty(std::string("largest_difference_") + name, fmt::format("{:.2e}", worst));
  }
  // The platform carried the block: it has moved sideways with the platform, to within a cell.
  const double went = pose.position.x() - d.rigid_bodies[0].pose.position.x();
  EXPECT_GT(went, 0.1);
  EXPECT_NEAR(mean(by_pose, "x") - 0.1, went, 0.02);
  expect_audit_closed(by_velocity);
  expect_audit_closed(by_pose);
}

}  // namespace contact_test
}  // namespace mpm
