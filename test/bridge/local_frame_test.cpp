// Scenes far from the origin, where float32 cannot tell particles apart: clouds and markers in a frame of their own,
// tables and files for ParaView in double precision.
#include "mpm_ros/message/local_frame.hpp"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "mpm_ros/message/topics.hpp"
#include "mpm_ros/message/view.hpp"
#include "mpm_ros/report/report.hpp"
#include "mpm_ros/report/temporary_folder.hpp"
#include "mpm_ros/run/run_scene.hpp"

namespace mpm_ros {
namespace local_frame_test {

mpm::GridDefinition grid(double cell, const mpm::Vec3& min, const mpm::Vec3& max) {
  mpm::GridDefinition grid;
  grid.cell = {cell, cell, cell};
  grid.min = min;
  grid.max = max;
  return grid;
}

// Numbers of float32 lie 2^-23 of their size apart, or closer: at 1,000 m 0.12 mm, a hundredth of a cell of 12 mm.
TEST(LocalFrame, IsThereWhereFloatsAreTooCoarse) {
  EXPECT_FALSE(local_frame(grid(0.013, {0, 0, 0}, {1000, 10, 10}), "world").apart());
  EXPECT_TRUE(local_frame(grid(0.011, {0, 0, 0}, {1000, 10, 10}), "world").apart());
  EXPECT_TRUE(local_frame(grid(0.011, {-1000, 0, 0}, {0, 10, 10}), "world").apart());
  const LocalFrame frame = local_frame(grid(0.1, {500000, 4600000, 100}, {500020, 4600030, 105}), "map");
  EXPECT_EQ(frame.name, "map_local");
  EXPECT_EQ(frame.origin, mpm::Vec3(500010, 4600020, 0));  // zero where zero serves
  EXPECT_NE(note_on(frame).find("the frame map_local at (500010, 4600020, 0) m"), std::string::npos) << note_on(frame);
  EXPECT_EQ(origins_of(static_transform(frame, {})).at("map_local"), frame.origin);
}

TEST(LocalFrame, MovesMarkersOfTheWorldAlone) {
  const LocalFrame frame = local_frame(grid(0.1, {500000, 0, 0}, {500001, 1, 1}), "world");
  visualization_msgs::MarkerArray markers;
  markers.markers.resize(3);
  for (auto& marker : markers.markers) marker.header.frame_id = "world";
  markers.markers[0].points.resize(1);
  markers.markers[0].points[0].x = 500000.25;
  markers.markers[1].pose.position.x = 500002.0;
  markers.markers[2].header.frame_id = "tool";
  move_to(frame, markers);
  EXPECT_EQ(markers.markers[0].points[0].x, 500000.25 - frame.origin.x());
  EXPECT_EQ(markers.markers[1].pose.position.x, 500002.0 - frame.origin.x());
  EXPECT_EQ(markers.markers[1].header.frame_id, "world_local");
  EXPECT_EQ(markers.markers[2].header.frame_id, "tool");
}

/// 4 x 4 x 4 particles 50 mm apart where a map's coordinates put them, beneath a tool that rests on them.
class FarAway : public ::testing::Test {
 protected:
  FarAway() {
    std::ofstream(folder_.file("scene.yaml"))
        << R"(grid: {cell: 0.1, min: [500000, 4600000, 0], max: [500001, 4600001, 1]}
time: {end: 1 us}
materials: [{name: soil, density: 1500, law: linear_elastic, young: 1 MPa, poisson: 0.2}]
bodies: [{name: ground, material: soil, shape: {box: {min: [500000.4, 4600000.4, 0], max: [500000.6, 4600000.6, 0.2]}}}]
rigid_bodies: [{name: plate, shape: {box: {size: [0.4, 0.4, 0.1]}}, pose: {position: [500000.5, 4600000.5, 0.245]}}]
output: {particle_fields: [vx, x0]}
)";
    options_.scene = folder_.file("scene.yaml");
    options_.threads = 1;
    options_.csv = folder_.file("csv");
    options_.vtk = folder_.file("vtk");
    options_.bag = folder_.file("run.bag");
    std::ostringstream out;
    result_ = run_scene(options_, out, err_, false, [] { return false; });
  }
  static std::set<double> column(const std::string& table, int number) {
    std::set<double> values;
    std::ifstream file(table);
    std::string row, cell;
    std::getline(file, row);
    while (std::getline(file, row)) {
      std::istringstream cells(row);
      for (int i = 0; i <= number; ++i) std::getline(cells, cell, ',');
      values.insert(std::stod(cell));
    }
    return values;
  }
  /// Four places, 50 mm apart, half of that from the edge.
  static void expect_lattice(const std::set<double>& places, double edge, const std::string& what) {
    ASSERT_EQ(places.size(), 4U) << what;
    double expected = edge + 0.025;
    for (const double place : places) {
      EXPECT_NEAR(place, expected, 1e-7) << what;
      expected += 0.05;
    }
  }

