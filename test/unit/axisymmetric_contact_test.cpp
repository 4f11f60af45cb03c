// Contact of tools of revolution on an axisymmetric grid, at nodes set by hand: the normal on the axis, the wrench of a
// whole revolution, and a ring that closes.
#include <gtest/gtest.h>

#include "mpm/contact/rigid_contact.hpp"
#include "mpm/shape/ring.hpp"

namespace mpm {
namespace axisymmetric_contact_test {

constexpr double kStep = 0.5;  // [s]

/// A tool and one block of a grid with cells of 1 m; x is r, and r and z begin at 0.
class ToolAmongNodes {
 public:
  explicit ToolAmongNodes(const RigidBodyDefinition& tool)
      : body_(tool), contact_(body_, fields_, 1, GeometryKind::axisymmetric) {
    grid_.rebuild({layout().key({0, 0, 0})});
    for (NodalField* field : {&grid_.mass, &grid_.momentum, &grid_.velocity, &grid_.force}) {
      std::fill_n(field->block(0), grid_.blocks.size() * field->components() * layout().nodes_per_block(), 0.0);
    }
  }

  /// Puts material of `mass` [kg], that of the whole ring, at node (r, z) with velocity (v_r, v_z).
  void set(double r, double z, double mass, double v_r, double v_z) {
    const int n = node(r, z), block = this->block();
    grid_.mass.at(block, 0, n) = mass;
    grid_.velocity.at(block, 0, n) = v_r;
    grid_.velocity.at(block, 1, n) = v_z;
  }
  Vec2 velocity(double r, double z) const {
    return {grid_.velocity.at(block(), 0, node(r, z)), grid_.velocity.at(block(), 1, node(r, z))};
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
  RigidContact& contact() { return contact_; }

 private:
  static GridLayout layout() { return {2, Vec3::Ones(), Vec3::Zero(), Vec3::Constant(8.0)}; }
  int block() const { return grid_.blocks.find(grid_.layout.key({0, 0, 0})); }
  int node(double r, double z) const {
    int n = 0;
    while (grid_.layout.node_position(grid_.blocks.block(block()), n) != Vec3(r, 0.0, z)) ++n;
    return n;
  }

  RigidBody body_;
  Fields fields_ = make_fields(layout());
  Grid& grid_ = *fields_.front();
  RigidContact contact_;
  double time_ = 0.0;
};

RigidBodyDefinition tool(std::unique_ptr<Surface> surface, const Vec3& position) {
  RigidBodyDefinition definition;
  definition.name = "tool";
  definition.surface = std::move(surface);
  definition.pose.position = position;
  return definition;
}

RigidBodyDefinition ring(double inner, double opened) {
  RigidBodyDefinition definition = tool(make_ring(inner, inner + 1.0, 20.0, true), {opened, 0.0, 0.0});
  definition.inner_radius = inner;
  definition.outer_radius = inner + 1.0;
  return definition;
}

TEST(AxisymmetricContact, OnTheAxisTheNormalIsAlongIt) {
  // The side of a cone of 90 degrees pushes equally downwards and outwards beside the axis.
  ToolAmongNodes cone(tool(make_cone(2.0, 2.0), {0.0, 0.0, 0.5}));
  cone.set(0.0, 1.0, 1.0, 0.0, 4.0);
  cone.set(1.0, 2.0, 1.0, 0.0, 4.0);
  cone.step();
  EXPECT_EQ(cone.velocity(0.0, 1.0), Vec2(0.0, 0.0));
  // The component of (0, 4) along (1, -1) / sqrt 2 is removed.
  EXPECT_LT((cone.velocity(1.0, 2.0) - Vec2(2.0, 2.0)).norm(), 4e-15);
}

TEST(AxisymmetricContact, ANodeOnTheAxisThatIsPushedSidewaysAloneIsFree) {
  // In the middle of a cylinder that is longer than wide its side is nearest.
  ToolAmongNodes cylinder(tool(make_cylinder(1.0, 20.0), {0.0, 0.0, 2.0}));
  cylinder.set(0.0, 2.0, 1.0, -1.0, -3.0);
  cylinder.step();
  EXPECT_EQ(cylinder.velocity(0.0, 2.0), Vec2(-1.0, -3.0));
  EXPECT_EQ(cylinder.take().nodes, 0);
}

TEST(AxisymmetricContact, ReportsWhatIsLeftAroundTheAxis) {
  ToolAmongNodes cone(tool(make_cone(2.0, 2.0), {0.0, 0.0, 0.5}));
  cone.set(1.0, 2.0, 3.0, 0.0, 4.0);
  cone.step();
  const ContactReport report = cone.take();
  // The node is given 3 kg x (2, -2) m/s, the tool the opposite, in 0.5 s; 1e-14: rounding of the normal, times 12 N.
  EXPECT_EQ(report.mean.force.x(), 0.0);
  EXPECT_NEAR(report.mean.force.z(), 12.0, 1e-14);
  EXPECT_EQ(report.mean.torque, Vec3::Zero());
  EXPECT_EQ(report.peak.force, report.mean.force);
  EXPECT_EQ(report.peak.torque, Vec3::Zero());
  EXPECT_EQ(report.friction.x(), 0.0);
  EXPECT_EQ(report.impulse.x(), 0.0);
  EXPECT_NEAR(report.impulse.z(), 6.0, 1e-14);
  EXPECT_NEAR(report.per_radian.x(), -12.0 / kTurn, 1e-14);
  EXPECT_NEAR(report.per_radian.z(), 12.0 / kTurn, 1e-14);
  EXPECT_EQ(report.per_radian.y(), 0.0);
  // The centre of pressure is at z = 2, on the axis.
  EXPECT_NEAR((report.centre_of_pressure() - Vec3(0.0, 0.0, 2.0)).norm(), 0.0, 1e-15);
  // The account includes the radial momentum given to the material.
  std::vector<ImpulseAccount> accounts;
  cone.contact().accounts(accounts);
  EXPECT_NEAR((accounts.at(0).impulse - Vec3(6.0, 0.0, -6.0)).norm(), 0.0, 1e-14);
}

TEST(AxisymmetricContact, ARingCarriesWhatItHoldsAlongEvenly) {
  // The inner face is at 1.5 + 0.5 = 2 m and closes at 3 m/s.
  ToolAmongNodes jaws(ring(1.5, 0.5));
  jaws.body().command_velocity({{-3.0, 0.0, 0.0}, Vec3::Zero()});
  EXPECT_EQ(jaws.body().velocity_at({2.0, 0.0, 1.0}), Vec3(-3.0, 0.0, 0.0));
  EXPECT_EQ(jaws.body().velocity_at({2.4, 0.0, 1.0}).x(), -3.0 * 2.4 / 2.0);
  EXPECT_EQ(jaws.body().velocity_at({3.0, 0.0, 1.0}), Vec3(-3.0, 0.0, 0.0));  // on the outer face
  EXPECT_EQ(jaws.body().velocity_at({0.0, 0.0, 1.0}), Vec3::Zero());
  jaws.set(1.0, 1.0, 1.0, 0.0, 0.0);  // in the hole
  jaws.set(2.0, 1.0, 2.0, 0.0, 0.0);  // on the face
  jaws.step();
  EXPECT_EQ(jaws.velocity(1.0, 1.0), Vec2(0.0, 0.0));
  EXPECT_EQ(jaws.velocity(2.0, 1.0), Vec2(-3.0, 0.0));
  const ContactReport report = jaws.take();
  EXPECT_EQ(report.mean.force, Vec3::Zero());
  EXPECT_DOUBLE_EQ(report.per_radian.x(), 2.0 * 3.0 / kStep / kTurn);
  EXPECT_EQ(report.centre_of_pressure(), Vec3(0.0, 0.0, 1.0));
  EXPECT_DOUBLE_EQ(jaws.contact().ledger().sums().work, 2.0 * 3.0 * 3.0);  // impulse times velocity
}

TEST(AxisymmetricContact, ARingOpenedBeyondTwiceItsRadiusHoldsNothingOnTheAxis) {
  // Opened by 5 m: r = 0 lies at x = -5 of its section, which spans 1 to 2.
  ToolAmongNodes jaws(ring(1.0, 5.0));
  jaws.body().command_velocity({{0.0, 0.0, 1.0}, Vec3::Zero()});
  for (const double r : {0.0, 1.0, 2.0, 3.0}) jaws.set(r, 1.0, 1.0, 1.0, 0.0);
  jaws.step();
  EXPECT_EQ(jaws.take().nodes, 0);
}

TEST(AxisymmetricContact, ARingThatClosesIsAnError) {
  RigidBody body(ring(1.0, 0.0));
  body.command_velocity({{-1.0, 0.0, 0.0}, Vec3::Zero()});
  body.begin_step(0.0, 0.75);
  EXPECT_NO_THROW(body.end_step(0.75));
  EXPECT_THROW(body.end_step(0.75), RigidError);
  EXPECT_THROW(RigidBody(ring(1.0, -1.0)), RigidError);
  RigidBody commanded(ring(1.0, 0.0));
  EXPECT_THROW(commanded.command_pose({{-1.5, 0.0, 0.0}, Quat::Identity()}, 0, 1000), RigidError);
  EXPECT_EQ(commanded.drive(), Drive::functions);
}

}  // namespace axisymmetric_contact_test
}  // namespace mpm
