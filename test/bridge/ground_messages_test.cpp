// Maps of the ground as messages, from heights written here, and in the outputs of run_scene. 0.5 s.
#include "mpm_ros/message/ground_messages.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "mpm/terrain/height_file.hpp"
#include "mpm_ros/message/height_map.hpp"
#include "mpm_ros/report/report_bag.hpp"
#include "mpm_ros/run/run_scene.hpp"
#include "test_files.hpp"

namespace mpm_ros {
namespace ground_messages_test {

const double kHole = std::numeric_limits<double>::quiet_NaN();
const mpm::HeightGrid kMap{{10.0, 20.0}, {11.0, 20.5}, 3, 2, {100.0, 100.25, 100.5, kHole, 101.0, 102.0}};

template <class Number>
Number number_at(const std::vector<std::uint8_t>& data, std::size_t at) {
  Number number;
  std::memcpy(&number, &data.at(at), sizeof number);
  return number;
}

TEST(GroundMessages, HeightMapIsWhatTheNodeReads) {
  HeightMap message = to_message(kMap, 100.0);
  message.header.frame_id = "world";
  EXPECT_EQ(message.resolution, 0.5);
  EXPECT_EQ(message.origin.z, 100.0);
  const mpm::HeightGrid back = height_grid(message, "terrain", "world");
  EXPECT_EQ(back.columns, 3);
  EXPECT_EQ(back.rows, 2);
  EXPECT_EQ(back.low, kMap.low);
  EXPECT_EQ(back.high, kMap.high);
  for (const std::size_t i : {0, 1, 2, 4, 5}) EXPECT_EQ(back.heights[i], kMap.heights[i]) << i;
  EXPECT_TRUE(std::isnan(back.heights[3]));
}

TEST(GroundMessages, CloudIsOrganisedInItsFrameWithTheChange) {
  LocalFrame frame{"world", "world_local", {10.0, 20.0, 100.0}};
  const sensor_msgs::PointCloud2 cloud = to_cloud(kMap, {100.0, 100.0, 100.0, 100.0, 100.0, 100.0}, frame);
  EXPECT_EQ(cloud.width, 3U);
  EXPECT_EQ(cloud.height, 2U);
  ASSERT_EQ(cloud.data.size(), 6U * 16U);
  EXPECT_EQ(cloud.fields.at(3).name, "change");
  const auto value = [&](int point, int field) { return number_at<float>(cloud.data, 16U * point + 4U * field); };
  EXPECT_EQ(value(5, 0), 1.0F);
  EXPECT_EQ(value(5, 1), 0.5F);
  EXPECT_EQ(value(5, 2), 2.0F);
  EXPECT_EQ(value(1, 3), 0.25F);
  EXPECT_TRUE(std::isnan(value(3, 2)));
}

TEST(GroundMessages, ImageHasHighYAtItsTop) {
  const sensor_msgs::Image image = to_image(kMap);
  EXPECT_EQ(image.encoding, "32FC1");
  ASSERT_EQ(image.data.size(), 24U);
  EXPECT_TRUE(std::isnan(number_at<float>(image.data, 0)));
  EXPECT_EQ(number_at<float>(image.data, 8), 102.0F);
  EXPECT_EQ(number_at<float>(image.data, 12), 100.0F);
}

/// Counts maps in a bag.
struct Maps : RunVisitor {
  void terrain(std::int64_t time, const HeightMap& message) override {
    times.push_back(time);
    last = message;
  }
  std::vector<std::int64_t> times;
  HeightMap last;
};

TEST(GroundMessages, ARunRecordsMapsThatChangeAndSavesTheLast) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("mpm_ground_messages_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  RunSceneOptions options;
  options.scene = data_file("press.yaml");
  options.threads = 1;
  options.end = "40 ms";
  options.bag = (folder / "run.bag").string();
  options.csv = (folder / "csv").string();
  options.terrain = (folder / "end.tif").string();
  options.set = {"output={terrain: {period: 10 ms, change: 1 mm}}"};
  std::ostringstream out, err;
  ASSERT_EQ(run_scene(options, out, err, false, [] { return false; }), RunSceneResult::done) << err.str();

  // Nothing touches the strip: one map at the start, and one at the end. It is 0.04 m high from 0.05 to 0.15 m.
  Maps maps;
  RunBag bag(options.bag, "");
  bag.read({&maps}, {});
  EXPECT_EQ(maps.times, (std::vector<std::int64_t>{0, 40'000'000}));
  ASSERT_EQ(maps.last.columns, 21U);
  ASSERT_EQ(maps.last.rows, 1U);
  for (int i = 0; i < 21; ++i) {
    if (i > 5 && i < 15) {
      EXPECT_NEAR(maps.last.heights[i], 0.04F, 1e-8F) << i;
    }
    if (i < 5 || i > 15) {
      EXPECT_TRUE(std::isnan(maps.last.heights[i])) << i;
    }
  }
  std::ifstream index(options.csv + "/terrain.csv");
  std::string line, lines;
  while (std::getline(index, line)) lines += line + "\n";
  EXPECT_EQ(lines,
            "file,time [s],columns [1],rows [1],resolution [m]\nterrain_0000.csv,0,21,1,0.01\n"
            "terrain_0001.csv,0.04,21,1,0.01\n");
  const mpm::HeightTable saved = mpm::read_height_file(options.terrain, mpm::kGroundLimit);
  ASSERT_EQ(saved.columns, 21);
  EXPECT_NEAR(saved.values[10], 0.04, 1e-12);
  EXPECT_TRUE(std::isnan(saved.values[2]));
  std::filesystem::remove_all(folder);
}

}  // namespace ground_messages_test
}  // namespace mpm_ros
