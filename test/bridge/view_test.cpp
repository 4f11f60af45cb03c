// The view of RViz that shows given particles.
#include "mpm_ros/message/view.hpp"

#include <gtest/gtest.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "mpm_ros/message/particle_cloud.hpp"
#include "mpm_ros/message/particle_colours.hpp"
#include "test_files.hpp"

namespace mpm_ros {
namespace view_test {

/// 5 x 3 x 2 particles 0.1 m apart, from (1, 2, 3) on, with the last axis fastest, as in filled bodies.
sensor_msgs::PointCloud2 lattice(const std::vector<std::string>& fields, bool planar = false) {
  mpm::ParticleColumns cloud_columns;
  std::vector<std::vector<float>>& columns = cloud_columns.values;
  columns.resize(3 + fields.size());
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 2; ++k) {
        columns[0].push_back(1.0F + 0.1F * static_cast<float>(i));
        columns[1].push_back(planar ? 0.0F : 2.0F + 0.1F * static_cast<float>(j));
        columns[2].push_back(3.0F + 0.1F * static_cast<float>(k));
      }
    }
  }
  for (std::size_t f = 3; f < columns.size(); ++f) columns[f].assign(columns[0].size(), 0.0F);
  for (std::uint32_t id = 0; id < columns[0].size(); ++id) cloud_columns.ids.push_back(id);
  sensor_msgs::PointCloud2 cloud;
  fill_cloud(fields, cloud_columns, cloud);
  return cloud;
}

constexpr double kSingle = 1e-6;  // a few roundings of numbers near 3 in single precision

TEST(View, LooksAtTheMiddleOfTheParticles) {
  const View view = view_of(lattice({"vx", "p"}));
  EXPECT_NEAR((view.focus - mpm::Vec3(1.2, 2.1, 3.05)).norm(), 0.0, kSingle);
  EXPECT_NEAR(view.particle_size, 0.1, kSingle);
  // The eye is outside the sphere around the particles.
  EXPECT_GT(view.distance, 0.5 * std::hypot(0.4, 0.2, 0.1));
}

TEST(View, PlanarScenesFromTheFront) {
  const View view = view_of(lattice({"p"}, true));
  EXPECT_NEAR(view.yaw, 1.5 * M_PI, 1e-15);  // the eye is at -y, so that x points to the right
  EXPECT_EQ(view.pitch, 0.0);
}

TEST(View, LooksAtTheDomainWhenItIsKnown) {
  mpm::Box domain;
  domain.add({0.0, -2.0, 1.0});
  domain.add({4.0, 2.0, 3.0});
  const View view = view_of(lattice({"p"}), {}, domain);
  EXPECT_EQ(view.focus, mpm::Vec3(2.0, 0.0, 2.0));
  EXPECT_GT(view.distance, 3.0);                  // the domain's half diagonal
  EXPECT_NEAR(view.particle_size, 0.1, kSingle);  // still that of the particles
  // A planar scene has its particles in one plane, whatever y its domain has.
  EXPECT_EQ(view_of(lattice({"p"}, true), {}, domain).focus, mpm::Vec3(2.0, 0.0, 2.0));
}

TEST(View, ColoursByWhatIsThere) {
  EXPECT_EQ(view_of(lattice({"vx", "p", "speed"})).field, "speed");
  EXPECT_EQ(view_of(lattice({"vx", "p"})).field, "p");
  EXPECT_EQ(view_of(lattice({"vx", "j"})).field, "vx");
  EXPECT_EQ(view_of(lattice({})).field, "");
  EXPECT_EQ(view_of(lattice({"vx", "speed"}), "vx").field, "vx");
  EXPECT_EQ(view_of(lattice({"vx", "speed"}), "ep").field, "speed");  // "ep" is asked for, but not recorded
}

TEST(View, AnEmptyCloudHasSomeView) {
  sensor_msgs::PointCloud2 cloud;
  fill_cloud({"p"}, {{}, {{}, {}, {}, {}}}, cloud);
  EXPECT_GT(view_of(cloud).distance, 0.0);
}

