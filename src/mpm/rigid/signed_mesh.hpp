// A closed triangle mesh as a signed distance: the nearest triangle of a tree, the sign by angle-weighted pseudonormals
// (Baerentzen & Aanaes (2005), IEEE Trans. Vis. Comput. Graph. 11(3), 243-253). Right for parts that do not overlap.
#pragma once

#include <array>
#include <vector>

#include "mpm/rigid/mesh_topology.hpp"
#include "triangle_tree.hpp"

namespace mpm {

class SignedMesh {
 public:
  explicit SignedMesh(SolidMesh solid);

  /// The surface as seen from a point whose nearest triangle is known.
  SurfacePoint seen_from(const Vec3& point, const Nearest& nearest) const;
  SurfacePoint at(const Vec3& point) const { return seen_from(point, tree_.nearest(point)); }

  const TriangleMesh& mesh() const { return mesh_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  const TriangleTree& tree() const { return tree_; }
  const Box& bounds() const { return bounds_; }
  /// Bounds of each body, without those of its holes [m].
  const std::vector<Box>& bodies() const { return bodies_; }
  const Vec3& face_normal(int triangle) const { return face_normals_[static_cast<std::size_t>(triangle)]; }
  std::array<Vec3, 3> corners(std::size_t t) const;

 private:
  void find_pseudonormals(const std::vector<int>& mate);

  std::vector<Box> bodies_;
  TriangleMesh mesh_;
  std::vector<Triangle> triangles_;
  Box bounds_;
  TriangleTree tree_;
  std::vector<Vec3> face_normals_, corner_normals_;
  std::vector<std::array<Vec3, 3>> edge_normals_;  // normals of each triangle's edges, edge i from corner i
};

/// Bounds of the triangles [m].
Box bounds_of(const TriangleMesh& mesh);

}  // namespace mpm
