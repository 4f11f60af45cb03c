// Planes, capsules and height fields in scenes: their meaning in each geometry, and refusals.
#include <sys/stat.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <regex>
#include <string>

#include "scene_tool.hpp"

namespace mpm {
namespace scene_surfaces_test {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(SceneSurfaces, APlaneInEachGeometry) {
  for (const std::string geometry : {"solid", "plane_strain", "axisymmetric"}) {
    EXPECT_EQ(tool(geometry, "plane: {}").surface->at({3.0, 2.0, 0.25}).distance, 0.25) << geometry;
  }
  EXPECT_EQ(tool("axisymmetric", "plane: {normal: [0, -2]}").surface->at({3.0, 2.0, 0.25}).distance, -0.25);
  EXPECT_EQ(tool("line", "plane: {normal: -1}").surface->at({0.5, 0.0, 0.0}).distance, -0.5);
  EXPECT_EQ(tool("line", "plane: {}").surface->at({0.5, 0.0, 0.0}).normal, Vec3::UnitX());
  EXPECT_NEAR(tool("plane_strain", "plane: {normal: [3, 4]}").surface->at({1.0, 9.0, 1.0}).distance, 1.4, 1e-15);
  EXPECT_NEAR(tool("solid", "plane: {normal: [0, 3, 4]}").surface->at({9.0, 1.0, 1.0}).distance, 1.4, 1e-15);
  // A pose turns the plane: the roll takes z to -y.
  const RigidBodyDefinition turned = tool("solid", "plane: {}", "pose: {position: [0, 1, 0], rpy: [90 deg, 0, 0]}");
  EXPECT_NEAR(turned.surface->at(turned.pose.to_body({5.0, 0.75, 7.0})).distance, 0.25, 1e-14);  // rounding of 7
}

TEST(SceneSurfaces, ACapsuleInEachGeometry) {
  const Box upright = tool("solid", "capsule: {radius: 10 cm, length: 0.4, axis: y}").surface->bounds();
  EXPECT_LT((upright.max - Vec3(0.1, 0.3, 0.1)).norm(), 1e-15);
  EXPECT_EQ(tool("axisymmetric", "capsule: {radius: 0.1, length: 0.4}").surface->bounds().max.z(), 0.2 + 0.1);
  const auto stadium = tool("plane_strain", "capsule: {radius: 0.1, length: 0.4, axis: x}").surface;
  EXPECT_EQ(stadium->bounds().max, Vec3(0.2 + 0.1, kInfinity, 0.1));
}

TEST(SceneSurfaces, AHeightFieldFromAListAndAnExpression) {
  const auto roof = tool("plane_strain", "height_field: {x: [-1, 1], heights: [0, 100 cm, 0]}").surface;
  EXPECT_NEAR(roof->at({0.0, 0.0, 2.0}).distance, 1.0, 1e-15);
  // Rows run along y: the field rises along y only.
  const auto ramp = tool("solid", "height_field: {x: [0, 1], y: [0, 3], heights: [[0, 0], [3, 3]]}").surface;
  EXPECT_NEAR(ramp->at({0.5, 1.0, 2.0}).distance, std::sqrt(0.5), 1e-15);
  // An expression is evaluated at the points x = 0, 0.25, …; by default they have the spacing of the grid, 0.1.
  const auto coarse = tool("plane_strain", "height_field: {x: [0, 1], heights: x^2, cells: 4}").surface;
  EXPECT_NEAR(coarse->at({0.25, 0.0, 0.0625}).distance, 0.0, 1e-15);
  EXPECT_LT(coarse->at({0.125, 0.0, 0.125 * 0.125}).distance, -0.01);
  const auto fine = tool("plane_strain", "height_field: {x: [0, 1], heights: x^2}").surface;
  EXPECT_NEAR(fine->at({0.3, 0.0, 0.09}).distance, 0.0, 1e-15);
  EXPECT_LT(fine->at({0.35, 0.0, 0.35 * 0.35}).distance, -1e-3);
  const auto saddle = tool("solid", "height_field: {x: [-1, 1], y: [0, 1], heights: x*y, cells: [4, 2]}").surface;
  EXPECT_NEAR(saddle->at({-0.5, 0.5, -0.25}).distance, 0.0, 1e-15);
}

class SceneHeightFile : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }
  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("mpm_height_test_" + std::to_string(std::random_device{}()));
};

