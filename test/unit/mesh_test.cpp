// Meshes as rigid bodies: distances against closed forms and brute force, and refused meshes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <string>

#include "mesh_shapes.hpp"
#include "mpm/math/constants.hpp"
#include "mpm/rigid/mesh_topology.hpp"
#include "mpm/rigid/surface.hpp"

namespace mpm {
namespace mesh_test {

using mpm::kPi;

/// L-shaped prism: the square [0, 2] x [0, 2] without (1, 2] x (1, 2], from y = 0 to 1; reentrant edge at x = z = 1.
TriangleMesh ell_mesh() {
  const double outline[6][2] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};  // counter-clockwise in (x, z)
  TriangleMesh mesh;
  for (const double y : {0.0, 1.0}) {
    for (const auto& p : outline) mesh.vertices.emplace_back(p[0], y, p[1]);
  }
  for (const auto& t : {std::array<int, 3>{0, 1, 3}, {1, 2, 3}, {0, 3, 5}, {3, 4, 5}}) {
    mesh.triangles.push_back(t);  // seen from -y, x to the right and z up: counter-clockwise
    mesh.triangles.push_back({t[0] + 6, t[2] + 6, t[1] + 6});
  }
  for (int i = 0; i < 6; ++i) {
    const int j = (i + 1) % 6;
    mesh.triangles.push_back({i, i + 6, j + 6});
    mesh.triangles.push_back({i, j + 6, j});
  }
  return mesh;
}

TriangleMesh inside_out(TriangleMesh mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
  return mesh;
}

struct Random {
  std::mt19937 engine{5};
  std::uniform_real_distribution<double> uniform{-1.0, 1.0};
  Vec3 point() { return {uniform(engine), uniform(engine), uniform(engine)}; }
};

std::string refusal(const TriangleMesh& mesh) {
  try {
    make_mesh(mesh);
  } catch (const RigidError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "";
}

TEST(Mesh, BoxMeshEqualsBox) {
  const Vec3 size(1.0, 0.6, 0.4);
  const auto box = make_box(size);
  const auto mesh = make_mesh(box_mesh(-0.5 * size, 0.5 * size));
  Random random;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 p = random.point();
    const SurfacePoint expected = box->at(p), found = mesh->at(p);
    EXPECT_NEAR(found.distance, expected.distance, 1e-15);
    EXPECT_LT((found.normal - expected.normal).norm(), 1e-13) << p.transpose();  // rounding over the distance, > 1e-3
  }
  EXPECT_EQ(mesh->bounds().min, box->bounds().min);
  EXPECT_EQ(mesh->bounds().max, box->bounds().max);
  EXPECT_DOUBLE_EQ(mesh->at(Vec3::Zero()).distance, -0.2);
}

TEST(Mesh, OnFacesEdgesAndCorners) {
  const auto mesh = make_mesh(box_mesh({-1, -1, -1}, {1, 1, 1}));
  EXPECT_EQ(mesh->at({1.0, 0.2, 0.3}).distance, 0.0);
  EXPECT_EQ(mesh->at({1.0, 0.2, 0.3}).normal, Vec3::UnitX());
  EXPECT_NEAR(mesh->at({1.0, 0.2, 1.0}).distance, 0.0, 3e-16);  // the nearest point comes from a quotient
  EXPECT_LT((mesh->at({1.0, 0.2, 1.0}).normal - Vec3(1, 0, 1).normalized()).norm(), 1e-15);
  EXPECT_EQ(mesh->at({1, 1, 1}).distance, 0.0);
  // Three right angles, however the faces are cut into triangles: weighting by angle gives the diagonal.
  EXPECT_LT((mesh->at({1, 1, 1}).normal - Vec3(1, 1, 1).normalized()).norm(), 1e-15);
}

TEST(Mesh, ReentrantEdge) {
  // Independent of the mesh code: the two boxes that form the L, and by hand inside near the reentrant edge.
  const auto mesh = make_mesh(ell_mesh());
  const auto low = make_box({2.0, 1.0, 1.0}), high = make_box({1.0, 1.0, 2.0});
  const Vec3 low_centre(1.0, 0.5, 0.5), high_centre(0.5, 0.5, 1.0);
  Random random;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 p = Vec3(1.0, 0.5, 1.0) + 1.5 * random.point();
    const double unite = std::min(low->at(p - low_centre).distance, high->at(p - high_centre).distance);
    const double found = mesh->at(p).distance;
    if (unite > 0.0) {
      EXPECT_NEAR(found, unite, 2e-15);  // outside: the distance to a union is the lesser of the two
    } else {
      EXPECT_LE(found, unite + 2e-15);  // inside: at least as deep as in either box
    }
  }
  // Inside, the reentrant edge is nearest: (1, 1) is 0.25 from (0.8, 0.85), outwards along (0.8, 0.6).
  const SurfacePoint s = mesh->at({0.8, 0.5, 0.85});
  EXPECT_NEAR(s.distance, -0.25, 1e-15);
  EXPECT_LT((s.normal - Vec3(0.8, 0.0, 0.6)).norm(), 1e-14);
}

