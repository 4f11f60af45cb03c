// The collision geometry of a robot's links, out of test/data/robot/tool.urdf. Distances by hand from its figures.
#include "mpm/rigid/urdf.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "scene_tool.hpp"
#include "test_files.hpp"

namespace mpm {
namespace urdf_test {

namespace fs = std::filesystem;

const std::string kRobot = data_file("robot/tool.urdf");
constexpr double kRound = 1e-12;  // for lengths of 1 m; the file has 17 digits of a quarter of a turn

std::string message(const std::string& path, const std::string& link) {
  try {
    load_urdf_link(path, link);
  } catch (const RigidError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "no error";
}

void expect_unreadable(const std::string& path, const std::string& link, const std::string& what) {
  const std::string found = message(path, link);
  EXPECT_EQ(found.substr(0, path.size() + 2), path + ": ");
  EXPECT_NE(found.find(what), std::string::npos) << found;
}

/// A file with these children of the link `tool`.
class UrdfFile {
 public:
  explicit UrdfFile(const std::string& children, const std::string& before = "")
      : path_((fs::path(::testing::TempDir()) / "urdf_test.urdf").string()) {
    std::ofstream(path_) << "<robot name=\"r\" xmlns:xacro=\"http://ros.org/wiki/xacro\">" << before
                         << "<link name=\"tool\">\n"
                         << children << "</link></robot>";
  }
  ~UrdfFile() { fs::remove(path_); }
  std::string message() const { return urdf_test::message(path_, "tool"); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

const std::string kBox = "<collision><geometry><box size=\"0.4 0.2 0.1\"/></geometry></collision>\n";

// urdfdom gives a link without the element that it cannot read and without those that follow: once a tool was the first
// box alone, without a word.
TEST(Urdf, ACollisionThatCannotBeReadIsRefusedByItsPlaceAndReason) {
  const std::pair<const char*, const char*> bad[] = {
      {"<collision name=\"b\"><geometry><capsule radius=\"1\" length=\"1\"/></geometry></collision>", "capsule"},
      {"<collision name=\"b\"><geometry><mesh filename=\"a.obj\" scale=\"0.1\"/></geometry></collision>", "scale"},
      {"<collision name=\"b\"><geometry><sphere/></geometry></collision>", "radius"},
      {"<collision name=\"b\"><geometry><box size=\"${w} 1 1\"/></geometry></collision>", "expand it first: xacro"},
      {"<collision name=\"b\"><origin xyz=\"0 1\"/><geometry><sphere radius=\"1\"/></geometry></collision>",
       "2 elements but 3 expected"},
      {"<collision name=\"b\"><geometry/></collision>", "no child element"},
      {"<collision name=\"b\"><geometry><sphere radius=\"1\"/><box size=\"1 1 1\"/></geometry></collision>",
       "its geometry holds sphere and box; write a collision element for each"},
  };
  for (const auto& [element, reason] : bad) {
    const UrdfFile file(kBox + element + kBox);
    const std::string found = file.message();
    EXPECT_NE(found.find("line 3: link 'tool': collision 2 'b': "), std::string::npos) << found;
    EXPECT_NE(found.find(reason), std::string::npos) << found;
  }
  const std::string first = UrdfFile(bad[0].first + kBox).message();
  EXPECT_NE(first.find("line 2: link 'tool': collision 1 'b': "), std::string::npos) << first;
  EXPECT_NE(
      UrdfFile(kBox + "<xacro:teeth n=\"5\"/>").message().find("line 3: xacro:teeth is of xacro; expand it first"),
      std::string::npos);
}

TEST(Urdf, ABadVisualOrInertialHidesNoCollision) {
  for (const char* bad : {"<visual><geometry><capsule radius=\"1\" length=\"1\"/></geometry></visual>\n",
                          "<inertial><mass value=\"heavy\"/></inertial>\n", "<visual><origin xyz=\"0\"/></visual>"}) {
    const UrdfFile file(bad + kBox + "<collision><origin xyz=\"0 0 1\"/><geometry><sphere radius=\"0.1\"/>" +
                        "</geometry></collision>");
    EXPECT_NEAR(load_urdf_link(file.path(), "tool")->bounds().max.z(), 1.1, kRound) << bad;
  }
}

TEST(Urdf, WhatTheParserWouldNotSurviveOrWaitForIsRefused) {
  std::string deep;
  for (int i = 0; i < 50000; ++i) deep += "<a>";
  EXPECT_NE(UrdfFile(kBox, deep).message().find("line 1: elements lie in each other more than 100 deep"),
            std::string::npos);
  const std::string quoted = UrdfFile(kBox, "<!-- <a><a> --><x b=\"<a><a>\" c='>'/>").message();
  EXPECT_EQ(quoted, "no error") << "what is no element has no depth";
  EXPECT_NE(message("/dev/zero", "tool").find("it is a device, a pipe or a socket"), std::string::npos);
  EXPECT_NE(message("/", "tool").find("it is a folder"), std::string::npos);
}

TEST(Urdf, SeveralCollisionElementsAreOneBodyEachAtItsOrigin) {
  const auto scoop = load_urdf_link(kRobot, "scoop");
  // The box is turned by a quarter about z: 0.2 along x. The ball stands at y = 0.3.
  EXPECT_NEAR(scoop->at({0.3, 0.0, 0.1}).distance, 0.2, kRound);
  EXPECT_NEAR((scoop->at({0.3, 0.0, 0.1}).normal - Vec3::UnitX()).norm(), 0.0, kRound);
  EXPECT_NEAR(scoop->at({0.0, 0.6, 0.1}).distance, 0.15, kRound);
  EXPECT_NEAR(scoop->at({0.0, -0.3, 0.1}).distance, 0.1, kRound);
}

TEST(Urdf, ACylinderLiesAlongItsOwnZ) {
  const auto probe = load_urdf_link(kRobot, "probe");
  // Rolled by a quarter about x: along y, from -0.1 to 0.1.
  EXPECT_NEAR(probe->at({0.5, 0.3, 0.0}).distance, 0.2, kRound);
  EXPECT_NEAR(probe->at({0.5, 0.0, 0.05}).distance, 0.04, kRound);
  EXPECT_NEAR(probe->at({0.5, 0.0, 0.0}).distance, -0.01, kRound);
}

TEST(Urdf, AMeshIsScaledAlongEachAxisAndMayBeMirrored) {
  const auto wedge = load_urdf_link(kRobot, "wedge");
  // Corners at the origin, (0.1, 0, 0), (0, 0.2, 0) and (0, 0, -0.3).
  EXPECT_NEAR((wedge->bounds().max - Vec3(0.1, 0.2, 0.0)).norm(), 0.0, kRound);
  EXPECT_NEAR((wedge->bounds().min - Vec3(0.0, 0.0, -0.3)).norm(), 0.0, kRound);
  EXPECT_LT(wedge->at({0.01, 0.02, -0.03}).distance, 0.0);  // mirrored, and not inside out
  EXPECT_NEAR(wedge->at({0.01, 0.02, 0.5}).distance, 0.5, kRound);
}

TEST(Urdf, WhatCannotBeABodyIsRefused) {
  expect_unreadable(kRobot, "scop", "it has no link 'scop'; did you mean 'scoop'?");
  expect_unreadable(kRobot, "camera",
                    "link 'camera' has no collision geometry; links that have: lost, probe, scoop, wedge");
  expect_unreadable(kRobot, "lost", "link 'lost': collision 1: ");
  EXPECT_NE(message(kRobot, "lost").find("nowhere.obj: no such file"), std::string::npos);
  expect_unreadable("/no/such/robot.urdf", "scoop", "no such file");
  expect_unreadable(data_file("press.yaml"), "scoop", "cannot be read as a URDF: ");
}

TEST(Urdf, ALinkIsTheShapeOfATool) {
  const RigidBodyDefinition scoop = tool("solid", "urdf: {file: " + kRobot + ", link: scoop}");
  EXPECT_NEAR(scoop.surface->at({0.3, 0.0, 0.1}).distance, 0.2, kRound);
  expect_refused(scene("plane_strain", "urdf: {file: a.urdf, link: b}"), "shape.urdf", "a robot's link is of a solid");
  expect_refused(scene("solid", "urdf: {file: nowhere.urdf, link: b}"), "shape.urdf", "nowhere.urdf: no such file");
  expect_refused(scene("solid", "urdf: {link: b}"), "shape.urdf", "file");
  expect_refused(scene("solid", "urdf: {parameter: robot_description, link: b}"), "shape.urdf.parameter",
                 "a scene is read without ROS");
}

TEST(Urdf, AMeshIsToBeSoThickAndABoxIsNot) {
  const auto refused = [](const std::string& link, double thinnest) {
    try {
      load_urdf_link(kRobot, link, thinnest);
    } catch (const RigidError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refused("wedge", 1.0).find("link 'wedge': collision 1: half of the mesh is less than "), std::string::npos);
  EXPECT_EQ(refused("wedge", 0.01), "");
  EXPECT_EQ(refused("scoop", 1.0), "");  // 0.1 m thick
}

}  // namespace urdf_test
}  // namespace mpm