TEST_F(SceneHeightFile, TextRowByRow) {
  const std::string file = write("ramp.csv", "# millimetres\n0, 0, 0\n3000 3000 3000\n");
  const std::string keys = "height_field: {x: [0, 1], y: [0, 3], scale: 1 mm, file: " + file + "}";
  EXPECT_NEAR(tool("solid", keys).surface->at({0.5, 1.0, 2.0}).distance, std::sqrt(0.5), 1e-15);
  for (const char* text : {"0, 1, 0", "0\n1\n0\n"}) {
    const std::string profile = "height_field: {x: [-1, 1], file: " + write("profile.csv", text) + "}";
    EXPECT_NEAR(tool("plane_strain", profile).surface->at({0.0, 0.0, 2.0}).distance, 1.0, 1e-15);
  }
}

// Maps as spreadsheets and other programs write them, which were once taken for other maps without a word.
TEST_F(SceneHeightFile, TextThatIsAnotherMapIsRefusedWithItsLine) {
  const auto refused = [&](const std::string& text, const std::string& what) {
    const std::string keys = "height_field: {x: [0, 1], y: [0, 1], file: " + write("map.txt", text) + "}";
    expect_refused(scene("solid", keys), "shape.height_field.file", what);
    expect_refused(scene("solid", "height_field: {x: [0, 1], y: [0, 1], table: \"" +
                                      std::regex_replace(std::regex_replace(text, std::regex("\n"), "\\n"),
                                                         std::regex("\t"), "\\t") +
                                      "\"}"),
                   "shape.height_field.table", what);
  };
  refused("0,1\t0,2\n0,3\t0,4\n",
          ":1: commas and blanks both divide its numbers, so that '1 0' stands between commas: if these are decimal");
  refused("1\t2\n1\t0,5\n", ":2: commas and blanks both divide");
  refused("0,1 0,2\n0,3 0,4\n", ":1: commas and blanks both divide");
  refused("0,1;0,2\n0,3;0,4\n", "write commas or blanks between numbers, and decimal points");
  refused("0.1,0.2,0.3\n0.1,,0.3\n", ":2: nothing stands in the place of number 2");
  refused("0.1,0.2\n,0.3\n", ":2: nothing stands in the place of number 1");
  refused("0.1,0.2,\n0.1,0.2,\n", ":1: nothing stands in the place of number 3");
  std::string places, holed;
  for (int i = 0; i < 12; ++i) {
    const std::string row = std::to_string(0.25 * (i % 4)) + " " + std::to_string(0.5 * (i / 4)) + " 0.3\n";
    places += row;
    if (i != 5) holed += row;
  }
  refused(places, "its 12 rows of three numbers are a list of points, x, y and height; write the heights alone");
  refused(holed, "its 11 rows of three numbers are a list of points");
  // Three heights a row are a map, also where the first two columns hold few different numbers.
  const std::string three = write("three.csv", "0 1 0\n1 0 0\n0 0 0\n0 1 0\n1 0 0\n0 0 0\n1 1 0\n");
  EXPECT_NO_THROW(tool("solid", "height_field: {x: [0, 1], y: [0, 1], file: " + three + "}"));
}

TEST_F(SceneHeightFile, AByteOrderMarkIsNoHeight) {
  const std::string file = write("bom.csv",
                                 "\xEF\xBB\xBF"
                                 "0,0,0\n3,3,3\n");
  const std::string keys = "height_field: {x: [0, 1], y: [0, 3], file: " + file + "}";
  EXPECT_NEAR(tool("solid", keys).surface->at({0.5, 1.0, 2.0}).distance, std::sqrt(0.5), 1e-15);
}

TEST_F(SceneHeightFile, WhatIsNoFileOrTooLargeIsRefused) {
  const auto refused = [](const std::string& rest, const std::string& where, const std::string& what) {
    expect_refused(scene("solid", "height_field: {x: [0, 1], y: [0, 1], " + rest + "}"), "shape.height_field." + where,
                   what);
  };
  const std::string pipe = (folder_ / "pipe.tif").string();
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  refused("file: " + pipe, "file", "pipe.tif: it is a device, a pipe or a socket; name a regular file");
  refused("file: " + folder_.string(), "file", "it is a folder; name a file");
  refused("file: /dev/zero", "file", "it is a device");
  // A tool is drawn and searched as triangles; ground is not (scene_terrain_test).
  refused("scale: 1, file: " + write("wide.pgm", "P5 2000 1000 255 0"), "file",
          "2000 x 1000 points are more than 1048576, the most that a map of a rigid body may have");
  refused("heights: x, cells: [2000, 1000]", "cells", "write fewer cells");
}

