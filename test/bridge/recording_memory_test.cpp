// The memory of a recording that is never split does not grow with its length, however its chunks end.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "mpm_ros/message/topics.hpp"
#include "mpm_ros/record/bag_recorder.hpp"
#include "mpm_ros/report/temporary_folder.hpp"

namespace mpm_ros {
namespace recording_memory_test {

constexpr std::int64_t kMegabyte = 1000000;
constexpr std::int64_t kCloud = 80000;  // size of a message [byte]
constexpr int kCut = 5;                 // messages between cuts: 0.4 MB, less than the 768 kB that end a chunk

/// Present memory of the process [byte].
std::int64_t memory() {
  std::ifstream file("/proc/self/statm");
  std::int64_t pages = 0, resident = 0;
  file >> pages >> resident;
  return resident * sysconf(_SC_PAGESIZE);
}

void record(BagRecorder& recorder, int from, int to) {
  sensor_msgs::PointCloud2 cloud;
  cloud.data.assign(kCloud, 7);
  for (int i = from; i < to; ++i) {
    recorder.put(topics::kParticles, ros::Time(1 + i), cloud);
    if (i % kCut == kCut - 1) recorder.sync_point();
  }
}

class RecordingMemory : public ::testing::TestWithParam<const char*> {};

// After the first 4 MB every buffer has its final size. Only the entries of chunks remain, 1000 of them here with 50
// bytes for each topic and as much again, 0.1 MB; and memory that the allocator does not return. A recorder that kept
// its chunks would hold 200 MB.
TEST_P(RecordingMemory, DoesNotGrowWithARecordingThatIsCutOften) {
  const TemporaryFolder folder;
  BagOptions options;
  options.compression = GetParam();
  options.chunk_period = std::chrono::seconds(0);  // each sync point ends a chunk
  BagRecorder recorder(folder.file("run.bag"), options);
  const int begun = 50, all = static_cast<int>(200 * kMegabyte / kCloud);
  record(recorder, 0, begun);
  const std::int64_t before = memory();
  record(recorder, begun, all);
  const std::int64_t grown = memory() - before;
  EXPECT_LT(grown, 3 * kMegabyte);
  RecordProperty("grown_bytes", static_cast<int>(grown));
  recorder.close();
  if (options.compression == "none") {
    EXPECT_GT(std::filesystem::file_size(recorder.path()), 200U * kMegabyte);
  }
}

INSTANTIATE_TEST_SUITE_P(Compressions, RecordingMemory, ::testing::Values("none", "lz4"));

}  // namespace recording_memory_test
}  // namespace mpm_ros
