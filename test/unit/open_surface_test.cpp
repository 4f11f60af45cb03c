// Surfaces of unbounded bodies: the plane, the stadium of planar scenes and height fields, against closed forms,
// against a search through all pieces, and against a closed mesh of the same shape.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "mpm/rigid/mesh_topology.hpp"
#include "mpm/rigid/surface.hpp"

namespace mpm {
namespace open_surface_test {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1e-14;  // round-off of coordinates of size one

struct Random {
  std::mt19937 engine{5};
  std::uniform_real_distribution<double> uniform{-1.0, 1.0};
  double operator()() { return uniform(engine); }
  Vec3 point() { return {uniform(engine), uniform(engine), uniform(engine)}; }
};

void expect_within_agrees(const Surface& surface, const Vec3& p) {
  for (const double band : {-0.1, 0.0, 0.2}) {
    const SurfacePoint s = surface.at(p);
    SurfacePoint found;
    ASSERT_EQ(surface.within(p, band, found), s.distance <= band) << p.transpose();
    if (s.distance > band) continue;
    EXPECT_EQ(found.distance, s.distance);
    EXPECT_EQ(found.normal, s.normal);
  }
}

TriangleMesh mesh_of(const Surface& surface) {
  TriangleMesh mesh;
  for (const auto& triangle : surface.triangles()) {
    const int n = static_cast<int>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), triangle.begin(), triangle.end());
    mesh.triangles.push_back({n, n + 1, n + 2});
  }
  return join_equal_vertices(mesh);
}

TEST(Plane, DistanceAlongItsNormal) {
  Random random;
  for (int i = 0; i < 200; ++i) {
    const Vec3 normal = random.point();
    const auto plane = make_plane(3.0 * normal);
    const Vec3 unit = normal / normal.norm();
    // A point of the plane, and a point at some distance from it along the normal.
    const Vec3 foot = unit.cross(random.point());
    const double way = random();
    const SurfacePoint s = plane->at(foot + way * unit);
    EXPECT_NEAR(s.distance, way, kRounding);
    EXPECT_LT((s.normal - unit).norm(), kRounding);
    expect_within_agrees(*plane, foot + way * unit);
  }
}

TEST(Plane, EndsAlongItsNormalAlone) {
  const auto floor = make_plane(Vec3::UnitZ());
  EXPECT_EQ(floor->bounds().max, Vec3(kInfinity, kInfinity, 0.0));
  EXPECT_EQ(floor->bounds().min, Vec3::Constant(-kInfinity));
  const auto right = make_plane(-2.0 * Vec3::UnitX());
  EXPECT_EQ(right->bounds().min, Vec3(0.0, -kInfinity, -kInfinity));
  EXPECT_EQ(make_plane({1.0, 0.0, 1.0})->bounds().max, Vec3::Constant(kInfinity));
  EXPECT_EQ(floor->thickness(), kInfinity);
}

TEST(Plane, IsDrawnAsASlabBelowIt) {
  for (const Vec3& normal : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(0.6, 0, 0.8), Vec3(1, 2, 3)}) {
    const auto plane = make_plane(normal, 2.0);
    EXPECT_NEAR(signed_volume(mesh_of(*plane)), 2.0 * 2.0 * 0.1, 1e-13);  // the slab's depth is a twentieth of its side
    double highest = -kInfinity;
    for (const auto& triangle : plane->triangles()) {
      for (const Vec3& corner : triangle) {
        highest = std::max(highest, plane->at(corner).distance);
        // With the normal of a planar scene two sides of the slab are parallel to it, with corners 1 m to either side.
        if (normal.y() == 0.0) {
          EXPECT_NEAR(std::abs(corner.y()), 1.0, kRounding) << normal.transpose();
        }
      }
    }
    EXPECT_NEAR(highest, 0.0, kRounding);
  }
}

TEST(Plane, OfNoDirectionIsRefused) {
  EXPECT_THROW(make_plane(Vec3::Zero()), RigidError);
  EXPECT_THROW(make_plane({0.0, kInfinity, 1.0}), RigidError);
  EXPECT_THROW(make_plane(Vec3::UnitZ(), 0.0), RigidError);
}

