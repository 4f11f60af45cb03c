// Several surfaces as one: distances and normals of parts that are moved and turned, against values computed by hand.
#include "mpm/rigid/compound.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mpm {
namespace compound_test {

constexpr double kRound = 1e-14;  // round-off of numbers of size 1, after a rotation

Quat about_z(double angle) { return Quat(Eigen::AngleAxisd(angle, Vec3::UnitZ())); }

std::shared_ptr<const Surface> box() { return make_box({0.4, 0.2, 0.1}); }
std::shared_ptr<const Surface> ball() { return make_sphere(0.15); }

TEST(Compound, OnePartIsThatPartWhereItIsPut) {
  const auto turned = make_compound({{box(), {{0.0, 0.0, 0.1}, about_z(0.5 * M_PI)}}});
  // Turned by 90 degrees about z, it is 0.2 along x and 0.4 along y.
  EXPECT_NEAR(turned->at({0.3, 0.0, 0.1}).distance, 0.2, kRound);
  EXPECT_NEAR((turned->at({0.3, 0.0, 0.1}).normal - Vec3::UnitX()).norm(), 0.0, kRound);
  EXPECT_NEAR(turned->at({0.0, 0.3, 0.1}).distance, 0.1, kRound);
  EXPECT_NEAR(turned->at({0.0, 0.0, 0.1}).distance, -0.05, kRound);
  EXPECT_NEAR((turned->bounds().max - Vec3(0.1, 0.2, 0.15)).norm(), 0.0, kRound);
  EXPECT_NEAR((turned->bounds().min - Vec3(-0.1, -0.2, 0.05)).norm(), 0.0, kRound);
  EXPECT_EQ(turned->thickness(), 0.1);
}

TEST(Compound, TheNearestPartCounts) {
  const auto body = make_compound({{box(), {}}, {ball(), {{0.3, 0.0, 0.0}, Quat::Identity()}}});
  EXPECT_NEAR(body->at({-0.3, 0.0, 0.0}).distance, 0.1, kRound);  // the end of the box
  EXPECT_NEAR(body->at({0.6, 0.0, 0.0}).distance, 0.15, kRound);  // the ball
  EXPECT_NEAR(body->at({0.3, 0.0, 0.0}).distance, -0.15, kRound);
  EXPECT_NEAR((body->bounds().max - Vec3(0.45, 0.15, 0.15)).norm(), 0.0, kRound);
  EXPECT_EQ(body->thickness(), 0.1);  // that of the box; the ball's is 0.3
  EXPECT_EQ(body->triangles().size(), box()->triangles().size() + ball()->triangles().size());
}

TEST(Compound, WithinIsAtUpToTheBand) {
  const auto body =
      make_compound({{box(), {{0.0, 0.1, 0.0}, about_z(0.3)}}, {ball(), {{0.3, 0.0, 0.0}, about_z(1.0)}}});
  std::mt19937_64 dice(7);
  std::uniform_real_distribution<double> place(-0.6, 0.6);
  int near = 0;
  for (int i = 0; i < 10000; ++i) {
    const Vec3 point(place(dice), place(dice), place(dice));
    const SurfacePoint exact = body->at(point);
    SurfacePoint found;
    const bool within = body->within(point, 0.05, found);
    ASSERT_EQ(within, exact.distance <= 0.05) << point.transpose();
    if (!within) continue;
    ++near;
    EXPECT_EQ(found.distance, exact.distance);
    EXPECT_EQ(found.normal, exact.normal);
  }
  EXPECT_GT(near, 200);  // bodies and bands fill about 0.06 of 1.7 m^3: 350 points
}

TEST(Compound, PartsThatCannotBeAreRefused) {
  EXPECT_THROW(make_compound({}), RigidError);
  EXPECT_THROW(make_compound({{make_plane(Vec3::UnitZ()), {}}}), RigidError);
}

}  // namespace compound_test
}  // namespace mpm