TEST(Mesh, SignNearSharpCorners) {
  // Needles: the normal of the nearest face alone gives the wrong sign beside a tip. Inside means behind all four
  // planes.
  Random random;
  for (int needle = 0; needle < 50; ++needle) {
    TriangleMesh mesh;
    for (int v = 0; v < 4; ++v) mesh.vertices.push_back(0.1 * random.point());
    mesh.vertices[3] += Vec3(0.0, 0.0, 2.0);
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    const Vec3 centre = 0.25 * (mesh.vertices[0] + mesh.vertices[1] + mesh.vertices[2] + mesh.vertices[3]);
    const auto surface = make_mesh(mesh);
    for (int i = 0; i < 400; ++i) {
      const Vec3 p = (i % 2 == 0 ? mesh.vertices[3] : mesh.vertices[i % 3]) + 0.05 * random.point();
      double deepest = -std::numeric_limits<double>::infinity();  // signed distance to the farthest plane
      for (const auto& [a, b, c] : mesh.triangles) {
        Vec3 n = (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).normalized();
        if (n.dot(centre - mesh.vertices[a]) > 0.0) n = -n;
        deepest = std::max(deepest, n.dot(p - mesh.vertices[a]));
      }
      const double found = surface->at(p).distance;
      EXPECT_EQ(found < 0.0, deepest < 0.0) << p.transpose();
      if (deepest < 0.0) {
        EXPECT_NEAR(found, deepest, 1e-14);  // inside a convex body it is the distance to the nearest plane
      } else {
        EXPECT_GE(found, deepest - 1e-14);  // outside, the distance to the body exceeds that to each plane
      }
    }
  }
}

TEST(Mesh, SphereMesh) {
  const auto mesh = make_mesh(sphere_mesh(0.5, 4));  // 2048 triangles
  // The facets lie between the sphere and one smaller by the sagitta r (1 - cos(half angle)). The longest edges of a
  // face that was split four times span less than 9 degrees, and its circumscribed circle has a radius below 5.5.
  const double sagitta = 0.5 * (1.0 - std::cos(5.5 * kPi / 180.0));
  Random random;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = random.point();
    const SurfacePoint s = mesh->at(p);
    EXPECT_GE(s.distance, p.norm() - 0.5 - 1e-15);
    EXPECT_LE(s.distance, p.norm() - 0.5 + sagitta);
    // p - d n lies on the facets.
    EXPECT_NEAR(mesh->at(p - s.distance * s.normal).distance, 0.0, 1e-14);
    SurfacePoint found;
    ASSERT_EQ(mesh->within(p, 0.1, found), s.distance <= 0.1);
    if (s.distance <= 0.1) {
      EXPECT_EQ(found.distance, s.distance);
    }
  }
  EXPECT_NEAR(mesh->thickness(), 1.0, 2.0 * sagitta);
}