  const TemporaryFolder folder_;
  RunSceneOptions options_;
  RunSceneResult result_ = RunSceneResult::bad_input;
  std::ostringstream err_;
};

TEST_F(FarAway, AllThatIsWrittenTellsParticlesApart) {
  ASSERT_EQ(result_, RunSceneResult::done) << err_.str();
  EXPECT_NE(err_.str().find("note: clouds and markers are in the frame world_local at (500001, 4600001, 0) m"),
            std::string::npos)
      << err_.str();
  // Tables: id, x, y, z, vx, x0.
  const std::string first = "/particles_0000.csv";
  expect_lattice(column(options_.csv + first, 1), 500000.4, "x of run_scene");
  expect_lattice(column(options_.csv + first, 2), 4600000.4, "y of run_scene");
  expect_lattice(column(options_.csv + first, 5), 500000.4, "x0 of run_scene");
  ReportOptions report;
  report.bags = {options_.bag};
  report.csv = folder_.file("report");
  report.check = true;
  std::ostringstream out, err;
  EXPECT_EQ(run_report(report, out, err, false), ReportResult::done) << out.str() << err.str();
  expect_lattice(column(report.csv + first, 1), 500000.4, "x of bag_report");
  expect_lattice(column(report.csv + first, 2), 4600000.4, "y of bag_report");
  // ParaView: the points are the first array of the appended data, behind an underscore and their length of 64 bits.
  for (const char* name : {"particles_0000.vtp", "body_plate_0000.vtp"}) {
    std::ostringstream text;
    text << std::ifstream(options_.vtk + "/" + name, std::ios::binary).rdbuf();
    EXPECT_NE(text.str().find("<DataArray type=\"Float64\" Name=\"Points\""), std::string::npos) << name;
  }
  std::ostringstream text;
  text << std::ifstream(options_.vtk + "/particles_0000.vtp", std::ios::binary).rdbuf();
  const std::string file = text.str();
  const char* points = file.data() + file.find("encoding=\"raw\">\n_") + 17 + sizeof(std::uint64_t);
  std::set<double> y;
  for (int p = 0; p < 64; ++p) {
    double place[3];
    std::memcpy(place, points + p * sizeof place, sizeof place);
    y.insert(place[1]);
  }
  expect_lattice(y, 4600000.4, "y of ParaView");
}

TEST_F(FarAway, TheBagSaysWhereTheCloudIs) {
  ASSERT_EQ(result_, RunSceneResult::done) << err_.str();
  rosbag::Bag bag(options_.bag);
  mpm::Vec3 origin = mpm::Vec3::Zero();
  for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery(topics::kTfStatic)))
    origin = origins_of(*message.instantiate<tf2_msgs::TFMessage>()).at("world_local");
  EXPECT_EQ(origin, mpm::Vec3(500001, 4600001, 0));
  for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TypeQuery("sensor_msgs/PointCloud2"))) {
    const auto cloud = message.instantiate<sensor_msgs::PointCloud2>();
    EXPECT_EQ(cloud->header.frame_id, "world_local");
    std::set<double> x;
    for (sensor_msgs::PointCloud2ConstIterator<float> value(*cloud, "x"); value != value.end(); ++value)
      x.insert(origin.x() + static_cast<double>(*value));
    expect_lattice(x, 500000.4, "x of the cloud");
    // RViz looks from there.
    EXPECT_NE(with_view("Visualization Manager:\n  Displays: []\n  Views: {Current: {}}\n", view_of(*cloud), "/mpm/")
                  .find("Fixed Frame: world_local"),
              std::string::npos);
  }
  for (const rosbag::MessageInstance& message :
       rosbag::View(bag, rosbag::TypeQuery("visualization_msgs/MarkerArray"))) {
    for (const auto& marker : message.instantiate<visualization_msgs::MarkerArray>()->markers)
      EXPECT_NE(marker.header.frame_id, "world");
  }
}

}  // namespace local_frame_test
}  // namespace mpm_ros
