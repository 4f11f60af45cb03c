// The process ends, with the node's exit code, while something waits for ever; not while a record is open. Each ends a
// process of its own. Cost: 6 s of waiting.
#include "mpm_ros/node/exit_watchdog.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>
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

// As while a scene is built for the next run: the record is closed first, and its thread goes no further.
TEST(ExitWatchdogDeathTest, AStopWhileItsThreadIsDeaf) {
  EXPECT_EXIT(
      {
        catch_stop_signals();
        ExitWatchdog watchdog;
        watchdog.must_finish();
        std::raise(SIGTERM);
        {
          const ExitWatchdog::Deaf deaf(watchdog, [] {
            std::fputs("closed", stderr);
            std::this_thread::sleep_for(milliseconds(500));
            return 3;
          });
          std::this_thread::sleep_for(milliseconds(1100));
        }
        std::fputs("gone on", stderr);
        hang(milliseconds(0));
      },
      ExitedWithCode(3), "^closed$");
}

TEST(ExitWatchdogDeathTest, AStopAfterItsThreadWasDeaf) {
  EXPECT_EXIT(
      {
        catch_stop_signals();
        ExitWatchdog watchdog;
        watchdog.must_finish();
        {
          const ExitWatchdog::Deaf deaf(watchdog, [] { return 3; });
        }
        std::raise(SIGTERM);
        hang(milliseconds(1100));
      },
      ExitedWithCode(99), "");
}

// ulimit -t and ulimit -f: the one is a stop, the other lets a write fail as a full disk does.
TEST(StopSignalsDeathTest, LimitsOfProcessorTimeAndOfFilesDoNotKill) {
  EXPECT_EXIT(
      {
        catch_stop_signals();
        std::raise(SIGXFSZ);
        if (stop_requested()) std::_Exit(1);
        std::raise(SIGXCPU);
        std::fputs(used_up().c_str(), stderr);
        std::_Exit(stop_requested() ? 0 : 2);
      },
      ExitedWithCode(0), "processor time .* is used up");
}

}  // namespace exit_watchdog_test
}  // namespace mpm_ros
