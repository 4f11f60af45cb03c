// Sample points on surfaces: counts, places, normals and areas of simple bodies, computed by hand.
#include "mpm/implicit/surface_samples.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "mesh_shapes.hpp"
#include "mpm/math/constants.hpp"
#include "mpm/rigid/compound.hpp"

namespace mpm {
namespace surface_samples_test {

using Samples = std::vector<SurfaceSample>;

constexpr double kRound = 1e-12;  // round-off of sums of hundreds of numbers of size 1
constexpr auto kPlane = GeometryKind::plane_strain;
constexpr auto kSpace = GeometryKind::solid;

double total_area(const Samples& samples) {
  double area = 0.0;
  for (const SurfaceSample& sample : samples) area += sample.area;
  return area;
}

auto count(const Samples& samples, const std::function<bool(const SurfaceSample&)>& what) {
  return std::count_if(samples.begin(), samples.end(), what);
}

auto count_facing(const Samples& samples, const Vec3& normal) {
  return count(samples, [&](const SurfaceSample& s) { return (s.normal - normal).norm() < kRound; });
}

/// Expects that each point has one opposite it, at -place, with the opposite normal and the same area.
void expect_mirrored(const Samples& samples) {
  for (const SurfaceSample& sample : samples) {
    EXPECT_EQ(count(samples,
                    [&](const SurfaceSample& s) {
                      return (s.place + sample.place).norm() < kRound && (s.normal + sample.normal).norm() < kRound &&
                             std::abs(s.area - sample.area) < kRound;
                    }),
              1)
        << sample.place.transpose();
  }
}

void expect_on(const Surface& surface, const Samples& samples) {
  for (const SurfaceSample& sample : samples) {
    EXPECT_NEAR(surface.at(sample.place).distance, 0.0, kRound) << sample.place.transpose();
    EXPECT_NEAR(sample.normal.norm(), 1.0, kRound);
    EXPECT_GT(sample.area, 0.0);
  }
}

// Faces of 0.4 and 0.2 m in parts of 0.05 m: 2 (8 + 4) points, each in the middle of its part.
TEST(SurfaceSamples, OfABoxInAPlaneAreTheMiddlesOfEqualParts) {
  const auto box = make_box({0.4, kInfinity, 0.2});
  const Samples samples = sample_surface(*box, kPlane, {0.05, 0.0});
  ASSERT_EQ(samples.size(), 24u);
  EXPECT_NEAR(total_area(samples), 1.2, kRound);  // 2 (0.4 + 0.2)
  expect_on(*box, samples);
  expect_mirrored(samples);
  for (int k = 0; k < 8; ++k) {
    const Vec3 place(-0.175 + 0.05 * k, 0.0, 0.1);
    EXPECT_EQ(count(samples,
                    [&](const SurfaceSample& s) {
                      return (s.place - place).norm() < kRound && (s.normal - Vec3::UnitZ()).norm() < kRound &&
                             std::abs(s.area - 0.05) < kRound;
                    }),
              1)
        << k;
  }
  for (const SurfaceSample& sample : samples) EXPECT_EQ(sample.normal.y(), 0.0);
}

// The first points are 0.025 m from the corners. The long faces are 8 spacings long and lose one at each end; the short
// ones, of 4, are narrower than 6 spacings and lose none.
TEST(SurfaceSamples, NearACornerAreLeftOutUnlessTheFaceIsNarrow) {
  const Samples samples = sample_surface(*make_box({0.4, kInfinity, 0.2}), kPlane, {0.05, 0.05});
  EXPECT_EQ(samples.size(), 20u);
  EXPECT_EQ(count_facing(samples, Vec3::UnitZ()), 6);
  EXPECT_EQ(count_facing(samples, Vec3::UnitX()), 4);
  for (const SurfaceSample& s : samples) {
    if (std::abs(s.normal.z()) > 0.5) {
      EXPECT_GE(0.2 - std::abs(s.place.x()), 0.05) << s.place.transpose();
    }
  }
}

// The disc is drawn as a polygon of 48 sides, 2 R sin(pi/48) each.
TEST(SurfaceSamples, OfADiscLieOnItsArc) {
  const double radius = 0.1, around = 48.0 * 2.0 * radius * std::sin(kPi / 48.0);
  const auto disc = make_cylinder(radius, kInfinity, 1);
  const Samples samples = sample_surface(*disc, kPlane, {0.02, 0.02});
  EXPECT_EQ(samples.size(), 31u);  // 0.6279 / 0.02 = 31.4; a round outline has no corners to keep clear of
  EXPECT_NEAR(total_area(samples), around, kRound);
  expect_on(*disc, samples);
  for (const SurfaceSample& s : samples) EXPECT_NEAR((s.normal - s.place / radius).norm(), 0.0, kRound);
}

// A notch has two convex corners beside it and two concave ones in it. Lengths by hand, as 0.05 m parts: the bottom 12,
// sides 8 each, lands 4 each (narrow), walls of the notch 4 each (narrow), its floor 4.
TEST(SurfaceSamples, OfAPolygonKeepClearOfConvexCornersOnly) {
  const Profile profile = {{-0.3, 0.0}, {0.3, 0.0},  {0.3, 0.4},  {0.1, 0.4},
                           {0.1, 0.2},  {-0.1, 0.2}, {-0.1, 0.4}, {-0.3, 0.4}};
  const auto polygon = make_polygon(profile);
  const Samples all = sample_surface(*polygon, kPlane, {0.05, 0.0});
  EXPECT_EQ(all.size(), 48u);
  EXPECT_NEAR(total_area(all), 2.4, kRound);
  const Samples clear = sample_surface(*polygon, kPlane, {0.05, 0.03});
  EXPECT_EQ(clear.size(), 48u - 2u - 4u);  // two of the bottom and two of each side, 0.025 m from a corner
  // A wide notch: its floor of 8 parts ends at concave corners, and keeps all.
  const Profile wide = {{-0.5, 0.0}, {0.5, 0.0},  {0.5, 0.4},  {0.2, 0.4},
                        {0.2, 0.2},  {-0.2, 0.2}, {-0.2, 0.4}, {-0.5, 0.4}};
  const Samples floor = sample_surface(*make_polygon(wide), kPlane, {0.05, 0.03});
  EXPECT_EQ(
      count(floor, [](const SurfaceSample& s) { return std::abs(s.place.z() - 0.2) < kRound && s.normal.z() > 0.5; }),
      8);
}

// The straight part of the stadium, 0.2 m on each side, and two half circles drawn with 2 x 8 chords of 2 R sin(pi/32).
TEST(SurfaceSamples, OfACapsuleInAPlaneGoAllAround) {
  for (const int axis : {0, 2}) {
    const auto capsule = make_capsule(0.1, 0.2, axis, true);
    const Samples samples = sample_surface(*capsule, kPlane, {0.02, 0.02});
    const double around = 0.4 + 32.0 * 0.2 * std::sin(kPi / 32.0);
    EXPECT_EQ(samples.size(), static_cast<std::size_t>(std::lround(around / 0.02)));
    EXPECT_NEAR(total_area(samples), around, 1e-9);
    expect_on(*capsule, samples);
  }
}

// Samples of the half section: the mantle, 0.3 m high, and two radii of 0.4 m; nothing on the axis, which is no edge
// either.
TEST(SurfaceSamples, InAxisymmetryLieOnTheHalfSection) {
  const auto cylinder = make_cylinder(0.4, 0.3);
  const Samples samples = sample_surface(*cylinder, GeometryKind::axisymmetric, {0.05, 0.0});
  EXPECT_EQ(samples.size(), 22u);
  EXPECT_NEAR(total_area(samples), 1.1, kRound);
  expect_on(*cylinder, samples);
  for (const SurfaceSample& s : samples) EXPECT_GT(s.place.x(), 0.0);
  const Samples clear = sample_surface(*cylinder, GeometryKind::axisymmetric, {0.05, 0.03});
  // Parts begin 0.025 m from the rims, and on the axis: eight of 0.375 m, and five of 0.25 m.
  EXPECT_EQ(count_facing(clear, Vec3::UnitZ()), 8);
  EXPECT_EQ(count_facing(clear, Vec3::UnitX()), 5);
  EXPECT_NEAR(total_area(clear), 2.0 * 0.375 + 0.25, kRound);
  for (const SurfaceSample& s : clear) {
    EXPECT_LT(s.place.x(), s.normal.x() > 0.5 ? 0.4 + kRound : 0.375 - 0.4 * 0.375 / 8.0);
    EXPECT_LT(std::abs(s.place.z()), s.normal.x() > 0.5 ? 0.1 + kRound : 0.15 + kRound);
  }
  // A ball's half section is drawn with 16 chords.
  const auto ball = make_sphere(0.1);
  const Samples round = sample_surface(*ball, GeometryKind::axisymmetric, {0.02, 0.02});
  EXPECT_NEAR(total_area(round), 16.0 * 0.2 * std::sin(kPi / 32.0), kRound);
  expect_on(*ball, round);
}

// 2 (8 x 4 + 4 x 6 + 8 x 6) points at 0.05 m; the area is 2 (a b + b c + c a).
TEST(SurfaceSamples, OfABoxInSpaceAreARegularGrid) {
  const auto box = make_box({0.4, 0.2, 0.3});
  const Samples samples = sample_surface(*box, kSpace, {0.05, 0.0});
  EXPECT_EQ(samples.size(), 208u);
  EXPECT_NEAR(total_area(samples), 2.0 * (0.08 + 0.06 + 0.12), kRound);
  expect_on(*box, samples);
  expect_mirrored(samples);
  EXPECT_EQ(count_facing(samples, Vec3::UnitZ()), 32);
  EXPECT_EQ(count_facing(samples, -Vec3::UnitX()), 24);
}

// Along x a face is 8 spacings wide and loses a row at each end; along y, 4, and z, 3, it is narrow.
TEST(SurfaceSamples, OfABoxInSpaceKeepClearOfEdgesAlongTheWideAxisOfAFace) {
  const Samples samples = sample_surface(*make_box({0.4, 0.2, 0.15}), kSpace, {0.05, 0.03});
  EXPECT_EQ(count_facing(samples, Vec3::UnitZ()), 6 * 4);
  EXPECT_EQ(count_facing(samples, Vec3::UnitY()), 6 * 3);
  EXPECT_EQ(count_facing(samples, Vec3::UnitX()), 4 * 3);
  expect_mirrored(samples);
}

// As the box, of which it is the surface.
TEST(SurfaceSamples, OfAMeshOfABoxAreThoseOfTheBox) {
  const Vec3 half(0.2, 0.1, 0.15);
  const SampleRules rules{0.05, 0.03};
  const Samples of_box = sample_surface(*make_box(2.0 * half), kSpace, rules);
  const Samples of_mesh = sample_surface(*make_mesh(box_mesh(-half, half)), kSpace, rules);
  ASSERT_EQ(of_mesh.size(), of_box.size());
  for (const SurfaceSample& sample : of_box) {
    EXPECT_EQ(count(of_mesh,
                    [&](const SurfaceSample& s) {
                      return (s.place - sample.place).norm() < kRound && (s.normal - sample.normal).norm() < kRound &&
                             std::abs(s.area - sample.area) < kRound;
                    }),
              1);
  }
}

// The mantle is drawn as 48 rectangles, and the ends as polygons of 48 corners.
TEST(SurfaceSamples, OfACylinderInSpaceLieOnMantleAndEnds) {
  const double radius = 0.2, height = 0.5;
  const double mantle = 48.0 * 2.0 * radius * std::sin(kPi / 48.0) * height;
  const double ends = 48.0 * radius * radius * std::sin(2.0 * kPi / 48.0);  // two of 24 R^2 sin
  const auto cylinder = make_cylinder(radius, height);
  const Samples samples = sample_surface(*cylinder, kSpace, {0.04, 0.0});
  EXPECT_NEAR(total_area(samples), mantle + ends, 1e-9);
  expect_on(*cylinder, samples);

  const Samples clear = sample_surface(*cylinder, kSpace, {0.04, 0.03});
  EXPECT_LT(clear.size(), samples.size());
  EXPECT_GT(clear.size(), samples.size() / 2);
  const double sagitta = radius * (1.0 - std::cos(kPi / 48.0));  // sagitta of the chord that is drawn for the rim
  for (const SurfaceSample& s : clear) {
    const Vec3 radial(s.place.x(), s.place.y(), 0.0);
    if (std::abs(s.normal.z()) < 0.5) {
      EXPECT_NEAR((s.normal - radial / radius).norm(), 0.0, kRound);
      EXPECT_GE(0.5 * height - std::abs(s.place.z()), 0.03 - sagitta);
    } else {
      EXPECT_GE(radius - radial.norm(), 0.03 - sagitta);
    }
  }
  EXPECT_GT(count(clear, [](const SurfaceSample& s) { return std::abs(s.normal.z()) < 0.5; }), 0);
  EXPECT_GT(count_facing(clear, Vec3::UnitZ()), 0);
  // A disc with a mantle of 2.5 spacings is narrow along z: none of the mantle's points is left out.
  const auto disc = make_cylinder(radius, 0.1);
  const auto on_mantle = [](const SurfaceSample& s) { return std::abs(s.normal.z()) < 0.5; };
  EXPECT_EQ(count(sample_surface(*disc, kSpace, {0.04, 0.03}), on_mantle),
            count(sample_surface(*disc, kSpace, {0.04, 0.0}), on_mantle));
}

// Points are gathered over a quarter of the mantle here, and lie deeper below it than below the disc's ends.
TEST(SurfaceSamples, OfAThinDiscFarApartLieOnItsMantle) {
  const auto disc = make_cylinder(0.1, 0.02);
  const Samples samples = sample_surface(*disc, kSpace, {0.2, 0.0});
  expect_on(*disc, samples);
  EXPECT_GE(count(samples, [](const SurfaceSample& s) { return std::abs(s.normal.z()) < 0.5; }), 4);
}

// Two boxes of 0.4 x 0.2 x 0.2 m that overlap along 0.1 m in x, and are shifted by 0.05 m along y and z.
TEST(SurfaceSamples, InsideAnotherPartOfACompoundAreLeftOut) {
  const std::shared_ptr<const Surface> box = make_box({0.4, 0.2, 0.2});
  const auto body = make_compound({{box, {}}, {box, {{0.3, 0.05, 0.05}, Quat::Identity()}}});
  const Samples samples = sample_surface(*body, kSpace, {0.025, 0.0});
  expect_on(*body, samples);
  // Each box loses its end of 0.2 x 0.2 m where the other one covers it, 0.15 x 0.15 m, and from four sides the strips
  // of 0.1 m under the other one: 0.15 m wide on two. The borders of all are borders of cells of 0.025 m.
  const double whole = 2.0 * (2.0 * 0.04 + 4.0 * 0.08);
  EXPECT_NEAR(total_area(samples), whole - 2.0 * (0.15 * 0.15 + 2.0 * 0.1 * 0.15), 1e-9);
}

// A ball of 0.1 m around the end of a rod of 0.06 m: it loses what is in the rod, a cap of the height 0.1 - 0.08 m
// where the rod enters it, with 2 pi R h; the rod keeps its sides from there on, 0.5 - 0.08 m, and the other end.
// Borders are those of cells and of the drawn triangles, so areas are right to some per cent.
TEST(SurfaceSamples, OfABallOnARodLieOnTheWholeBody) {
  const std::shared_ptr<const Surface> ball = make_sphere(0.1), rod = make_cylinder(0.06, 0.5, 0);
  const auto body = make_compound({{ball, {}}, {rod, {{0.25, 0.0, 0.0}, Quat::Identity()}}});
  const Samples samples = sample_surface(*body, kSpace, {0.01, 0.0});
  expect_on(*body, samples);
  const double of_ball = 2.0 * kPi * 0.1 * (0.2 - 0.02);
  const double of_rod = 2.0 * kPi * 0.06 * (0.5 - 0.08) + kPi * 0.06 * 0.06;
  EXPECT_NEAR(total_area(samples), of_ball + of_rod, 0.02 * (of_ball + of_rod));
  const Samples clear = sample_surface(*body, kSpace, {0.01, 0.01});
  // The outer rim is an edge, that inside the ball is none, and the joint is concave.
  EXPECT_NEAR(total_area(samples) - total_area(clear), 2.0 * kPi * 0.06 * 0.01 + kPi * (0.06 * 0.06 - 0.05 * 0.05),
              0.0025);
}

// A box that stands on another one: an edge inside the other one is none, nor is the concave one around its foot.
TEST(SurfaceSamples, OfACompoundKeepClearOfEdgesOfTheWholeBody) {
  const std::shared_ptr<const Surface> plate = make_box({0.4, 0.4, 0.1}), post = make_box({0.1, 0.1, 0.4});
  const auto body = make_compound({{plate, {}}, {post, {{0.0, 0.0, 0.2}, Quat::Identity()}}});
  const Samples samples = sample_surface(*body, kSpace, {0.05, 0.03});
  // The plate's top: 8 x 8 cells, without the outer row and the four under the post.
  EXPECT_EQ(count(samples, [](const SurfaceSample& s) { return s.normal.z() > 0.5 && s.place.z() < 0.1; }), 36 - 4);
  // A side of the post: 2 x 8 cells, of which the lower one is inside the plate and the upper row near the top's edge.
  EXPECT_EQ(count(samples, [](const SurfaceSample& s) { return s.normal.x() > 0.5 && s.place.x() < 0.1; }), 2 * 6);
}

// The drawn area is that of the triangles.
TEST(SurfaceSamples, OfASphereLieOnItAndHaveTheDrawnArea) {
  const auto ball = make_sphere(0.3);
  double drawn = 0.0;
  for (const auto& [a, b, c] : ball->triangles()) drawn += 0.5 * (b - a).cross(c - a).norm();
  for (const double spacing : {0.05, 0.1, 0.5, 2.0}) {  // also wider than the ball, where its two sides come together
    const Samples samples = sample_surface(*ball, kSpace, {spacing, 0.05});
    EXPECT_NEAR(total_area(samples), drawn, 1e-9) << spacing;
    expect_on(*ball, samples);
    Vec3 sum = Vec3::Zero();
    for (const SurfaceSample& s : samples) {
      EXPECT_NEAR((s.normal - s.place / 0.3).norm(), 0.0, kRound);
      sum += s.area * s.place;
    }
    EXPECT_NEAR(sum.norm(), 0.0, 1e-3 * drawn * 0.3) << spacing;  // but for the diagonals of the triangles
    EXPECT_GE(samples.size(), 8u);
  }
}

// A half space drawn 0.4 m wide: what is drawn of its face, and nothing of the slab's other sides; no edges.
TEST(SurfaceSamples, OfAPlaneAreThoseOfItsDrawnFace) {
  const auto plane = make_plane(Vec3::UnitZ(), 0.4);
  const Samples in_space = sample_surface(*plane, kSpace, {0.05, 0.03});
  EXPECT_EQ(in_space.size(), 64u);
  EXPECT_EQ(count_facing(in_space, Vec3::UnitZ()), 64);
  EXPECT_EQ(sample_surface(*plane, kPlane, {0.05, 0.03}).size(), 8u);
  EXPECT_EQ(sample_surface(*plane, GeometryKind::axisymmetric, {0.05, 0.03}).size(), 4u);
  const auto tilted = make_plane(Vec3(1.0, 0.0, 2.0), 0.4);
  EXPECT_EQ(sample_surface(*tilted, kPlane, {0.05, 0.03}).size(), 8u);
}

// Drawn 0.4 m long, as it is wide, in 48 strips of 2 R sin(pi/48); its ends are none, nor are the edges there.
TEST(SurfaceSamples, OfACylinderWithoutEndLieOnItsMantle) {
  const auto cylinder = make_cylinder(0.2, kInfinity);
  const Samples samples = sample_surface(*cylinder, kSpace, {0.04, 0.03});
  EXPECT_NEAR(total_area(samples), 48.0 * 0.4 * std::sin(kPi / 48.0) * 0.4, 1e-9);
  expect_on(*cylinder, samples);
}

// The top, 9 pieces of 0.1 m on a slope of 1 in 10, and the sides as deep below the lowest height as the field is wide.
TEST(SurfaceSamples, OfAHeightFieldInAPlaneAreThoseOfTopAndSides) {
  HeightGrid grid;
  grid.low = {0.0, 0.0};
  grid.high = {0.9, 0.0};
  grid.columns = 10;
  for (int i = 0; i < 10; ++i) grid.heights.push_back(0.01 * i);
  const auto field = make_height_field(grid);
  const Samples samples = sample_surface(*field, kPlane, {0.05, 0.0});
  EXPECT_EQ(count_facing(samples, Vec3(-0.1, 0.0, 1.0).normalized()), 18);  // 0.9045 m
  EXPECT_EQ(count_facing(samples, -Vec3::UnitX()), 18);                     // 0.9 m
  EXPECT_EQ(count_facing(samples, Vec3::UnitX()), 20);                      // 0.99 m
  EXPECT_EQ(samples.size(), 56u);                                           // nothing below
}

TEST(SurfaceSamples, ComeInTheSameOrder) {
  const auto mesh = make_mesh(sphere_mesh(0.3, 4));
  const Samples one = sample_surface(*mesh, kSpace, {0.05, 0.0}), two = sample_surface(*mesh, kSpace, {0.05, 0.0});
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].place, two[i].place);
}

TEST(SurfaceSamples, NeedRulesThatMakeSense) {
  const auto ball = make_sphere(0.3);
  EXPECT_THROW(sample_surface(*ball, kSpace, {0.0, 0.0}), RigidError);
  EXPECT_THROW(sample_surface(*ball, kSpace, {kInfinity, 0.0}), RigidError);
  EXPECT_THROW(sample_surface(*ball, kSpace, {0.1, -0.1}), RigidError);
  EXPECT_THROW(sample_surface(*ball, GeometryKind::line, {0.1, 0.0}), RigidError);
}

}  // namespace surface_samples_test
}  // namespace mpm
