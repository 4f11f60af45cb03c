// The condition at r = 0 (boundary/axis.hpp) on a grid with a block of nodes beyond the axis: the radial velocities
// that it sets, and the momentum that it accounts for, that of nodes which carry any, and no other.
#include "mpm/boundary/axis.hpp"

#include <gtest/gtest.h>

#include "step_scene.hpp"

namespace mpm::test {
namespace axis_test {

using Scene = StepScene<Axisymmetric>;

double field(const std::array<int, 3>& node) { return 1.0 + 0.3 * node[0] - 0.2 * node[1]; }

/// A body about the axis with its mass on the grid, and 2 m/s along z at every node.
struct Fixture {
  Fixture() : scene({ShapeKind::ugimp, UpdateScheme::usf, {}}), context{scene.grid, scene.dt} {
    StepContext all = scene.context();
    scene.mechanics->scatter_momentum(all);
    scene.each_node([&](int b, int n, const std::array<int, 3>& node) {
      scene.grid.velocity.at(b, 0, n) = field(node);
      scene.grid.velocity.at(b, 1, n) = 2.0;
      scene.grid.force.at(b, 0, n) = 7.0;
    });
  }
  double velocity(int b, int n) const { return scene.grid.velocity.at(b, 0, n); }
  Scene scene;
  FieldContext context;
};

TEST(Axis, SetsTheNodesOnItAndBeyond) {
  for (const AxisGhosts ghosts : {AxisGhosts::free, AxisGhosts::zero, AxisGhosts::mirror}) {
    Fixture f;
    Axis axis(ghosts);
    axis.momentum_gathered(f.context);
    axis.before_strain(f.context);
    int beyond = 0;
    f.scene.each_node([&](int b, int n, const std::array<int, 3>& node) {
      const char* const name = kAxisGhostNames[static_cast<int>(ghosts)];
      EXPECT_EQ(f.scene.grid.velocity.at(b, 1, n), 2.0);
      if (node[0] > 0) {
        EXPECT_EQ(f.velocity(b, n), field(node)) << name;
      } else if (node[0] == 0 || ghosts == AxisGhosts::zero) {
        EXPECT_EQ(f.velocity(b, n), 0.0) << name;
      } else if (ghosts == AxisGhosts::free) {
        EXPECT_EQ(f.velocity(b, n), field(node)) << name;
      } else if (f.scene.grid.blocks.find(
                     f.scene.grid.layout.key({-node[0] / kBlockEdge, f.scene.grid.blocks.block(b)[1], 0})) >= 0) {
        EXPECT_EQ(f.velocity(b, n), -field({-node[0], node[1], 0})) << name << " " << node[0];
      }
      beyond += node[0] < 0;
    });
    EXPECT_GT(beyond, 0);
  }
}

// Impulse and acceleration of each node that carries mass: m dv and dv / dt; planar functions would spread some of it
// beyond the axis as well.
TEST(Axis, OwnsUpToTheMomentumItChanges) {
  Fixture f;
  Axis axis(AxisGhosts::zero);
  double expected = 0.0;
  f.scene.each_node([&](int b, int n, const std::array<int, 3>& node) {
    if (node[0] <= 0 && f.scene.grid.carries(b, n)) expected -= f.scene.grid.mass.at(b, 0, n) * field(node);
  });
  ASSERT_NE(expected, 0.0);
  axis.momentum_gathered(f.context);
  axis.momentum_updated(f.context);
  axis.grid_advanced(f.context);
  std::vector<ImpulseAccount> accounts;
  axis.accounts(accounts);
  ASSERT_EQ(accounts.size(), 1U);
  EXPECT_EQ(accounts[0].name, "axis");
  // Round-off of a sum of some ten products.
  EXPECT_NEAR(accounts[0].impulse.x(), expected, 1e-14 * std::abs(expected));
  EXPECT_EQ(accounts[0].impulse.z(), 0.0);
  f.scene.each_node([&](int b, int n, const std::array<int, 3>& node) {
    const bool held = node[0] <= 0 && f.scene.grid.carries(b, n);
    EXPECT_DOUBLE_EQ(f.scene.grid.force.at(b, 0, n), held ? 7.0 - field(node) / f.scene.dt : 7.0);
  });
  // An account is reported once.
  axis.grid_advanced(f.context);
  accounts.clear();
  axis.accounts(accounts);
  EXPECT_NEAR(accounts[0].impulse.x(), expected, 1e-14 * std::abs(expected));
}

// XPIC and FMPM: setting the filtered velocity takes no momentum; the momentum removed from the increments counts.
TEST(Axis, HoldsWhatIsFiltered) {
  Fixture f;
  Axis axis(AxisGhosts::zero);
  axis.momentum_gathered(f.context);
  NodalField& increment = f.scene.grid.increment;
  increment = f.scene.grid.velocity;
  axis.velocity_found(f.context);
  f.scene.each_node([&](int b, int n, const std::array<int, 3>& node) {
    if (node[0] == 0) {
      EXPECT_EQ(increment.at(b, 0, n), 0.0);
    }
  });
  axis.grid_advanced(f.context);
  std::vector<ImpulseAccount> accounts;
  axis.accounts(accounts);
  EXPECT_EQ(accounts[0].impulse.norm(), 0.0);
  increment = f.scene.grid.velocity;
  axis.increment_found(f.context);
  axis.grid_advanced(f.context);
  accounts.clear();
  axis.accounts(accounts);
  EXPECT_NE(accounts[0].impulse.x(), 0.0);
  f.scene.each_node([&](int b, int n, const std::array<int, 3>& node) {
    if (node[0] != 0) return;
    EXPECT_EQ(increment.at(b, 0, n), f.scene.grid.carries(b, n) ? 0.0 : field(node));
  });
}

// The impulse of the hoop stress is the sum of the radial forces, times the step.
TEST(Axis, BooksTheHoopStress) {
  Fixture f;
  double sum = 0.0;
  f.scene.each_node([&](int, int, const std::array<int, 3>&) { sum += 7.0; });
  HoopForce hoop;
  hoop.forces_gathered(f.context);
  std::vector<ImpulseAccount> accounts;
  hoop.accounts(accounts);
  EXPECT_EQ(accounts[0].name, "hoop stress");
  EXPECT_NEAR(accounts[0].impulse.x(), sum * f.scene.dt, 1e-13 * sum * f.scene.dt);
  EXPECT_EQ(accounts[0].impulse.z(), 0.0);
}

}  // namespace axis_test
}  // namespace mpm::test
