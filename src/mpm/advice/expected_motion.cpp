#include "mpm/advice/expected_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mpm/material/law.hpp"
#include "mpm/material/material_point.hpp"
#include "mpm/math/constants.hpp"
#include "mpm/scene/scene_parts.hpp"

namespace mpm {
namespace {

constexpr double kFlowStrain = 1.0;     // strain of a material that deforms without end
constexpr double kPressedStrain = 0.1;  // strain where the scene alone does not determine it
constexpr double kQuarterTurn = 0.5 * kPi;
constexpr int kSamples = 5;  // points along an axis at which a body's largest speed is sought

/// Initial motion, from the velocity at points spread over the body's bounds.
struct Start {
  double speed = 0.0;  ///< largest [m/s]
  double rate = 0.0;   ///< rate of rotation about the middle [rad/s]
};

/// Points where an expression has no value are skipped; the error comes when particles are made.
Start start_of(const BodyDefinition& body, const Scene& scene) {
  const Box bounds = body.region.bounds();
  const Vec3 middle = 0.5 * (bounds.min + bounds.max);
  const std::vector<int> axes = axes_of(scene);
  Start start;
  Vec3 turning = Vec3::Zero();  // sum of r x v
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  const auto samples = static_cast<int>(std::lround(std::pow(kSamples, axes.size())));
  for (int i = 0; i < samples; ++i) {
    Vec3 arm = Vec3::Zero();
    for (int k = 0, rest = i; k < static_cast<int>(axes.size()); ++k, rest /= kSamples) {
      const double part = static_cast<double>(rest % kSamples) / (kSamples - 1) - 0.5;
      arm[axes[k]] = part * (bounds.max[axes[k]] - bounds.min[axes[k]]);
    }
    Vec3 place = Vec3::Zero();
    for (const int axis : axes) place[axis] = middle[axis] + arm[axis];
    try {
      const Vec3 velocity(body.velocity[0](0.0, place), body.velocity[1](0.0, place), body.velocity[2](0.0, place));
      start.speed = std::max(start.speed, velocity.norm());
      turning += arm.cross(velocity);
      inertia += arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose();
    } catch (const FunctionError&) {
      continue;
    }
  }
  if (axes.size() > 1 && start.speed > 0.0) start.rate = inertia.ldlt().solve(turning).norm();
  return start;
}

struct Arrival {
  double speed = 0.0;   ///< largest, at the start or after a fall to the face of the grid [m/s]
  double rate = 0.0;    ///< rate of rotation at the start [rad/s]
  double weight = 0.0;  ///< g H [m^2/s^2]
};

Arrival arrival(const BodyDefinition& body, const Scene& scene) {
  const Box bounds = body.region.bounds();
  const GridDefinition& grid = scene.definition.grid;
  const Vec3& gravity = scene.definition.gravity;
  double fall = 0.0;  // g h
  Arrival result;
  for (const int axis : axes_of(scene)) {
    const double pull = std::abs(gravity[axis]);
    const double gap = gravity[axis] < 0.0 ? bounds.min[axis] - grid.min[axis] : grid.max[axis] - bounds.max[axis];
    // A body within a cell of the face stands on it.
    if (pull > 0.0 && gap > grid.cell[axis]) fall += pull * gap;
    if (pull > 0.0) result.weight += pull * (bounds.max[axis] - bounds.min[axis]);
  }
  const Start start = start_of(body, scene);
  result.speed = std::sqrt(start.speed * start.speed + 2.0 * fall);
  result.rate = start.rate;
  return result;
}

/// Largest edge of the body's bounds [m].
double body_size(const BodyDefinition& body, const Scene& scene) {
  double largest = 0.0;
  for (const int axis : axes_of(scene)) largest = std::max(largest, body.region.bounds().size()[axis]);
  return largest;
}

void find_elastic_motion(const Scene& scene, ExpectedMotion& expected) {
  expected.strain_why = "nothing moves the material";
  const double end = scene.definition.time.end;
  for (const BodyDefinition& body : scene.bodies) {
    const double wave = MaterialPoint(material_of(body, scene)).wave_speed();
    const Arrival at = arrival(body, scene);
    const double strain = at.speed / wave + at.weight / (wave * wave);
    const double turn = end > 0.0 ? at.rate * end : kQuarterTurn;
    // A billionth of the rate at which the fastest point would circle the middle is round-off.
    if (axisymmetric(scene.definition.geometry)) {
      expected.turn_why = "nothing turns as a whole about an axis";
    } else if (at.rate * body_size(body, scene) > 1e-9 * at.speed && turn > expected.turn) {
      expected.turn = turn;
      expected.turn_why = fmt::format("{} starts to turn at {:.3g} rad/s", body.name, at.rate);
    }
    if (strain <= expected.strain) continue;
    expected.strain = strain;
    expected.strain_why =
        fmt::format("{} at up to {:.3g} m/s and under its weight, over waves of {:.3g} m/s", body.name, at.speed, wave);
  }
  const SimulationDefinition& definition = scene.definition;
  const bool stressed = std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                    [](const BodyDefinition& body) { return body.stress.has_value(); });
  const bool loaded =
      !definition.body_forces.empty() || !definition.particle_forces.empty() || !definition.tractions.empty();
  const char* unknown = !definition.rigid_bodies.empty() ? "rigid bodies may press"
                        : loaded                         ? "loads act"
                        : stressed                       ? "there is stress at the start"
                                                         : nullptr;
  if (unknown != nullptr && expected.strain < kPressedStrain) {
    expected.strain = kPressedStrain;
    expected.strain_why = fmt::format("not known, since {}", unknown);
  }
}

}  // namespace

ExpectedMotion expected_motion(const Scene& scene) {
  const SimulationDefinition& definition = scene.definition;
  ExpectedMotion expected;
  expected.turn_why =
      definition.geometry == GeometryKind::line ? "nothing turns in a line" : "no body turns at the start";
  for (const BodyDefinition& body : scene.bodies) {
    if (!traits_of(material_of(body, scene)).flows) continue;
    expected.flows = true;
    expected.strain = kFlowStrain;
    expected.strain_why = fmt::format("{} flows", body.material);
    break;
  }
  expected.free = std::any_of(scene.bodies.begin(), scene.bodies.end(),
                              [&](const BodyDefinition& body) { return arrival(body, scene).speed > 0.0; });
  if (!expected.flows) find_elastic_motion(scene, expected);
  const bool turned =
      std::any_of(definition.rigid_bodies.begin(), definition.rigid_bodies.end(), [](const RigidBodyDefinition& body) {
        return std::any_of(body.rotation_rate.begin(), body.rotation_rate.end(),
                           [](const Function& rate) { return !rate.is_zero(); });
      });
  if (definition.geometry != GeometryKind::line && (expected.flows || turned)) {
    expected.turn = kQuarterTurn;
    expected.turn_why = expected.flows ? "flowing material turns" : "a rigid body turns";
  }
  expected.contact = !definition.rigid_bodies.empty() ||
                     std::any_of(definition.walls.begin(), definition.walls.end(),
                                 [](const WallDefinition& wall) { return wall.kind == WallKind::frictional; });
  expected.free = expected.free || scene.bodies.size() > 1;
  return expected;
}

}  // namespace mpm
