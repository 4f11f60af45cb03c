// Bodies and robots that are put elsewhere between two steps, and what the run has to forget of where they were.
#include <fmt/format.h>

#include <algorithm>

#include "mpm/boundary/periodic.hpp"
#include "mpm/math/nearest.hpp"
#include "mpm/ranks/of_all.hpp"
#include "mpm/simulation/state_set.hpp"
#include "state.hpp"

namespace mpm {
namespace {

constexpr double kDeepest = 0.5;  ///< cells that material may lie in a body, as at the start of a scene

/// The depth of the material that lies deepest in a body [m], and the name of its own body; 0 where none does.
std::pair<double, std::string> deepest_in(const RigidBody& body, const std::vector<ParticleSet>& sets,
                                          const GridLayout& layout) {
  std::pair<double, std::string> deepest{0.0, {}};
  const Box bounds = body.world_bounds();
  for (const ParticleSet& set : sets) {
    for (int p = 0; p < set.size(); ++p) {
      Vec3 place = Vec3::Zero();
      bool near = true;
      for (int k = 0; k < layout.dim(); ++k) {
        const int axis = layout.axis(k);
        place[axis] = set.x[k][p];
        near = near && place[axis] >= bounds.min[axis] && place[axis] <= bounds.max[axis];
      }
      if (!near) continue;
      const double depth = -body.surface().at(body.pose().to_body(place)).distance;
      if (depth > deepest.first) deepest = {depth, set.name};
    }
  }
  return deepest;
}

/// Reason why a body cannot be where it is now, or empty.
std::string why_not_there(const RigidBody& body, const std::vector<ParticleSet>& sets, const GridLayout& layout) {
  if (const std::string face = periodic_face_reached(body, layout); !face.empty()) {
    return fmt::format("rigid body '{}' cannot be set to within a cell and a half of {}, which is periodic",
                       body.name(), face);
  }
  const auto [depth, of] = deepest_in(body, sets, layout);
  if (!(depth > kDeepest * layout.smallest_cell())) return {};
  return fmt::format(
      "rigid body '{}' cannot be set there: material of '{}' lies in it by {:.3g} m, more than half a cell; set it "
      "beside "
      "the material, and let it come in by commands or by its weight",
      body.name(), of, depth);
}

bool same(const Pose& a, const Pose& b) {
  return a.position == b.position && a.orientation.coeffs() == b.orientation.coeffs();
}

}  // namespace

void Simulation::State::check_places(const std::vector<const RigidBody*>& moved) {
  fetch(Device::Numbers::motion);
  std::string reason;
  if (services.bed != nullptr) {
    // The ground there has to be known; where the place is refused it goes again at the next sync point.
    bring_ground();
    reason = services.bed->fault().value_or("");
  }
  for (const RigidBody* body : moved) {
    if (reason.empty()) reason = why_not_there(*body, sets, layout());
  }
  reason = text_of_all(ranks.get(), reason);
  if (!reason.empty()) throw RigidError(reason);
  for (const Module* module : modules.list()) {
    for (const RigidBody* body : moved) module->check_put(*body);
  }
}

void Simulation::State::forget_contact(const std::vector<const RigidBody*>& moved) {
  const std::vector<Module*>& list = modules.list();
  const auto asks = [](const Module* module) { return module->needs_sort(); };
  // Once more after the first sort has woken what was asleep there: it has sides of thin tools, too.
  for (int round = 0; round < 2; ++round) {
    for (Module* module : list) {
      for (const RigidBody* body : moved) module->body_put(*body);
    }
    if (!any_of_all(ranks.get(), std::any_of(list.begin(), list.end(), asks))) return;
    sort(seconds_of(time));
  }
}

void Simulation::State::set_body(RigidBody& body, const StateSet& set) {
  const std::string start = fmt::format("rigid body '{}' ", body.name());
  if (body.link_motion() != nullptr) {
    throw RigidError(start + fmt::format("is a link of robot '{}', whose base and joints put it; set those",
                                         body.name().substr(0, body.name().find('/'))));
  }
  if (!set.joints.empty()) throw RigidError(start + "has no joints; leave them out, or name a robot");
  if (!set.pose) throw RigidError(start + "has a pose and a twist to set, and no pose is given; give the present one");
  if (body.definition().particles) {
    throw RigidError(start + "is made of particles, whose way since the start its contact knows; move it by commands");
  }
  const GeometryKind geometry = definition.geometry;
  const Pose pose = projected(*set.pose, geometry, body.definition());
  const Twist twist = projected(set.twist, geometry, body.definition());
  const RigidBody before = body;
  body.set_state(pose, twist, definition.gravity);
  if (same(before.pose(), body.pose())) return;
  try {
    check_places({&body});
  } catch (const RigidError&) {
    body = before;
    throw;
  }
  forget_contact({&body});
}

void Simulation::set_state(const StateSet& set) {
  State& s = *state_;
  if (s.failed) throw RigidError("the run has failed, and nothing is set in it; begin it again");
  if (const int robot = find_robot(set.name); robot >= 0) {
    std::vector<const RigidBody*> links;
    s.robots[static_cast<std::size_t>(robot)]->set_state(set.pose, set.twist,
                                                         {set.joints, set.positions, set.velocities},
                                                         [&](const std::vector<const RigidBody*>& moved) {
                                                           s.check_places(moved);
                                                           links = moved;
                                                         });
    s.forget_contact(links);
    return;
  }
  const int body = find_body(set.name);
  if (body < 0) {
    std::vector<std::string> names;
    for (const RigidBody& one : s.bodies) names.push_back(one.name());
    for (const auto& one : s.robots) names.push_back(one->name());
    throw RigidError(fmt::format("there is no rigid body and no robot '{}'; {}", set.name,
                                 names.empty() ? "the scene has none" : suggest(set.name, names)));
  }
  s.set_body(s.bodies[static_cast<std::size_t>(body)], set);
}

}  // namespace mpm
