// rigid_bodies: the source of a body's commands, and its limits.
#include <gtest/gtest.h>

#include "scene_tool.hpp"
#include "test_files.hpp"

namespace mpm {
namespace scene_drive_test {

const std::string kBall = "sphere: {radius: 0.1}";

CommandDefinition commands(const std::string& rest, const std::string& shape = kBall) {
  const Scene read = parse_scene(scene("solid", shape, rest), "good.yaml");
  EXPECT_EQ(read.commands.size(), 1U);
  return read.commands.at(0);
}

void expect_refused(const std::string& rest, const std::string& where, const std::string& what) {
  mpm::expect_refused(scene("solid", kBall, rest), where, what);
}

TEST(SceneDrive, WithoutKeysABodyTakesAnyCommandOnTopics) {
  const CommandDefinition none = commands("");
  EXPECT_TRUE(none.frame.empty());
  EXPECT_FALSE(none.limits.any());
}

TEST(SceneDrive, ABodyFollowsAFrame) {
  EXPECT_EQ(commands("drive: {tf: left/tool0}").frame, "left/tool0");
  EXPECT_EQ(commands("drive: tf").frame, "tool");  // the body's name
  const std::string link = "urdf: {file: " + data_file("robot/tool.urdf") + ", link: scoop}";
  EXPECT_EQ(commands("drive: tf", link).frame, "scoop");
  EXPECT_EQ(commands("drive: {tf: tool0}", link).frame, "tool0");
}

TEST(SceneDrive, LimitsAreOfNormsInSi) {
  const MotionLimits limits =
      commands("limits: {speed: 50 mm/s, rotation_rate: 180 deg/s, acceleration: 2, rotation_acceleration: 3 rad/s^2}")
          .limits;
  EXPECT_EQ(limits.speed, 0.05);
  EXPECT_NEAR(limits.rotation_rate, 3.14159265358979, 1e-14);
  EXPECT_EQ(limits.acceleration, 2.0);
  EXPECT_EQ(limits.rotation_acceleration, 3.0);
  EXPECT_EQ(commands("limits: {speed: 1}").limits.acceleration, MotionLimits::kNone);
}

TEST(SceneDrive, WhatCannotBeMeantIsRefused) {
  expect_refused("drive: velocity", "drive", "leave drive out");
  expect_refused("drive: tff", "drive", "'tf'");
  expect_refused("drive: {tf: /tool0}", "drive.tf", "without a slash before it");
  expect_refused("drive: {frame: tool0}", "drive.frame", "unknown key");
  expect_refused("drive: tf, motion: {velocity: [0, 0, 1]}", "drive", "motion or a frame, not both");
  expect_refused("drive: tf, free: {mass: 1}", "drive", "a free body moves by forces");
  expect_refused("limits: {}", "limits", "limits nothing");
  expect_refused("limits: {speed: 0}", "limits.speed", "is not greater than 0");
  expect_refused("limits: {acceleration: 1 m/s}", "limits.acceleration",
                 "is a velocity, but an acceleration is expected");
  expect_refused("limits: {rotation_acceleration: 1 m/s}", "limits.rotation_acceleration",
                 "is a velocity, but a rotational acceleration is expected; write one such as 90 deg/s^2");
  expect_refused("limits: {velocity: 1}", "limits.velocity", "write speed");
}

}  // namespace scene_drive_test
}  // namespace mpm
