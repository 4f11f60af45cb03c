#include "mpm/rigid/compound.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace mpm {

namespace {

/// The box, axis-aligned in the body's frame, about a box of the part's.
Box moved(const Box& box, const Pose& pose) {
  Box result;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 point;
    for (int k = 0; k < 3; ++k) point[k] = (corner >> k & 1) != 0 ? box.max[k] : box.min[k];
    result.add(pose.to_world(point));
  }
  return result;
}

class CompoundSurface final : public Surface {
 public:
  explicit CompoundSurface(std::vector<PlacedSurface> parts) : parts_(std::move(parts)) {
    for (const PlacedSurface& part : parts_) {
      const Box bounds = moved(part.surface->bounds(), part.pose);
      bounds_.add(bounds.min);
      bounds_.add(bounds.max);
      thickness_ = std::min(thickness_, part.surface->thickness());
    }
  }

  SurfacePoint at(const Vec3& point) const override {
    SurfacePoint nearest;
    nearest.distance = std::numeric_limits<double>::infinity();
    for (const PlacedSurface& part : parts_) {
      const SurfacePoint found = part.surface->at(part.pose.to_body(point));
      if (found.distance < nearest.distance) nearest = {found.distance, part.pose.orientation * found.normal};
    }
    return nearest;
  }

  bool within(const Vec3& point, double band, SurfacePoint& result) const override {
    if (!bounds_.grown(std::max(band, 0.0)).contains(point)) return false;
    bool any = false;
    for (const PlacedSurface& part : parts_) {
      SurfacePoint found;
      if (!part.surface->within(part.pose.to_body(point), band, found)) continue;
      if (any && !(found.distance < result.distance)) continue;
      result = {found.distance, part.pose.orientation * found.normal};
      any = true;
    }
    return any;
  }

  Box bounds() const override { return bounds_; }
  double thickness() const override { return thickness_; }

  std::vector<std::array<Vec3, 3>> triangles() const override {
    std::vector<std::array<Vec3, 3>> result;
    for (const PlacedSurface& part : parts_) {
      for (const std::array<Vec3, 3>& triangle : part.surface->triangles()) {
        result.push_back(
            {part.pose.to_world(triangle[0]), part.pose.to_world(triangle[1]), part.pose.to_world(triangle[2])});
      }
    }
    return result;
  }

 private:
  std::vector<PlacedSurface> parts_;
  Box bounds_;
  double thickness_ = std::numeric_limits<double>::infinity();
};

}  // namespace

std::unique_ptr<Surface> make_compound(std::vector<PlacedSurface> parts) {
  if (parts.empty()) throw RigidError("a body of several parts has none; give it one");
  for (const PlacedSurface& part : parts) {
    const Box bounds = part.surface->bounds();
    if (!bounds.min.allFinite() || !bounds.max.allFinite()) {
      throw RigidError("a part of a body of several parts is without end; give it one along every axis");
    }
  }
  return std::make_unique<CompoundSurface>(std::move(parts));
}

}  // namespace mpm
