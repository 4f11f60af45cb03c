// Each check of bag_report against a bag with one fault.
#include "mpm_ros/report/report_check.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "mpm_ros/report/report_bag.hpp"
#include "mpm_ros/report/report_plots.hpp"
#include "report_run.hpp"

namespace mpm_ros {
namespace report_check_test {

using test::HalfSineRun;
using Names = std::vector<std::string>;

class ReportCheckTest : public ::testing::Test {
 protected:
  /// Names of the checks that fail.
  std::vector<std::string> failures_of(const HalfSineRun& run,
                                       mpm::Precision precision = mpm::Precision::float64) const {
    const std::string path = folder_.path() + "/run.bag";
    run.write(path);
    RunBag bag(path, "");
    RunChecks checks(bag.info() ? bag.info()->sync_period : 0.0, precision, bag.missing());
    bag.read({&checks});
    std::vector<std::string> names;
    for (const CheckResult& result : checks.results()) {
      if (!result.passed) names.push_back(result.name);
    }
    return names;
  }

  TemporaryFolder folder_;
};

TEST_F(ReportCheckTest, AGoodRunPassesAllChecks) { EXPECT_EQ(failures_of({}), std::vector<std::string>()); }

TEST_F(ReportCheckTest, CheckFindsMomentumFromNowhere) {
  HalfSineRun run;
  run.on_state = [](int i, SolverState& message) {
    if (i == 60) message.momentum.y += 1e-8;  // about 1.8 N s are exchanged: above the limit of 1e-10
    return true;
  };
  EXPECT_EQ(failures_of(run), Names{"audit"});
}

TEST_F(ReportCheckTest, CheckBelievesAnAuditThatReportsItsOwnFailure) {
  HalfSineRun run;
  run.on_state = [](int i, SolverState& message) {
    if (i == 60) message.momentum_error = 1e-9;
    return true;
  };
  EXPECT_EQ(failures_of(run), Names{"audit"});
}

TEST_F(ReportCheckTest, AnAuditInSinglePrecisionMayBeOffByTheRoundingOfFloats) {
  double error = 1e-8;
  HalfSineRun run;
  run.on_state = [&error](int i, SolverState& message) {
    if (i == 60) message.momentum_error = error;
    return true;
  };
  EXPECT_EQ(failures_of(run, mpm::Precision::float32), Names());
  error = 2e-7;  // more than three roundings of a float, 2^-24 each, in one direction
  EXPECT_EQ(failures_of(run, mpm::Precision::float32), Names{"audit"});
}

TEST_F(ReportCheckTest, ImpulsesOnBodiesAreDoubleInSinglePrecisionToo) {
  HalfSineRun run;
  run.on_state = [](int i, SolverState& message) {
    if (i == 30) {  // 1e-8 N s of about 0.5 N s; the material's balance still closes
      message.impulses[0].impulse.z += 1e-8;
      message.impulses[1].impulse.z -= 1e-8;
    }
    return true;
  };
  EXPECT_EQ(failures_of(run, mpm::Precision::float32), Names{"reaction"});
}

TEST_F(ReportCheckTest, CheckFindsAnEnergyThatIsNotFinite) {
  HalfSineRun run;
  run.on_state = [](int i, SolverState& message) {
    if (i == 3) message.energy_plastic = std::numeric_limits<double>::infinity();
    return true;
  };
  EXPECT_EQ(failures_of(run), Names{"energy"});
}

TEST_F(ReportCheckTest, CheckFindsARunThatFailed) {
  HalfSineRun run;
  run.on_state = [](int i, SolverState& message) {
    if (i == HalfSineRun::kIntervals) message.failed = true;
    return true;
  };
  EXPECT_EQ(failures_of(run), Names{"run"});
}

TEST_F(ReportCheckTest, MomentumThatCancelsHasASizeToo) {
  // Two bodies of 1 kg approach each other with 2 m/s each, without contact: no momentum is exchanged; they carry 4 N
  // s.
  double residual = 3e-10;  // 0.75e-10 of that
  HalfSineRun run;
  run.on_state = [&residual](int i, SolverState& message) {
    for (Impulse& impulse : message.impulses) impulse.impulse = geometry_msgs::Vector3();
    message.momentum = message.initial_momentum = geometry_msgs::Vector3();
    message.momentum_exchanged = 0.0;
    message.momentum_carried = 4.0;
    if (i == 50) message.momentum.x = residual;
    return true;
  };
  run.on_forces = [](int, ContactForces& message) {
    message.bodies.clear();
    return true;
  };
  run.on_bodies = [](int, BodyStates& message) {
    message.bodies.clear();
    return true;
  };
  EXPECT_EQ(failures_of(run), Names());
  residual = 5e-10;
  EXPECT_EQ(failures_of(run), Names{"audit"});
}

TEST_F(ReportCheckTest, CheckFindsStepsThatTheTimeHasNoRoomFor) {
  HalfSineRun run;  // 10 steps of 0.1 ms between states
  run.on_state = [](int i, SolverState& message) {
    if (i >= 40) ++message.steps;
    return true;
  };
  EXPECT_EQ(failures_of(run), Names{"steps"});
  run.on_state = [](int i, SolverState& message) {
    if (i == 40) message.steps = 390;  // time advanced without steps
    return true;
  };
  EXPECT_EQ(failures_of(run), Names{"steps"});
  run.on_state = [](int i, SolverState& message) {
    if (i == 40) message.steps = 380;
    return true;
  };
  EXPECT_EQ(failures_of(run), Names{"steps"});
}

TEST_F(ReportCheckTest, CheckFindsCommandsThatWereRefusedOrLost) {
  HalfSineRun run;
  run.on_state = [](int i, SolverState& message) {
    message.commands_refused = i > 70 ? 1 : 0;
    return true;
  };
  EXPECT_EQ(failures_of(run), Names{"commands"});
  run.on_state = [](int, SolverState& message) {
    message.commands_applied = 2;  // the bag has one
    return true;
  };
  EXPECT_EQ(failures_of(run), Names{"commands"});
  run.on_state = [](int, SolverState& message) {
    message.commands_late = 1;  // normal
    return true;
  };
  EXPECT_EQ(failures_of(run), Names());
}

TEST_F(ReportCheckTest, CommandsCountUpToTheLastState) {
  // The only command takes effect at the sync point of state 10. The state of a sync point precedes its commands, but
  // the last state of a run follows them; a run that was killed there may have neither.
  int last = 9;
  std::uint64_t applied = 0;
  HalfSineRun run;
  run.on_state = [&](int i, SolverState& message) {
    if (i == last) message.commands_applied = applied;
    return i <= last;
  };
  EXPECT_EQ(failures_of(run), Names());
  last = 10;
  EXPECT_EQ(failures_of(run), Names());
  applied = 1;
  EXPECT_EQ(failures_of(run), Names());
  applied = 2;
  EXPECT_EQ(failures_of(run), Names{"commands"});
  last = 11;
  applied = 0;
  EXPECT_EQ(failures_of(run), Names{"commands"});
}

TEST_F(ReportCheckTest, CommandsThatWereRefusedBeforeAResetAreNotOfThisRun) {
  std::uint64_t refused = 3;
  HalfSineRun run;
  run.on_state = [&refused](int i, SolverState& message) {
    message.commands_refused = i < 50 ? 3 : refused;
    return true;
  };
  EXPECT_EQ(failures_of(run), Names());
  refused = 4;
  EXPECT_EQ(failures_of(run), Names{"commands"});
}

TEST(RunChecks, LooksAtTheClockWhereItWasRecorded) {
  const auto result = [](const std::vector<std::int64_t>& times) {
    RunChecks checks(1e-3, mpm::Precision::float64, {});
    for (const std::int64_t time : times) checks.clock(time);
    for (const CheckResult& one : checks.results()) {
      if (one.name == "clock") return one;
    }
    return CheckResult{};
  };
  EXPECT_FALSE(result({}).made);
  EXPECT_TRUE(result({1, 1000000, 5000000, 5000000}).passed);
  EXPECT_TRUE(result({1, 1000000, 5000000}).made);
  EXPECT_FALSE(result({1, 2000000, 1000000}).passed);  // backwards
  EXPECT_FALSE(result({1, 1500000}).passed);           // between sync points
}

TEST(RunChecks, FindsAGlobalQuantityThatIsNotFinite) {
  GlobalQuantities message;
  message.names = {"sxx"};
  message.units = {"Pa"};
  message.values = {1.0};
  RunChecks checks(1e-3, mpm::Precision::float64, {});
  checks.global_quantities(0, message);
  message.values = {std::numeric_limits<double>::quiet_NaN()};
  checks.global_quantities(1000000, message);
  for (const CheckResult& one : checks.results()) {
    EXPECT_EQ(one.passed, one.name != "global") << one.name;
  }
}

TEST_F(ReportCheckTest, CheckFindsALostState) {
  HalfSineRun run;
  run.on_state = [](int i, SolverState&) { return i != 40; };
  EXPECT_EQ(failures_of(run), Names{"gaps"});
}

TEST_F(ReportCheckTest, CheckFindsALostContactMessage) {
  HalfSineRun run;
  run.on_forces = [](int i, ContactForces&) { return i != 40; };
  EXPECT_EQ(failures_of(run), Names{"gaps"});
}

TEST_F(ReportCheckTest, AShorterLastIntervalIsNoGap) {
  HalfSineRun run;  // states every 2 ms, the last after 1 ms, since 101 is odd
  run.on_state = [](int i, SolverState&) { return i % 2 == 0 || i == HalfSineRun::kIntervals; };
  EXPECT_TRUE(failures_of(run).empty());
}

TEST_F(ReportCheckTest, ARunThatGoesOnBetweenTwoMultiplesBeginsWithLess) {
  // A run that was resumed at 7 ms has states every 10 ms: the first interval is 3 ms, the last one 1 ms.
  int lost = -1;
  const auto recorded = [&lost](int i) {
    return i != lost && (i == 7 || (i > 7 && i % 10 == 0) || i == HalfSineRun::kIntervals);
  };
  HalfSineRun run;
  run.on_state = [&](int i, SolverState&) { return recorded(i); };
  run.on_bodies = [&](int i, BodyStates&) { return recorded(i); };
  EXPECT_EQ(failures_of(run), Names());
  lost = 50;
  EXPECT_EQ(failures_of(run), Names{"gaps"});
}

TEST_F(ReportCheckTest, ALostThirdStateIsAGap) {
  HalfSineRun run;  // 0, 1, 3, 4 ms, ...: the longer interval is not taken for the usual one
  run.on_state = [](int i, SolverState&) { return i != 2; };
  EXPECT_EQ(failures_of(run), Names{"gaps"});
}

TEST_F(ReportCheckTest, CheckFindsAStampThatIsNotTheSolversTime) {
  HalfSineRun run;
  run.on_state = [](int i, SolverState& message) {
    if (i == 5) message.time += 1e-6;
    return true;
  };
  EXPECT_EQ(failures_of(run), Names{"stamps"});
}

TEST_F(ReportCheckTest, CheckFindsMaterialTurnedInsideOut) {
  HalfSineRun run;
  run.on_state = [](int i, SolverState& message) {
    if (i == 100) message.min_j = 0.0;
    return true;
  };
  EXPECT_EQ(failures_of(run), Names{"volume"});
}

TEST_F(ReportCheckTest, CheckFindsAPoseThatIsNotFinite) {
  HalfSineRun run;
  run.on_bodies = [](int i, BodyStates& message) {
    if (i == 9) message.bodies[0].pose.position.z = std::numeric_limits<double>::quiet_NaN();
    return true;
  };
  EXPECT_EQ(failures_of(run), Names{"bodies"});
}

TEST_F(ReportCheckTest, CheckFindsForcesThatDoNotAddUpToTheImpulse) {
  HalfSineRun run;
  run.on_forces = [](int i, ContactForces& message) {
    if (i == 30) message.bodies[0].wrench.force.z = 1e-3;  // 1e-6 N s of about 0.5 N s
    return true;
  };
  EXPECT_EQ(failures_of(run), Names{"impulse"});
}

/// Two deformable bodies pressed with 2 N throughout.
bool add_pair(int i, ContactForces& message) {
  ContactPair pair;
  pair.name = "block/slab";
  pair.interval = i == 0 ? 0.0 : HalfSineRun::kStep;
  pair.force.z = i == 0 ? 0.0 : -2.0;
  pair.impulse.z = -2.0 * i * HalfSineRun::kStep;
  message.pairs.push_back(pair);
  return true;
}

TEST_F(ReportCheckTest, PairsOfDeformableBodiesNeedNoPlaceInTheAudit) {
  HalfSineRun run;
  run.on_forces = add_pair;
  EXPECT_EQ(failures_of(run), Names());
}

TEST_F(ReportCheckTest, CheckFindsForcesOfAPairThatDoNotAddUpToTheImpulse) {
  HalfSineRun run;
  run.on_forces = [](int i, ContactForces& message) {
    add_pair(i, message);
    if (i == 30) message.pairs[0].force.x = 1e-3;  // 1e-6 N s of 0.06 N s
    return true;
  };
  EXPECT_EQ(failures_of(run), Names{"impulse"});
}

TEST_F(ReportCheckTest, CheckFindsAnEnergyOfFreeBodiesThatIsNotFinite) {
  for (double SolverState::*energy : {&SolverState::energy_free_kinetic, &SolverState::energy_free_potential,
                                      &SolverState::energy_free_loss, &SolverState::free_work}) {
    HalfSineRun run;
    run.on_state = [energy](int i, SolverState& message) {
      if (i == 3) message.*energy = std::numeric_limits<double>::quiet_NaN();
      return true;
    };
    EXPECT_EQ(failures_of(run), Names{"energy"});
  }
}

TEST_F(ReportCheckTest, CheckFindsAnEnergyOfFrictionThatIsNotFinite) {
  HalfSineRun run;
  run.on_state = [](int i, SolverState& message) {
    if (i == 3) message.energy_pair_friction = std::numeric_limits<double>::quiet_NaN();
    return true;
  };
  EXPECT_EQ(failures_of(run), Names{"energy"});
}

TEST_F(ReportCheckTest, CheckFindsABodyThatFeelsOtherThanTheMaterial) {
  HalfSineRun run;
  run.on_state = [](int i, SolverState& message) {
    if (i == 30) {  // the material's balance still closes
      message.impulses[0].impulse.z += 1e-6;
      message.impulses[1].impulse.z -= 1e-6;
    }
    return true;
  };
  EXPECT_EQ(failures_of(run), Names{"reaction"});
}

TEST_F(ReportCheckTest, CheckFindsAParticleValueThatIsNotFinite) {
  HalfSineRun run;
  run.on_particles = [](int i, sensor_msgs::PointCloud2& message) {
    const float bad = std::numeric_limits<float>::quiet_NaN();
    if (i == 4) std::memcpy(message.data.data() + 20 + 16, &bad, 4);  // vx of the second particle
    return true;
  };
  EXPECT_EQ(failures_of(run), Names{"particles"});
}

TEST_F(ReportCheckTest, CheckMissesWhatIsNotThere) {
  HalfSineRun without_info;
  without_info.with_info = false;
  EXPECT_EQ(failures_of(without_info), Names{"complete"});
  HalfSineRun without_pose;
  without_pose.on_bodies = [](int, BodyStates& message) {
    message.bodies.clear();
    return true;
  };
  EXPECT_EQ(failures_of(without_pose), Names{"complete"});
  HalfSineRun without_particles;
  without_particles.on_particles = [](int, sensor_msgs::PointCloud2&) { return false; };
  EXPECT_EQ(failures_of(without_particles), Names{"complete"});
}

TEST_F(ReportCheckTest, StampsMayCountFromAnyTime) {
  HalfSineRun run;
  run.origin = ros::Time(1700000000, 5);
  EXPECT_EQ(failures_of(run), Names());
}

}  // namespace report_check_test
}  // namespace mpm_ros
