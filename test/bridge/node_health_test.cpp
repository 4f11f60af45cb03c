// The levels and messages of the two statuses on /diagnostics.
#include "mpm_ros/message/node_health.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace mpm_ros {
namespace node_health_test {

using diagnostic_msgs::DiagnosticStatus;
using Status = diagnostic_updater::DiagnosticStatusWrapper;

std::string value_of(const Status& status, const std::string& key) {
  for (const diagnostic_msgs::KeyValue& value : status.values) {
    if (value.key == key) return value.value;
  }
  return "(no " + key + ")";
}

SolverHealth running() {
  SolverHealth solver;
  solver.phase = "running";
  solver.time = 1.5;
  solver.real_time_factor = 1.0;
  solver.asked_factor = 1.0;
  solver.steps = 300;
  solver.step = 1e-4;
  solver.step_limited_by = "wave speed of 'sand' at (0.1, 0, 0.2) m";
  solver.momentum_error = 1e-14;
  solver.particles = 160;
  return solver;
}

Status solver_status(const SolverHealth& solver) {
  NodeHealth health;
  health.set_solver(solver);
  Status status;
  health.fill_solver(status);
  return status;
}

TEST(SolverHealth, IsOkWhileItRuns) {
  const Status status = solver_status(running());
  EXPECT_EQ(status.level, DiagnosticStatus::OK);
  EXPECT_EQ(status.message, "running");
  EXPECT_EQ(value_of(status, "simulated time [s]"), "1.5");
  EXPECT_EQ(value_of(status, "time step limited by"), "wave speed of 'sand' at (0.1, 0, 0.2) m");
  EXPECT_EQ(value_of(status, "steps"), "300");
  EXPECT_EQ(value_of(status, "particles"), "160");
  EXPECT_EQ(value_of(status, "particles outside (one ends the run)"), "0");
}

// For ten seconds after a sync period whose sweeps were ended too soon, by the largest error in them.
TEST(SolverHealth, WarnsOfForcesThatABudgetMakesWorse) {
  NodeHealth health;
  const auto told = [&](double error) {
    SolverHealth solver = running();
    solver.cut_error = error;
    health.set_solver(solver);
    Status status;
    health.fill_solver(status);
    return status;
  };
  EXPECT_EQ(told(0.04).level, DiagnosticStatus::OK);
  EXPECT_EQ(told(0.12).level, DiagnosticStatus::WARN);
  EXPECT_TRUE(health.take_news());
  for (const double later : {0.08, 0.0}) {
    EXPECT_EQ(told(later).level, DiagnosticStatus::WARN);
    EXPECT_EQ(told(later).message, "running; time.budget has ended sweeps where the force on tools was off by 12 %");
  }
  Status status;
  health.fill_solver(status, NodeHealth::Clock::now() + NodeHealth::kFresh);
  EXPECT_EQ(status.level, DiagnosticStatus::OK);
}

TEST(SolverHealth, WarnsWhenParticlesWerePutBack) {
  SolverHealth solver = running();
  EXPECT_EQ(value_of(solver_status(solver), "particles returned"), "0");
  solver.returned = 1;
  Status status = solver_status(solver);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_EQ(status.message, "running; 1 particle left the grid and was put back");
  solver.returned = 12;
  status = solver_status(solver);
  EXPECT_EQ(status.message, "running; 12 particles left the grid and were put back");
  EXPECT_EQ(value_of(status, "particles returned"), "12");
}

TEST(SolverHealth, WarnsWhenTheAuditDoesNotClose) {
  SolverHealth solver = running();
  solver.momentum_error = 1e-10;  // still round-off
  EXPECT_EQ(solver_status(solver).level, DiagnosticStatus::OK);
  solver.momentum_error = 3e-9;
  const Status status = solver_status(solver);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_NE(status.message.find("audit is off by 3e-09"), std::string::npos) << status.message;
  solver.momentum_error = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(solver_status(solver).level, DiagnosticStatus::WARN);
}

TEST(SolverHealth, AuditInSinglePrecisionIsOffByTheRoundingOfFloats) {
  SolverHealth solver = running();
  solver.precision = mpm::Precision::float32;
  solver.momentum_error = 6e-8;  // 2^-24
  EXPECT_EQ(solver_status(solver).level, DiagnosticStatus::OK);
  solver.momentum_error = 2e-7;
  EXPECT_EQ(solver_status(solver).level, DiagnosticStatus::WARN);
}

TEST(SolverHealth, WarnsWhenAWaveOutrunsACell) {
  SolverHealth solver = running();
  solver.courant = 1.0;
  EXPECT_EQ(solver_status(solver).level, DiagnosticStatus::OK);
  solver.courant = 1.3;
  const Status status = solver_status(solver);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_NE(status.message.find("crossed 1.3 cells"), std::string::npos) << status.message;
}

TEST(SolverHealth, WarnsOfACrushedParticle) {
  SolverHealth solver = running();
  solver.min_j = 0.05;
  const Status status = solver_status(solver);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_NE(status.message.find("crushed to 0.05"), std::string::npos) << status.message;
}

TEST(SolverHealth, WarnsWhenTheWallClockIsNotKeptUpWith) {
  SolverHealth solver = running();
  solver.real_time_factor = 0.3;
  EXPECT_EQ(solver_status(solver).level, DiagnosticStatus::OK);  // just started: no period was late yet
  solver.overruns = 12;
  EXPECT_EQ(solver_status(solver).level, DiagnosticStatus::WARN);
  solver.asked_factor = 0.0;  // free, in lockstep or paused: no factor is asked for
  EXPECT_EQ(solver_status(solver).level, DiagnosticStatus::OK);
}

TEST(SolverHealth, IsAnErrorWhenTheRunFailed) {
  SolverHealth solver = running();
  solver.phase = "failed: particle 7\nis gone";
  solver.failed = true;
  solver.min_j = 0.0;
  const Status status = solver_status(solver);
  EXPECT_EQ(status.level, DiagnosticStatus::ERROR);
  EXPECT_EQ(status.message.find("failed: particle 7"), 0U);
  EXPECT_EQ(status.message.find('\n'), std::string::npos);
}

TEST(CommandHealth, IsOkWhenTheyAreAppliedLateOrNot) {
  NodeHealth health;
  health.follow("blade", 1.25);
  health.follow("blade", 1.5);
  health.set_commands({2, 3, 4});
  Status status;
  health.fill_commands(status);
  EXPECT_EQ(status.level, DiagnosticStatus::OK);
  EXPECT_EQ(value_of(status, "late: stamp zero"), "2");
  EXPECT_EQ(value_of(status, "late: stamp past"), "3");
  EXPECT_EQ(value_of(status, "waiting"), "4");
  EXPECT_EQ(value_of(status, "applied to blade"), "2, the last at 1.500000 s");
}

TEST(CommandHealth, WarnsOfARefusalForAWhile) {
  NodeHealth health;
  health.refuse("frame 'a\nb' is not known");
  EXPECT_TRUE(health.take_news());
  EXPECT_FALSE(health.take_news());
  Status status;
  health.fill_commands(status);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_EQ(status.message, "refused: frame 'a?b' is not known");
  Status later;
  health.fill_commands(later, NodeHealth::Clock::now() + NodeHealth::kFresh);
  EXPECT_EQ(later.level, DiagnosticStatus::OK);
  EXPECT_EQ(value_of(later, "refused"), "1");  // the count is kept
  EXPECT_EQ(value_of(later, "last refused"), "refused: frame 'a?b' is not known");
}

TEST(CommandHealth, WarnsAsLongAsABodyHearsNothing) {
  NodeHealth health;
  health.follow("blade", 1.0);
  health.time_out("blade", "no command for 'blade'");
  const auto much_later = NodeHealth::Clock::now() + std::chrono::hours(1);
  Status status;
  health.fill_commands(status, much_later);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_EQ(status.message, "no command for 'blade'");
  health.follow("blade", 2.0);
  Status again;
  health.fill_commands(again, much_later);
  EXPECT_EQ(again.level, DiagnosticStatus::OK);
  EXPECT_EQ(value_of(again, "timeouts"), "1");
}

TEST(CommandHealth, WarnsOfABodyThatWaitsForItsFrame) {
  NodeHealth health;
  health.wait("probe", "'probe' waits for the tf frame 'tool0'");
  Status status;
  health.fill_commands(status);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_EQ(status.message, "'probe' waits for the tf frame 'tool0'");
  EXPECT_TRUE(health.take_news());
  health.wait("probe", "");
  Status after;
  health.fill_commands(after);
  EXPECT_EQ(after.level, DiagnosticStatus::OK);
}

TEST(CommandHealth, WarnsForAWhileOfWhatWasDroppedAndCountsIt) {
  NodeHealth health;
  CommandHealth commands;
  commands.dropped = 7;
  commands.missing = 2;
  health.set_commands(commands);
  health.set_commands(commands);  // no more than before
  Status status;
  health.fill_commands(status);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_NE(status.message.find("7 commands and 0 messages of tf have been dropped"), std::string::npos);
  EXPECT_EQ(value_of(status, "dropped"), "7");
  EXPECT_EQ(value_of(status, "gaps in header.seq"), "2");
  Status later;
  health.fill_commands(later, NodeHealth::Clock::now() + NodeHealth::kFresh);
  EXPECT_EQ(later.level, DiagnosticStatus::OK);
}

TEST(CommandHealth, WarnsOfAFrameThatAnotherNodePublishesToo) {
  NodeHealth health;
  health.share_frame("blade", "/other/simulator");
  EXPECT_TRUE(health.take_news());
  health.share_frame("blade", "/other/simulator");
  EXPECT_FALSE(health.take_news());
  Status status;
  health.fill_commands(status);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_NE(status.message.find("the node /other/simulator publishes the tf frame 'blade' too"), std::string::npos);
}

TEST(CommandHealth, WarnsOfAJumpForAWhileAndCountsIt) {
  NodeHealth health;
  health.jump("'probe' jumps");
  Status status;
  health.fill_commands(status);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_EQ(value_of(status, "jumps"), "1");
  Status later;
  health.fill_commands(later, NodeHealth::Clock::now() + 2 * NodeHealth::kFresh);
  EXPECT_EQ(later.level, DiagnosticStatus::OK);
  EXPECT_EQ(value_of(later, "last jump"), "'probe' jumps");
  EXPECT_EQ(health.refused(), 0U);
}

TEST(CommandHealth, WarnsWhileABodyIsBehindItsPose) {
  NodeHealth health;
  health.limit("sled", {3, 0.25, 0.5});
  Status status;
  health.fill_commands(status);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_EQ(status.message, "'sled' is behind its pose by 0.25 m and 0.5 rad, as its limits have it");
  EXPECT_EQ(value_of(status, "limited of sled"), "3");
  health.limit("sled", {3, 0.0, 0.0});
  Status after;
  health.fill_commands(after);
  EXPECT_EQ(after.level, DiagnosticStatus::OK);
  EXPECT_EQ(value_of(after, "behind [m] of sled"), "0");
}

}  // namespace node_health_test
}  // namespace mpm_ros
