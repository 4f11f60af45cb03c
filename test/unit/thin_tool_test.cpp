// The side of a thin tool on which a point lies, and whether the tool is between two points.
#include "mpm/contact/thin_tool.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mpm {
namespace thin_tool_test {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

RigidBody body_of(std::unique_ptr<Surface> surface, const Pose& pose = {}) {
  RigidBodyDefinition definition;
  definition.name = "tool";
  definition.surface = std::move(surface);
  definition.pose = pose;
  return RigidBody(definition);
}

TEST(ThinTool, APlateHasTheSidesOfItsPlaneHoweverItLies) {
  const Quat turn(Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, 3.0).normalized()));
  const RigidBody plate = body_of(make_box({1.0, 0.8, 0.05}), {{0.3, -0.2, 0.5}, turn});
  const ThinTool tool(plate, GeometryKind::solid);
  EXPECT_EQ(tool.distinguished(), 1.0);
  // The second point lies far beyond the edge of the tool.
  for (const Vec3& along : {Vec3(0.1, -0.2, 0.0), Vec3(2.0, 1.0, 0.0)}) {
    const int above = tool.side(plate.pose().to_world(along + Vec3(0.0, 0.0, 0.02)));
    EXPECT_NE(above, tool.side(plate.pose().to_world(along - Vec3(0.0, 0.0, 0.02))));
    EXPECT_EQ(above, tool.side(plate.pose().to_world(along + Vec3(0.0, 0.0, 2.0))));
  }
}

TEST(ThinTool, ABodyOfThreeCellsIsNotThin) {
  RigidBodyDefinition cube;
  cube.name = "cube";
  cube.surface = make_box({0.3, 0.3, 0.3});
  EXPECT_FALSE(is_thin(cube, GeometryKind::solid, 0.1));  // 3 x 0.1 is more than 0.3 in doubles
  cube.surface = make_box({0.3, 0.3, 0.299});
  EXPECT_TRUE(is_thin(cube, GeometryKind::solid, 0.1));
}

TEST(ThinTool, ItIsBetweenPointsWhoseLineMeetsIt) {
  const RigidBody plate = body_of(make_box({1.0, kInfinite, 0.001}), {{1.0, 0.0, 2.0}, Quat::Identity()});
  const ThinTool tool(plate, GeometryKind::plane_strain);
  EXPECT_TRUE(tool.between({1.2, 0.0, 1.9}, {1.3, 0.0, 2.1}));
  EXPECT_FALSE(tool.between({1.2, 0.0, 2.1}, {1.3, 0.0, 2.3}));   // above it
  EXPECT_FALSE(tool.between({1.5, 0.0, 1.9}, {1.52, 0.0, 2.1}));  // past its edge at x = 1.5, which it meets at 1.51
  EXPECT_TRUE(tool.between({1.48, 0.0, 1.9}, {1.51, 0.0, 2.1}));  // at 1.495
  EXPECT_TRUE(tool.between({1.2, 0.0, 2.0}, {1.2, 0.0, 2.0}));
}

// A tube with a wall of 1 cm has an inside and an outside. In the half plane of an axisymmetric scene its section is a
// plate.
TEST(ThinTool, ATubeHasAnInsideAndAnOutside) {
  const RigidBody tube = body_of(make_ring(0.3, 0.31, 0.5));
  for (const GeometryKind geometry : {GeometryKind::solid, GeometryKind::axisymmetric}) {
    const ThinTool tool(tube, geometry);
    EXPECT_GT(tool.distinguished(), 0.99);
    const int inside = tool.side({0.25, 0.0, 0.1});
    EXPECT_EQ(inside, tool.side({0.05, 0.0, 0.2}));
    EXPECT_NE(inside, tool.side({0.35, 0.0, 0.1}));
    if (geometry == GeometryKind::solid) {
      EXPECT_EQ(inside, tool.side({-0.15, 0.2, -0.1}));
      EXPECT_NE(inside, tool.side({-0.25, 0.25, -0.1}));
    }
  }
}

// A washer counts as a plate although it is empty in the middle.
TEST(ThinTool, AWasherIsAPlate) {
  const RigidBody washer = body_of(make_ring(0.3, 0.6, 0.02));
  for (const GeometryKind geometry : {GeometryKind::solid, GeometryKind::axisymmetric}) {
    const ThinTool tool(washer, geometry);
    EXPECT_EQ(tool.distinguished(), 1.0);
    EXPECT_NE(tool.side({0.4, 0.0, 0.05}), tool.side({0.4, 0.0, -0.05}));
    EXPECT_EQ(tool.side({0.4, 0.0, 0.05}), tool.side({0.1, 0.0, 0.05}));
  }
}

TEST(ThinTool, AWireHasABeforeAndABehind) {
  RigidBody wire = body_of(make_cylinder(0.05, kInfinite, 1));
  ThinTool tool(wire, GeometryKind::plane_strain);
  EXPECT_NE(tool.side({0.0, 0.0, 0.1}), tool.side({0.0, 0.0, -0.1}));
  wire.command_velocity({{2.0, 0.0, 0.1}, Vec3::Zero()});
  wire.begin_step(0.0, 1e-3);
  tool.aim();
  EXPECT_NE(tool.side({0.1, 0.0, 0.0}), tool.side({-0.1, 0.0, 0.0}));
  wire.command_velocity({{2.0, 0.0, 1.0}, Vec3::Zero()});  // 24 degrees farther: the side does not change
  wire.begin_step(0.0, 1e-3);
  tool.aim();
  EXPECT_EQ(tool.side({0.1, 0.0, 0.0}), tool.side({0.1, 0.0, -0.25}));
}

TEST(ThinTool, OnTheAxisARodHasOneSide) {
  const double cell = 0.1;
  const RigidBodyDefinition rod = body_of(make_cylinder(0.05, 2.0)).definition();
  EXPECT_TRUE(is_thin(rod, GeometryKind::solid, cell));
  EXPECT_FALSE(is_thin(rod, GeometryKind::axisymmetric, cell));
  const RigidBodyDefinition disk = body_of(make_cylinder(1.0, 0.1)).definition();
  EXPECT_TRUE(is_thin(disk, GeometryKind::axisymmetric, cell));
  const RigidBodyDefinition tube = body_of(make_ring(0.5, 0.6, 2.0)).definition();
  EXPECT_TRUE(is_thin(tube, GeometryKind::axisymmetric, cell));
  EXPECT_FALSE(is_thin(tube, GeometryKind::axisymmetric, 0.03));
}

}  // namespace thin_tool_test
}  // namespace mpm
