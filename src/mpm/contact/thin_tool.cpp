#include "mpm/contact/thin_tool.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

namespace mpm {
namespace {

/// Excess by which a surface is a plate's: of its parts (summing to 1) that face along each of three directions, the
/// largest exceeds the next by this. A rectangle of 1 to 2 is one, a square is not.
constexpr double kPlate = 0.25;
constexpr double kAsThin = 0.5;           ///< part of the largest part: a direction that a round tool is as thin along
constexpr double kTurned = 0.8660254038;  ///< cosine of 30 degrees
constexpr double kLeastStride = 1e-3;     ///< part of a line that is traced: a sheet thinner than that may be missed

constexpr double kThinCells = 3.0 * (1.0 - 1e-9);  ///< a body of just three cells is not thin for round-off
constexpr double kOpposite = 1.5, kBefore = 0.1;   ///< thicknesses into the body, to beyond it, and out of it

/// The middle of the bounds, 0 along axes without end.
Vec3 middle_of(const Surface& surface) {
  const Box bounds = surface.bounds();
  Vec3 middle = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    if (std::isfinite(bounds.min[k]) && std::isfinite(bounds.max[k])) middle[k] = bounds.center()[k];
  }
  return middle;
}

}  // namespace

bool is_thin(const RigidBodyDefinition& body, GeometryKind geometry, double cell) {
  const Surface& surface = *body.surface;
  if (surface.thickness() >= kThinCells * cell) return false;
  const bool rod = axisymmetric(geometry) && body.inner_radius == 0.0 && surface.at(middle_of(surface)).distance <= 0.0;
  return !rod || surface.bounds().size().z() < kThinCells * cell;
}

bool divides(const RigidBodyDefinition& tool, const std::string& body) {
  const auto& named = tool.divides;
  return named.empty() || std::find(named.begin(), named.end(), body) != named.end();
}

ThinTool::ThinTool(const RigidBody& body, GeometryKind geometry) : body_(&body) {
  const RigidBodyDefinition& definition = body.definition();
  if (definition.inner_radius > 0.0) {  // the section of a ring, in the half plane
    middle_.x() = 0.5 * (definition.inner_radius + definition.outer_radius);
    if (definition.outer_radius - definition.inner_radius < body.surface().bounds().size().z()) across_ = Vec3::UnitX();
    return;
  }
  middle_ = middle_of(body.surface());
  find_directions(geometry);
  distinguished_ = count_apart();
  const Kind flat = std::exchange(kind_, Kind::shell);
  if (const double as_shell = count_apart(); as_shell > distinguished_) {
    distinguished_ = as_shell;
  } else {
    kind_ = flat;
  }
}

double ThinTool::count_apart() const {
  const Surface& surface = body_->surface();
  const double thickness = surface.thickness();
  double opposed = 0.0, apart = 0.0;
  for (const auto& [a, b, c] : surface.triangles()) {
    const Vec3 twice = (b - a).cross(c - a);
    const double area = twice.norm();
    if (!(area > 0.0)) continue;
    const Vec3 normal = twice / area, face = (a + b + c) / 3.0, opposite = face - kOpposite * thickness * normal;
    if (surface.at(opposite).distance <= 0.0) continue;
    opposed += area;
    if (side_in_body(face + kBefore * thickness * normal) != side_in_body(opposite)) apart += area;
  }
  return opposed > 0.0 ? apart / opposed : 1.0;
}

void ThinTool::find_directions(GeometryKind geometry) {
  Mat3 facing = Mat3::Zero();
  for (const auto& [a, b, c] : body_->surface().triangles()) {
    const Vec3 normal = 0.5 * (b - a).cross(c - a);
    if (const double area = normal.norm(); area > 0.0) facing += normal * normal.transpose() / area;
  }
  for (const int axis : axes_beside(geometry)) {
    facing.row(axis).setZero();
    facing.col(axis).setZero();
  }
  if (axisymmetric(geometry)) {  // across the axis is no other side
    facing.setZero();
    facing(2, 2) = 1.0;
  }
  facing /= facing.trace();
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(facing);  // ascending
  const Vec3 part = solver.eigenvalues();
  const Mat3 direction = solver.eigenvectors();
  if (part[2] - part[1] > kPlate) {
    across_ = direction.col(2);
    return;
  }
  kind_ = Kind::round;
  for (int i = 0; i < 3; ++i) {
    if (part[i] > kAsThin * part[2]) possible_ += direction.col(i) * direction.col(i).transpose();
  }
  // Direction z or x, for a rod along z or a wire along y in a plane.
  const Vec3 up = possible_ * Vec3::UnitZ();
  across_ = (up.norm() > 0.5 ? up : Vec3(possible_ * Vec3::UnitX())).normalized();
}

void ThinTool::aim() {
  if (kind_ != Kind::round) return;
  const Vec3 motion = possible_ * (body_->pose().orientation.conjugate() * body_->twist().linear);
  const double speed = motion.norm();
  if (speed > 0.0 && std::abs(motion.dot(across_)) < kTurned * speed) across_ = motion / speed;
}

int ThinTool::side(const Vec3& point) const { return side_in_body(body_->pose().to_body(point)); }

int ThinTool::side_in_body(const Vec3& at) const {
  if (kind_ != Kind::shell) return (at - middle_).dot(across_) < 0.0 ? 1 : 0;
  const SurfacePoint nearest = body_->surface().at(at);
  const Vec3 foot = at - nearest.distance * nearest.normal;
  return (foot - middle_).dot(nearest.normal) < 0.0 ? 1 : 0;
}

bool ThinTool::within(const Vec3& point, double band, SurfacePoint& found) const {
  return body_->surface().within(body_->pose().to_body(point), band, found);
}

bool ThinTool::between(const Vec3& from, const Vec3& to) const {
  const Vec3 start = body_->pose().to_body(from), line = body_->pose().to_body(to) - start;
  const double length = line.norm();
  for (double travelled = 0.0; travelled <= length;) {
    const Vec3 at = length > 0.0 ? Vec3(start + line * (travelled / length)) : start;
    const double free = body_->surface().at(at).distance;
    if (free <= 0.0) return true;
    travelled += free + kLeastStride * length;
    if (length == 0.0) break;
  }
  return false;
}

}  // namespace mpm
