// sleep: from when on material counts as being at rest and is not stepped.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "mpm/scene/sections.hpp"

namespace mpm {
namespace {

constexpr double kOfFall = 0.01;    ///< default speed: of that after a free fall of half a cell
constexpr double kWake = 3.0;       ///< default of `wake`, in speeds
constexpr double kFalls = 1.0;      ///< default of `after`, in times of a free fall of half a cell
constexpr double kFromMotion = 10;  ///< what the scene moves on purpose has to be so many times as fast
constexpr int kLooksAtMotion = 100;       ///< of a motion over the run

/// The highest speed of a body that has a motion of its own, as far as functions of time say it; 0: at rest.
double speed_of(const RigidBodyDefinition& body, double end) {
  double highest = 0.0;
  for (int i = 0; i <= kLooksAtMotion; ++i) {
    Vec3 velocity;
    for (int k = 0; k < 3; ++k) velocity[k] = body.velocity[k](end * i / kLooksAtMotion, Vec3::Zero());
    highest = std::max(highest, velocity.norm());
  }
  return highest;
}

void check_motion(const Value& where, const Scene& scene) {
  const SleepDefinition& sleep = *scene.definition.sleep;
  const auto refuse = [&](const std::string& what, double speed) {
    where.fail(
        fmt::format("{} moves at {:.3g} m/s, and material at rest counts as such up to {:.3g} m/s, which would "
                    "freeze what it moves; lower sleep.speed to {:.3g} m/s or less",
                    what, speed, sleep.speed, speed / kFromMotion));
  };
  for (const RigidBodyDefinition& body : scene.definition.rigid_bodies) {
    const double speed = speed_of(body, scene.definition.time.end);
    if (speed > 0.0 && speed < kFromMotion * sleep.speed) refuse(fmt::format("rigid body '{}'", body.name), speed);
  }
  for (const BodyDefinition& body : scene.bodies) {
    double speed = 0.0;
    for (const Function& part : body.velocity) speed += part.is_constant() ? std::pow(part(0.0, Vec3::Zero()), 2) : 0.0;
    speed = std::sqrt(speed);
    if (speed > 0.0 && speed < kFromMotion * sleep.speed) refuse(fmt::format("body '{}'", body.name), speed);
  }
}

}  // namespace

void read_sleep(const Map& root, Scene& scene) {
  const auto section = root.find("sleep");
  if (!section) return;
  SimulationDefinition& definition = scene.definition;
  SleepDefinition sleep;
  double cell = definition.grid.cell[0];
  for (const int axis : axes_of(scene)) cell = std::min(cell, definition.grid.cell[axis]);
  const double weight = definition.gravity.norm();
  const Map map(*section, {"speed", "wake", "after", "damping", "from_start"});
  if (const auto speed = map.find("speed")) {
    sleep.speed = speed->positive(kVelocity);
  } else {
    if (weight == 0.0) map.fail("without gravity there is no scale for what is at rest; write sleep.speed");
    sleep.speed = kOfFall * std::sqrt(weight * cell);
    scene.choices.emplace_back(
        "sleep.speed", fmt::format("{:.3g} m/s: a hundredth of the speed of a fall of half a cell", sleep.speed));
  }
  if (const auto wake = map.find("wake")) {
    sleep.wake = wake->positive(kVelocity);
    if (sleep.wake < sleep.speed) wake->fail("it is below sleep.speed, so that blocks would wake as they fall asleep");
  } else {
    sleep.wake = kWake * sleep.speed;
    scene.choices.emplace_back("sleep.wake", fmt::format("{:.3g} m/s: three times sleep.speed", sleep.wake));
  }
  if (const auto after = map.find("after")) {
    sleep.after = after->positive(kTime);
  } else {
    if (weight == 0.0) map.fail("without gravity there is no scale for how long; write sleep.after");
    sleep.after = kFalls * std::sqrt(cell / weight);
    scene.choices.emplace_back("sleep.after", fmt::format("{:.3g} s: the time of a fall of half a cell", sleep.after));
  }
  if (const auto damping = map.find("damping")) {
    sleep.damping = damping->non_negative(kPlain);
    if (!(sleep.damping < 1.0)) damping->fail("it is a part of a force, so it is below 1");
  }
  if (const auto start = map.find("from_start")) sleep.from_start = start->choice({"false", "true"}) == 1;
  definition.sleep = sleep;
  if (!definition.body_forces.empty() || !definition.particle_forces.empty() || !definition.tractions.empty()) {
    map.fail("loads act on material wherever it is, and sleep does not know them; leave out 'sleep' or 'loads'");
  }
  if (!definition.conditions.empty()) {
    map.fail("boundaries.conditions move material wherever it is, and sleep does not know them; leave out one of both");
  }
  check_motion(*section, scene);
}

}  // namespace mpm