TEST(Mesh, NearestTriangleIsFoundByTheTree) {
  // Reference: all triangles one by one, by the distance to each edge and plane, without a tree or Voronoi regions.
  TriangleMesh mesh = sphere_mesh(1.0, 2);
  Random random;
  for (Vec3& vertex : mesh.vertices) vertex *= 0.7 + 0.2 * random.uniform(random.engine);
  const auto surface = make_mesh(mesh);
  for (int i = 0; i < 500; ++i) {
    const Vec3 p = 1.2 * random.point();
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& triangle : mesh.triangles) {
      const Vec3 corner[3] = {mesh.vertices[triangle[0]], mesh.vertices[triangle[1]], mesh.vertices[triangle[2]]};
      const Vec3 n = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
      bool above = true;  // true if the projection onto the plane lies within the triangle
      for (int e = 0; e < 3; ++e) {
        const Vec3 &a = corner[e], &b = corner[(e + 1) % 3];
        above = above && n.dot((b - a).cross(p - a)) >= 0.0;
        const double s = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
        nearest = std::min(nearest, (p - a - s * (b - a)).norm());
      }
      if (above) nearest = std::min(nearest, std::abs(n.dot(p - corner[0])));
    }
    EXPECT_NEAR(std::abs(surface->at(p).distance), nearest, 1e-14);
  }
}

TEST(Mesh, Thickness) {
  EXPECT_DOUBLE_EQ(make_mesh(box_mesh({0, 0, 0}, {1.0, 0.6, 0.05}))->thickness(), 0.05);
  EXPECT_DOUBLE_EQ(make_mesh(box_mesh({0, 0, 0}, {1.0, 2.0, 3.0}))->thickness(), 1.0);
  // The arms of the L and the prism have a thickness of 1.
  EXPECT_DOUBLE_EQ(make_mesh(ell_mesh())->thickness(), 1.0);
}

TEST(Mesh, InsideOutIsTurned) {
  const auto mesh = make_mesh(inside_out(box_mesh({-1, -1, -1}, {1, 1, 1})));
  EXPECT_EQ(mesh->at({0.0, 0.0, 1.5}).distance, 0.5);
  EXPECT_EQ(mesh->at({0.1, 0.2, 0.7}).normal, Vec3::UnitZ());
  double volume = 0.0;
  for (const auto& [a, b, c] : mesh->triangles()) volume += a.dot(b.cross(c)) / 6.0;
  EXPECT_NEAR(volume, 8.0, 1e-14);
}

TEST(Mesh, SeveralParts) {
  const TriangleMesh left = box_mesh({-3, -1, -1}, {-1, 1, 1}), right = box_mesh({1, -1, -1}, {3, 1, 1});
  const auto apart = make_mesh(joined(left, right));
  EXPECT_EQ(apart->at({0.25, 0.0, 0.0}).distance, 0.75);
  EXPECT_EQ(apart->at({2.9, 0.1, 0.0}).normal, Vec3::UnitX());
  // A hollow box: the cavity's faces look into the cavity.
  const TriangleMesh outer = box_mesh({-2, -2, -2}, {2, 2, 2}), inner = box_mesh({-1, -1, -1}, {1, 1, 1});
  const auto hollow = make_mesh(joined(outer, inside_out(inner)));
  EXPECT_EQ(hollow->at({0.1, 0.0, 0.0}).distance, 0.9);
  EXPECT_EQ(hollow->at({1.25, 0.0, 0.0}).distance, -0.25);
  EXPECT_EQ(hollow->at({1.25, 0.1, 0.2}).normal, -Vec3::UnitX());
  EXPECT_DOUBLE_EQ(hollow->thickness(), 1.0);
  // A hollow box that is inside out as a whole is turned as a whole.
  EXPECT_EQ(make_mesh(inside_out(joined(outer, inside_out(inner))))->at({0.1, 0.0, 0.0}).distance, 0.9);
  EXPECT_TRUE(starts_with(refusal(joined(outer, inner)), "mesh: the part at "));
  EXPECT_NE(refusal(joined(outer, inner)).find("lies inside another part"), std::string::npos);
  const TriangleMesh small = box_mesh({5, 0, 0}, {6, 1, 1});
  EXPECT_NE(refusal(joined(outer, inside_out(small))).find("is turned inside out"), std::string::npos);
}

/// The union of boxes, by their distances.
double least_of(const std::vector<std::pair<Vec3, Vec3>>& boxes, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [low, high] : boxes)
    least = std::min(least, make_box(high - low)->at(p - 0.5 * (low + high)).distance);
  return least;
}

