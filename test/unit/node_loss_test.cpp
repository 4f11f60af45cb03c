// Loss of a surface at a node, by hand.
#include "mpm/step/node_loss.hpp"

#include <gtest/gtest.h>

namespace mpm {
namespace node_loss_test {

const Vec3 kUp = Vec3::UnitZ();

// 3 N s against a slip that goes from 2 to 1 m/s, which particles see as 1.5 m/s: 3 x (2 + 1.5) / 2.
TEST(NodeLoss, FrictionTakesTheImpulseTimesTheMeanSlipOfStrain) {
  NodeLoss loss;
  const Vec3 none = Vec3::Zero(), start(2.0, 0.0, 0.0), left(1.0, 0.0, 0.0), gathered(1.5, 0.0, 0.0);
  loss.strain(start, none);
  SurfaceLoss taken = loss.act({3.0, kUp, none, {-3.0, 0.0, 0.0}, start, left});
  taken += loss.strain(gathered, none);
  EXPECT_DOUBLE_EQ(taken.friction, 5.25);
  EXPECT_EQ(taken.held, 0.0);
  EXPECT_EQ(loss.strain(left, none).friction, 0.0) << "an impulse counts once";
}

// A mass of 2 kg comes down at 3 m/s and is held, as it is in the strain of both ends: m v^2 / 2 is gone. So it is if
// it comes in along a surface to which it sticks.
TEST(NodeLoss, AHeldNodeLosesItsKineticEnergy) {
  const Vec3 none = Vec3::Zero();
  for (const Vec3& start : {Vec3(0.0, 0.0, -3.0), Vec3(3.0, 0.0, 0.0)}) {
    NodeLoss loss;
    loss.strain(start, -start);
    SurfaceLoss taken = loss.act({2.0, kUp, none, -2.0 * start, start, none});
    taken += loss.strain(none, none);
    EXPECT_DOUBLE_EQ(taken.held, 9.0);
    EXPECT_EQ(taken.friction, 0.0);
  }
}

// A node of 2 kg comes in at 2 m/s along a surface to which it sticks, pushed on by a force of 6 N s: it loses its 4 J,
// and the force does no work on strain, which sees it at rest. -J.(u0 + u1)/2 is 0, and (F dt + J).(c0 + c1)/2, with
// F dt + J = -4 N s, c0 = -2 m/s and c1 = 0, is 4 J.
TEST(NodeLoss, WhatComesToStickLosesItsMotionWhateverPushesIt) {
  NodeLoss loss;
  const Vec3 none = Vec3::Zero(), start(2.0, 0.0, 0.0);
  loss.strain(start, -start);
  SurfaceLoss taken = loss.act({2.0, kUp, none, {-10.0, 0.0, 5.0}, start, none});
  taken += loss.strain(none, none);
  EXPECT_DOUBLE_EQ(taken.held, 4.0);
  EXPECT_EQ(taken.friction, 0.0);
}

// Particles move past a node of 2 kg, which is gathered with -1 m/s along the normal at both ends of the step, held in
// strain and brought to rest. Its momentum changes by 2 N s, its weight gives -6 N s, so F dt + J = 8 N s, and strain
// sees c = 1 m/s less of their work: 8 J, whichever ends of the step strain sees.
TEST(NodeLoss, ANodeThatParticlesMovePastTakesTheSameWithEveryUpdate) {
  for (const double strain_at_start : {0.0, 0.5, 1.0}) {
    NodeLoss loss;
    loss.strain(-kUp, kUp);
    SurfaceLoss taken = loss.act({2.0, kUp, -6.0 * kUp, 4.0 * kUp, -kUp, Vec3::Zero(), true, strain_at_start});
    if (strain_at_start < 1.0) taken += loss.strain(-kUp, kUp);
    EXPECT_DOUBLE_EQ(taken.held, 8.0) << strain_at_start;
    EXPECT_EQ(taken.friction, 0.0);
  }
}

// Another surface holds the node for strain already, and gives the impulse: this one takes nothing.
TEST(NodeLoss, WhatAnotherSurfaceHoldsCountsOnce) {
  NodeLoss loss;
  const Vec3 none = Vec3::Zero();
  loss.strain(none, none);
  SurfaceLoss taken = loss.act({2.0, kUp, none, none, -kUp, none});
  taken += loss.strain(none, none);
  EXPECT_EQ(taken.held, 0.0);
  EXPECT_EQ(taken.friction, 0.0);
}

}  // namespace node_loss_test
}  // namespace mpm
