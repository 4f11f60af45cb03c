#include "mpm/scene/expected_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mpm/material/material_point.hpp"
#include "mpm/scene/sections.hpp"

namespace mpm {
namespace {

constexpr double kFlowStrain = 1.0;     // of what deforms without end
constexpr double kPressedStrain = 0.1;  // by what the scene alone does not tell
constexpr double kQuarterTurn = 0.5 * 3.14159265358979323846;
constexpr int kSamples = 5;  // along an axis, to find a body's largest speed

bool flows(const MaterialDefinition& material) {
  return std::holds_alternative<DruckerPragerDefinition>(material.law) ||
         std::holds_alternative<MohrCoulombDefinition>(material.law) ||
         std::holds_alternative<J2PlasticityDefinition>(material.law) ||
         std::holds_alternative<NewtonianFluidDefinition>(material.law) ||
         std::holds_alternative<IdealGasDefinition>(material.law);
}

const MaterialDefinition& material_of(const BodyDefinition& body, const Scene& scene) {
  const auto& materials = scene.definition.materials;
  return *std::find_if(materials.begin(), materials.end(),
                       [&](const MaterialDefinition& material) { return material.name == body.material; });
}

/// Largest speed at the start [m/s], among points spread over the body's bounds. Where an expression has no value is
/// for the error that is given when particles are made.
double speed(const BodyDefinition& body) {
  const Box bounds = body.region.bounds();
  const bool constant =
      std::all_of(body.velocity.begin(), body.velocity.end(), [](const Function& f) { return f.is_constant(); });
  const int samples = constant ? 1 : kSamples;
  double fastest = 0.0;
  for (int i = 0; i < samples * samples * samples; ++i) {
    const Vec3 part(i % samples, i / samples % samples, i / (samples * samples));
    Vec3 place = bounds.min;
    for (int axis = 0; axis < 3; ++axis) {
      const double size = bounds.max[axis] - bounds.min[axis];
      if (!constant && std::isfinite(size)) place[axis] += part[axis] / (kSamples - 1) * size;
    }
    try {
      const Vec3 velocity(body.velocity[0](0.0, place), body.velocity[1](0.0, place), body.velocity[2](0.0, place));
      fastest = std::max(fastest, velocity.norm());
    } catch (const FunctionError&) {
      continue;
    }
  }
  return fastest;
}

struct Arrival {
  double speed = 0.0;   ///< largest, at the start or after a fall to the face of the grid [m/s]
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
  result.speed = std::sqrt(std::pow(speed(body), 2) + 2.0 * fall);
  return result;
}

void find_elastic_strain(const Scene& scene, ExpectedMotion& expected) {
  expected.strain_why = "nothing moves it";
  for (const BodyDefinition& body : scene.bodies) {
    const double wave = MaterialPoint(material_of(body, scene)).wave_speed();
    const Arrival at = arrival(body, scene);
    const double strain = at.speed / wave + at.weight / (wave * wave);
    if (at.speed > 0.0) expected.free = true;
    if (strain <= expected.strain) continue;
    expected.strain = strain;
    expected.strain_why =
        fmt::format("{} at up to {:.3g} m/s and under its weight, over waves of {:.3g} m/s", body.name, at.speed, wave);
  }
  const SimulationDefinition& definition = scene.definition;
  const bool stressed = std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                    [](const BodyDefinition& body) { return body.stress.has_value(); });
  const char* unknown = !definition.rigid_bodies.empty() ? "rigid bodies may press"
                        : !definition.body_forces.empty() || !definition.particle_forces.empty() ? "loads act"
                        : stressed                                                               ? "stress at the start"
                                                                                                 : nullptr;
  if (unknown != nullptr && expected.strain < kPressedStrain) {
    expected.strain = kPressedStrain;
    expected.strain_why = fmt::format("{}, and how far is not known", unknown);
  }
}

}  // namespace

ExpectedMotion expected_motion(const Scene& scene) {
  const SimulationDefinition& definition = scene.definition;
  ExpectedMotion expected;
  for (const BodyDefinition& body : scene.bodies) {
    if (!flows(material_of(body, scene))) continue;
    expected.flows = true;
    expected.strain = kFlowStrain;
    expected.strain_why = fmt::format("{} flows", body.material);
    break;
  }
  if (!expected.flows) find_elastic_strain(scene, expected);
  const bool turned =
      std::any_of(definition.rigid_bodies.begin(), definition.rigid_bodies.end(), [](const RigidBodyDefinition& body) {
        return std::any_of(body.rotation_rate.begin(), body.rotation_rate.end(),
                           [](const Function& rate) { return !rate.is_zero(); });
      });
  if (definition.geometry == GeometryKind::line) {
    expected.turn_why = "nothing turns in a line";
  } else if (expected.flows || turned) {
    expected.turn = kQuarterTurn;
    expected.turn_why = expected.flows ? "what flows turns" : "a rigid body turns";
  } else {
    expected.turn_why = "the scene says of none";
  }
  expected.contact = !definition.rigid_bodies.empty() ||
                     std::any_of(definition.walls.begin(), definition.walls.end(),
                                 [](const WallDefinition& wall) { return wall.kind == WallKind::frictional; });
  expected.free = expected.free || scene.bodies.size() > 1;
  return expected;
}

}  // namespace mpm