TEST(Stadium, DistanceIsThatOfTheMiddleLine) {
  Random random;
  for (const int axis : {0, 2}) {
    const auto stadium = make_capsule(0.2, 0.8, axis, true);
    for (int i = 0; i < 500; ++i) {
      const Vec3 p = random.point();
      const double expected = std::hypot(std::max(std::abs(p[axis]) - 0.4, 0.0), p[2 - axis]) - 0.2;
      const SurfacePoint s = stadium->at(p);
      EXPECT_NEAR(s.distance, expected, kRounding);
      EXPECT_EQ(s.normal.y(), 0.0);
      EXPECT_NEAR(s.normal.norm(), 1.0, kRounding);
      EXPECT_NEAR(stadium->at(p - s.distance * s.normal).distance, 0.0, kRounding);
      expect_within_agrees(*stadium, p);
    }
    EXPECT_EQ(stadium->bounds().max.y(), kInfinity);
    EXPECT_EQ(stadium->bounds().max[axis], 0.4 + 0.2);
    EXPECT_EQ(stadium->thickness(), 0.4);
    // On the line itself the normal is perpendicular to it, in the plane.
    const SurfacePoint middle = stadium->at({0.0, 0.3, 0.0});
    EXPECT_EQ(middle.distance, -0.2);
    EXPECT_EQ(middle.normal, Vec3(Vec3::Unit(2 - axis)));
  }
}

/// A roof that rises at 45 degrees from x = -1 to its ridge at (0, `up`) and falls again; a valley if `up` is negative.
HeightGrid roof(double up) { return {{-1.0, 0.0}, {1.0, 0.0}, 3, 1, {0.0, up, 0.0}}; }

TEST(HeightProfile, RoofByHand) {
  const auto surface = make_height_field(roof(1.0));
  const double half = std::sqrt(0.5);
  const SurfacePoint slope = surface->at({0.5, 7.0, 1.0});  // the slope x + z = 1
  EXPECT_NEAR(slope.distance, half * 0.5, kRounding);
  EXPECT_LT((slope.normal - Vec3(half, 0.0, half)).norm(), kRounding);
  // Above the ridge the normal points from the ridge to the point.
  const SurfacePoint above = surface->at({0.3, 0.0, 1.4});
  EXPECT_NEAR(above.distance, 0.5, kRounding);
  EXPECT_LT((above.normal - Vec3(0.6, 0.0, 0.8)).norm(), kRounding);
  // On the ridge the normal is that of a face; below it, at equal distance from both faces, that of either.
  const SurfacePoint ridge = surface->at({0.0, 0.0, 1.0});
  EXPECT_EQ(ridge.distance, 0.0);
  EXPECT_NEAR(std::abs(ridge.normal.x()), half, kRounding);
  EXPECT_NEAR(ridge.normal.z(), half, kRounding);
  const SurfacePoint bisector = surface->at({0.0, 0.0, 0.6});
  EXPECT_NEAR(bisector.distance, -half * 0.4, kRounding);
  EXPECT_NEAR(std::abs(bisector.normal.x()), half, kRounding);
  EXPECT_NEAR(bisector.normal.z(), half, kRounding);
  // At the end of the rectangle there is an upright side, endless downwards.
  EXPECT_EQ(surface->at({1.25, 0.0, -3.0}).normal, Vec3::UnitX());
  EXPECT_EQ(surface->at({1.25, 0.0, -3.0}).distance, 0.25);
  EXPECT_EQ(surface->at({-0.75, 0.0, -9.0}).distance, -0.25);
  EXPECT_EQ(surface->at({-0.75, 0.0, -9.0}).normal, -Vec3::UnitX());
  EXPECT_NEAR(surface->at({-1.4, 0.0, 0.3}).distance, 0.5, kRounding);
  EXPECT_EQ(surface->thickness(), 2.0);
  EXPECT_EQ(surface->bounds().max, Vec3(1.0, kInfinity, 1.0));
}

