// Ten thousand random commands pass the reader and the queue into a run in progress: nothing crashes or hangs, every
// refusal is one line with the reason and changes nothing, and applied commands are recorded and replay.
#include <gtest/gtest.h>
#include <ros/console.h>

#include <cmath>

#include "command_dice.hpp"
#include "mpm_ros/command/command_log.hpp"
#include "mpm_ros/command/command_reader.hpp"
#include "mpm_ros/run/run.hpp"
#include "test_files.hpp"

namespace mpm_ros {
namespace command_fuzz_test {

using test::Dice;
using test::kOrigin;

constexpr std::uint64_t kSeed = 20240607;
constexpr int kMessages = 10'000;
constexpr int kMessagesBetweenSyncPoints = 25;
/// Keeps the commands that a run applied.
class CommandKeeper : public MessageSink {
 public:
  bool wants(const std::string& topic) const override { return topic == "commands"; }
  void put(const std::string&, const ros::Time&, const Command& message) override { commands.push_back(message); }

  std::vector<Command> commands;
};

const mpm::Scene& press() {
  static const mpm::Scene scene = mpm::load_scene(data_file("press.yaml"), {"time.end=1000"});
  return scene;
}

RunOptions options() {
  RunOptions options;
  options.threads = 1;
  return options;
}

/// The part of the node between topics and run, without a connection: reader, queue and run.
class Console {
 public:
  Console() : reader_({"plate", "rod"}, "world", "/mpm/bodies/", frames_, queue_, health_) {
    geometry_msgs::TransformStamped sensor;
    sensor.header.frame_id = "world";
    sensor.child_frame_id = "sensor";
    sensor.transform.translation.x = 0.1;
    sensor.transform.rotation.w = std::sqrt(0.5);
    sensor.transform.rotation.y = std::sqrt(0.5);
    frames_.setTransform(sensor, "test", true);
    reader_.set_stamps(Stamps(kOrigin));
    run_.begin();
  }

  CommandReader& reader() { return reader_; }
  mpm::Simulation& simulation() { return run_.simulation(); }
  const std::vector<Command>& recorded() const { return keeper_.commands; }
  std::uint64_t refused() const { return health_.refused(); }
  std::uint64_t taken() const { return taken_; }
  std::size_t waiting() const { return queue_.waiting(); }
  void refuse(const std::string& reason) { health_.refuse(reason); }

  std::string last_refusal() const {
    diagnostic_updater::DiagnosticStatusWrapper status;
    health_.fill_commands(status);
    for (const diagnostic_msgs::KeyValue& value : status.values) {
      if (value.key == "last refused") return value.value;
    }
    return {};
  }

  void apply(const AppliedCommand& command) {
    try {
      run_.apply(command);
      ++applied_;
    } catch (const mpm::RigidError& error) {
      health_.refuse(error.what());
      expect_explained();
    }
  }
  std::uint64_t applied() const { return applied_; }

  void advance() {
    const std::int64_t now = simulation().time();
    for (const DueCommand& due : queue_.take(now)) {
      ++taken_;
      apply(in_world(due, simulation().bodies(), now));
    }
    run_.advance();
  }

  void expect_explained() const {
    const std::string line = last_refusal();
    ASSERT_GT(line.size(), std::string("refused: ").size());
    for (const char c : line) ASSERT_TRUE(c >= ' ' && c <= '~') << line;
  }

