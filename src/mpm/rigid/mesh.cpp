// A closed triangle mesh as a body: the signed distance of signed_mesh.hpp, with the cells of near_triangles.hpp for
// points that are asked for again and again. Parts that overlap or touch are several of these, and the nearest counts:
// outside and on the surface this is the distance to their union; inside, the depth in the part that is deepest there.
#include <fmt/format.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "mesh_moments.hpp"
#include "mpm/math/constants.hpp"
#include "mpm/rigid/compound.hpp"
#include "near_triangles.hpp"
#include "signed_mesh.hpp"

namespace mpm {

namespace {

constexpr double kThinFaces = 0.05;   // part of the surface: less may be thinner than the thickness
constexpr double kHalfOfFaces = 0.5;  // part of the surface: a sharp edge does not make a mesh thin
/// Number of samples of thickness; of a mesh with more triangles every second, third and so on is taken.
constexpr std::size_t kMostSampled = 100000;

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
struct ThicknessSample {
  double length, area;
};

std::vector<ThicknessSample> sample_thickness(const SignedMesh& mesh) {
  std::vector<ThicknessSample> samples;
  const std::size_t count = mesh.triangles().size(), each = (count + kMostSampled - 1) / kMostSampled;
  for (std::size_t i = 0; i < count; i += each) {
    const Triangle& t = mesh.triangles()[i];
    Ray ray{t.a + (t.ab + t.ac) / 3.0, -mesh.face_normal(t.index), t.index};
    Eigen::BVIntersect(mesh.tree().boxes(), ray);
    samples.push_back({ray.length, 0.5 * t.ab.cross(t.ac).norm()});
  }
  return samples;
}

/// The length that this part of the area stays below; `other` where no ray left the mesh. An estimate: a large triangle
/// is sampled once, and a knife edge of less area than that does not count.
double thickness_of(std::vector<ThicknessSample> samples, double part, double other) {
  std::sort(samples.begin(), samples.end(), [](const ThicknessSample& a, const ThicknessSample& b) {
    return a.length != b.length ? a.length < b.length : a.area < b.area;
  });
  double total = 0.0, below = 0.0;
  for (const ThicknessSample& sample : samples) total += sample.area;
  for (const ThicknessSample& sample : samples) {
    below += sample.area;
    if (below >= part * total && std::isfinite(sample.length)) return sample.length;
  }
  return other;
}

class MeshSurface final : public Surface {
 public:
  explicit MeshSurface(SolidMesh solid)
      : mesh_(std::move(solid)),
        near_(mesh_.tree(), mesh_.triangles(), mesh_.bounds(),
              [this](const Vec3& p, const Nearest& nearest) { return mesh_.seen_from(p, nearest).distance < 0.0; }),
        samples_(sample_thickness(mesh_)) {
    thickness_ = thickness_of(samples_, kThinFaces, mesh_.bounds().size().minCoeff());
  }

  SurfacePoint at(const Vec3& point) const override {
    Nearest nearest;
    near_.nearest(point, kInfinity, nearest);
    return mesh_.seen_from(point, nearest);
  }

  bool within(const Vec3& point, double band, SurfacePoint& result) const override {
    const Box& bounds = mesh_.bounds();
    const double outside = (bounds.min - point).cwiseMax(point - bounds.max).maxCoeff();
    if (outside > std::max(band, 0.0)) return false;
    Nearest nearest;
    if (!near_.nearest(point, band, nearest)) return false;
    const SurfacePoint found = mesh_.seen_from(point, nearest);
    if (found.distance > band) return false;
    result = found;
    return true;
  }

  Box bounds() const override { return mesh_.bounds(); }
  double thickness() const override { return thickness_; }

  std::vector<std::array<Vec3, 3>> triangles() const override {
    std::vector<std::array<Vec3, 3>> result;
    result.reserve(mesh_.triangles().size());
    for (std::size_t t = 0; t < mesh_.triangles().size(); ++t) result.push_back(mesh_.corners(t));
    return result;
  }

  std::optional<SolidMoments> moments(double) const override { return moments_of(mesh_.mesh()); }

  const SignedMesh& mesh() const { return mesh_; }
  /// Hands over the samples, which are of no use later.
  std::vector<ThicknessSample> take_samples() { return std::exchange(samples_, {}); }

 private:
  SignedMesh mesh_;
  NearTriangles near_;
  std::vector<ThicknessSample> samples_;
  double thickness_ = 0.0;
};

/// Groups of parts as one body.
class MeshUnion final : public Surface {
 public:
  explicit MeshUnion(std::vector<std::unique_ptr<MeshSurface>> groups) {
    for (auto& group : groups) groups_.push_back(std::move(group));
    std::vector<PlacedSurface> placed;
    for (const auto& group : groups_) placed.push_back({group, {}});
    nearest_ = make_compound(std::move(placed));
  }

  SurfacePoint at(const Vec3& point) const override { return nearest_->at(point); }
  bool within(const Vec3& point, double band, SurfacePoint& result) const override {
    return nearest_->within(point, band, result);
  }
  Box bounds() const override { return nearest_->bounds(); }
  double thickness() const override { return nearest_->thickness(); }
  std::vector<std::array<Vec3, 3>> triangles() const override { return nearest_->triangles(); }

  std::optional<SolidMoments> moments(double) const override {
    std::vector<const SignedMesh*> meshes;
    for (const auto& group : groups_) meshes.push_back(&group->mesh());
    return moments_of_union(meshes);
  }

 private:
  std::vector<std::shared_ptr<MeshSurface>> groups_;
  std::unique_ptr<Surface> nearest_;
};

}  // namespace

std::unique_ptr<Surface> make_mesh(const TriangleMesh& mesh, double thinnest) {
  std::vector<std::unique_ptr<MeshSurface>> groups;
  std::vector<ThicknessSample> samples;
  Box bounds;
  for (SolidMesh& group : disjoint_groups(solid_mesh(mesh))) {
    groups.push_back(std::make_unique<MeshSurface>(std::move(group)));
    const std::vector<ThicknessSample> own = groups.back()->take_samples();
    samples.insert(samples.end(), own.begin(), own.end());
    bounds.add(groups.back()->bounds().min);
    bounds.add(groups.back()->bounds().max);
  }
  const Vec3 size = bounds.size();
  if (const double half = thickness_of(std::move(samples), kHalfOfFaces, size.minCoeff()); half < thinnest) {
    throw RigidError(
        fmt::format("half of the mesh is less than {:.3g} m thick, and it has to be at least {:.3g} m; its size is "
                    "{:.4g} x {:.4g} x {:.4g} m: check its unit (scale), make it thicker, or the grid's cells smaller",
                    half, thinnest, size.x(), size.y(), size.z()));
  }
  if (groups.size() > 1) return std::make_unique<MeshUnion>(std::move(groups));
  return std::move(groups.front());
}

}  // namespace mpm
