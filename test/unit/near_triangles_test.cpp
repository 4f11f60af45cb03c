// The triangles that can be nearest in a cell against all triangles, to the bit: in cells asked for the first time, in
// filled ones, by several threads at once, outside the grid, and where a cell has too many of them.
#include "../../src/mpm/rigid/near_triangles.hpp"

#include <gtest/gtest.h>

#include <random>
#include <thread>
#include <vector>

#include "mesh_shapes.hpp"
#include "mpm/math/constants.hpp"

namespace mpm {
namespace near_triangles_test {

struct Mesh {
  explicit Mesh(const TriangleMesh& mesh)
      : triangles(triangles_of(mesh)),
        bounds(bounds_of(mesh)),
        tree(triangles),
        near(tree, triangles, bounds, [this](const Vec3& p, const Nearest&) { return inside && bounds.contains(p); }) {}

  static Box bounds_of(const TriangleMesh& mesh) {
    Box box;
    for (const Vec3& vertex : mesh.vertices) box.add(vertex);
    return box;
  }
  Nearest of_all(const Vec3& point) const {
    Nearest best;
    for (const Triangle& t : triangles) nearest_of(t, point, best);
    return best;
  }

  std::vector<Triangle> triangles;
  Box bounds;
  TriangleTree tree;
  bool inside = false;  ///< answer for points within the bounds
  NearTriangles near;
};

std::vector<Vec3> points_around(const Box& bounds, int count) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(-0.9, 0.9);  // parts of the size: some lie outside the grid
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const Vec3 at(uniform(engine), uniform(engine), uniform(engine));
    points.push_back(bounds.center() + at * bounds.size().maxCoeff());
  }
  return points;
}

bool same(const Nearest& a, const Nearest& b) {
  return a.squared == b.squared && a.triangle == b.triangle && a.feature == b.feature && a.point == b.point;
}

/// A strip of thin quads bent about y, closed by a second one behind it: like a blade.
TriangleMesh blade() {
  TriangleMesh mesh;
  constexpr int kRows = 24;
  for (const double behind : {0.0, 0.05}) {
    for (int i = 0; i <= kRows; ++i) {
      const double angle = 0.04 * i;
      mesh.vertices.emplace_back(behind - 0.3 * std::sin(angle), -0.5, 0.6 * std::cos(angle));
      mesh.vertices.emplace_back(behind - 0.3 * std::sin(angle), 0.5, 0.6 * std::cos(angle));
    }
  }
  const int back = 2 * (kRows + 1);
  for (int i = 0; i < kRows; ++i) {
    const int a = 2 * i, b = a + 1, c = a + 2, d = a + 3;
    mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {b, d, c}});
    mesh.triangles.insert(mesh.triangles.end(), {{a + back, c + back, b + back}, {b + back, c + back, d + back}});
  }
  return mesh;
}

TEST(NearTriangles, IsThatOfAllTrianglesToTheBit) {
  const double far = 4e5;  // m from the origin, as on a map
  for (const TriangleMesh& shape : {box_mesh({-0.5, -0.3, -0.02}, {0.5, 0.3, 0.02}), blade(),
                                    box_mesh({far, far, 0.0}, {far + 0.5, far + 0.3, 0.02})}) {
    const Mesh mesh(shape);
    for (int round = 0; round < 2; ++round) {
      for (const Vec3& p : points_around(mesh.bounds, 3000)) {
        Nearest found;
        ASSERT_TRUE(mesh.near.nearest(p, 1e9, found));
        ASSERT_TRUE(same(found, mesh.of_all(p))) << p.transpose();
        ASSERT_TRUE(same(mesh.tree.nearest(p), found)) << p.transpose();
      }
    }
  }
}

// Parts of a ring are all as near to its middle, so its cell has too many triangles.
TEST(NearTriangles, WhereACellHasTooMany) {
  TriangleMesh ring;
  constexpr int kSides = 300;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2.0 * mpm::kPi * i / kSides;
    ring.vertices.emplace_back(std::cos(angle), std::sin(angle), -0.5);
    ring.vertices.emplace_back(std::cos(angle), std::sin(angle), 0.5);
    const int next = (i + 1) % kSides;
    ring.triangles.insert(ring.triangles.end(), {{2 * i, 2 * next, 2 * i + 1}, {2 * next, 2 * next + 1, 2 * i + 1}});
  }
  const Mesh mesh(ring);
  for (const Vec3& p : points_around({{-0.02, -0.02, -0.3}, {0.02, 0.02, 0.3}}, 200)) {
    Nearest found;
    ASSERT_TRUE(mesh.near.nearest(p, 1e9, found));
    ASSERT_TRUE(same(found, mesh.of_all(p))) << p.transpose();
  }
}

TEST(NearTriangles, ByThreadsAtOnce) {
  const Mesh mesh(blade());
  const std::vector<Vec3> points = points_around(mesh.bounds, 2000);
  std::vector<int> wrong(4, 0);
  std::vector<std::thread> threads;
  for (int& count : wrong) {
    threads.emplace_back([&] {
      for (const Vec3& p : points) {
        Nearest found;
        count += mesh.near.nearest(p, 1e9, found) && same(found, mesh.of_all(p)) ? 0 : 1;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

// A point is passed over only if it is outside and beyond the band, and nearly all of those in the grid are.
TEST(NearTriangles, PassesOverWhatIsFarOutside) {
  Mesh mesh(box_mesh({-0.5, -0.3, -0.02}, {0.5, 0.3, 0.02}));
  int passed = 0, far = 0;
  for (const Vec3& p : points_around(mesh.bounds.grown(-0.1), 3000)) {
    Nearest found;
    const double distance = std::sqrt(mesh.of_all(p).squared);
    const bool over = !mesh.near.nearest(p, 0.1, found);
    if (over) {
      EXPECT_GT(distance, 0.1) << p.transpose();
    }
    passed += over ? 1 : 0;
    far += distance > 0.2 && mesh.bounds.grown(0.25).contains(p) ? 1 : 0;
  }
  EXPECT_GT(far, 100);
  EXPECT_GE(passed, far);
  // No point inside is passed over, however deep it lies.
  Mesh deep(box_mesh({-1, -1, -1}, {1, 1, 1}));
  deep.inside = true;
  Nearest found;
  EXPECT_TRUE(deep.near.nearest({0.1, 0.0, 0.2}, 0.1, found));
}

}  // namespace near_triangles_test
}  // namespace mpm
