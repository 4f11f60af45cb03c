// The report of a rigid body's contact: sums at nodes set by hand, and a whole run against symmetry and the identity of
// moments.
#include "mpm/contact/contact_report.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mpm/contact/rigid_contact.hpp"
#include "mpm/simulation/simulation.hpp"
#include "particle_block.hpp"

namespace mpm {
namespace contact_report_test {

constexpr double kStep = 0.5;  // [s]

/// A plate with its upper face at z = 0 and its origin 0.1 m below, on a grid with cells of 1 m and one block in use.
class PlateBelowNodes {
 public:
  explicit PlateBelowNodes(double friction) : body_(definition(friction)), contact_(body_, fields_, 1) {
    grid_.rebuild({layout().key({0, 0, 0})});
    for (NodalField* field : {&grid_.mass, &grid_.momentum, &grid_.velocity, &grid_.force}) {
      std::fill_n(field->block(0), grid_.blocks.size() * field->components() * 64, 0.0);
    }
  }

  /// Puts material of `mass` [kg] at node (x, y, 0) with `velocity`.
  void set(int x, int y, double mass, const Vec3& velocity) {
    const int block = grid_.blocks.find(grid_.layout.key({0, 0, 0}));
    for (int n = 0; n < 64; ++n) {
      if (grid_.layout.node_position(grid_.blocks.block(block), n) != Vec3(x, y, 0.0)) continue;
      grid_.mass.at(block, 0, n) = mass;
      for (int k = 0; k < 3; ++k) grid_.velocity.at(block, k, n) = velocity[k];
    }
  }

  void step() {
    StepContext context{fields_, kStep};
    contact_.momentum_gathered(context);
    contact_.momentum_updated(context);
    contact_.grid_advanced(context);
    time_ += kStep;
  }
  ContactReport take() { return contact_.ledger().read(time_); }
  RigidBody& body() { return body_; }

 private:
  static GridLayout layout() { return {3, Vec3::Ones(), Vec3::Zero(), Vec3::Constant(8.0)}; }
  static RigidBodyDefinition definition(double friction) {
    RigidBodyDefinition plate;
    plate.name = "plate";
    plate.surface = make_box({20.0, 20.0, 0.2});
    plate.pose.position = {0.0, 0.0, -0.1};
    plate.friction.coefficient = friction;
    return plate;
  }

