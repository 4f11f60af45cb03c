// Files for ParaView, read back by the rules of VTK's XML format: header, offsets, raw blocks after their lengths.
#include <gtest/gtest.h>
#include <rosbag/view.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include "full_disk.hpp"
#include "mpm_ros/record/crack_lines.hpp"
#include "mpm_ros/record/vtk_file.hpp"
#include "mpm_ros/report/report_bag.hpp"
#include "mpm_ros/report/temporary_folder.hpp"
#include "mpm_ros/run/run_scene.hpp"
#include "test_files.hpp"

namespace mpm_ros {
namespace vtk_test {

namespace fs = std::filesystem;

std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// The content of a .vtp file.
struct PolyData {
  double time = -1.0;
  std::size_t points = 0, verts = 0, lines = 0, polys = 0;
  std::map<std::string, std::string> types;  ///< type of each array, "Float32" or "Float32 x 3"
  std::map<std::string, std::string> bytes;

  template <typename Value>
  std::vector<Value> values(const std::string& name) const {
    std::vector<Value> result(bytes.at(name).size() / sizeof(Value));
    std::memcpy(result.data(), bytes.at(name).data(), bytes.at(name).size());
    return result;
  }
};

PolyData read_vtp(const std::string& path) {
  PolyData result;
  const std::string file = content(path);
  const std::size_t appended = file.find("<AppendedData encoding=\"raw\">");
  EXPECT_NE(appended, std::string::npos) << path;
  const std::string header = file.substr(0, appended);
  const std::size_t data = file.find('_', appended) + 1;
  EXPECT_NE(header.find("header_type=\"UInt64\""), std::string::npos);
  std::smatch found;
  EXPECT_TRUE(std::regex_search(header, found, std::regex("Name=\"TimeValue\"[^>]*>([^<]*)<")));
  result.time = std::stod(found[1]);
  const auto count = [&](const std::string& name) {
    EXPECT_TRUE(std::regex_search(header, found, std::regex(name + "=\"([0-9]+)\""))) << name;
    return static_cast<std::size_t>(std::stoul(found[1]));
  };
  result.points = count("NumberOfPoints");
  result.verts = count("NumberOfVerts");
  result.lines = count("NumberOfLines");
  result.polys = count("NumberOfPolys");
  std::size_t end = data;
  const std::regex array(
      "type=\"([A-Za-z0-9]+)\" Name=\"([^\"]+)\" NumberOfComponents=\"([0-9]+)\" format=\"appended\" "
      "offset=\"([0-9]+)\"");
  for (std::sregex_iterator entry(header.begin(), header.end(), array), last; entry != last; ++entry) {
    const std::string name = (*entry)[2];
    const std::size_t offset = data + std::stoul((*entry)[4]);
    std::uint64_t size = 0;
    std::memcpy(&size, file.data() + offset, sizeof(size));
    EXPECT_EQ(offset, end) << name;  // one after the other
    end = offset + sizeof(size) + size;
    EXPECT_LE(end, file.size()) << name;
    result.types[name] = (*entry)[1].str() + ((*entry)[3] == "1" ? "" : " x " + (*entry)[3].str());
    result.bytes[name] = file.substr(offset + sizeof(size), size);
  }
  EXPECT_EQ(file.substr(end), "\n</AppendedData>\n</VTKFile>\n");
  return result;
}

TEST(Vtk, ATriangleAsTheFormatHasIt) {
  const TemporaryFolder folder;
  VtkFile file(0.25, {0, 0, 0, 1, 0, 0, 0, 2, 0});
  file.draw_triangles();
  file.add("height & width", std::vector<float>{1.5F, -2.5F, 3.5F});
  file.write(folder.file("one.vtp"));
  const PolyData read = read_vtp(folder.file("one.vtp"));
  EXPECT_EQ(read.time, 0.25);
  EXPECT_EQ(read.points, 3U);
  EXPECT_EQ(read.verts, 0U);
  EXPECT_EQ(read.polys, 1U);
  EXPECT_EQ(read.types.at("Points"), "Float32 x 3");
  EXPECT_EQ(read.values<float>("Points"), (std::vector<float>{0, 0, 0, 1, 0, 0, 0, 2, 0}));
  EXPECT_EQ(read.types.at("connectivity"), "Int32");
  EXPECT_EQ(read.values<std::int32_t>("connectivity"), (std::vector<std::int32_t>{0, 1, 2}));
  EXPECT_EQ(read.values<std::int32_t>("offsets"), (std::vector<std::int32_t>{3}));
  EXPECT_EQ(read.values<float>("height &amp; width"), (std::vector<float>{1.5F, -2.5F, 3.5F}));
}

geometry_msgs::Point point(double x, double z) {
  geometry_msgs::Point result;
  result.x = x;
  result.z = z;
  return result;
}

TEST(Vtk, ACrackIsALineAlongEachFace) {
  // From (0, 0) to (3, 4) and on in that direction, which is (0.6, 0.8); to its left is (-0.8, 0.6). At the first point
  // the faces are 0.5 apart across the crack, half of it on either side, and 0.25 along it.
  Cracks message;
  message.cracks.resize(1);
  Crack& crack = message.cracks[0];
  crack.name = "cut";
  crack.points = {point(0, 0), point(3, 4), point(6, 8)};
  crack.above = {point(-0.8 * 0.25 + 0.6 * 0.25, 0.6 * 0.25 + 0.8 * 0.25), point(3, 4), point(6, 8)};
  crack.below = {point(0.8 * 0.25, -0.6 * 0.25), point(3, 4), point(6, 8)};
  crack.normal_traction = {1.0, 2.0, 3.0};
  crack.shear_traction = {4.0, 5.0, 6.0};
  crack.debonded = {1, 0, 0};
  message.tips.resize(1);
  message.tips[0].crack = "cut";
  message.tips[0].end = "end";
  message.tips[0].j = 60.0;
  message.tips[0].k_one = 7.0;
  message.tips[0].k_two = -8.0;
  const TemporaryFolder folder;
  crack_lines(0.5, message).write(folder.file("cracks.vtp"));
  const PolyData read = read_vtp(folder.file("cracks.vtp"));
  EXPECT_EQ(read.time, 0.5);
  EXPECT_EQ(read.points, 6U);
  EXPECT_EQ(read.lines, 2U);
  EXPECT_EQ(read.verts + read.polys, 0U);
  EXPECT_EQ(read.values<std::int32_t>("connectivity"), (std::vector<std::int32_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(read.values<std::int32_t>("offsets"), (std::vector<std::int32_t>{3, 6}));
  EXPECT_EQ(read.values<std::uint32_t>("crack"), (std::vector<std::uint32_t>(6, 1)));
  EXPECT_EQ(read.values<std::uint32_t>("face"), (std::vector<std::uint32_t>{1, 1, 1, 2, 2, 2}));
  EXPECT_EQ(read.values<std::uint32_t>("debonded"), (std::vector<std::uint32_t>{1, 0, 0, 1, 0, 0}));
  EXPECT_EQ(read.values<float>("normal_traction"), (std::vector<float>{1, 2, 3, 1, 2, 3}));
  EXPECT_EQ(read.values<float>("shear_traction"), (std::vector<float>{4, 5, 6, 4, 5, 6}));
  const std::vector<float> places = read.values<float>("Points"), opening = read.values<float>("opening"),
                           slip = read.values<float>("slip"), j = read.values<float>("j"),
                           k_one = read.values<float>("k_one"), k_two = read.values<float>("k_two");
  EXPECT_EQ(places[9], 0.2F);   // the face below, x of its first point: 0.8 x 0.25
  EXPECT_EQ(places[17], 8.0F);  // z of its last
  for (std::size_t k = 0; k < 6; ++k) {
    // Rounded to a float32: 2^-24 of 0.5.
    EXPECT_NEAR(opening[k], k % 3 == 0 ? 0.5 : 0.0, 3e-8) << k;
    EXPECT_NEAR(slip[k], k % 3 == 0 ? 0.25 : 0.0, 3e-8) << k;
    const bool tip = k % 3 == 2;
    EXPECT_EQ(std::isnan(j[k]), !tip) << k;
    if (!tip) continue;
    EXPECT_EQ(j[k], 60.0F);
    EXPECT_EQ(k_one[k], 7.0F);
    EXPECT_EQ(k_two[k], -8.0F);
  }
}

TEST(Vtk, CracksAreWrittenWithEachCloud) {
  const TemporaryFolder folder;
  RunSceneOptions options;
  options.scene = source_file("config/scenes/edge_crack.yaml");
  options.set = {"time.end=1.2e-5"};  // three sync periods, a cloud each, and the one of the start
  options.threads = 1;
  options.vtk = folder.file("vtk");
  std::ostringstream out, err;
  ASSERT_EQ(run_scene(options, out, err, false, [] { return false; }), RunSceneResult::done) << err.str();
  const std::string list = content(options.vtk + "/run.pvd");
  for (int cloud = 0; cloud < 4; ++cloud) {
    const std::string name = "cracks_000" + std::to_string(cloud) + ".vtp";
    EXPECT_NE(list.find("name=\"cracks\" file=\"" + name + "\""), std::string::npos) << list;
    const PolyData cracks = read_vtp(options.vtk + "/" + name);
    EXPECT_NEAR(cracks.time, 4e-6 * cloud, 1e-15);  // decimal digits read back
    EXPECT_EQ(cracks.lines, 2U);
    const std::vector<float> places = cracks.values<float>("Points");
    // From the mouth to the tip, as the scene has them; what little the wave of the load moves them is less than a
    // micrometre, since it has not come there.
    EXPECT_NEAR(places[0], 0.3e-3, 1e-6);
    EXPECT_NEAR(places[places.size() - 3], 10.1e-3, 1e-6);
  }
}

TEST(Vtk, WhatCannotBeWrittenIsNamed) {
  EXPECT_THROW(VtkFile(0.0, {}).write("/no/such/folder/one.vtp"), VtkError);
  const TemporaryFolder folder;
  const test::FullDisk disk(100);
  try {
    VtkFile(0.0, {0, 0, 0}).write(folder.file("one.vtp"));
    ADD_FAILURE() << "written";
  } catch (const VtkError& error) {
    EXPECT_EQ(error.what(), folder.file("one.vtp") + ": cannot be written; check the space on its disk");
  }
}

/// The clouds and bodies of a bag.
class Recorded : public RunVisitor {
 public:
  void bodies(std::int64_t time, const BodyStates& message) override { bodies_at[time] = message; }
  void particles(std::int64_t time, const sensor_msgs::PointCloud2& message) override { clouds[time] = message; }
  void markers(const visualization_msgs::MarkerArray& message) override { shapes = message; }
  std::map<std::int64_t, BodyStates> bodies_at;
  std::map<std::int64_t, sensor_msgs::PointCloud2> clouds;
  visualization_msgs::MarkerArray shapes;
};

TEST(Vtk, ARunHoldsWhatItsBagHolds) {
  const TemporaryFolder folder;
  RunSceneOptions options;
  options.scene = data_file("press.yaml");
  options.set = {"time.end=0.06", "rigid_bodies.plate.motion={velocity: [0.1, -0.2], rotation_rate: 0.5}"};
  options.threads = 1;
  options.vtk = folder.file("vtk");
  options.bag = folder.file("run.bag");
  std::ostringstream out, err;
  ASSERT_EQ(run_scene(options, out, err, false, [] { return false; }), RunSceneResult::done) << err.str();
  Recorded recorded;
  RunBag(options.bag, "").read({&recorded});

  const std::string list = content(options.vtk + "/run.pvd");
  std::vector<std::string> files;
  std::vector<double> times;
  const std::regex entry("<DataSet timestep=\"([^\"]+)\" part=\"[0-9]+\" name=\"[^\"]+\" file=\"([^\"]+)\"/>");
  for (std::sregex_iterator set(list.begin(), list.end(), entry), last; set != last; ++set) {
    times.push_back(std::stod((*set)[1]));
    files.push_back((*set)[2]);
  }
  // Particles, plate and rod at 0, 0.02, 0.04 and 0.06 s.
  ASSERT_EQ(files.size(), 12U) << list;
  for (int cloud = 0; cloud < 4; ++cloud) {
    EXPECT_NEAR(times[3 * static_cast<std::size_t>(cloud)], 0.02 * cloud, 1e-12);  // decimal digits read back
    const std::string number = "_000" + std::to_string(cloud) + ".vtp";
    EXPECT_EQ(files[3 * static_cast<std::size_t>(cloud)], "particles" + number);
    const sensor_msgs::PointCloud2& message = recorded.clouds.at(20'000'000 * cloud);
    const PolyData particles = read_vtp(options.vtk + "/particles" + number);
    EXPECT_EQ(particles.points, message.width);
    EXPECT_EQ(particles.verts, message.width);
    EXPECT_EQ(particles.types.at("id"), "UInt32");
    const std::vector<float> places = particles.values<float>("Points"), j = particles.values<float>("j");
    const std::vector<std::uint32_t> ids = particles.values<std::uint32_t>("id");
    sensor_msgs::PointCloud2ConstIterator<float> x(message, "x"), z(message, "z"), recorded_j(message, "j");
    sensor_msgs::PointCloud2ConstIterator<std::uint32_t> id(message, "id");
    for (std::size_t i = 0; i < message.width; ++i, ++x, ++z, ++recorded_j, ++id) {
      EXPECT_EQ(places[3 * i], *x);
      EXPECT_EQ(places[3 * i + 2], *z);
      EXPECT_EQ(j[i], *recorded_j);
      EXPECT_EQ(ids[i], *id);
    }

    // The plate at its pose: turned about y, then moved.
    const BodyState& plate = recorded.bodies_at.at(20'000'000 * cloud).bodies[0];
    const double angle = 2.0 * std::atan2(plate.pose.orientation.y, plate.pose.orientation.w);
    EXPECT_NEAR(angle, 0.5 * 0.02 * cloud, 1e-12);  // the rate times the time
    const PolyData body = read_vtp(options.vtk + "/body_plate" + number);
    const std::vector<geometry_msgs::Point>& shape = recorded.shapes.markers[0].points;
    EXPECT_EQ(body.polys, shape.size() / 3);
    const std::vector<float> corners = body.values<float>("Points");
    ASSERT_EQ(corners.size(), 3 * shape.size());
    for (std::size_t i = 0; i < shape.size(); ++i) {
      // Rounded to a float32: 2^-24 of 0.2 m.
      EXPECT_NEAR(corners[3 * i], plate.pose.position.x + std::cos(angle) * shape[i].x + std::sin(angle) * shape[i].z,
                  2e-8);
      EXPECT_NEAR(corners[3 * i + 2],
                  plate.pose.position.z - std::sin(angle) * shape[i].x + std::cos(angle) * shape[i].z, 2e-8);
    }
  }
}

}  // namespace vtk_test
}  // namespace mpm_ros
