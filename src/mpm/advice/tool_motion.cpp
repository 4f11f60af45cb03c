#include "mpm/advice/tool_motion.hpp"

#include <algorithm>
#include <cmath>

namespace mpm {
namespace {

constexpr double kWhile = 10.0;      ///< part of a run without an end in which motions are looked at [s]
constexpr int kLooksAtMotion = 100;  ///< looks at a motion over the run

}  // namespace

ToolMotion tool_motion(const RigidBodyDefinition& body, const SimulationDefinition& definition) {
  const double length = definition.time.end > 0.0 ? definition.time.end : kWhile;
  // It turns about its origin; not along an axis without end, as y in a plane.
  const Box bounds = body.surface->bounds();
  const Vec3 corner = bounds.min.cwiseAbs().cwiseMax(bounds.max.cwiseAbs());
  const double arm = corner.unaryExpr([](double c) { return std::isfinite(c) ? c : 0.0; }).norm();
  const Vec3 down = definition.gravity.normalized();  // zero where there is none
  ToolMotion motion;
  Vec3 place = Vec3::Zero();
  for (int i = 0; i <= kLooksAtMotion; ++i) {
    Vec3 velocity, turning;
    try {
      for (std::size_t k = 0; k < 3; ++k) {
        velocity[static_cast<int>(k)] = body.velocity[k](length * i / kLooksAtMotion);
        turning[static_cast<int>(k)] = body.rotation_rate[k](length * i / kLooksAtMotion);
      }
    } catch (const FunctionError&) {
      continue;
    }
    motion.fastest = std::max(motion.fastest, velocity.norm() + arm * turning.norm());
    motion.turns = motion.turns || turning.norm() > 0.0;
    const Vec3 way = velocity * length / kLooksAtMotion;
    const double along = way.dot(down);
    motion.along += std::abs(along);
    motion.across += (way - along * down).norm();
    place += way;
    motion.places.push_back(place);
  }
  if (body.free) {
    const Twist& start = body.free->velocity;
    motion.fastest = std::max(motion.fastest, start.linear.norm() + arm * start.angular.norm());
  }
  return motion;
}

}  // namespace mpm
