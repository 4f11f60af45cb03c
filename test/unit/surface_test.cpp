// Signed distances and normals of box, sphere, cylinder and capsule against independent values: the nearest of densely
// sampled points of the surface, finite differences, and values computed by hand at chosen points.
#include "mpm/rigid/surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>

#include "mpm/math/constants.hpp"

namespace mpm {
namespace surface_test {

using mpm::kPi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A surface with independent knowledge of it: whether a point is inside, and points of the surface such that one lies
/// within `gap` of every point of it.
struct Case {
  std::string name;
  std::shared_ptr<Surface> surface;
  std::function<bool(const Vec3&)> inside;
  std::vector<Vec3> samples;
  double gap;
};

Case box_case() {
  const Vec3 half(0.5, 0.3, 0.2);
  const int n = 60;
  std::vector<Vec3> samples;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= n; ++j) {
          Vec3 p;
          p[axis] = sign * half[axis];
          p[(axis + 1) % 3] = half[(axis + 1) % 3] * (2.0 * i / n - 1.0);
          p[(axis + 2) % 3] = half[(axis + 2) % 3] * (2.0 * j / n - 1.0);
          samples.push_back(p);
        }
      }
    }
  }
  const auto inside = [half](const Vec3& p) {
    return std::abs(p.x()) < half.x() && std::abs(p.y()) < half.y() && std::abs(p.z()) < half.z();
  };
  return {"box", make_box(2.0 * half), inside, samples, std::hypot(1.0, 0.6) / n};
}

Case sphere_case() {
  const double radius = 0.4;
  std::vector<Vec3> samples;
  const int n = 120;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j < 2 * n; ++j) {
      const double a = kPi * i / n, b = kPi * j / n;
      samples.push_back(radius * Vec3(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)));
    }
  }
  return {"sphere", make_sphere(radius), [=](const Vec3& p) { return p.norm() < radius; }, samples,
          std::sqrt(2.0) * radius * kPi / n};
}

Case cylinder_case(int axis) {
  const double radius = 0.3, half = 0.4;
  std::vector<Vec3> samples;
  const int n = 100;
  const auto add = [&](double r, double angle, double along) {
    Vec3 p;
    p[axis] = along;
    p[(axis + 1) % 3] = r * std::cos(angle);
    p[(axis + 2) % 3] = r * std::sin(angle);
    samples.push_back(p);
  };
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j < 2 * n; ++j) {
      const double angle = kPi * j / n;
      add(radius, angle, half * (2.0 * i / n - 1.0));
      add(radius * i / n, angle, half);
      add(radius * i / n, angle, -half);
    }
  }
  const auto inside = [=](const Vec3& p) {
    return std::abs(p[axis]) < half && std::hypot(p[(axis + 1) % 3], p[(axis + 2) % 3]) < radius;
  };
  return {"cylinder " + std::to_string(axis), make_cylinder(radius, 2.0 * half, axis), inside, samples,
          std::hypot(radius * kPi, 2.0 * half) / n};
}

Case capsule_case(int axis) {
  const double radius = 0.3, half = 0.25;
  std::vector<Vec3> samples;
  const int n = 100;
  const auto add = [&](double r, double angle, double along) {
    Vec3 p;
    p[axis] = along;
    p[(axis + 1) % 3] = r * std::cos(angle);
    p[(axis + 2) % 3] = r * std::sin(angle);
    samples.push_back(p);
  };
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j < 2 * n; ++j) {
      const double angle = kPi * j / n, up = 0.5 * kPi * i / n;
      add(radius, angle, half * (2.0 * i / n - 1.0));
      add(radius * std::cos(up), angle, half + radius * std::sin(up));
      add(radius * std::cos(up), angle, -half - radius * std::sin(up));
    }
  }
  const auto inside = [=](const Vec3& p) {
    const double r = std::hypot(p[(axis + 1) % 3], p[(axis + 2) % 3]);
    return (std::abs(p[axis]) < half && r < radius) || std::hypot(std::abs(p[axis]) - half, r) < radius;
  };
  return {"capsule " + std::to_string(axis), make_capsule(radius, 2.0 * half, axis), inside, samples,
          std::hypot(radius * kPi, 2.0 * half) / n};
}