/// Expects boxes in one mesh, whose vertices are joined as from a file, to be the union of boxes: distance outside,
/// sign and at least the depth in one of them inside; volume [m^3] and its centre, to the round-off of some 10,000
/// rays.
void expect_union(const std::vector<std::pair<Vec3, Vec3>>& boxes, double volume, const Vec3& centre) {
  TriangleMesh all;
  for (const auto& [low, high] : boxes) all = joined(all, box_mesh(low, high));
  const auto mesh = make_mesh(join_equal_vertices(all));
  Random random;
  const Vec3 middle = mesh->bounds().center(), half = 0.6 * mesh->bounds().size();
  for (int i = 0; i < 3000; ++i) {
    const Vec3 p = middle + half.cwiseProduct(random.point());
    const double expected = least_of(boxes, p), found = mesh->at(p).distance;
    if (expected > 0.0) {
      ASSERT_NEAR(found, expected, 1e-14) << p.transpose();
    } else {
      ASSERT_LE(found, expected + 1e-14) << p.transpose();
    }
    SurfacePoint near;
    ASSERT_EQ(mesh->within(p, 0.0, near), found <= 0.0) << p.transpose();
  }
  const auto moments = mesh->moments(0.0);
  ASSERT_TRUE(moments);
  EXPECT_NEAR(moments->volume, volume, 1e-10 * volume);
  EXPECT_NEAR((moments->centre - centre).norm(), 0.0, 1e-10);
}