  RigidBody body_;
  Fields fields_ = make_fields(layout());
  Grid& grid_ = *fields_.front();
  RigidContact contact_;
  double time_ = 0.0;
};

TEST(ContactReport, CentreOfPressureIsTheMeanPlaceWeightedByTheNormalImpulse) {
  PlateBelowNodes plate(0.0);
  plate.set(1, 2, 3.0, {0.0, 0.0, -2.0});  // 6 N s
  plate.set(3, 0, 1.0, {5.0, 0.0, -2.0});  // 2 N s, and no friction
  plate.set(2, 3, 9.0, {0.0, 0.0, 1.0});   // leaves
  plate.step();
  const ContactReport report = plate.take();
  EXPECT_EQ(report.nodes, 2);
  // (6 (1, 2) + 2 (3, 0)) / 8; all these numbers are exact in binary except the origin's 0.1.
  EXPECT_NEAR((report.centre_of_pressure() - Vec3(1.5, 1.5, 0.0)).norm(), 0.0, 1e-15);
  EXPECT_EQ(report.pressing, 8.0 / kStep);
  EXPECT_EQ(report.mean.force, Vec3(0.0, 0.0, -8.0 / kStep));
  EXPECT_LE(report.friction.norm(), 1e-12 * report.pressing);
}

TEST(ContactReport, FrictionIsThePartAlongTheSurface) {
  PlateBelowNodes plate(0.25);
  plate.set(1, 1, 2.0, {3.0, 0.0, -4.0});  // slides: 8 N s normal, Coulomb's 0.25 x 8 = 2 N s along x
  plate.set(3, 1, 2.0, {0.0, 0.5, -4.0});  // sticks: 8 N s normal, its whole 1 N s along y
  plate.step();
  const ContactReport report = plate.take();
  EXPECT_EQ(report.friction, Vec3(2.0, 1.0, 0.0) / kStep);
  EXPECT_EQ(report.mean.force, Vec3(2.0, 1.0, -16.0) / kStep);
  EXPECT_EQ(report.pressing, 16.0 / kStep);
  // Friction does not count: both nodes press equally.
  EXPECT_NEAR((report.centre_of_pressure() - Vec3(2.0, 1.0, 0.0)).norm(), 0.0, 1e-15);
}

TEST(ContactReport, CentreOfPressureTravelsWithTheBody) {
  PlateBelowNodes plate(0.0);
  plate.body().command_velocity({{8.0, 0.0, 0.0}, Vec3::Zero()});
  plate.set(1, 1, 1.0, {0.0, 0.0, -1.0});
  plate.step();
  plate.body().end_step(kStep);
  // The pressure acted at (1, 1), 1 m ahead of the body's origin, which has moved on by 4 m.
  EXPECT_NEAR((plate.take().centre_of_pressure() - Vec3(5.0, 1.0, 0.0)).norm(), 0.0, 1e-15);
}

TEST(ContactReport, NothingPressedHasNoCentre) {
  PlateBelowNodes plate(0.0);
  plate.set(1, 1, 1.0, {0.0, 0.0, -1.0});
  plate.step();
  EXPECT_TRUE(plate.take().centre_of_pressure().allFinite());
  plate.set(1, 1, 1.0, {0.0, 0.0, 1.0});
  plate.step();
  const ContactReport report = plate.take();
  EXPECT_FALSE(report.centre_of_pressure().allFinite());
  EXPECT_EQ(report.pressing, 0.0);
}

// A block of 0.4 x 0.2 m and 0.2 m high on a smooth plate, whose origin is far from the block's middle.
SimulationDefinition block_on_plate() {
  SimulationDefinition d;
  d.grid = {Vec3::Constant(0.1), Vec3::Zero(), Vec3(2.0, 1.6, 1.0)};
  d.time.sync = 10'000'000;
  d.gravity = {0.0, 0.0, -9.81};
  d.materials = {{"rubber", 1000.0, NeoHookeanDefinition{{1e5, 0.3}}}};
  DeformableBody block;
  block.name = "block";
  block.material = "rubber";
  block.particle_volume = 0.05 * 0.05 * 0.05;
  block.positions = particle_block(GeometryKind::solid, {1.0, 0.4, 0.2}, {8, 4, 4}, 0.05);
  d.bodies = {block};
  RigidBodyDefinition plate;
  plate.name = "plate";
  plate.surface = make_box({4.0, 4.0, 0.2});
  plate.pose.position = {0.3, 0.2, 0.1};
  d.rigid_bodies = {plate};
  return d;
}

TEST(ContactReport, AFlatBlockPressesAtItsMiddle) {
  SimulationDefinition definition = block_on_plate();
  definition.contact.method = ContactMethod::nodes;  // sweeps over points have an order, which is not symmetric
  Simulation simulation(std::move(definition), {1});
  for (int i = 0; i < 20; ++i) simulation.advance();
  const ContactReport report = simulation.take_contact(0);
  ASSERT_GT(report.pressing, 0.0);
  // The problem is symmetric about the block's middle. Mirrored halves add the same numbers in another order, so they
  // differ by round-off, 1e-16 of their size, which a few hundred stable steps multiply by less than a thousand.
  EXPECT_NEAR(report.centre_of_pressure().x(), 1.2, 1e-13);
  EXPECT_NEAR(report.centre_of_pressure().y(), 0.5, 1e-13);
  // Nodes lie on the face, and in the row below it once the block's edge has sagged past that.
  EXPECT_LE(report.centre_of_pressure().z(), 0.2 + 1e-13);
  EXPECT_GT(report.centre_of_pressure().z(), 0.1);
}

TEST(ContactReport, OnAFlatSmoothFaceTheTorqueIsArmTimesForce) {
  Simulation simulation(block_on_plate(), {1});
  simulation.command_velocity(0, {{0.2, -0.1, 0.0}, Vec3::Zero()});  // along its face
  for (int i = 0; i < 20; ++i) simulation.advance();
  const ContactReport report = simulation.take_contact(0);
  ASSERT_GT(report.pressing, 0.0);
  // Every node contributes a force along z at its arm: the moments about the centre of pressure cancel, and there is no
  // moment about z. Round-off of sums over some thousand terms: 1e-12 of force times arm.
  const Vec3 left = report.mean.torque - report.arm.cross(report.mean.force);
  EXPECT_LT(left.norm(), 1e-12 * report.arm.norm() * report.mean.force.norm());
  EXPECT_GT(report.mean.torque.norm(), 0.1 * report.arm.norm() * report.mean.force.norm());
  EXPECT_NEAR(report.pressing, -report.mean.force.z(), 1e-12 * report.pressing);
  EXPECT_LE(report.friction.norm(), 1e-12 * report.pressing);
}

}  // namespace contact_report_test
}  // namespace mpm
