// Robots that are refused: the place, what is wrong, and what to do, in one line.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"
#include "robot_case.hpp"

namespace bad_robot_test {

using namespace mpm;
using namespace robot_test;

std::string scene_of(const std::string& robot) {
  return R"(
name: bad
gravity: [0, 0, -9.81]
grid: {cell: 0.1, min: [-1, -1, -1], max: [1, 1, 1]}
time: {end: 0.1}
materials: [{name: clay, law: j2_plasticity, density: 1800, young: 2 MPa, poisson: 0.4, yield_stress: 10 kPa}]
bodies: [{name: bed, material: clay, shape: {box: {min: [-1, -1, -1], max: [1, 1, 0]}}}]
robots:
)" + robot;
}

/// The refusal of a scene; empty where it is taken.
std::string refusal(const std::string& robot) {
  try {
    parse_scene(scene_of(robot), "bad.yaml");
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

void expect_refused(const std::string& robot, const std::vector<std::string>& words) {
  const std::string answer = refusal(robot);
  EXPECT_EQ(answer.find('\n'), std::string::npos) << answer;
  for (const std::string& word : words) EXPECT_NE(answer.find(word), std::string::npos) << word << ": " << answer;
}

/// A URDF of one moving link, with these elements more.
std::string urdf_of(const std::string& link, const std::string& joint, const std::string& more = {}) {
  const std::string file = testing::TempDir() + "bad_robot.urdf";
  std::ofstream(file) << "<robot name=\"r\">\n<link name=\"base\"/>\n<link name=\"arm\">" << link
                      << "</link>\n<joint name=\"j\" " << joint
                      << "<parent link=\"base\"/><child link=\"arm\"/></joint>\n"
                      << more << "</robot>\n";
  return file;
}

const std::string kInertial =
    "<inertial><mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>";
const std::string kHinge =
    "type=\"revolute\"><axis xyz=\"0 0 1\"/><limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/>";

std::string robot_of(const std::string& urdf, const std::string& keys = {}) {
  return fmt::format("  - {{name: r, urdf: {}{}}}\n", urdf, keys);
}

TEST(BadRobot, AGoodOneIsTaken) { EXPECT_EQ(refusal(robot_of(urdf_of(kInertial, kHinge))), ""); }

TEST(BadRobot, NamesThatAreNotThere) {
  const std::string arm = data_file("arm.urdf");
  expect_refused(robot_of(arm, ", joints: {elbw: {drive: velocity}}"), {"bad.yaml:9", "elbw", "elbow"});
  expect_refused(robot_of(arm, ", joints: {flange: {drive: velocity}}"), {"bad.yaml:9", "fixed"});
  expect_refused(robot_of(arm, ", links: {lod: {}}"), {"bad.yaml:9", "lod", "load"});
  expect_refused(robot_of(arm, ", links: {load: {}}"), {"bad.yaml:9", "no collision geometry"});
  expect_refused(robot_of(arm, ", sensors: [wrst]"), {"bad.yaml:9", "wrst", "wrist"});
  expect_refused(robot_of(arm, ", base: floating"), {"bad.yaml:9", "base"});
  expect_refused(robot_of("nowhere.urdf"), {"bad.yaml:9", "nowhere.urdf"});
}

TEST(BadRobot, NumbersThatDoNotFit) {
  const std::string arm = data_file("arm.urdf");
  expect_refused(robot_of(arm, ", joints: {elbow: {position: 3}}"), {"bad.yaml:9", "limits", "2"});
  expect_refused(robot_of(arm, ", joints: {elbow: {drive: velocity, stiffness: 3}}"), {"stiffness", "by position"});
  expect_refused(robot_of(arm, ", joints: {elbow: {drive: position, damping: 3}}"), {"damping", "stiffness"});
  expect_refused(robot_of(arm, ", joints: {elbow: {drive: position, effort: 0}}"), {"effort", "greater than 0"});
  expect_refused(robot_of(arm, ", joints: {elbow: {drive: position, target: 0.5, position: 0}}"),
                 {"jump", "stiffness"});
  expect_refused(robot_of(arm, ", base: free"), {"base", "'base'", "inertia"});
}

TEST(BadRobot, FilesThatAreNoRobot) {
  expect_refused(robot_of(urdf_of("", kHinge)), {"bad_robot.urdf", "line 3", "'arm'", "<inertial>"});
  expect_refused(robot_of(urdf_of(kInertial, "type=\"floating\">")), {"line 4", "'j'", "base: free"});
  expect_refused(robot_of(urdf_of(kInertial, "type=\"continuous\"><axis xyz=\"0 0 0\"/>")), {"'j'", "axis"});
  expect_refused(robot_of(urdf_of(kInertial, kHinge + "<mimic joint=\"k\"/>")), {"'j'", "mimics 'k'"});
  expect_refused(robot_of(urdf_of(kInertial, kHinge,
                                  "<link name=\"other\">" + kInertial +
                                      "</link><joint name=\"k\" type=\"fixed\"><parent link=\"other\"/><child "
                                      "link=\"arm\"/></joint><joint name=\"l\" type=\"fixed\"><parent "
                                      "link=\"base\"/><child link=\"other\"/></joint>")),
                 {"'arm'", "closed loops"});
  std::ofstream(testing::TempDir() + "broken.urdf") << "<robot name=\"r\"><link name=\"base\">";
  expect_refused(robot_of(testing::TempDir() + "broken.urdf"), {"broken.urdf", "URDF"});
}

TEST(BadRobot, CommandsThatAJointCannotFollow) {
  std::vector<RigidBody> none;
  Robot robot(load("arm.urdf", JointDrive::position), kGravity, none);
  EXPECT_THROW(robot.find_joint("elbw"), RigidError);
  EXPECT_THROW(robot.find_joint("flange"), RigidError);
  EXPECT_THROW(robot.check_command(1, 2.5), RigidError);
  EXPECT_THROW(robot.check_command(1, std::nan("")), RigidError);
  EXPECT_THROW(robot.check_trajectory(1, {{0.2, 0.0, 0.0}, {0.1, 0.0, 0.0}}, 0.0), RigidError);
  EXPECT_THROW(robot.check_trajectory(1, {{0.1, 0.0, 0.0}}, 0.2), RigidError);
  EXPECT_THROW(robot.check_trajectory(1, {{0.1, 2.5, 0.0}}, 0.0), RigidError);
}

}  // namespace bad_robot_test
