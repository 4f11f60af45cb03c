// Volume, centre and inertia of closed surfaces, against formulas of textbooks and against each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mpm/rigid/surface.hpp"

namespace solid_moments_test {

using mpm::SolidMoments;
using mpm::Vec2;
using mpm::Vec3;

constexpr double kEndless = std::numeric_limits<double>::infinity();

/// Sums over the points of a fine lattice that lie inside: exact to the volume of the cells that the surface cuts.
SolidMoments counted(const mpm::Surface& surface, const mpm::Box& box, int cells) {
  SolidMoments sum;
  const Vec3 cell = box.size() / cells;
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      for (int k = 0; k < cells; ++k) {
        const Vec3 place = box.min + cell.cwiseProduct(Vec3(i + 0.5, j + 0.5, k + 0.5));
        if (surface.at(place).distance > 0.0) continue;
        sum.volume += cell.prod();
        sum.centre += cell.prod() * place;
        sum.second += cell.prod() * place * place.transpose();
      }
    }
  }
  sum.centre /= sum.volume;
  sum.second -= sum.volume * sum.centre * sum.centre.transpose();
  return sum;
}

void expect_near(const SolidMoments& a, const SolidMoments& b, double part) {
  EXPECT_NEAR(a.volume, b.volume, part * b.volume);
  EXPECT_LT((a.centre - b.centre).norm(), part * std::cbrt(b.volume));
  EXPECT_LT((a.second - b.second).norm(), part * b.second.norm());
}

TEST(SolidMoments, OfBoxSphereAndCylinder) {
  const SolidMoments box = *mpm::make_box({0.1, 0.2, 0.4})->moments(1.0);
  EXPECT_NEAR(box.volume, 0.008, 1e-15);
  EXPECT_NEAR(box.inertia()(2, 2), 0.008 * (0.01 + 0.04) / 12.0, 1e-15);
  const SolidMoments ball = *mpm::make_sphere(0.5)->moments(1.0);
  EXPECT_NEAR(ball.inertia()(0, 0), 0.4 * ball.volume * 0.25, 1e-15);
  const SolidMoments rod = *mpm::make_cylinder(0.1, 2.0, 0)->moments(1.0);
  EXPECT_NEAR(rod.inertia()(0, 0), 0.5 * rod.volume * 0.01, 1e-15);
  EXPECT_NEAR(rod.inertia()(1, 1), rod.volume * (3.0 * 0.01 + 4.0) / 12.0, 1e-15);
  // In a planar scene the thickness is that of the scene.
  const SolidMoments disc = *mpm::make_cylinder(0.1, kEndless, 1)->moments(0.3);
  EXPECT_NEAR(disc.volume, M_PI * 0.01 * 0.3, 1e-15);
  EXPECT_NEAR(disc.inertia()(1, 1), 0.5 * disc.volume * 0.01, 1e-15);
}

// On a lattice of 100^3 points the cells at the surface contribute errors that largely cancel: 1e-3 is asked.
TEST(SolidMoments, OfCapsuleAsCounted) {
  const auto capsule = mpm::make_capsule(0.2, 0.5, 0);
  expect_near(*capsule->moments(1.0), counted(*capsule, capsule->bounds(), 100), 1e-3);
  const auto flat = mpm::make_capsule(0.2, 0.5, 2, true);
  mpm::Box box = flat->bounds();
  box.min.y() = -0.15;
  box.max.y() = 0.15;
  expect_near(*flat->moments(0.3), counted(*flat, box, 100), 1e-3);
}

TEST(SolidMoments, OfMeshAndPolygonAreThoseOfTheBox) {
  mpm::TriangleMesh mesh;
  const Vec3 size(0.1, 0.2, 0.4), place(0.3, -0.2, 0.1);
  const auto faces = mpm::make_box(size)->triangles();
  for (const auto& face : faces) {
    std::array<int, 3> triangle{};
    for (int i = 0; i < 3; ++i) {
      const Vec3 vertex = face[i] + place;
      int found = -1;
      for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        if (mesh.vertices[v] == vertex) found = static_cast<int>(v);
      }
      if (found < 0) {
        found = static_cast<int>(mesh.vertices.size());
        mesh.vertices.push_back(vertex);
      }
      triangle[i] = found;
    }
    mesh.triangles.push_back(triangle);
  }
  SolidMoments box = *mpm::make_box(size)->moments(1.0);
  box.centre = place;
  expect_near(*mpm::make_mesh(mesh)->moments(1.0), box, 1e-13);

  const mpm::Profile clockwise = {{0.25, -0.1}, {0.25, 0.3}, {0.35, 0.3}, {0.35, -0.1}};
  SolidMoments plate = *mpm::make_box({0.1, kEndless, 0.4})->moments(0.2);
  plate.centre = {0.3, 0.0, 0.1};
  expect_near(*mpm::make_polygon(clockwise)->moments(0.2), plate, 1e-13);
}

TEST(SolidMoments, OfWhatHasNoEndAreNotKnown) { EXPECT_FALSE(mpm::make_plane(Vec3::UnitZ())->moments(1.0)); }

// Points inside and outside, beside a face, beyond a corner and in a notch.
TEST(Polygon, KnowsItsDistance) {
  const mpm::Profile notched = {{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {1.0, 0.5}, {0.0, 1.0}};
  const auto polygon = mpm::make_polygon(notched);
  EXPECT_NEAR(polygon->at({0.5, 7.0, -0.25}).distance, 0.25, 1e-15);
  EXPECT_NEAR(polygon->at({0.5, 0.0, -0.25}).normal.z(), -1.0, 1e-15);
  EXPECT_NEAR(polygon->at({2.3, 0.0, -0.4}).distance, 0.5, 1e-15);
  EXPECT_NEAR(polygon->at({0.1, 0.0, 0.4}).distance, -0.1, 1e-15);
  EXPECT_NEAR(polygon->at({1.0, 0.0, 1.0}).distance, 0.5 * std::cos(std::atan(0.5)), 1e-15);
  EXPECT_THROW(mpm::make_polygon({{0.0, 0.0}, {1.0, 0.0}}), mpm::RigidError);
  EXPECT_THROW(mpm::make_polygon({{0.0, 0.0}, {1.0, 1.0}, {1.0, 0.0}, {0.0, 1.0}}), mpm::RigidError);
}

// A notch whose lowest corner a triangle from corner to corner would cover, in both senses.
TEST(Polygon, IsDrawnFilled) {
  mpm::Profile notched = {{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {1.0, 0.5}, {0.0, 1.0}};
  for (int sense = 0; sense < 2; ++sense) {
    const auto polygon = mpm::make_polygon(notched, 0.2);
    double volume = 0.0, front = 0.0;
    for (const auto& [a, b, c] : polygon->triangles()) {
      volume += a.dot(b.cross(c)) / 6.0;
      const Vec3 area = 0.5 * (b - a).cross(c - a);
      if (area.y() < 0.0) front -= area.y();
      EXPECT_LE(polygon->at((a + b + c) / 3.0).distance, 1e-15);
    }
    // By hand: the rectangle of 2 less the notch of 0.5; 0.2 m thick.
    EXPECT_NEAR(front, 1.5, 1e-14);
    EXPECT_NEAR(volume, 0.3, 1e-14);
    std::reverse(notched.begin(), notched.end());
  }
}

}  // namespace solid_moments_test