TEST(View, IsPutIntoTheShippedConfiguration) {
  std::ifstream file(source_file("config/rviz/mpm.rviz"));
  std::stringstream text;
  text << file.rdbuf();
  View view;
  view.focus = {1.0, 2.0, 3.0};
  view.distance = 4.5;
  view.floor = 2.5;
  view.particle_size = 0.02;
  view.field = "ep";
  const YAML::Node root = YAML::Load(with_view(text.str(), view, "/other/"));
  const YAML::Node manager = root["Visualization Manager"];
  int clouds = 0, arrays = 0, grids = 0;
  for (const YAML::Node& display : manager["Displays"]) {
    const auto type = display["Class"].as<std::string>();
    if (type == "rviz/PointCloud2") {
      ++clouds;
      EXPECT_EQ(display["Topic"].as<std::string>(), "/other/particles");
      EXPECT_EQ(display["Channel Name"].as<std::string>(), "ep");
      EXPECT_EQ(display["Size (m)"].as<double>(), 0.02);
    } else if (type == "rviz/Grid") {
      ++grids;
      EXPECT_EQ(display["Cell Size"].as<double>(), 0.5);  // the round number below 0.15 x 4.5
      EXPECT_EQ(display["Plane"].as<std::string>(), "XY");
      EXPECT_EQ(display["Offset"]["Z"].as<double>(), 2.5 - 0.01);  // half a particle below the lowest one
    } else if (type == "rviz/MarkerArray") {
      ++arrays;
      EXPECT_EQ(display["Marker Topic"].as<std::string>().find("/other/"), 0U);
    }
  }
  EXPECT_EQ(clouds, 1);
  EXPECT_EQ(grids, 1);
  EXPECT_EQ(arrays, 3);  // tools, contact forces, cracks
  const YAML::Node eye = manager["Views"]["Current"];
  EXPECT_EQ(eye["Distance"].as<double>(), 4.5);
  EXPECT_EQ(eye["Focal Point"]["Z"].as<double>(), 3.0);
}

TEST(View, DrawsSmallParticlesOfPlanarScenesFlat) {
  std::ifstream file(source_file("config/rviz/mpm.rviz"));
  std::stringstream text;
  text << file.rdbuf();
  const auto style = [&](bool planar, double size) {
    View view;  // shows a radius of 1 / 2.4 m
    view.planar = planar;
    view.particle_size = size;
    for (const YAML::Node& display :
         YAML::Load(with_view(text.str(), view, "/"))["Visualization Manager"]["Displays"]) {
      if (display["Class"].as<std::string>() == "rviz/PointCloud2") return display["Style"].as<std::string>();
    }
    return std::string();
  };
  EXPECT_EQ(style(true, 0.004), "Flat Squares");
  EXPECT_EQ(style(true, 0.005), "Spheres");
  EXPECT_EQ(style(false, 0.004), "Spheres");
}

TEST(View, ShowsTheColouredParticlesAndTheirBar) {
  std::ifstream file(source_file("config/rviz/mpm.rviz"));
  std::stringstream text;
  text << file.rdbuf();
  View view;
  view.field = "ep";
  view.coloured = "/watch_1/particles";
  view.bar = "/watch_1/colour_bar";
  const YAML::Node root = YAML::Load(with_view(text.str(), view, "/mpm/"));
  const YAML::Node displays = root["Visualization Manager"]["Displays"];
  for (const YAML::Node& display : displays) {
    if (display["Class"].as<std::string>() != "rviz/PointCloud2") continue;
    EXPECT_EQ(display["Topic"].as<std::string>(), "/watch_1/particles");
    EXPECT_EQ(display["Color Transformer"].as<std::string>(), "RGB8");
  }
  const YAML::Node bar = displays[displays.size() - 1];
  EXPECT_EQ(bar["Marker Topic"].as<std::string>(), "/watch_1/colour_bar");
}

/// A hundred particles along x with the values 0 to 98 and one outlier.
sensor_msgs::PointCloud2 with_outlier(float outlier) {
  mpm::ParticleColumns columns;
  columns.values.resize(4);
  for (std::uint32_t i = 0; i < 100; ++i) {
    columns.ids.push_back(i);
    columns.values[0].push_back(static_cast<float>(i));
    columns.values[1].push_back(0.0F);
    columns.values[2].push_back(0.5F);
    columns.values[3].push_back(i < 99 ? static_cast<float>(i) : outlier);
  }
  sensor_msgs::PointCloud2 cloud;
  fill_cloud({"speed"}, columns, cloud);
  return cloud;
}

TEST(ParticleColours, AnOutlierDoesNotSetTheRange) {
  ParticleColours colours("speed");
  const sensor_msgs::PointCloud2 coloured = colours.colour(with_outlier(1e6F));
  EXPECT_EQ(colours.low(), 0.0);    // the 1st per cent, 0 or 1, lies so near to 0 that the range begins there
  EXPECT_EQ(colours.high(), 98.0);  // the 99th
  sensor_msgs::PointCloud2ConstIterator<float> x(coloured, "x"), z(coloured, "z");
  sensor_msgs::PointCloud2ConstIterator<std::uint8_t> rgb(coloured, "rgb");
  EXPECT_EQ(*(x + 7), 7.0F);
  EXPECT_EQ(*(z + 7), 0.5F);
  const auto sum = [&](int i) { return int((rgb + i)[0]) + int((rgb + i)[1]) + int((rgb + i)[2]); };
  EXPECT_GT(sum(0), sum(50));  // dark is the upper end, as in the pictures of bag_report
  EXPECT_GT(sum(50), sum(98));
  EXPECT_EQ(sum(98), sum(99));  // beyond the end: its colour
}

