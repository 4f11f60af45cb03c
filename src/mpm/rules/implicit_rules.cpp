#include "mpm/rules/implicit_rules.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "mpm/definition/rigid_contacts.hpp"
#include "mpm/implicit/implicit_step.hpp"
#include "mpm/implicit/soil_law.hpp"
#include "mpm/implicit/sweep_momentum.hpp"
#include "mpm/math/geometry_kind.hpp"

namespace mpm {
namespace {

using Fault = std::optional<MethodFault>;

Fault method_part(const SimulationDefinition& d) {
  const MethodDefinition& method = d.method;
  const AxisRules axis;
  if (method.axis.domains != axis.domains || method.axis.functions != axis.functions ||
      method.axis.ghosts != axis.ghosts) {
    return MethodFault{"method.axis",
                       "implicit steps have rings that end at the axis; leave domains, functions and ghosts out"};
  }
  if (!traits_of(method.shape).takes_implicit)
    return MethodFault{"method.shape", "implicit steps have ugimp alone; leave it out"};
  const Transfer& transfer = method.transfer;
  const bool plain = transfer.kind == TransferKind::flip && transfer.mixed == 1 && transfer.every == 1;
  if (!plain && transfer.kind != TransferKind::apic) {
    return MethodFault{"method.transfer",
                       "implicit steps have a fraction of flip, pic or apic; leave it out, or write {flip: 0.95}"};
  }
  if (method.average_stress) {
    return MethodFault{"method.average_stress", "implicit steps have one stress in a cell as it is; leave it out"};
  }
  if (method.gradient_terms != MethodDefinition().gradient_terms) {
    return MethodFault{"method.gradient_terms",
                       fmt::format("implicit steps have {} terms; leave it out", MethodDefinition().gradient_terms)};
  }
  if (method.sweeps && d.time.budget && *method.sweeps <= kLeastSweeps) {
    return MethodFault{"time.budget",
                       fmt::format("it ends no step before {} sweeps, and method.sweeps is {}; leave one "
                                   "of them out",
                                   kLeastSweeps, *method.sweeps)};
  }
  return {};
}

/// Refuses metal that is stronger than what the sweeps of a step can carry.
Fault strength_part(const SimulationDefinition& d, const MaterialDefinition& material) {
  const double yield = ImplicitSoil(material).yield_stress, step = d.time.step.value_or(kImplicitStep);
  const int sweeps = d.method.sweeps.value_or(kMostSweeps);
  const double cell = d.smallest_cell(), modulus = modulus_of(sweeps) * material.density * cell * cell / (step * step);
  if (yield <= kMostSweepLoad * modulus) return {};
  return MethodFault{
      "materials",
      fmt::format("'{}' bears {:.3g} kPa, of which {} sweeps in a step of {:g} ms carry {:.3g} kPa on cells of {:g} m; "
                  "write a time.step of {:.2g} ms, or use method.update: usavg",
                  material.name, 1e-3 * yield, sweeps, 1e3 * step, 1e-3 * kMostSweepLoad * modulus, cell,
                  1e3 * step * std::sqrt(kMostSweepLoad * modulus / yield))};
}

Fault material_part(const SimulationDefinition& d) {
  for (const DeformableBody& body : d.bodies) {
    const MaterialDefinition& material = find_material(d, body);
    if (const std::string text = refused_implicit(material); !text.empty()) return MethodFault{"materials", text};
    if (Fault fault = strength_part(d, material)) return fault;
  }
  return {};
}

constexpr double kAlong = 1.0 - 1e-9;  ///< least component of a unit vector along its axis

bool plain(const FrictionLaw& law) { return law.static_coefficient < 0.0 && law.adhesion == 0.0; }

Fault wall_part(const SimulationDefinition& d) {
  for (std::size_t w = 0; w < d.walls.size(); ++w) {
    const WallDefinition& wall = d.walls[w];
    const std::string key = std::string("boundaries.") + kWallNames[w];
    if (wall.kind == WallKind::frictional && !plain(wall.friction)) {
      return MethodFault{
          key,
          "implicit steps have one coefficient of friction and no adhesion; leave static_friction and adhesion out"};
    }
  }
  return {};
}

Fault tool_part(const SimulationDefinition& d, const RigidBodyDefinition& body) {
  const std::string key = fmt::format("rigid_bodies.{}", body.name);
  for (const int axis : axes_of(d.geometry)) {
    const Box bounds = body.surface->bounds();
    if (std::isfinite(bounds.min[axis]) && std::isfinite(bounds.max[axis])) continue;
    return MethodFault{
        key,
        "implicit steps meet bodies at points of their surface, which has to end; write a box that is as large as "
        "the scene needs, or use method.update: usavg"};
  }
  if (body.reach > 0.0) return MethodFault{key, "implicit steps have no reach; leave it out"};
  std::optional<ContactLaw> first;
  for (const DeformableBody& other : d.bodies) {
    const ContactLaw law = rigid_contact_law(d, body, other.name);
    if (law.kind != ContactLaw::Kind::coulomb && law.kind != ContactLaw::Kind::stick) {
      return MethodFault{key, "implicit steps have friction or stick; write one of these in contact.pairs"};
    }
    if (law.static_friction || !law.adhesion.is_zero()) {
      return MethodFault{
          key,
          "implicit steps have one coefficient of friction and no adhesion; leave static_friction and adhesion out"};
    }
    if (first && !same_law(*first, law)) {
      return MethodFault{
          key, fmt::format(
                   "it has another law with '{}' than with '{}'; with implicit steps a body has one law with all soil",
                   other.name, d.bodies.front().name)};
    }
    first = law;
  }
  return {};
}

Fault other_part(const SimulationDefinition& d) {
  if (d.time.step && *d.time.step > kLongestImplicitStep) {
    return MethodFault{"time.step",
                       fmt::format("{:g} s is too long for an implicit step; write {:g} s or less, such as 10 ms",
                                   *d.time.step, kLongestImplicitStep)};
  }
  if (!d.contact.sharp_edges) return MethodFault{"contact.edges", "implicit steps have one kind of edge; leave it out"};
  for (const ConditionDefinition& condition : d.conditions) {
    if (condition.direction.cwiseAbs().maxCoeff() > kAlong) continue;
    return MethodFault{"boundaries.conditions",
                       fmt::format("'{}' has a direction between the axes; implicit steps hold nodes along one axis: "
                                   "write two conditions, or use method.update: usavg",
                                   condition.region.name)};
  }
  return {};
}

}  // namespace

std::optional<MethodFault> implicit_fault(const SimulationDefinition& d) {
  if (d.method.update != UpdateScheme::implicit) {
    if (d.method.sweeps)
      return MethodFault{"method.sweeps", "explicit steps have none; leave it out, or write update: implicit"};
    if (!d.time.budget) return {};
    return MethodFault{"time.budget",
                       "explicit steps have no sweeps that could end sooner; leave it out, or write method.update: "
                       "implicit"};
  }
  for (const auto part : {method_part, material_part, wall_part, other_part}) {
    if (const Fault fault = part(d)) return fault;
  }
  for (const RigidBodyDefinition& body : d.rigid_bodies) {
    if (const Fault fault = tool_part(d, body)) return fault;
  }
  return {};
}

}  // namespace mpm
