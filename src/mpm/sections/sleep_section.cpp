// sleep: from when on material counts as being at rest and is not stepped.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "mpm/advice/tool_motion.hpp"
#include "mpm/sections/sections.hpp"
#include "mpm/sleep/sleep_keys.hpp"

namespace mpm {
namespace {

constexpr double kOfFall = 0.01;      ///< default speed: of that after a free fall of half a cell
constexpr double kWake = 3.0;         ///< default of `wake`, in speeds
constexpr double kWithoutEnd = 10.0;  ///< time over which a condition is looked at where a run has no end [s]
constexpr int kLooks = 100;           ///< at a condition, over the run
constexpr double kFromMotion = 10;    ///< ratio by which what the scene moves on purpose has to be faster

/// The highest speed of a body at the start, at the corners and the middle of its bounds.
double speed_of(const BodyDefinition& body) {
  const Box bounds = body.region.bounds();
  double highest = 0.0;
  for (int corner = 0; corner < 9; ++corner) {
    Vec3 place = bounds.center();
    for (int axis = 0; axis < 3 && corner < 8; ++axis) {
      place[axis] = (corner >> axis & 1) != 0 ? bounds.max[axis] : bounds.min[axis];
    }
    try {
      const Vec3 velocity(body.velocity[0](0.0, place), body.velocity[1](0.0, place), body.velocity[2](0.0, place));
      highest = std::max(highest, velocity.norm());
    } catch (const FunctionError&) {
      continue;  // building the body says so
    }
  }
  return highest;
}

/// The highest speed of a condition over the run, in the middle of its region.
double speed_of(const ConditionDefinition& condition, const SimulationDefinition& definition) {
  if (!condition.velocity) return tool_motion(condition.region, definition).fastest;
  const Vec3 place = RigidBody(condition.region).world_bounds().center();
  const double end = definition.time.end > 0.0 ? definition.time.end : kWithoutEnd;
  double highest = 0.0;
  for (int i = 0; i <= kLooks; ++i) {
    try {
      highest = std::max(highest, std::abs((*condition.velocity)(end * i / kLooks, place)));
    } catch (const FunctionError&) {
      continue;  // the run says so
    }
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
    const double speed = tool_motion(body, scene.definition).fastest;
    if (speed > 0.0 && speed < kFromMotion * sleep.speed) refuse(fmt::format("rigid body '{}'", body.name), speed);
  }
  for (const ConditionDefinition& condition : scene.definition.conditions) {
    const double speed = speed_of(condition, scene.definition);
    if (speed > 0.0 && speed < kFromMotion * sleep.speed)
      refuse(fmt::format("condition '{}'", condition.region.name), speed);
  }
  for (const BodyDefinition& body : scene.bodies) {
    const double speed = speed_of(body);
    if (speed > 0.0 && speed < kFromMotion * sleep.speed) refuse(fmt::format("body '{}'", body.name), speed);
  }
}

}  // namespace

void read_sleep(const Map& root, Scene& scene) {
  const auto section = root.find("sleep");
  if (!section || (section->is_text() && section->choice({"off"}) == 0)) return;
  SimulationDefinition& definition = scene.definition;
  SleepDefinition sleep;
  const double cell = definition.smallest_cell(), weight = definition.gravity.norm();
  const Map map = read_keys(*section, sleep_keys(), sleep);
  if (const auto speed = map.find("speed")) {
    if (weight > 0.0 && sleep.speed > std::sqrt(weight * cell)) {
      speed->fail(fmt::format("{:.3g} m/s is no rest: it is more than that of a fall of half a cell, {:.3g} m/s",
                              sleep.speed, std::sqrt(weight * cell)));
    }
  } else {
    if (weight == 0.0) map.fail("without gravity there is no scale for what is at rest; write sleep.speed");
    sleep.speed = kOfFall * std::sqrt(weight * cell);
    scene.choices.emplace_back(
        "sleep.speed", fmt::format("{:.3g} m/s: a hundredth of the speed of a fall of half a cell", sleep.speed));
  }
  if (const auto wake = map.find("wake")) {
    if (sleep.wake < sleep.speed) wake->fail("it is below sleep.speed, so that blocks would wake as they fall asleep");
  } else {
    sleep.wake = kWake * sleep.speed;
    scene.choices.emplace_back("sleep.wake", fmt::format("{:.3g} m/s: three times sleep.speed", sleep.wake));
  }
  if (!map.find("after")) {
    if (weight == 0.0) map.fail("without gravity there is no scale for how long; write sleep.after");
    sleep.after = std::sqrt(cell / weight);
    scene.choices.emplace_back("sleep.after", fmt::format("{:.3g} s: the time of a fall of half a cell", sleep.after));
  }
  definition.sleep = sleep;
  for (const BodyDefinition& body : scene.bodies) {
    if (!sleep.from_start || weight == 0.0 || body.geostatic || body.stress) continue;
    map.at("from_start")
        .fail(fmt::format("body '{}' starts without stress under its weight, so it is not at rest; let it start "
                          "geostatic, give it stress, or leave out from_start",
                          body.name));
  }
  check_motion(*section, scene);
}

}  // namespace mpm
