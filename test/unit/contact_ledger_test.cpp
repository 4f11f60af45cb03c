// Two readers of one ledger: each has means over its own intervals and the peak since its own last call. Expected
// values are the impulses given, over the times between calls; all are exact in binary.
#include "mpm/contact/contact_ledger.hpp"

#include <gtest/gtest.h>

namespace mpm {
namespace contact_ledger_test {

constexpr double kStep = 0.5;  // [s]

RigidBodyDefinition plate() {
  RigidBodyDefinition definition;
  definition.name = "plate";
  definition.surface = make_box({1.0, 1.0, 1.0});
  return definition;
}

/// One step in which the body presses the material down by `impulse` [N s], on `area` [m^2].
void press(ContactLedger& ledger, double impulse, double area) {
  ledger.give({{0.0, 0.0, -impulse}, {0.0, 0.0, -1.0}, Vec3::Zero(), Vec3::Zero()});
  ledger.end_step(kStep, 1, area);
}

TEST(ContactLedger, ReadersDoNotDisturbEachOther) {
  const RigidBody body(plate());
  ContactLedger ledger(body, false);
  press(ledger, 8.0, 2.0);
  const int second = ledger.add_reader(0.5);  // has not seen the 8 N s
  press(ledger, 2.0, 1.0);

  ContactReport report = ledger.read(1.0);  // 8 + 2 N s in 1 s
  EXPECT_EQ(report.interval, 1.0);
  EXPECT_EQ(report.mean.force.z(), 10.0);
  EXPECT_EQ(report.pressing, 10.0);
  EXPECT_EQ(report.area, 1.5);
  EXPECT_EQ(report.peak.force.z(), 8.0 / kStep);

  press(ledger, 4.0, 3.0);
  report = ledger.read(1.5);  // 4 N s in 0.5 s; the peak of before is forgotten
  EXPECT_EQ(report.interval, 0.5);
  EXPECT_EQ(report.mean.force.z(), 8.0);
  EXPECT_EQ(report.peak.force.z(), 4.0 / kStep);

  press(ledger, 1.0, 0.0);
  report = ledger.read(2.0, second);  // 2 + 4 + 1 N s in 1.5 s, whatever the other read
  EXPECT_EQ(report.interval, 1.5);
  EXPECT_EQ(report.mean.force.z(), 7.0 / 1.5);
  EXPECT_EQ(report.pressing, 7.0 / 1.5);
  EXPECT_EQ(report.area, (1.0 + 3.0 + 0.0) * kStep / 1.5);
  EXPECT_EQ(report.peak.force.z(), 4.0 / kStep);

  report = ledger.read(2.0);  // 1 N s in 0.5 s
  EXPECT_EQ(report.mean.force.z(), 2.0);
  EXPECT_EQ(report.peak.force.z(), 1.0 / kStep);
  EXPECT_EQ(report.impulse.z(), 15.0);  // since the start
  EXPECT_EQ(ledger.read(2.0, second).peak.force.z(), 0.0);
}

}  // namespace contact_ledger_test
}  // namespace mpm
