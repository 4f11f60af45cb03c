// Two million steps in lockstep while everything is recorded in parts: memory does not grow, and the clock equals the
// number of sync periods.
#include <fmt/format.h>
#include <mpm_ros/RunInfo.h>

#include <iostream>

#include "mpm_ros/message/bag_parts.hpp"
#include "process_memory.hpp"
#include "simulator_process.hpp"
#include "test_files.hpp"

namespace mpm_ros::test {
namespace full_endurance_node_test {

TEST(FullEndurance, TwoMillionStepsInLockstep) {
  constexpr std::uint64_t kSteps = 2'000'000, kStepsOfSync = 100, kSyncs = kSteps / kStepsOfSync;
  constexpr std::uint64_t kSync = 10'000'000;  // [ns]
  constexpr int kCalls = 200;
  // One heap for all threads; otherwise a thread takes a megabyte of its own when it serves its first call.
  setenv("MALLOC_ARENA_MAX", "1", 1);
  const TemporaryFolder folder;
  const std::string bag = folder.file("run.bag");
  SimulatorProcess simulator({"scene:=" + data_file("endurance.yaml"), "pacing:=lockstep", "threads:=1",
                              "record:=" + bag, "record_split_size:=1"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  const auto began = std::chrono::steady_clock::now();
  double warm = 0.0, largest = 0.0;
  for (int call = 1; call <= kCalls; ++call) {
    const Step::Response response = simulator.step(kSyncs / kCalls, {velocity("stop", call % 2 == 0 ? 0.001 : -0.001)});
    ASSERT_TRUE(response.success) << response.message;
    const std::uint64_t syncs = call * (kSyncs / kCalls);
    ASSERT_EQ(response.stamp.toNSec(), syncs * kSync);
    ASSERT_EQ(response.time, static_cast<double>(syncs * kSync) * 1e-9);
    const double memory = memory_of(simulator.pid());
    if (call % (kCalls / 10) == 0)
      std::cout << fmt::format("{} kB after {} sync periods\n", memory, syncs) << std::flush;
    if (call == kCalls / 10) warm = memory;  // several parts are closed by then
    if (call > kCalls / 10) largest = std::max(largest, memory);
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  const double end = memory_of(simulator.pid());
  simulator.signal(SIGINT);
  EXPECT_EQ(simulator.wait(), 0) << simulator.log();

  const std::vector<std::string> parts = parts_of(bag);
  std::uintmax_t bytes = 0;
  for (const std::string& part : parts) bytes += std::filesystem::file_size(part);
  std::cout << fmt::format(
      "{} steps in {:.1f} s; {} parts, {:.1f} MB; memory {} kB after a tenth, {} kB at the end, {} kB at most "
      "between\n",
      kSteps, seconds, parts.size(), 1e-6 * static_cast<double>(bytes), warm, end, largest);
  EXPECT_GT(parts.size(), 5U);
  EXPECT_LE(static_cast<double>(largest), 1.01 * static_cast<double>(warm));
  EXPECT_LE(static_cast<double>(end), 1.01 * static_cast<double>(warm));
  const SolverState last = last_state_in(parts.back());
  EXPECT_EQ(last.steps, kSteps);
  EXPECT_EQ(last.time, static_cast<double>(kSyncs * kSync) * 1e-9);
  EXPECT_EQ(last.header.stamp.toNSec(), kSyncs * kSync);
}

}  // namespace full_endurance_node_test
}  // namespace mpm_ros::test