std::vector<Case> cases() {
  return {box_case(),       sphere_case(),   cylinder_case(0), cylinder_case(1),
          cylinder_case(2), capsule_case(0), capsule_case(1),  capsule_case(2)};
}

struct Random {
  std::mt19937 engine{11};
  std::uniform_real_distribution<double> uniform{-1.0, 1.0};
  Vec3 point() { return {uniform(engine), uniform(engine), uniform(engine)}; }
};

TEST(Surface, DistanceIsThatOfTheNearestSample) {
  for (const Case& c : cases()) {
    Random random;
    for (int i = 0; i < 300; ++i) {
      const Vec3 p = random.point();
      double nearest = kInfinity;
      for (const Vec3& sample : c.samples) nearest = std::min(nearest, (p - sample).norm());
      const double distance = c.surface->at(p).distance;
      // A sample lies on the surface, so it cannot be nearer, and one lies within a gap of the nearest point.
      EXPECT_LE(std::abs(distance), nearest + 1e-14) << c.name;
      EXPECT_GE(std::abs(distance), nearest - c.gap) << c.name;
      EXPECT_EQ(distance < 0.0, c.inside(p)) << c.name << " at " << p.transpose();
    }
  }
}

TEST(Surface, NearestPointLiesOnTheSurface) {
  // The distance at p - distance * normal is zero only if distance and normal are both right.
  for (const Case& c : cases()) {
    Random random;
    for (int i = 0; i < 1000; ++i) {
      const Vec3 p = random.point();
      const SurfacePoint s = c.surface->at(p);
      EXPECT_NEAR(s.normal.norm(), 1.0, 1e-15) << c.name;
      EXPECT_NEAR(c.surface->at(p - s.distance * s.normal).distance, 0.0, 4e-16) << c.name;
    }
  }
}

TEST(Surface, NormalIsTheGradient) {
  for (const Case& c : cases()) {
    Random random;
    const double h = 1e-6;
    int compared = 0;
    for (int i = 0; i < 1000; ++i) {
      const Vec3 p = random.point();
      const SurfacePoint s = c.surface->at(p);
      Vec3 gradient;
      bool kink = false;  // two nearest faces inside: the gradient does not exist
      for (int k = 0; k < 3; ++k) {
        const SurfacePoint a = c.surface->at(p + h * Vec3::Unit(k)), b = c.surface->at(p - h * Vec3::Unit(k));
        gradient[k] = (a.distance - b.distance) / (2.0 * h);
        kink = kink || (a.normal - b.normal).norm() > 0.1;
      }
      if (kink) continue;
      ++compared;
      // 1e-8: h^2 times third derivatives (to 1/0.01^2 near edges) is 1e-8; rounding 1e-16 / 1e-6 is 1e-10.
      EXPECT_LT((gradient - s.normal).norm(), 1e-8) << c.name << " at " << p.transpose();
    }
    EXPECT_GT(compared, 990) << c.name;
  }
}

TEST(Surface, WithinAgreesWithAt) {
  for (const Case& c : cases()) {
    Random random;
    int near = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vec3 p = 0.8 * random.point();
      for (const double band : {-0.05, 0.0, 0.1}) {
        const SurfacePoint s = c.surface->at(p);
        SurfacePoint found;
        ASSERT_EQ(c.surface->within(p, band, found), s.distance <= band) << c.name;
        if (s.distance > band) continue;
        ++near;
        EXPECT_EQ(found.distance, s.distance) << c.name;
        EXPECT_EQ(found.normal, s.normal) << c.name;
      }
    }
    EXPECT_GT(near, 200) << c.name;
  }
}