TEST(ParticleColours, TheRangeWidensAtOnceAndNarrowsSlowly) {
  ParticleColours colours("speed");
  sensor_msgs::PointCloud2 rest = with_outlier(0.0F);
  for (sensor_msgs::PointCloud2Iterator<float> value(rest, "speed"); value != value.end(); ++value) *value = 0.0F;
  colours.colour(rest);
  EXPECT_EQ(colours.high(), 0.0);
  colours.colour(with_outlier(0.0F));
  EXPECT_EQ(colours.high(), 97.0);  // the second largest of 0, 0, 1 ... 98
  colours.colour(rest);
  EXPECT_NEAR(colours.high(), 0.95 * 97.0, 1e-12);
}

mpm::Vec3 place_of(const geometry_msgs::Point& point) { return {point.x, point.y, point.z}; }

TEST(ParticleColours, TheBarStandsInThePictureWhereverItIsSeenFrom) {
  ParticleColours colours("speed");
  colours.colour(with_outlier(0.0F));
  for (const bool planar : {false, true}) {
    View view = view_of(lattice({"speed"}, planar));
    view.bar = "/watch/colour_bar";
    std::ifstream file(source_file("config/rviz/mpm.rviz"));
    std::stringstream text;
    text << file.rdbuf();
    const YAML::Node eye =
        YAML::Load(with_view(text.str(), view, "/mpm/"))["Visualization Manager"]["Views"]["Current"];
    const YAML::Node at = eye["Focal Point"];
    const mpm::Vec3 target(at["X"].as<double>(), at["Y"].as<double>(), at["Z"].as<double>());
    // RViz's orbit: the eye lies at yaw and pitch from the target. A half of its picture is as high as the tangent of
    // half of 45 degrees, and with the panels of a window of 1360 x 860 pixels 1.27 times as wide.
    const double yaw = eye["Yaw"].as<double>(), pitch = eye["Pitch"].as<double>();
    const mpm::Vec3 back(std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch), std::sin(pitch));
    const mpm::Vec3 right = mpm::Vec3::UnitZ().cross(back).normalized(), up = back.cross(right);
    const double half = std::tan(M_PI / 8.0) * eye["Distance"].as<double>();
    const visualization_msgs::MarkerArray bar = colours.bar(view, "world");
    ASSERT_EQ(bar.markers.size(), 5U);
    const auto expect_inside = [&](const mpm::Vec3& point, double beside) {
      const mpm::Vec3 away = point - target;
      EXPECT_NEAR(away.dot(back), 0.0, 1e-6 * half);  // neither in front of the target nor behind it
      EXPECT_GT(away.dot(right), 0.5 * half);
      EXPECT_LT(away.dot(right) + beside, 1.27 * half);
      EXPECT_LT(std::abs(away.dot(up)), half);
    };
    const mpm::Vec3 middle = place_of(bar.markers[0].pose.position);
    ASSERT_EQ(bar.markers[0].points.size(), bar.markers[0].colors.size());
    for (const geometry_msgs::Point& corner : bar.markers[0].points) expect_inside(middle + place_of(corner), 0.0);
    for (std::size_t i = 1; i < bar.markers.size(); ++i) {
      const auto& label = bar.markers[i];  // a letter is about half as wide as high
      expect_inside(place_of(label.pose.position), 0.25 * label.scale.z * static_cast<double>(label.text.size()));
    }
  }
}

TEST(ParticleColours, TheBarsEndsHaveThreeDigits) {
  const auto labels = [](float largest) {
    ParticleColours colours("speed");
    sensor_msgs::PointCloud2 cloud = with_outlier(0.0F);
    for (sensor_msgs::PointCloud2Iterator<float> value(cloud, "speed"); value != value.end(); ++value) {
      *value *= largest / 97.0F;  // 97 is at the 99th per cent
    }
    colours.colour(cloud);
    const visualization_msgs::MarkerArray bar = colours.bar(View(), "world");
    return std::vector<std::string>{bar.markers[1].text, bar.markers[2].text, bar.markers[3].text, bar.markers[4].text};
  };
  // The reference grid's cell is the round number below 0.15 times the eye's distance of 1 m.
  EXPECT_EQ(labels(0.05786F), (std::vector<std::string>{"speed [m/s]", "0.0579", "0", "grid 0.1 m"}));
  EXPECT_EQ(labels(97.0F)[1], "97.0");
  EXPECT_EQ(labels(5082.0F)[1], "5080");
  EXPECT_EQ(labels(2.5e7F)[1], "2.50e+07");
}

TEST(View, RefusesWhatIsNoConfiguration) {
  EXPECT_THROW(with_view("Displays: [", View(), "/mpm/"), std::runtime_error);
}

}  // namespace view_test
}  // namespace mpm_ros