TEST_F(SceneHeightFile, AnImageWithItsTopAtHighY) {
  // The image is dark below and white (3 m) above, in 8 bits plain and 16 bits binary.
  const std::string plain = write("plain.pgm", "P2 # dark below\n2 2\n255\n255 255\n0 0\n");
  const std::string binary = write("binary.pgm", std::string("P5 2 2 65535\n\xff\xff\xff\xff\0\0\0\0", 21));
  for (const std::string& file : {plain, binary}) {
    const std::string keys = "height_field: {x: [0, 1], y: [0, 3], scale: 3, file: " + file + "}";
    EXPECT_NEAR(tool("solid", keys).surface->at({0.5, 1.0, 2.0}).distance, std::sqrt(0.5), 1e-15);
  }
}

TEST_F(SceneHeightFile, FilesThatHoldNoFieldAreRefused) {
  const auto refused = [](const std::string& file, const std::string& what, const std::string& more = "") {
    expect_refused(scene("solid", "height_field: {x: [0, 1], y: [0, 1], file: " + file + more + "}"),
                   "shape.height_field.file", what);
  };
  refused("/no/such.csv", "no such file; check the path");
  refused(write("words.csv", "0, 1\n0, high\n"), "words.csv:2: 'high' is not a number");
  refused(write("ragged.csv", "0, 1\n0\n"), "ragged.csv:2: 1 numbers, but 2 in the rows before");
  refused(write("one.csv", "0, 1\n"), "two points at least along each axis");
  refused(write("nan.csv", "0, nan\n0, 0\n"),
          "1 of its points under the body have no height, the first at x = 1 m, y = 0 m");
  refused(write("no_scale.pgm", "P2 2 2 1 0 0 0 0"), "write scale");
  refused(write("colour.pgm", "P3 2 2 1 0 0 0 0"), "not a greyscale image", ", scale: 1");
  refused(write("short.pgm", "P2 2 2 1 0 0 0"), "ends early", ", scale: 1");
  refused(write("bright.pgm", "P2 2 2 1 0 0 0 7"), "above its white", ", scale: 1");
}

TEST(SceneSurfaces, WhatIsNoSuchShapeIsRefused) {
  const auto refused = [](const std::string& geometry, const std::string& shape, const std::string& where,
                          const std::string& what) { expect_refused(scene(geometry, shape), "shape." + where, what); };
  refused("solid", "plane: {normal: [0, 0, 0]}", "plane.normal", "its length is 0");
  refused("axisymmetric", "plane: {normal: [1, 1]}", "plane.normal", "not a body of revolution");
  refused("solid", "plane: {point: [0, 0, 0]}", "plane.point", "put it by pose");
  refused("line", "capsule: {radius: 1, length: 1}", "capsule", "a line has no capsule");
  refused("plane_stress", "capsule: {radius: 1, length: 1, axis: y}", "capsule.axis", "write x or z");
  refused("axisymmetric", "capsule: {radius: 1, length: 1, axis: x}", "capsule.axis", "write z, or leave it out");
  refused("solid", "capsule: {radius: 1, length: 0}", "capsule.length", "");
  const std::string field = "height_field: {x: [0, 1]";
  refused("axisymmetric", field + ", heights: [0, 1]}", "height_field", "write revolved");
  refused("line", field + ", heights: [0, 1]}", "height_field", "a line has no height field");
  refused("plane_strain", field + ", y: [0, 1], heights: [0, 1]}", "height_field.y", "leave it out");
  refused("plane_strain", field + "}", "height_field", "heights or file; write one of them");
  refused("plane_strain", field + ", heights: [0, 1], file: a.csv}", "height_field", "write one of them");
  refused("plane_strain", field + ", heights: [0]}", "height_field.heights", "two points at least");
  refused("plane_strain", field + ", heights: [0, 1], cells: 4}", "height_field.cells", "leave it out");
  refused("plane_strain", field + ", heights: [0, 1], scale: 4}", "height_field.scale", "belongs to file");
  refused("plane_strain", field + ", heights: 1/x}", "height_field.heights", "");
  refused("plane_strain", field + ", heights: x, cells: 0}", "height_field.cells", "write 1 to 4096");
  refused("plane_strain", "height_field: {x: [1, 0], heights: x}", "height_field.x", "write [from, to]");
  refused("solid", field + ", y: [0, 1], heights: [[0, 1], [0]]}", "height_field.heights.1", "2 in the first row");
  refused("solid", field + ", y: [0, 1], heights: x, cells: 3}", "height_field.cells", "");
}

}  // namespace scene_surfaces_test
}  // namespace mpm
