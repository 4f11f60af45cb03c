#include "mpm/advice/implicit_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "mpm/advice/feasible.hpp"
#include "mpm/advice/scene_warnings.hpp"
#include "mpm/advice/tool_motion.hpp"
#include "mpm/implicit/implicit_step.hpp"
#include "mpm/material/law.hpp"
#include "mpm/pace/tool_use.hpp"
#include "mpm/rules/feature_rules.hpp"
#include "mpm/rules/implicit_rules.hpp"
#include "mpm/rules/method_text.hpp"
#include "mpm/scene/scene_parts.hpp"

namespace mpm {
namespace {

constexpr double kSlow = 0.1;   ///< speed of a slow tool over that of the waves, at the most
constexpr double kWorth = 3.0;  ///< explicit steps that an implicit one has to span

/// The word of target.tool, or none.
std::string use_of_tools(const Map& root) {
  const auto target = root.find("target");
  if (!target || !target->is_map()) return {};
  const YAML::Node use = target->node()["tool"];
  return use && use.IsScalar() ? use.Scalar() : "";
}

/// True if a motion takes the lowest point of a tool down by more than a cell below the top of what it is above.
bool is_pressed(const RigidBodyDefinition& body, const ToolMotion& motion, const Scene& scene) {
  const SimulationDefinition& definition = scene.definition;
  int up = 0;
  definition.gravity.cwiseAbs().maxCoeff(&up);
  const double sense = definition.gravity[up] < 0.0 ? 1.0 : -1.0;
  const Box start = world_bounds(body.pose, body.surface->bounds());
  const double bottom = sense > 0.0 ? start.min[up] : -start.max[up];
  double pressed = 0.0, before = bottom;
  for (const Vec3& place : motion.places) {
    const double now = bottom + sense * place[up];
    double ground = -std::numeric_limits<double>::infinity();
    for (const BodyDefinition& soil : scene.bodies) {
      const Box bounds = soil.region.bounds();
      bool beside = false;
      for (const int axis : axes_of(definition.geometry)) {
        if (axis == up) continue;
        beside = beside || bounds.max[axis] < start.min[axis] + place[axis] ||
                 bounds.min[axis] > start.max[axis] + place[axis];
      }
      if (!beside) ground = std::max(ground, sense > 0.0 ? bounds.max[up] : -bounds.min[up]);
    }
    pressed += std::max(std::min(before, ground) - now, 0.0);
    before = now;
  }
  return pressed > definition.smallest_cell();
}

bool cuts_or_rolls(const RigidBodyDefinition& body, const ToolMotion& motion, const Scene& scene,
                   const std::string& use) {
  if (!use.empty()) return use != pace::kToolUseNames[static_cast<int>(pace::ToolUse::plate)];
  if (body.free) return motion.turns;
  return motion.across > motion.along && !is_pressed(body, motion, scene);
}

/// Bodies that are not built yet, with the names that rules look at.
std::vector<DeformableBody> unbuilt(const Scene& scene) {
  std::vector<DeformableBody> bodies;
  for (const BodyDefinition& one : scene.bodies) {
    bodies.emplace_back();
    bodies.back().name = one.name;
    bodies.back().material = one.material;
  }
  return bodies;
}

/// True if two bodies of material have a law of contact, for which each has velocities of its own.
bool has_pairs(const Scene& scene) {
  const auto is_rigid = [&](const std::string& name) {
    const auto& bodies = scene.definition.rigid_bodies;
    return std::any_of(bodies.begin(), bodies.end(), [&](const auto& body) { return body.name == name; });
  };
  const auto& pairs = scene.definition.contact.pairs;
  return std::any_of(pairs.begin(), pairs.end(), [&](const PairDefinition& pair) { return !is_rigid(pair.second); });
}

}  // namespace

// APIC lets columns run too far, PIC stops them too early (doc/implicit.md).
Transfer transfer_of_implicit() {
  Transfer transfer;
  transfer.flip = 0.95;
  return transfer;
}

void take_implicit_step(Scene& scene) {
  scene.definition.time.step = kImplicitStep;
  scene.choices.emplace_back("time.step", fmt::format("{:g} s, as implicit steps last", kImplicitStep));
}

bool choose_implicit(const AutoMethod& asked, const Map& root, Scene& scene) {
  const SimulationDefinition& before = scene.definition;
  if (asked.keep_update || asked.names_more || before.rigid_bodies.empty() || before.gravity.isZero()) return false;
  SimulationDefinition after = before;
  after.method.update = UpdateScheme::implicit;
  if (!asked.names_transfer) after.method.transfer = transfer_of_implicit();
  after.bodies = unbuilt(scene);
  if (has_pairs(scene) || feature_fault(after) || implicit_fault(after)) return false;
  const auto unmeasured = [&](const MaterialDefinition& material) {
    const auto is_of = [&](const BodyDefinition& body) { return body.material == material.name; };
    return traits_of(material).implicit != ImplicitSteps::measured &&
           std::any_of(scene.bodies.begin(), scene.bodies.end(), is_of);
  };
  if (std::any_of(before.materials.begin(), before.materials.end(), unmeasured)) return false;
  const WaveStep wave = wave_step(scene);
  const double slowest = slowest_wave(scene).speed;
  const std::string use = use_of_tools(root);
  for (const RigidBodyDefinition& body : before.rigid_bodies) {
    const ToolMotion motion = tool_motion(body, before);
    if (!cuts_or_rolls(body, motion, scene, use) || motion.fastest > kSlow * slowest) return false;
  }
  const double step = before.time.step.value_or(kImplicitStep);
  if (!(step > kWorth * wave.dt)) return false;
  scene.definition.method = after.method;
  // Transfer of explicit steps, which implicit ones do not take.
  const auto is_transfer = [](const auto& choice) { return choice.first == "method.transfer"; };
  scene.choices.erase(std::remove_if(scene.choices.begin(), scene.choices.end(), is_transfer), scene.choices.end());
  scene.choices.emplace_back(
      "method", fmt::format("{}, {}, {}: soil with slow tools, where a step may last as long as {:.0f} explicit ones",
                            shape_name(after.method.shape), update_name(after.method.update),
                            transfer_text(after.method.transfer), step / wave.dt));
  if (!before.time.step) take_implicit_step(scene);
  return true;
}

}  // namespace mpm
