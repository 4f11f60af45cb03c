// bag_report reads a bag of any size in the memory of its largest message, with any options.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "mpm_ros/report/report.hpp"
#include "mpm_ros/report/temporary_folder.hpp"
#include "report_run.hpp"

namespace mpm_ros {
namespace report_memory_test {

constexpr std::size_t kMegabyte = 1000000;

/// A line of /proc/self/status [bytes]: VmRSS is the present memory, VmHWM the largest since it was reset.
std::size_t memory(const std::string& line) {
  std::ifstream file("/proc/self/status");
  for (std::string text; std::getline(file, text);) {
    if (text.rfind(line + ":", 0) == 0) return 1024U * std::stoul(text.substr(line.size() + 1));
  }
  return 0;
}

bool reset_peak() {
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;
  return static_cast<bool>(file);
}

constexpr std::uint32_t kParticles = 50000;       // particles of a cloud
constexpr std::size_t kCloud = 20U * kParticles;  // bytes of a cloud

/// A bag with this number of clouds of 1 MB each.
std::string bag_with_clouds(const TemporaryFolder& folder, int clouds) {
  const std::string path = folder.file("run.bag");
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  test::HalfSineRun run;
  sensor_msgs::PointCloud2 large;
  run.on_particles = [&large](int, sensor_msgs::PointCloud2& cloud) {
    large = cloud;
    return true;
  };
  run.write(bag);
  const std::vector<std::uint8_t> few = large.data;
  large.width = kParticles;
  large.row_step = 20 * kParticles;
  large.data.resize(kCloud);
  for (std::uint32_t i = 0; i < kParticles; ++i) {
    std::memcpy(large.data.data() + 20 * i, few.data() + 20 * (i % 4), 20);
  }
  for (int i = 0; i < clouds; ++i) bag.write("/mpm/particles", large.header.stamp, large);
  bag.close();
  return path;
}

/// Increase of memory at the peak of a report [bytes]; 0 if it cannot be measured here.
std::size_t growth(int clouds) {
  const TemporaryFolder folder;
  ReportOptions options;
  options.bags = {bag_with_clouds(folder, clouds)};
  EXPECT_GT(std::filesystem::file_size(options.bags.front()), static_cast<std::size_t>(clouds) * kCloud);
  options.csv = folder.file("csv");
  options.snapshots = 3;
  options.animate = folder.file("run.gif");
  options.frames = 2;
  options.check = true;
  const std::size_t before = memory("VmRSS");
  if (!reset_peak()) return 0;
  std::ostringstream out, err;
  EXPECT_EQ(run_report(options, out, err, false), ReportResult::done) << err.str();
  return memory("VmHWM") - before;
}

/// Memory for one cloud: the bag library holds its chunk and its record, ROS its message, and its columns are as large
/// again while it is written as CSV or passed to the animation. Each buffer may be twice as large as its content, since
/// it grew by doubling. The rest is for the index, the sample of values for the scale of colours (0.8 MB, twice while
/// it is sorted), the tables and the allocator.
constexpr std::size_t kBound = 2U * 4U * kCloud + 6U * kMegabyte;

TEST(ReportMemory, IsThatOfTheLargestCloud) {
  const std::size_t grown = growth(60);
  if (grown == 0) GTEST_SKIP() << "this kernel does not reset the peak of a process's memory";
  EXPECT_LT(grown, kBound);
  RecordProperty("grown_bytes", static_cast<int>(grown));
}

TEST(FullReportMemory, OfABagOf400MegabytesIsThatOfTheLargestCloud) {
  const std::size_t grown = growth(400);
  if (grown == 0) GTEST_SKIP() << "this kernel does not reset the peak of a process's memory";
  EXPECT_LT(grown, kBound);
  RecordProperty("grown_bytes", static_cast<int>(grown));
}

}  // namespace report_memory_test
}  // namespace mpm_ros
