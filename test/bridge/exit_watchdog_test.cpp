// The process ends, with the node's exit code, while something waits for ever; not while a record is open. Each ends a
// process of its own. Cost: 4 s of waiting.
#include "mpm_ros/node/exit_watchdog.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <thread>

#include "mpm_ros/run/stop_signals.hpp"

namespace mpm_ros {
namespace exit_watchdog_test {

using std::chrono::milliseconds;
using testing::ExitedWithCode;

/// As a call to a master that hangs; 99 when nothing has ended it.
[[noreturn]] void hang(milliseconds time) {
  std::this_thread::sleep_for(time);
  std::_Exit(99);
}

TEST(ExitWatchdogDeathTest, ANodeThatEndsByItself) {
  EXPECT_EXIT(
      {
        ExitWatchdog watchdog(milliseconds(100));
        watchdog.must_finish();
        watchdog.ends(3);
        hang(milliseconds(10'000));
      },
      ExitedWithCode(3), "");
}

TEST(ExitWatchdogDeathTest, AStopBeforeThereIsARecord) {
  EXPECT_EXIT(
      {
        catch_stop_signals();
        ExitWatchdog watchdog;
        std::raise(SIGTERM);
        hang(milliseconds(10'000));
      },
      ExitedWithCode(0), "");
}

TEST(ExitWatchdogDeathTest, AStopDoesNotCutOffARecord) {
  EXPECT_EXIT(
      {
        catch_stop_signals();
        ExitWatchdog watchdog;
        watchdog.must_finish();
        std::raise(SIGTERM);
        hang(milliseconds(1500));
      },
      ExitedWithCode(99), "");
}

// A library that reads a large file asks nobody.
TEST(ExitWatchdogDeathTest, AStopWhileASceneIsRead) {
  EXPECT_EXIT(
      {
        catch_stop_signals();
        const NothingToLose reading;
        std::raise(SIGTERM);
        hang(milliseconds(10'000));
      },
      ExitedWithCode(0), "stopped while the scene was read; nothing was recorded");
}

}  // namespace exit_watchdog_test
}  // namespace mpm_ros