TEST(HeightProfile, ValleyByHand) {
  const auto surface = make_height_field(roof(-1.0));
  const double half = std::sqrt(0.5);
  // Above a notch both faces are nearest on its bisector: one of them counts there, and on either side its own face.
  const SurfacePoint bisector = surface->at({0.0, 0.0, -0.5});
  EXPECT_NEAR(bisector.distance, half * 0.5, kRounding);
  EXPECT_NEAR(std::abs(bisector.normal.x()), half, kRounding);
  EXPECT_NEAR(bisector.normal.z(), half, kRounding);
  EXPECT_GT(surface->at({-0.01, 0.0, -0.5}).normal.x(), 0.5);
  // Below the notch, inside the body, its edge is nearest: the normal points towards it.
  const SurfacePoint below = surface->at({0.0, 0.0, -1.25});
  EXPECT_EQ(below.distance, -0.25);
  EXPECT_LT((below.normal - Vec3::UnitZ()).norm(), kRounding);
}

HeightGrid rough_profile(Random& random) {
  HeightGrid grid{{-0.8, 0.0}, {0.7, 0.0}, 40, 1, {}};
  for (int i = 0; i < grid.columns; ++i) grid.heights.push_back(0.3 * random());
  return grid;
}

TEST(HeightProfile, NearestOfAllPieces) {
  Random random;
  const HeightGrid grid = rough_profile(random);
  const auto surface = make_height_field(grid);
  const double step = (grid.high.x() - grid.low.x()) / (grid.columns - 1);
  for (int k = 0; k < 3000; ++k) {
    const Vec3 p = 1.2 * random.point();
    double nearest = kInfinity, height = 0.0;
    const auto piece = [&](const Vec2& from, const Vec2& to) {
      const Vec2 at(p.x(), p.z()), along = to - from;
      const double t = std::clamp((at - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (at - from - t * along).norm());
    };
    for (int i = 0; i + 1 < grid.columns; ++i) {
      const Vec2 from(grid.low.x() + i * step, grid.heights[i]), to(grid.low.x() + (i + 1) * step, grid.heights[i + 1]);
      piece(from, to);
      if (p.x() >= from.x() && p.x() <= to.x()) {
        height = from.y() + (p.x() - from.x()) / (to.x() - from.x()) * (to.y() - from.y());
      }
    }
    piece({grid.low.x(), grid.heights.front()}, {grid.low.x(), -100.0});
    piece({grid.high.x(), grid.heights.back()}, {grid.high.x(), -100.0});
    const bool inside = p.x() > grid.low.x() && p.x() < grid.high.x() && p.z() < height;
    const SurfacePoint s = surface->at(p);
    EXPECT_NEAR(s.distance, inside ? -nearest : nearest, kRounding);
    // Going back along the normal by the distance leads to the surface.
    EXPECT_NEAR(surface->at(p - s.distance * s.normal).distance, 0.0, kRounding);
    EXPECT_NEAR(s.normal.norm(), 1.0, kRounding);
    expect_within_agrees(*surface, p);
  }
}

TEST(HeightProfile, IsDrawnAsAClosedBody) {
  // A roof of 2 x 2 m over 2 m more of depth: 2 (1 + 4) m^3.
  EXPECT_NEAR(signed_volume(mesh_of(*make_height_field(roof(1.0)))), 10.0, 1e-13);
}

HeightGrid rough_field(Random& random) {
  HeightGrid grid{{-0.9, -0.6}, {0.8, 0.7}, 12, 9, {}};
  for (int i = 0; i < grid.columns * grid.rows; ++i) grid.heights.push_back(0.2 * random());
  return grid;
}

TEST(HeightField, AgreesWithTheMeshOfTheSameShape) {
  // The mesh is independent: it has its own tree, and signs by pseudonormals. It ends 0.85 m below the lowest height,
  // which is -0.2 m or more. The two must agree where the surface is nearer than that bottom.
  Random random;
  const auto field = make_height_field(rough_field(random));
  const TriangleMesh triangles = mesh_of(*field);
  const auto mesh = make_mesh(triangles);
  int inside = 0;
  for (int k = 0; k < 4000; ++k) {
    const Vec3 p(1.3 * random(), 1.1 * random(), 0.5 * random());
    const SurfacePoint s = field->at(p), m = mesh->at(p);
    if (p.z() - mesh->bounds().min.z() < std::abs(s.distance)) continue;
    ASSERT_NEAR(s.distance, m.distance, kRounding) << p.transpose();
    EXPECT_LT((s.normal - m.normal).norm(), 1e-9) << p.transpose();
    EXPECT_NEAR(field->at(p - s.distance * s.normal).distance, 0.0, kRounding);
    inside += s.distance < 0.0 ? 1 : 0;
    expect_within_agrees(*field, p);
  }
  EXPECT_GT(inside, 500);
}

TEST(HeightField, OfOneProfileIsThatProfile) {
  // With the same heights in each row the field equals the planar one, away from the ends along y.
  Random random;
  HeightGrid profile = rough_profile(random);
  const auto planar = make_height_field(profile);
  HeightGrid grid = profile;
  grid.low.y() = -5.0, grid.high.y() = 5.0, grid.rows = 7;
  for (int j = 1; j < grid.rows; ++j) {
    grid.heights.insert(grid.heights.end(), profile.heights.begin(), profile.heights.end());
  }
  const auto solid = make_height_field(grid);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 p = random.point();
    EXPECT_NEAR(solid->at(p).distance, planar->at(p).distance, kRounding);
    EXPECT_LT((solid->at(p).normal - planar->at(p).normal).norm(), 1e-9);
  }
}

