// A closed triangle mesh as a signed distance: the nearest triangle (near_triangles.hpp), the sign by angle-weighted
// pseudonormals (Baerentzen & Aanaes (2005), IEEE Trans. Vis. Comput. Graph. 11(3), 243-253).
#include <fmt/format.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "mpm/math/constants.hpp"
#include "mpm/rigid/mesh_topology.hpp"
#include "mpm/rigid/surface.hpp"
#include "near_triangles.hpp"

namespace mpm {

namespace {

constexpr double kThinFaces = 0.05;   // of the surface: less may be thinner than the thickness
constexpr double kHalfOfFaces = 0.5;  // of the surface: a sharp edge does not make a mesh thin

class MeshSurface final : public Surface {
 public:
  MeshSurface(const TriangleMesh& mesh, double thinnest)
      : mesh_(solid_mesh(mesh)),
        triangles_(triangles_of(mesh_)),
        bounds_(bounds_of(mesh_)),
        tree_(triangles_),
        near_(tree_, triangles_, bounds_,
              [this](const Vec3& p, const Nearest& nearest) { return seen_from(p, nearest).distance < 0.0; }) {
    find_pseudonormals();
    const std::vector<Sample> samples = sample_thickness();
    thickness_ = thickness_of(samples, kThinFaces);
    if (const double half = thickness_of(samples, kHalfOfFaces); half < thinnest) {
      const Vec3 size = bounds_.size();
      throw RigidError(fmt::format(
          "half of the mesh is less than {:.3g} m thick, and it has to be at least {:.3g} m; its size is "
          "{:.4g} x {:.4g} x {:.4g} m: check its unit (scale), make it thicker, or the grid's cells smaller",
          half, thinnest, size.x(), size.y(), size.z()));
    }
  }

  SurfacePoint at(const Vec3& point) const override {
    Nearest nearest;
    near_.nearest(point, kInfinity, nearest);
    return seen_from(point, nearest);
  }

  bool within(const Vec3& point, double band, SurfacePoint& result) const override {
    const double outside = (bounds_.min - point).cwiseMax(point - bounds_.max).maxCoeff();
    if (outside > std::max(band, 0.0)) return false;
    Nearest nearest;
    if (!near_.nearest(point, band, nearest)) return false;
    const SurfacePoint found = seen_from(point, nearest);
    if (found.distance > band) return false;
    result = found;
    return true;
  }

  Box bounds() const override { return bounds_; }
  double thickness() const override { return thickness_; }

  std::vector<std::array<Vec3, 3>> triangles() const override {
    std::vector<std::array<Vec3, 3>> result;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) result.push_back(corners(t));
    return result;
  }

  // Tetrahedra from a point to every triangle, with their signs.
  std::optional<SolidMoments> moments(double) const override {
    const Vec3 apex = bounds_.center();
    double volume = 0.0;
    Vec3 first = Vec3::Zero();
    Mat3 second = Mat3::Zero();
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      std::array<Vec3, 3> arm = corners(t);
      for (Vec3& corner : arm) corner -= apex;
      const double six = arm[0].dot(arm[1].cross(arm[2]));
      const Vec3 sum = arm[0] + arm[1] + arm[2];
      Mat3 squares = sum * sum.transpose();
      for (const Vec3& corner : arm) squares += corner * corner.transpose();
      volume += six / 6.0;
      first += six / 24.0 * sum;
      second += six / 120.0 * squares;
    }
    const Vec3 centre = first / volume;
    return SolidMoments{volume, apex + centre, second - volume * centre * centre.transpose()};
  }

 private:
  static Box bounds_of(const TriangleMesh& mesh) {
    Box bounds;
    for (const auto& triangle : mesh.triangles) {
      for (const int corner : triangle) bounds.add(mesh.vertices[corner]);
    }
    return bounds;
  }