 private:
  tf2::BufferCore frames_;
  NodeHealth health_;
  CommandKeeper keeper_;
  Run run_{press(), options(), Stamps(kOrigin), &keeper_};
  CommandQueue queue_{run_.simulation().sync_period()};
  CommandReader reader_;
  std::uint64_t taken_ = 0;
  std::uint64_t applied_ = 0;
};

/// Sends a command as a service request; it is applied at once if it is valid.
void request(Console& console, const mpm_ros::Command& message) {
  std::string problem;
  DueCommand due;
  due.command = console.reader().read(message, problem);
  const std::int64_t now = console.simulation().time(), sync = console.simulation().sync_period();
  due.arrival = (due.command.stamp.value_or(now + sync) + sync - 1) / sync * sync;
  if (problem.empty()) {
    console.apply(in_world(due, console.simulation().bodies(), now));
  } else {
    console.refuse(problem);
  }
}

class CommandFuzz : public testing::Test {
 protected:
  void SetUp() override {
    if (ros::console::set_logger_level(ROSCONSOLE_DEFAULT_NAME, ros::console::levels::Fatal)) {
      ros::console::notifyLoggerLevelsChanged();
    }
  }
  void TearDown() override {
    if (ros::console::set_logger_level(ROSCONSOLE_DEFAULT_NAME, ros::console::levels::Info)) {
      ros::console::notifyLoggerLevelsChanged();
    }
  }
};

double seconds_of(Console& console) { return static_cast<double>(console.simulation().time()) * 1e-9; }

/// Sends a command that is valid except for one part. Commands that are too fast are refused when they are due, the
/// others at once.
void send_bad(Console& console, Dice& dice) {
  const int body = dice.below(2);
  const double now = seconds_of(console);
  geometry_msgs::TwistStamped twist;
  twist.header.stamp = kOrigin + ros::Duration(now);
  twist.twist = dice.twist(true);
  geometry_msgs::PoseStamped pose;
  pose.header.stamp = kOrigin + ros::Duration(now + dice.uniform(0.05, 0.1));
  pose.pose = dice.pose(true);
  mpm_ros::Command command;
  command.body = "plate";
  command.kind = mpm_ros::Command::VELOCITY;
  command.pose.orientation.w = 1.0;
  switch (dice.below(12)) {
    case 0:
      *dice.one_of({&twist.twist.linear.x, &twist.twist.linear.y, &twist.twist.angular.z}) = dice.bad_number();
      return console.reader().take(body, twist.twist);
    case 1:
      *dice.one_of({&twist.twist.linear.z, &twist.twist.angular.x, &twist.twist.angular.y}) = dice.bad_number();
      return console.reader().take(body, twist);
    case 2:
      twist.header.frame_id = dice.unknown_frame();
      return console.reader().take(body, twist);
    case 3:
      twist.header.stamp = dice.far_stamp(now);
      return console.reader().take(body, twist);
    case 4:
      *dice.one_of({&pose.pose.position.x, &pose.pose.position.y, &pose.pose.orientation.z}) = dice.bad_number();
      return console.reader().take(body, pose);
    case 5:
      pose.pose.orientation.w += dice.one_of({2.5, -2.5, 10.0});
      return console.reader().take(body, pose);
    case 6:
      return console.reader().take(body, geometry_msgs::PoseStamped());  // empty: its quaternion is zero
    case 7:
      pose.header.frame_id = dice.unknown_frame();
      return console.reader().take(body, pose);
    case 8:
      command.body = dice.one_of<std::string>({"", "plat", "blade", "rod\n", std::string(5000, 'b')});
      return request(console, command);
    case 9:
      command.kind = static_cast<std::uint8_t>(dice.one_of({0, 4, 77, 255}));
      return request(console, command);
    case 10:
      command.twist.linear.x = dice.huge_number();  // at once
      return request(console, command);
    default:
      *dice.one_of({&twist.twist.linear.x, &twist.twist.linear.z}) = dice.huge_number();  // at the next sync point
      return console.reader().take(body, twist.twist);
  }
}

TEST_F(CommandFuzz, WhatIsRefusedIsExplainedAndChangesNothing) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  Dice dice(kSeed);
  Console pestered, quiet;
  for (int i = 0; i < kMessages; ++i) {
    const std::uint64_t before = pestered.refused();
    send_bad(pestered, dice);
    if (pestered.refused() > before) {
      pestered.expect_explained();
    } else {
      ASSERT_EQ(pestered.waiting(), 1U) << "message " << i << " was neither refused nor taken";
      pestered.advance();
      quiet.advance();
    }
    ASSERT_EQ(pestered.refused(), before + 1) << "message " << i;
    if (HasFatalFailure()) return;
    if (i % kMessagesBetweenSyncPoints == 0) {
      pestered.advance();
      quiet.advance();
    }
  }
  EXPECT_EQ(pestered.refused(), static_cast<std::uint64_t>(kMessages));
  EXPECT_TRUE(pestered.recorded().empty());
  EXPECT_EQ(pestered.simulation().time(), quiet.simulation().time());
  EXPECT_EQ(pestered.simulation().state_hash(), quiet.simulation().state_hash());
}

void send_any(Console& console, Dice& dice) {
  const int body = dice.below(2);
  const double now = seconds_of(console);
  switch (dice.below(4)) {
    case 0:
      return console.reader().take(body, dice.below(10) == 0 ? geometry_msgs::Twist() : dice.twist());
    case 1: {
      geometry_msgs::TwistStamped message;
      if (dice.below(10) > 0) {
        message.header.stamp = dice.stamp(now);
        message.header.frame_id = dice.frame();
        message.twist = dice.twist();
      }
      return console.reader().take(body, message);
    }
    case 2: {
      geometry_msgs::PoseStamped message;
      if (dice.below(10) > 0) {
        message.header.stamp = dice.stamp(now);
        message.header.frame_id = dice.frame();
        message.pose = dice.pose();
      }
      return console.reader().take(body, message);
    }
    default: {
      mpm_ros::Command message;
      message.body = dice.one_of<std::string>({"plate", "rod", "rod", "blade", ""});
      message.kind = static_cast<std::uint8_t>(dice.below(4));
      message.header.frame_id = dice.frame();
      message.twist = dice.twist();
      message.pose = dice.pose();
      message.arrival = dice.stamp(now);
      return request(console, message);
    }
  }
}

/// Replays the recorded commands in a new run and expects it to end as the first did, with the same state.
void expect_replay(const std::vector<Command>& recorded, std::int64_t end, bool failed, std::uint64_t hash) {
  Run run(press(), options(), Stamps(kOrigin), nullptr);
  run.begin();
  CommandLog log(recorded);
  bool failed_again = false;
  try {
    while (run.simulation().time() < end || (failed && run.simulation().time() == end)) {
      for (const AppliedCommand& command : log.take(run.simulation())) run.apply(command);
      run.advance();
    }
  } catch (const mpm::PhysicsError&) {
    failed_again = true;
  }
  EXPECT_EQ(failed_again, failed);
  EXPECT_EQ(run.simulation().time(), end);
  EXPECT_EQ(run.simulation().state_hash(), hash);
}

TEST_F(CommandFuzz, WhatIsAppliedIsRecordedAndReplays) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  Dice dice(kSeed);
  auto console = std::make_unique<Console>();
  std::uint64_t refused = 0, applied = 0, sync_points = 0;
  const auto finish = [&](bool failed) {
    EXPECT_EQ(console->recorded().size(), console->applied());
    expect_replay(console->recorded(), console->simulation().time(), failed, console->simulation().state_hash());
    refused += console->refused();
    applied += console->applied();
  };
  for (int i = 0; i < kMessages; ++i) {
    const std::uint64_t before = console->refused() + console->applied() + console->waiting();
    send_any(*console, dice);
    ASSERT_EQ(console->refused() + console->applied() + console->waiting(), before + 1) << "message " << i;
    if (console->refused() > 0) console->expect_explained();
    if (HasFatalFailure()) return;
    if (i % kMessagesBetweenSyncPoints != 0) continue;
    ++sync_points;
    try {
      console->advance();
    } catch (const mpm::PhysicsError& error) {
      // A tool that is driven through the strip may tear it. This ends the run with one line, and another begins.
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      finish(true);
      console = std::make_unique<Console>();
    }
  }
  finish(false);
  // Refused and applied commands must both be frequent, otherwise the test would show nothing.
  EXPECT_GT(refused, 1000U);
  EXPECT_GT(applied, 1000U);
  EXPECT_GE(sync_points, static_cast<std::uint64_t>(kMessages / kMessagesBetweenSyncPoints));
}

}  // namespace command_fuzz_test
}  // namespace mpm_ros
