#include "mesh_moments.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace mpm {

namespace {

constexpr double kRays = 65536;                     ///< through all overlaps together
constexpr int kFewestAcross = 6, kMostAcross = 64;  ///< across an overlap, with two rays along each axis
constexpr int kTries = 8;                           ///< tries of a ray that meets an edge, each time a little aside
constexpr double kAside = 1e-7;                     ///< part of a cell

/// Integrals of 1, x and x x^T about a point.
struct Integrals {
  double volume = 0.0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();

  SolidMoments about(const Vec3& apex) const {
    const Vec3 centre = first / volume;
    return {volume, apex + centre, second - volume * centre * centre.transpose()};
  }
};

/// Adds tetrahedra from the apex to every triangle, with their signs.
void add_mesh(const TriangleMesh& mesh, const Vec3& apex, Integrals& sum) {
  for (const auto& triangle : mesh.triangles) {
    std::array<Vec3, 3> arm;
    for (int c = 0; c < 3; ++c) arm[c] = mesh.vertices[triangle[c]] - apex;
    const double six = arm[0].dot(arm[1].cross(arm[2]));
    const Vec3 of_arms = arm[0] + arm[1] + arm[2];
    Mat3 squares = of_arms * of_arms.transpose();
    for (const Vec3& corner : arm) squares += corner * corner.transpose();
    sum.volume += six / 6.0;
    sum.first += six / 24.0 * of_arms;
    sum.second += six / 120.0 * squares;
  }
}

/// All places at which a ray along an axis passes the surface, for Eigen::BVIntersect.
struct Crossings {
  Vec3 origin;
  int axis;
  std::vector<std::pair<double, int>> found;  ///< place along the axis; 1 into the mesh, -1 out of it

  bool intersectVolume(const Eigen::AlignedBox3d& box) const {
    for (int k = 0; k < 3; ++k) {
      if (k != axis && (origin[k] < box.min()[k] || origin[k] > box.max()[k])) return false;
    }
    return true;
  }
  /// Moeller & Trumbore (1997). Returns true to stop: never.
  bool intersectObject(const Triangle& t) {
    const Vec3 direction = Vec3::Unit(axis), h = direction.cross(t.ac);
    const double det = t.ab.dot(h);
    if (det == 0.0) return false;
    const Vec3 s = origin - t.a, q = s.cross(t.ab);
    const double u = s.dot(h) / det, v = direction.dot(q) / det;
    if (u < 0.0 || v < 0.0 || u + v > 1.0) return false;
    found.emplace_back(origin[axis] + t.ac.dot(q) / det, det > 0.0 ? 1 : -1);
    return false;
  }
};

using Spans = std::vector<std::pair<double, double>>;

/// Spans where a line along an axis is inside a mesh. False if it meets an edge, so that this is not known.
bool spans_inside(const SignedMesh& mesh, const Vec3& origin, int axis, Spans& spans) {
  Crossings crossings{origin, axis, {}};
  Eigen::BVIntersect(mesh.tree().boxes(), crossings);
  std::sort(crossings.found.begin(), crossings.found.end());
  int depth = 0;
  double begin = 0.0;
  for (const auto& [place, step] : crossings.found) {
    if (depth == 0) begin = place;
    depth += step;
    if (depth == 0) spans.emplace_back(begin, place);
    if (depth < 0) return false;
  }
  return depth == 0;
}

/// Adds what lies both in `own` and in one of `before`, within a box.
class Overlap {
 public:
  Overlap(const SignedMesh& own, std::vector<const SignedMesh*> before, const Vec3& apex)
      : own_(own), before_(std::move(before)), apex_(apex) {}

  void add_box(const Box& box, int cells, Integrals& sum) const {
    const Vec3 size = box.size();
    int axis = 0;
    size.maxCoeff(&axis);
    const int one = (axis + 1) % 3, two = (axis + 2) % 3;
    // Gauss' two points in each cell. A cell more along one axis: no ray then lies on a diagonal of the box.
    const double step_one = size[one] / cells, step_two = size[two] / (cells + 1);
    const double gauss[2] = {0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)};
    for (int i = 0; i < 2 * cells; ++i) {
      for (int j = 0; j < 2 * (cells + 1); ++j) {
        Vec3 place = box.min;
        place[one] += (i / 2 + gauss[i % 2]) * step_one;
        place[two] += (j / 2 + gauss[j % 2]) * step_two;
        const Vec3 aside = kAside * (step_one * Vec3::Unit(one) + 0.7 * step_two * Vec3::Unit(two));
        for (const auto& [begin, end] : spans(place, axis, aside)) {
          add(place, axis, std::max(begin, box.min[axis]), std::min(end, box.max[axis]), 0.25 * step_one * step_two,
              sum);
        }
      }
    }
  }