  SurfacePoint seen_from(const Vec3& point, const Nearest& nearest) const {
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

  std::array<Vec3, 3> corners(std::size_t t) const {
    const auto& [i, j, k] = mesh_.triangles[t];
    return {mesh_.vertices[i], mesh_.vertices[j], mesh_.vertices[k]};
  }

  /// An edge's is the sum of its two faces' normals, a corner's that of its faces' weighted by their angle there.
  void find_pseudonormals() {
    const std::size_t count = mesh_.triangles.size();
    face_normals_.resize(count);
    edge_normals_.resize(count);
    corner_normals_.assign(mesh_.vertices.size(), Vec3::Zero());
    std::map<std::pair<int, int>, Vec3> edge_sum;  // undirected: lower index first
    const auto key = [](int i, int j) { return std::make_pair(std::min(i, j), std::max(i, j)); };
    for (std::size_t t = 0; t < count; ++t) {
      const auto [a, b, c] = corners(t);
      const Vec3 normal = (b - a).cross(c - a).normalized();
      face_normals_[t] = normal;
      const std::array<Vec3, 3> p{a, b, c};
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const Vec3 u = p[j] - p[i], v = p[k] - p[i];
        corner_normals_[mesh_.triangles[t][i]] += std::atan2(u.cross(v).norm(), u.dot(v)) * normal;
        edge_sum.emplace(key(mesh_.triangles[t][i], mesh_.triangles[t][j]), Vec3::Zero()).first->second += normal;
      }
    }
    for (Vec3& normal : corner_normals_) normal.normalize();
    for (std::size_t t = 0; t < count; ++t) {
      for (int i = 0; i < 3; ++i) {
        edge_normals_[t][i] = edge_sum.at(key(mesh_.triangles[t][i], mesh_.triangles[t][(i + 1) % 3])).normalized();
      }
    }
  }

  /// A ray from inside the mesh, for Eigen::BVIntersect: how far to where it leaves.
  struct Ray {
    Vec3 origin, direction;
    int from;  ///< triangle it starts at
    double length = kInfinity;

    bool intersectVolume(const Eigen::AlignedBox3d& box) const {
      double enter = 0.0, leave = length;
      for (int i = 0; i < 3; ++i) {
        if (direction[i] == 0.0) {
          if (origin[i] < box.min()[i] || origin[i] > box.max()[i]) return false;
          continue;
        }
        const double one = (box.min()[i] - origin[i]) / direction[i];
        const double two = (box.max()[i] - origin[i]) / direction[i];
        enter = std::max(enter, std::min(one, two));
        leave = std::min(leave, std::max(one, two));
      }
      return enter <= leave;
    }

    /// Moeller & Trumbore (1997). Returns true to stop: never, since a nearer triangle may follow.
    bool intersectObject(const Triangle& t) {
      const Vec3 h = direction.cross(t.ac);
      const double det = t.ab.dot(h);
      if (t.index == from || det >= 0.0) return false;  // entering, or along the face
      const Vec3 s = origin - t.a, q = s.cross(t.ab);
      const double u = s.dot(h) / det, v = direction.dot(q) / det, distance = t.ac.dot(q) / det;
      if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0) length = std::min(length, distance);
      return false;
    }
  };

  /// A triangle's area, and the length of a ray inwards from its centroid; infinite where none leaves the mesh.
  struct Sample {
    double length, area;
  };

  std::vector<Sample> sample_thickness() const {
    std::vector<Sample> samples;
    for (const Triangle& t : triangles_) {
      Ray ray{t.a + (t.ab + t.ac) / 3.0, -face_normals_[t.index], t.index};
      Eigen::BVIntersect(tree_.boxes(), ray);
      samples.push_back({ray.length, 0.5 * t.ab.cross(t.ac).norm()});
    }
    std::sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) {
      return a.length != b.length ? a.length < b.length : a.area < b.area;
    });
    return samples;
  }

  /// The length that this part of the area stays below. An estimate: a large triangle is sampled once, and a knife edge
  /// of less area than that does not count.
  double thickness_of(const std::vector<Sample>& samples, double part) const {
    double total = 0.0, below = 0.0;
    for (const Sample& sample : samples) total += sample.area;
    for (const Sample& sample : samples) {
      below += sample.area;
      if (below >= part * total && std::isfinite(sample.length)) return sample.length;
    }
    return bounds_.size().minCoeff();
  }

  TriangleMesh mesh_;
  std::vector<Triangle> triangles_;
  Box bounds_;
  TriangleTree tree_;
  NearTriangles near_;
  std::vector<Vec3> face_normals_, corner_normals_;
  std::vector<std::array<Vec3, 3>> edge_normals_;  // of each triangle, edge i from corner i
  double thickness_ = 0.0;
};

}  // namespace

std::unique_ptr<Surface> make_mesh(const TriangleMesh& mesh, double thinnest) {
  return std::make_unique<MeshSurface>(mesh, thinnest);
}

}  // namespace mpm
