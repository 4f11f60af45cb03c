#include "signed_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mpm {

Box bounds_of(const TriangleMesh& mesh) {
  Box bounds;
  for (const auto& triangle : mesh.triangles) {
    for (const int corner : triangle) bounds.add(mesh.vertices[corner]);
  }
  return bounds;
}

namespace {

/// A hole's lie in those of the body around it; those of bodies that are apart do not.
std::vector<Box> bounds_of_bodies(const SolidMesh& solid) {
  std::vector<Box> all(static_cast<std::size_t>(solid.parts)), bodies;
  for (std::size_t t = 0; t < solid.part.size(); ++t) {
    for (const int corner : solid.mesh.triangles[t]) all[solid.part[t]].add(solid.mesh.vertices[corner]);
  }
  for (std::size_t p = 0; p < all.size(); ++p) {
    const auto holds = [&](const Box& other) {
      return &other != &all[p] && other.contains(all[p].min) && other.contains(all[p].max);
    };
    if (std::none_of(all.begin(), all.end(), holds)) bodies.push_back(all[p]);
  }
  return bodies;
}

}  // namespace

SignedMesh::SignedMesh(SolidMesh solid)
    : bodies_(bounds_of_bodies(solid)),
      mesh_(std::move(solid.mesh)),
      triangles_(triangles_of(mesh_)),
      bounds_(bounds_of(mesh_)),
      tree_(triangles_) {
  find_pseudonormals(solid.mate);
}

std::array<Vec3, 3> SignedMesh::corners(std::size_t t) const {
  const auto& [i, j, k] = mesh_.triangles[t];
  return {mesh_.vertices[i], mesh_.vertices[j], mesh_.vertices[k]};
}

SurfacePoint SignedMesh::seen_from(const Vec3& point, const Nearest& nearest) const {
  const Vec3 away = point - nearest.point;
  SurfacePoint result;
  if (nearest.feature == kFace) {
    result.normal = face_normals_[nearest.triangle];
    result.distance = away.dot(result.normal);
    return result;
  }
  const Vec3& pseudonormal = nearest.feature < kEdge
                                 ? corner_normals_[mesh_.triangles[nearest.triangle][nearest.feature]]
                                 : edge_normals_[nearest.triangle][nearest.feature - kEdge];
  const double distance = std::sqrt(nearest.squared);
  const double sign = away.dot(pseudonormal) < 0.0 ? -1.0 : 1.0;
  result.distance = sign * distance;
  // On the edge itself, to rounding, there is no direction from the nearest point.
  const bool on_surface = distance <= 1e-13 * (bounds_.size().norm() + point.norm());
  result.normal = on_surface ? pseudonormal : Vec3(sign * away / distance);
  return result;
}

/// An edge's is the sum of its two faces' normals, a corner's that of its faces' weighted by their angle there.
void SignedMesh::find_pseudonormals(const std::vector<int>& mate) {
  const std::size_t count = mesh_.triangles.size();
  face_normals_.resize(count);
  edge_normals_.resize(count);
  corner_normals_.assign(mesh_.vertices.size(), Vec3::Zero());
  for (std::size_t t = 0; t < count; ++t) {
    const auto [a, b, c] = corners(t);
    const Vec3 normal = (b - a).cross(c - a).normalized();
    face_normals_[t] = normal;
    const std::array<Vec3, 3> p{a, b, c};
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const Vec3 u = p[j] - p[i], v = p[k] - p[i];
      corner_normals_[mesh_.triangles[t][i]] += std::atan2(u.cross(v).norm(), u.dot(v)) * normal;
    }
  }
  for (Vec3& normal : corner_normals_) normal.normalize();
  for (std::size_t t = 0; t < count; ++t) {
    for (std::size_t i = 0; i < 3; ++i)
      edge_normals_[t][i] = (face_normals_[t] + face_normals_[mate[3 * t + i] / 3]).normalized();
  }
}

}  // namespace mpm