// A wheel with lugs, a bucket with teeth: once the sign was that of the nearest triangle, also where that lay inside
// another part, and what overlapped had its volume twice.
TEST(Mesh, PartsThatOverlapOrTouchAreTheirUnion) {
  {
    SCOPED_TRACE("a plug through a plate");
    expect_union({{{0, 0, 0}, {4, 4, 1}}, {{1, 1, -1}, {2, 2, 3}}}, 16.0 + 3.0,
                 {(32.0 + 4.5) / 19.0, (32.0 + 4.5) / 19.0, (8.0 + 3.0 * 0 + 4.0 * 1.0 - 0.5) / 19.0});
  }
  {
    SCOPED_TRACE("a cross");
    expect_union({{{-3, -1, -1}, {3, 1, 1}}, {{-1, -3, -1}, {1, 3, 1}}, {{-1, -1, -3}, {1, 1, 3}}}, 8.0 + 6 * 8.0,
                 Vec3::Zero());
  }
  {
    SCOPED_TRACE("flush: faces of both in one plane, one part reaching into the other");
    expect_union({{{0, 0, 0}, {2, 1, 1}}, {{1, 0, 0}, {3, 1, 1}}}, 3.0, {1.5, 0.5, 0.5});
  }
  {
    SCOPED_TRACE("flush: side by side with a common face, whose vertices are joined");
    expect_union({{{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {3, 1, 1}}}, 3.0, {1.5, 0.5, 0.5});
  }
  {
    SCOPED_TRACE("a tooth on a plate");
    expect_union({{{0, 0, 0}, {4, 4, 1}}, {{1, 1, 1}, {2, 2, 2}}}, 17.0, {33.5 / 17.0, 33.5 / 17.0, 9.5 / 17.0});
  }
  {
    SCOPED_TRACE("a common edge");
    expect_union({{{0, 0, 0}, {1, 1, 1}}, {{1, 1, 0}, {2, 2, 1}}}, 2.0, {1.0, 1.0, 0.5});
  }
}

// Two spheres of radius 0.5 whose centres are 0.6 apart share two caps of height 0.2:
// 2 pi h^2 (3 r - h) / 3 = 0.10891 m^3 of 2 * 4 pi r^3 / 3 = 1.04720 m^3. The facets of 2048 triangles lack 0.4 %.
TEST(Mesh, WhatOverlapsCountsOnce) {
  TriangleMesh right = sphere_mesh(0.5, 4);
  for (Vec3& vertex : right.vertices) vertex += Vec3(0.6, 0.0, 0.0);
  const auto mesh = make_mesh(joined(sphere_mesh(0.5, 4), right));
  const double caps = 2.0 * kPi * 0.04 * 1.3 / 3.0, balls = 2.0 * kPi / 6.0;
  EXPECT_NEAR(mesh->moments(0.0)->volume, balls - caps, 0.005 * balls);
  EXPECT_NEAR((mesh->moments(0.0)->centre - Vec3(0.3, 0.0, 0.0)).norm(), 0.0, 1e-3);
  EXPECT_NEAR(mesh->at({0.3, 0.0, 0.0}).distance, -0.2, 0.003);
}

TEST(Mesh, AHoleIsInOnePartAlone) {
  // A housing with a rotor in its cavity; one part of another body reaches into the cavity.
  const TriangleMesh outer = box_mesh({-2, -2, -2}, {2, 2, 2}), cavity = inside_out(box_mesh({-1, -1, -1}, {1, 1, 1}));
  const TriangleMesh rotor = box_mesh({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  const TriangleMesh pin = box_mesh({0.8, -0.1, -0.1}, {3.0, 0.1, 0.1});
  const auto mesh = make_mesh(joined(joined(outer, cavity), joined(rotor, pin)));
  EXPECT_DOUBLE_EQ(mesh->at({0.0, 0.0, 0.7}).distance, 0.2);   // in the cavity, beside the rotor
  EXPECT_DOUBLE_EQ(mesh->at({0.9, 0.0, 0.0}).distance, -0.1);  // in the pin
  EXPECT_NEAR(mesh->moments(0.0)->volume, 64.0 - 8.0 + 1.0 + 0.04 * (0.2 + 1.0), 57e-10);
  const TriangleMesh other = inside_out(box_mesh({0.5, -0.5, -0.5}, {1.5, 0.5, 0.5}));
  EXPECT_NE(refusal(joined(joined(outer, cavity), other)).find("is a hole that overlaps another one"),
            std::string::npos);
  const TriangleMesh through = inside_out(box_mesh({1.0, -0.5, -0.5}, {3.0, 0.5, 0.5}));
  EXPECT_NE(refusal(joined(outer, through)).find("unite it with the part that it cuts"), std::string::npos);
}

TEST(Mesh, RefusedMeshes) {
  const TriangleMesh box = box_mesh({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(refusal({}), "mesh: it has no triangles");
  TriangleMesh open = box;
  open.triangles.pop_back();
  EXPECT_TRUE(starts_with(refusal(open), "mesh: not closed: 3 edges have a triangle on one side only"))
      << refusal(open);
  TriangleMesh mixed = box;
  std::swap(mixed.triangles[3][0], mixed.triangles[3][1]);
  EXPECT_TRUE(starts_with(refusal(mixed), "mesh: not consistently oriented")) << refusal(mixed);
  TriangleMesh wild = box;
  wild.triangles[0][1] = 8;
  EXPECT_EQ(refusal(wild), "mesh: triangle 0 names vertex 8, but there are 8");
  TriangleMesh nan = box;
  nan.vertices[2].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(starts_with(refusal(nan), "mesh: vertex 2 is not finite"));
  TriangleMesh flat = box_mesh({0, 0, 0}, {1, 1, 0});
  EXPECT_NE(refusal(flat), "");
  TriangleMesh sheet;  // two sides of one triangle: closed, but without volume
  sheet.vertices = {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()};
  sheet.triangles = {{0, 1, 2}, {0, 2, 1}};
  EXPECT_EQ(refusal(sheet), "mesh: it encloses no volume");
}

TEST(Mesh, DegenerateTriangles) {
  TriangleMesh repeated = box_mesh({0, 0, 0}, {1, 1, 1});
  repeated.triangles.push_back({0, 1, 1});  // uses an edge twice; the mesh is closed without it
  EXPECT_EQ(make_mesh(repeated)->triangles().size(), 12U);
  // A vertex in the middle of an edge, and a triangle without area that closes the gap on one side.
  TriangleMesh line = box_mesh({0, 0, 0}, {1, 1, 1});
  line.vertices.emplace_back(0.5, 0.0, 0.0);  // on the edge 0-1, face {0, 3, 1} split and {0, 1, 5} not
  line.triangles[1] = {0, 3, 8};
  line.triangles.push_back({8, 3, 1});
  line.triangles.push_back({0, 8, 1});
  EXPECT_NE(refusal(line).find("has no area"), std::string::npos) << refusal(line);
}

}  // namespace mesh_test
}  // namespace mpm