TEST(Surface, TrianglesCloseAndLieOnTheSurface) {
  for (const Case& c : cases()) {
    TriangleMesh mesh;
    double volume = 0.0;
    for (const auto& [a, b, d] : c.surface->triangles()) {
      for (const Vec3& corner : {a, b, d}) EXPECT_NEAR(c.surface->at(corner).distance, 0.0, 1e-15) << c.name;
      volume += a.dot(b.cross(d)) / 6.0;
    }
    // By hand: box 1 x 0.6 x 0.4; sphere and cylinder a few per cent less because of flat faces (32 and 48 to a turn).
    const double ends = 4.0 / 3.0 * kPi * 0.027;  // the capsule's ends, together a sphere
    const double exact = c.name == "box"               ? 0.24
                         : c.name == "sphere"          ? 4.0 / 3.0 * kPi * 0.064
                         : c.name.find("capsule") == 0 ? kPi * 0.09 * 0.5 + ends
                                                       : kPi * 0.09 * 0.8;
    EXPECT_LE(volume, exact * (1.0 + 1e-14)) << c.name;
    EXPECT_GE(volume, exact * (c.name == "box" ? 1.0 - 1e-14 : 0.97)) << c.name;
  }
}

TEST(Surface, BoxByHand) {
  const auto box = make_box({2.0, 4.0, 6.0});
  const SurfacePoint corner = box->at({2.0, 4.0, 5.0});  // (1, 2, 2) beyond the corner: 3
  EXPECT_NEAR(corner.distance, 3.0, 1e-15);
  EXPECT_LT((corner.normal - Vec3(1.0, 2.0, 2.0) / 3.0).norm(), 1e-15);
  const SurfacePoint centre = box->at(Vec3::Zero());  // the x faces are nearest
  EXPECT_EQ(centre.distance, -1.0);
  EXPECT_EQ(centre.normal, Vec3::UnitX());
  const SurfacePoint edge = box->at({1.0, 2.0, 0.0});  // on the edge itself
  EXPECT_EQ(edge.distance, 0.0);
  EXPECT_EQ(edge.normal.norm(), 1.0);
  EXPECT_EQ(box->at({0.0, -1.75, 0.0}).normal, Vec3(0.0, -1.0, 0.0));
  EXPECT_EQ(box->thickness(), 2.0);
  EXPECT_EQ(box->bounds().max, Vec3(1.0, 2.0, 3.0));
  EXPECT_EQ(box->bounds().min, Vec3(-1.0, -2.0, -3.0));
}

TEST(Surface, SphereAndCylinderByHand) {
  const auto sphere = make_sphere(2.0);
  EXPECT_EQ(sphere->at(Vec3::Zero()).distance, -2.0);
  EXPECT_EQ(sphere->at(Vec3::Zero()).normal.norm(), 1.0);
  EXPECT_EQ(sphere->at({0.0, 0.0, -1e-200}).normal, Vec3(0.0, 0.0, -1.0));
  EXPECT_EQ(sphere->thickness(), 4.0);
  const auto cylinder = make_cylinder(3.0, 2.0);  // flat: the caps are nearest at the centre
  EXPECT_EQ(cylinder->at(Vec3::Zero()).distance, -1.0);
  EXPECT_EQ(cylinder->at(Vec3::Zero()).normal, Vec3::UnitZ());
  const SurfacePoint rim = cylinder->at({0.0, 6.0, 5.0});  // (3, 4) beyond the rim: 5
  EXPECT_NEAR(rim.distance, 5.0, 1e-15);
  EXPECT_LT((rim.normal - Vec3(0.0, 0.6, 0.8)).norm(), 1e-15);
  const auto rod = make_cylinder(1.0, 8.0);  // long: the side is nearest, and on the axis all sides are
  EXPECT_EQ(rod->at(Vec3::Zero()).distance, -1.0);
  EXPECT_EQ(rod->at(Vec3::Zero()).normal.norm(), 1.0);
  EXPECT_EQ(rod->at(Vec3::Zero()).normal.z(), 0.0);
  EXPECT_EQ(cylinder->thickness(), 2.0);
  EXPECT_EQ(rod->thickness(), 2.0);
  EXPECT_EQ(rod->bounds().max, Vec3(1.0, 1.0, 4.0));
}