TEST(HeightField, FlatIsABoxWithoutEndBelow) {
  const auto field = make_height_field({{-0.5, -0.4}, {0.5, 0.4}, 5, 4, std::vector<double>(20, 0.1)});
  const auto box = make_box({1.0, 0.8, 200.0});  // its top at 100
  Random random;
  for (int k = 0; k < 2000; ++k) {
    const Vec3 p = random.point(), in_box = p + Vec3(0.0, 0.0, 99.9);
    EXPECT_NEAR(field->at(p).distance, box->at(in_box).distance, 2e-14 * 100.0);  // rounding of the box's 100 m
    EXPECT_LT((field->at(p).normal - box->at(in_box).normal).norm(), 1e-9) << p.transpose();
  }
  // On the edge between two triangles, and just above it, the normal is that of a face.
  EXPECT_EQ(field->at({0.0, 0.0, 0.1}).normal, Vec3::UnitZ());
  EXPECT_EQ(field->at({0.25, 0.1, 0.1 + 1e-15}).normal, Vec3::UnitZ());
  EXPECT_EQ(field->thickness(), 0.8);
}

TEST(HeightField, NumbersThatMakeNoFieldAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(make_height_field({{0, 0}, {1, 0}, 1, 1, {0.0}}), RigidError);
  EXPECT_THROW(make_height_field({{0, 0}, {1, 0}, 3, 1, {0.0, 1.0}}), RigidError);
  EXPECT_THROW(make_height_field({{1, 0}, {1, 0}, 2, 1, {0.0, 1.0}}), RigidError);
  EXPECT_THROW(make_height_field({{0, 0}, {1, 0}, 2, 2, {0.0, 1.0, 0.0, 1.0}}), RigidError);
  EXPECT_THROW(make_height_field({{0, 0}, {kInfinity, 0}, 2, 1, {0.0, 1.0}}), RigidError);
  try {
    make_height_field({{0, 0}, {1, 1}, 2, 2, {0.0, 1.0, nan, 1.0}});
    FAIL();
  } catch (const RigidError& error) {
    EXPECT_STREQ(error.what(), "height_field: height 1 of row 2 is nan; all must be finite");
  }
}

}  // namespace open_surface_test
}  // namespace mpm
