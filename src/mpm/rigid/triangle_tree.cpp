#include "triangle_tree.hpp"

#include <array>
#include <utility>

namespace mpm {
namespace {

using Tree = Eigen::KdBVH<double, 3, Triangle>;

constexpr double kOfCoordinates = 1e-14;  ///< round-off over the coordinate

/// A box that has still to be entered.
struct Entry {
  double squared;
  int node;
};
/// The tree is balanced: its depth is the logarithm of the number of triangles.
using Stack = std::array<Entry, 64>;

}  // namespace

std::vector<Triangle> triangles_of(const TriangleMesh& mesh) {
  std::vector<Triangle> result;
  for (const auto& [i, j, k] : mesh.triangles) {
    result.emplace_back(mesh.vertices[i], mesh.vertices[j], mesh.vertices[k], static_cast<int>(result.size()));
  }
  return result;
}

TriangleTree::TriangleTree(const std::vector<Triangle>& triangles) {
  std::vector<Eigen::AlignedBox3d> boxes;
  Eigen::AlignedBox3d all;
  for (const Triangle& t : triangles) {
    boxes.emplace_back(t.a);
    boxes.back().extend(t.a + t.ab).extend(t.a + t.ac);
    all.extend(boxes.back());
  }
  round_off_ = kOfCoordinates * all.min().cwiseAbs().cwiseMax(all.max().cwiseAbs()).maxCoeff();
  tree_.init(triangles.begin(), triangles.end(), boxes.begin(), boxes.end());
}

// Depth first, the nearer child first; boxes farther than the best triangle so far are passed over.
Nearest TriangleTree::nearest(const Vec3& point) const {
  Nearest best;
  Stack stack;
  int size = 0;
  stack[size++] = {0.0, tree_.getRootIndex()};
  while (size > 0) {
    const Entry entry = stack[--size];
    if (entry.squared > with_round_off(best.squared)) continue;
    Tree::VolumeIterator child = nullptr, last_child = nullptr;
    Tree::ObjectIterator leaf = nullptr, last_leaf = nullptr;
    tree_.getChildren(entry.node, child, last_child, leaf, last_leaf);
    for (; leaf != last_leaf; ++leaf) nearest_of(*leaf, point, best);
    const int first = size;
    for (; child != last_child; ++child) {
      const double squared = tree_.getVolume(*child).squaredExteriorDistance(point);
      if (squared <= with_round_off(best.squared)) stack[size++] = {squared, *child};
    }
    if (size - first == 2 && stack[first].squared < stack[first + 1].squared) {
      std::swap(stack[first], stack[first + 1]);
    }
  }
  return best;
}

int TriangleTree::within(const Vec3& point, double distance, const Triangle** found, int most) const {
  const double farthest = with_round_off(distance * distance);
  int count = 0;
  Stack stack;
  int size = 0;
  stack[size++] = {0.0, tree_.getRootIndex()};
  while (size > 0) {
    Tree::VolumeIterator child = nullptr, last_child = nullptr;
    Tree::ObjectIterator leaf = nullptr, last_leaf = nullptr;
    tree_.getChildren(stack[--size].node, child, last_child, leaf, last_leaf);
    for (; leaf != last_leaf; ++leaf) {
      Nearest nearest;
      nearest_of(*leaf, point, nearest);
      if (nearest.squared > farthest) continue;
      if (count == most) return -1;
      found[count++] = leaf;
    }
    for (; child != last_child; ++child) {
      const double squared = tree_.getVolume(*child).squaredExteriorDistance(point);
      if (squared <= farthest) stack[size++] = {squared, *child};
    }
  }
  return count;
}

}  // namespace mpm
