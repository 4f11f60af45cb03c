#include "mpm/advice/scene_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mpm/advice/tool_motion.hpp"
#include "mpm/material/law.hpp"
#include "mpm/material/material_point.hpp"
#include "mpm/scene/scene_parts.hpp"

namespace mpm {
namespace {

constexpr double kMostWeightStrain = 0.1;  ///< strain of a body under its own weight
constexpr double kLightest = 5.0;          ///< [kg/m^3]; solids and liquids are heavier, foams among them
constexpr double kHeaviest = 23000.0;      ///< [kg/m^3]; osmium has 22,590
constexpr double kRoundOff = 1e-9;

void look_at_end(const Scene& scene, std::vector<std::string>& warnings) {
  const TimeDefinition& time = scene.definition.time;
  if (!(time.end > 0.0)) return;
  const double sync = seconds_of(time.sync), periods = time.end / sync;
  if (std::abs(periods - std::round(periods)) <= std::max(kRoundOff * periods, 1e-6)) return;
  warnings.push_back(
      fmt::format("the run goes on to {:.12g} s, the first sync point after its end at {:.12g} s: sync points are "
                  "{:.9g} s apart, and what is read at the end is read there; write an end that is a multiple of "
                  "time.sync, or a time.sync "
                  "that divides it",
                  std::ceil(periods) * sync, time.end, sync));
}

/// rho g h over the stiffness of a bar that cannot widen, rho c^2.
void look_at_weight(const BodyDefinition& body, const Scene& scene, std::vector<std::string>& warnings) {
  const MaterialDefinition& material = material_of(body, scene);
  if (traits_of(material).stiffness_of_pressure) return;
  const Vec3& gravity = scene.definition.gravity;
  const Box bounds = body.region.bounds();
  double height = 0.0;  // g h
  for (const int axis : axes_of(scene)) height += std::abs(gravity[axis]) * (bounds.max[axis] - bounds.min[axis]);
  const double wave = MaterialPoint(material).wave_speed(), strain = height / (wave * wave);
  if (!std::isfinite(strain) || strain <= kMostWeightStrain) return;
  warnings.push_back(
      fmt::format("body '{}': its own weight would strain it by {:.2g} %: density x gravity x height is {:.3g} Pa, and "
                  "the stiffness of '{}' {:.3g} Pa; check the units of its stiffness (0.5 is 0.5 Pa, write 0.5 MPa) "
                  "and of its density",
                  body.name, 100.0 * strain, material.density * height, material.name, material.density * wave * wave));
}

/// Only where something weighs: scenes without gravity may have units of their own.
void look_at_density(const MaterialDefinition& material, std::vector<std::string>& warnings) {
  if (traits_of(material).matter == Matter::gas) return;
  if (material.density >= kLightest && material.density <= kHeaviest) return;
  warnings.push_back(fmt::format(
      "materials.{}.density: {:.3g} kg/m^3 is {}; check its unit (1.6 is 1.6 kg/m^3, write 1.6 g/cm^3 or 1600)",
      material.name, material.density,
      material.density < kLightest ? "lighter than any solid or liquid" : "heavier than any matter"));
}

void look_at_speeds(const Scene& scene, std::vector<std::string>& warnings) {
  const SlowestWave wave = slowest_wave(scene);
  for (const RigidBodyDefinition& body : scene.definition.rigid_bodies) {
    const double speed = tool_motion(body, scene.definition).fastest;
    if (speed > wave.speed) warnings.push_back(faster_than_waves(body.name, speed, wave));
  }
}

/// Drops that fly alone keep APIC's velocity gradient, and beside a wall, where the second moment of a folded spline
/// goes to zero, it grows without bound.
void look_at_spray(const Scene& scene, std::vector<std::string>& warnings) {
  const MethodDefinition& method = scene.definition.method;
  if (!traits_of(method.shape).spline() || method.transfer.kind != TransferKind::apic) return;
  for (const BodyDefinition& body : scene.bodies) {
    if (traits_of(material_of(body, scene)).matter != Matter::liquid) continue;
    warnings.push_back(fmt::format(
        "body '{}': with apic and {} drops that come to a wall alone gain energy without bound; take another "
        "shape, as ugimp, or another transfer, as {{fmpm: 2}}, unless the fluid stays together",
        body.name, shape_name(method.shape)));
  }
}

}  // namespace

SlowestWave slowest_wave(const Scene& scene) {
  SlowestWave slowest;
  for (const BodyDefinition& body : scene.bodies) {
    const double speed = MaterialPoint(material_of(body, scene)).wave_speed();
    if (!slowest.material.empty() && speed >= slowest.speed) continue;
    slowest = {speed, body.material};
  }
  return slowest;
}

std::string faster_than_waves(const std::string& body, double speed, const SlowestWave& wave) {
  return fmt::format(
      "rigid body '{}' moves at {:.3g} m/s, faster than waves in '{}' ({:.3g} m/s), which cannot get out of its way; "
      "check the units of its motion and of the material's stiffness and density",
      body, speed, wave.material, wave.speed);
}

std::vector<std::string> scene_warnings(const Scene& scene) {
  std::vector<std::string> warnings = scene.definition.warnings;
  look_at_end(scene, warnings);
  for (const BodyDefinition& body : scene.bodies) look_at_weight(body, scene, warnings);
  if (!scene.definition.gravity.isZero(0.0)) {
    for (const MaterialDefinition& material : scene.definition.materials) look_at_density(material, warnings);
  }
  look_at_speeds(scene, warnings);
  look_at_spray(scene, warnings);
  return warnings;
}

}  // namespace mpm