 private:
  /// Spans where a line is inside both; nowhere, if it meets edges however it is moved.
  Spans spans(const Vec3& place, int axis, const Vec3& aside) const {
    for (int attempt = 0; attempt < kTries; ++attempt) {
      Spans own, others, both;
      const Vec3 moved = place + attempt * aside;
      bool known = spans_inside(own_, moved, axis, own);
      for (const SignedMesh* mesh : before_) known = known && spans_inside(*mesh, moved, axis, others);
      if (!known) continue;
      std::sort(others.begin(), others.end());
      double reached = -std::numeric_limits<double>::infinity();
      for (const auto& [begin, end] : others) {
        for (const auto& [from, to] : own) {
          const double low = std::max({begin, from, reached}), high = std::min(end, to);
          if (high > low) both.emplace_back(low, high);
        }
        reached = std::max(reached, end);
      }
      return both;
    }
    return {};
  }

  void add(const Vec3& place, int axis, double begin, double end, double area, Integrals& sum) const {
    if (!(end > begin)) return;
    const double length = end - begin;
    Vec3 middle = place - apex_;
    middle[axis] = 0.5 * (begin + end) - apex_[axis];
    const double volume = area * length;
    sum.volume += volume;
    sum.first += volume * middle;
    sum.second += volume * middle * middle.transpose();
    sum.second(axis, axis) += volume * length * length / 12.0;
  }

  const SignedMesh& own_;
  std::vector<const SignedMesh*> before_;
  Vec3 apex_;
};

/// For each body of meshes[number] the box in which it can overlap those of meshes before it.
std::vector<Box> overlaps_before(const std::vector<const SignedMesh*>& meshes, std::size_t number) {
  std::vector<Box> overlaps;
  for (const Box& body : meshes[number]->bodies()) {
    Box overlap;
    bool any = false;
    for (std::size_t before = 0; before < number; ++before) {
      for (const Box& other : meshes[before]->bodies()) {
        const Box common{body.min.cwiseMax(other.min), body.max.cwiseMin(other.max)};
        if (!(common.size().array() > 0.0).all()) continue;
        overlap.add(common.min);
        overlap.add(common.max);
        any = true;
      }
    }
    if (any) overlaps.push_back(overlap);
  }
  return overlaps;
}

}  // namespace

SolidMoments moments_of(const TriangleMesh& mesh) {
  const Vec3 apex = bounds_of(mesh).center();
  Integrals sum;
  add_mesh(mesh, apex, sum);
  return sum.about(apex);
}

SolidMoments moments_of_union(const std::vector<const SignedMesh*>& meshes) {
  Box bounds;
  for (const SignedMesh* mesh : meshes) {
    bounds.add(mesh->bounds().min);
    bounds.add(mesh->bounds().max);
  }
  const Vec3 apex = bounds.center();
  Integrals sum;
  std::vector<std::vector<Box>> overlaps;
  std::size_t count = 0;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    add_mesh(meshes[m]->mesh(), apex, sum);
    overlaps.push_back(overlaps_before(meshes, m));
    count += overlaps.back().size();
  }
  const double along = 0.5 * std::sqrt(kRays / static_cast<double>(std::max<std::size_t>(count, 1)));
  const int cells = static_cast<int>(std::clamp<double>(along, kFewestAcross, kMostAcross));
  for (std::size_t m = 1; m < meshes.size(); ++m) {
    const Overlap overlap(*meshes[m], {meshes.begin(), meshes.begin() + static_cast<std::ptrdiff_t>(m)}, apex);
    for (const Box& box : overlaps[m]) {
      Integrals twice;
      overlap.add_box(box, cells, twice);
      sum.volume -= twice.volume;
      sum.first -= twice.first;
      sum.second -= twice.second;
    }
  }
  return sum.about(apex);
}

}  // namespace mpm