TEST(Surface, WithoutEndAlongY) {
  // In a planar scene it is the two-dimensional distance in x-z, whatever y is.
  const auto box = make_box({1.0, kInfinity, 0.5});
  const auto disc = make_cylinder(0.5, kInfinity, 1);
  Random random;
  for (int i = 0; i < 500; ++i) {
    const Vec3 p = random.point();
    const double qx = std::abs(p.x()) - 0.5, qz = std::abs(p.z()) - 0.25;
    const double expected = std::hypot(std::max(qx, 0.0), std::max(qz, 0.0)) + std::min(std::max(qx, qz), 0.0);
    EXPECT_NEAR(box->at(p).distance, expected, 1e-15);
    EXPECT_NEAR(disc->at(p).distance, std::hypot(p.x(), p.z()) - 0.5, 1e-15);
    for (const Surface* surface : {box.get(), disc.get()}) {
      const SurfacePoint s = surface->at(p);
      EXPECT_EQ(s.normal.y(), 0.0);
      EXPECT_NEAR(s.normal.norm(), 1.0, 1e-15);
      const SurfacePoint far = surface->at({p.x(), 1e6, p.z()});
      EXPECT_EQ(far.distance, s.distance);
      SurfacePoint found;
      EXPECT_EQ(surface->within(p, 0.1, found), s.distance <= 0.1);
    }
  }
  EXPECT_EQ(box->thickness(), 0.5);
  EXPECT_EQ(disc->thickness(), 1.0);
  EXPECT_EQ(box->bounds().max.y(), kInfinity);
  // In a one-dimensional scene it is the distance along x, whatever y and z are; it is drawn as a cube.
  const auto interval = make_box({1.0, kInfinity, kInfinity});
  EXPECT_EQ(interval->at({0.7, 3.0, -9.0}).distance, 0.7 - 0.5);
  EXPECT_EQ(interval->at({-0.4, 3.0, -9.0}).distance, 0.4 - 0.5);
  EXPECT_EQ(interval->at({-0.4, 3.0, -9.0}).normal, Vec3(-1, 0, 0));
  EXPECT_EQ(interval->thickness(), 1.0);
  for (const auto& triangle : interval->triangles()) {
    for (const Vec3& corner : triangle) EXPECT_EQ(corner.cwiseAbs(), Vec3::Constant(0.5));
  }
  EXPECT_TRUE(disc->bounds().contains({0.0, 1e9, 0.0}));
  for (const Surface* surface : {box.get(), disc.get()}) {
    for (const auto& triangle : surface->triangles()) {
      for (const Vec3& corner : triangle) EXPECT_TRUE(corner.allFinite());
    }
  }
}

TEST(Surface, ImpossibleSizesAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {0.0, -1.0, nan}) {
    EXPECT_THROW(make_box({1.0, bad, 1.0}), RigidError) << bad;
    EXPECT_THROW(make_sphere(bad), RigidError) << bad;
    EXPECT_THROW(make_cylinder(bad, 1.0), RigidError) << bad;
    EXPECT_THROW(make_cylinder(1.0, bad), RigidError) << bad;
  }
  for (const double bad : {0.0, -1.0, nan, kInfinity}) {
    EXPECT_THROW(make_capsule(bad, 1.0), RigidError) << bad;
    EXPECT_THROW(make_capsule(1.0, bad), RigidError) << bad;
  }
  EXPECT_THROW(make_capsule(1.0, 1.0, 3), RigidError);
  EXPECT_THROW(make_capsule(1.0, 1.0, 1, true), RigidError);
  EXPECT_THROW(make_sphere(kInfinity), RigidError);
  EXPECT_THROW(make_cylinder(kInfinity, 1.0), RigidError);
  EXPECT_THROW(make_cylinder(1.0, 1.0, 3), RigidError);
  EXPECT_THROW(make_box({kInfinity, kInfinity, kInfinity}), RigidError);
  try {
    make_box({1.0, -2.0, 1.0});
    FAIL();
  } catch (const RigidError& error) {
    EXPECT_STREQ(error.what(), "box: edge length along y is -2 m; all three must be positive");
  }
}

}  // namespace surface_test
}  // namespace mpm
