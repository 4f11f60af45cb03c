// Parameters, pacing and the mailbox, without a master.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <atomic>
#include <stdexcept>
#include <thread>

#include "mpm_ros/node/mailbox.hpp"
#include "mpm_ros/node/node_parameters.hpp"
#include "mpm_ros/node/pacer.hpp"
#include "test_files.hpp"

namespace mpm_ros {
namespace node_parts_test {

/// The text of the error, or "" if the parameters are accepted.
std::string error_of(const ParameterValues& values) {
  std::vector<std::string> warnings;
  try {
    read_parameters(values, warnings);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return {};
}

ParameterValues with(const std::string& name, const XmlRpc::XmlRpcValue& value) {
  return {{"scene", XmlRpc::XmlRpcValue("press")}, {name, value}};
}

TEST(NodeParameters, SceneMustBeGiven) {
  const std::string error = error_of({});
  EXPECT_NE(error.find("~scene is not given"), std::string::npos) << error;
  EXPECT_EQ(error.find('\n'), std::string::npos);
}

TEST(NodeParameters, DefaultsAreSound) {
  std::vector<std::string> warnings;
  const NodeParameters parameters = read_parameters({{"scene", XmlRpc::XmlRpcValue("press")}}, warnings);
  EXPECT_EQ(parameters.pacing, Pacing::real_time);
  EXPECT_EQ(parameters.real_time_factor, 1.0);
  EXPECT_EQ(parameters.on_timeout, OnTimeout::hold);
  EXPECT_FALSE(parameters.keep_alive);
  EXPECT_TRUE(warnings.empty());
}

TEST(NodeParameters, LockstepServesOnAfterTheEnd) {
  std::vector<std::string> warnings;
  EXPECT_TRUE(read_parameters(with("pacing", "lockstep"), warnings).keep_alive);
}

TEST(NodeParameters, WrongTypesAndRangesNameTheParameter) {
  EXPECT_NE(error_of(with("pacing", "lock_step")).find("~pacing is 'lock_step'"), std::string::npos);
  EXPECT_NE(error_of(with("real_time_factor", 0.0)).find("~real_time_factor"), std::string::npos);
  EXPECT_NE(error_of(with("real_time_factor", "fast")).find("~real_time_factor must be a number"), std::string::npos);
  EXPECT_NE(error_of(with("threads", -1)).find("~threads"), std::string::npos);
  EXPECT_NE(error_of(with("threads", 1.5)).find("~threads"), std::string::npos);
  EXPECT_NE(error_of(with("isa", "sse9")).find("parameter ~isa: there is no instruction set 'sse9'"),
            std::string::npos);
  EXPECT_EQ(error_of(with("isa", "plain")), "");
  EXPECT_NE(error_of({{"scene", XmlRpc::XmlRpcValue(7)}}).find("~scene must be text"), std::string::npos);
  EXPECT_NE(error_of(with("command_timeout", -0.1)).find("~command_timeout"), std::string::npos);
  EXPECT_NE(error_of(with("on_timeout", "panic")).find("~on_timeout"), std::string::npos);
  EXPECT_NE(error_of(with("reset_time", "now")).find("~reset_time is 'now'"), std::string::npos);
  EXPECT_NE(error_of(with("particle_stride", 0)).find("~particle_stride"), std::string::npos);
  EXPECT_NE(error_of(with("record_compression", "zip")).find("~record_compression"), std::string::npos);
  EXPECT_EQ(error_of(with("real_time_factor", 2)), "");  // an integer is accepted
}

TEST(NodeParameters, MisspeltNamesAreWarnedOf) {
  std::vector<std::string> warnings;
  read_parameters(with("pacin", "free"), warnings);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("~pacin"), std::string::npos);
  EXPECT_NE(warnings[0].find("'pacing'"), std::string::npos);
}

// As tf had it, tf2's predecessor; tf2 refuses the name.
TEST(NodeParameters, ASlashBeforeTheWorldFrameIsLeftOut) {
  std::vector<std::string> warnings;
  EXPECT_EQ(read_parameters(with("world_frame", "/map"), warnings).world_frame, "map");
  EXPECT_NE(error_of(with("world_frame", "/")).find("~world_frame is empty"), std::string::npos);
}

TEST(NodeParameters, FieldsAreAListOrOneText) {
  XmlRpc::XmlRpcValue list;
  list[0] = "vx";
  list[1] = "szz";
  std::vector<std::string> warnings;
  const std::vector<std::string> expected{"vx", "szz"};
  EXPECT_EQ(read_parameters(with("particle_fields", list), warnings).particle_fields, expected);
  EXPECT_EQ(read_parameters(with("particle_fields", "[vx, szz]"), warnings).particle_fields, expected);
}

TEST(NodeParameters, TheTemplateHoldsEveryParameterWithItsDefault) {
  ParameterValues values;
  for (const auto& entry : YAML::LoadFile(source_file("config/simulator.yaml"))) {
    const auto name = entry.first.as<std::string>();
    const YAML::Node& value = entry.second;
    if (value.IsSequence()) {
      XmlRpc::XmlRpcValue list;
      list.setSize(0);
      values[name] = list;
    } else if (value.Tag() == "!") {  // in quotes
      values[name] = XmlRpc::XmlRpcValue(value.as<std::string>());
    } else if (value.Scalar() == "true" || value.Scalar() == "false") {
      values[name] = XmlRpc::XmlRpcValue(value.as<bool>());
    } else if (value.Scalar().find('.') != std::string::npos) {
      values[name] = XmlRpc::XmlRpcValue(value.as<double>());
    } else {
      values[name] = XmlRpc::XmlRpcValue(value.as<int>());
    }
  }
  std::vector<std::string> warnings;
  const NodeParameters given = read_parameters(values, warnings);
  EXPECT_TRUE(warnings.empty()) << warnings.front();
  const NodeParameters plain = read_parameters({{"scene", XmlRpc::XmlRpcValue("press")}}, warnings);
  EXPECT_EQ(given.pacing, plain.pacing);
  EXPECT_EQ(given.real_time_factor, plain.real_time_factor);
  EXPECT_EQ(given.isa, plain.isa);
  EXPECT_EQ(given.device.word, plain.device.word);
  EXPECT_EQ(given.threads, plain.threads);
  EXPECT_EQ(given.record, plain.record);
  EXPECT_EQ(given.record_compression, plain.record_compression);
  EXPECT_EQ(given.commands, plain.commands);
  EXPECT_EQ(given.command_timeout, plain.command_timeout);
  EXPECT_EQ(given.on_timeout, plain.on_timeout);
  EXPECT_EQ(given.world_frame, plain.world_frame);
  EXPECT_EQ(given.publish_clock, plain.publish_clock);
  EXPECT_EQ(given.clock_rate, plain.clock_rate);
  EXPECT_EQ(given.reset_time, plain.reset_time);
  EXPECT_EQ(given.wrench_rate, plain.wrench_rate);
  EXPECT_EQ(given.force_scale, plain.force_scale);
  EXPECT_EQ(given.state_hash, plain.state_hash);
  EXPECT_EQ(given.keep_alive, plain.keep_alive);
  EXPECT_EQ(given.start_paused, plain.start_paused);
}

using std::chrono::milliseconds;

TEST(Pacer, DeadlinesFollowTheFactor) {
  // 10 ms of simulated time at twice the wall's pace: 5 ms apart.
  Pacer pacer(10'000'000, 2.0);
  const Pacer::Clock::time_point start{};
  pacer.restart(start);
  EXPECT_EQ(pacer.next(start), start + milliseconds(5));
  EXPECT_EQ(pacer.next(start + milliseconds(5)), start + milliseconds(10));
  EXPECT_EQ(pacer.overruns(), 0U);
}

// After a period that took 35 ms the next ones, which take 2 ms, come 8 ms apart, not at once, until the deadlines are
// met again: a delay of 25 ms is caught up with in 12 periods.
TEST(Pacer, DelaysAreCaughtUpWithEvenly) {
  Pacer pacer(10'000'000, 1.0);
  const Pacer::Clock::time_point start{};
  pacer.restart(start);
  Pacer::Clock::time_point begun = pacer.next(start + milliseconds(35));
  EXPECT_LT(begun, start + milliseconds(35));
  begun = start + milliseconds(35);
  int late = 0;
  for (int period = 2; period <= 20; ++period) {
    const Pacer::Clock::time_point due = pacer.next(begun + milliseconds(2));
    EXPECT_GE(due, begun + milliseconds(8));
    late += due > start + milliseconds(10 * period) ? 1 : 0;
    begun = due;
  }
  EXPECT_EQ(late, 12);
  EXPECT_EQ(begun, start + milliseconds(200));
  EXPECT_EQ(pacer.given_up(), 0U);
}

// A sync period of 10 ms that begins 3 ms late has lost these 3 ms; one that catches up on a longer delay has lost 2
// ms, the part of a period that catching up takes.
TEST(Pacer, SaysWhatOfAPeriodHasGone) {
  Pacer pacer(10'000'000, 1.0);
  const Pacer::Clock::time_point start{};
  pacer.restart(start);
  EXPECT_EQ(pacer.late(start), milliseconds(0));
  EXPECT_EQ(pacer.late(start + milliseconds(3)), milliseconds(3));
  EXPECT_EQ(pacer.next(start + milliseconds(6)), start + milliseconds(10));
  EXPECT_EQ(pacer.late(start + milliseconds(10)), milliseconds(0));
  EXPECT_EQ(pacer.late(start + milliseconds(9)), milliseconds(0));
  pacer.next(start + milliseconds(45));
  EXPECT_EQ(pacer.late(start + milliseconds(45)), milliseconds(2));
}

TEST(Pacer, SmallDelaysAreCaughtUpWithAndLargeOnesAreNot) {
  Pacer pacer(10'000'000, 1.0);
  const Pacer::Clock::time_point start{};
  pacer.restart(start);
  EXPECT_EQ(pacer.next(start + milliseconds(30)), start + milliseconds(10));
  EXPECT_EQ(pacer.overruns(), 1U);
  EXPECT_EQ(pacer.next(start + milliseconds(500)), start + milliseconds(500));
  EXPECT_EQ(pacer.overruns(), 2U);
  EXPECT_EQ(pacer.given_up(), 1U);
  EXPECT_EQ(pacer.last_delay(), milliseconds(480));
}

TEST(Pacer, NoRoundingAddsUp) {
  // A third of a millisecond is not a whole number of nanoseconds; three million of them are 1000 s.
  Pacer pacer(1'000'000, 3.0);
  const Pacer::Clock::time_point start{};
  pacer.restart(start);
  Pacer::Clock::time_point due = start;
  for (int i = 0; i < 3'000'000; ++i) due = pacer.next(due);
  EXPECT_EQ(due, start + std::chrono::seconds(1000));
  EXPECT_EQ(pacer.overruns(), 0U);
}

TEST(Mailbox, WorkIsDoneOnTheOtherThread) {
  Mailbox mailbox;
  std::thread::id worker;
  bool done = false;
  std::thread caller([&] { done = mailbox.call([&] { worker = std::this_thread::get_id(); }); });
  while (worker == std::thread::id()) mailbox.run_until(std::chrono::steady_clock::now() + milliseconds(10));
  caller.join();
  EXPECT_TRUE(done);
  EXPECT_EQ(worker, std::this_thread::get_id());
}

// A step that is under way ends when a pause can be found, not before and not after, and the pause is then the first.
TEST(Mailbox, WorkAtOnceIsToldOfWhileItWaits) {
  Mailbox mailbox;
  std::vector<std::string> done;
  std::thread step([&] { mailbox.call([&] { done.emplace_back("step"); }); });
  std::this_thread::sleep_for(milliseconds(20));
  EXPECT_FALSE(mailbox.urgent());
  std::thread pause([&] {
    mailbox.call(
        [&] {
          EXPECT_FALSE(mailbox.urgent());
          done.emplace_back("pause");
        },
        Mailbox::Turn::at_once);
  });
  while (!mailbox.urgent()) std::this_thread::yield();
  mailbox.run_until(std::chrono::steady_clock::now());
  pause.join();
  step.join();
  EXPECT_EQ(done, (std::vector<std::string>{"pause", "step"}));
  EXPECT_FALSE(mailbox.urgent());
}

TEST(Mailbox, ClosingLetsCallersGo) {
  Mailbox mailbox;
  bool done = true;
  std::thread caller([&] { done = mailbox.call([] {}); });
  std::this_thread::sleep_for(milliseconds(20));
  mailbox.close();
  caller.join();
  EXPECT_FALSE(done);
  EXPECT_FALSE(mailbox.call([] {}));
}

// While a scene is built nobody waits for its end; what takes less than kBusyPatience is waited for. Cost: 1 s of
// waiting.
TEST(Mailbox, CallersAreLetGoWhileItIsBusyForLong) {
  Mailbox mailbox;
  bool done = true, short_done = false;
  std::thread before([&] { done = mailbox.call([] {}, Mailbox::Turn::at_once); });
  while (!mailbox.urgent()) std::this_thread::yield();
  mailbox.set_busy(true);
  before.join();
  EXPECT_FALSE(done);
  EXPECT_FALSE(mailbox.urgent());
  EXPECT_FALSE(mailbox.call([] {}));  // at once, since it has been busy for long
  EXPECT_FALSE(mailbox.closed());
  mailbox.set_busy(true);
  std::thread caller([&] { short_done = mailbox.call([] {}, Mailbox::Turn::at_once); });
  while (!mailbox.urgent()) std::this_thread::yield();
  mailbox.set_busy(false);
  mailbox.run_until(std::chrono::steady_clock::now() + milliseconds(10));
  caller.join();
  EXPECT_TRUE(short_done);
}

TEST(Mailbox, AnErrorComesOutAndTheCallerIsLetGo) {
  Mailbox mailbox;
  std::thread caller([&] { mailbox.call([] { throw std::runtime_error("work"); }); });
  bool thrown = false;
  while (!thrown) {
    try {
      mailbox.run_until(std::chrono::steady_clock::now() + milliseconds(10));
    } catch (const std::runtime_error&) {
      thrown = true;
    }
  }
  caller.join();
  EXPECT_TRUE(thrown);
}

}  // namespace node_parts_test
}  // namespace mpm_ros
