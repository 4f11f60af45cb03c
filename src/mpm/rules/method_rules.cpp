#include "mpm/rules/method_rules.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "mpm/kernel/select.hpp"
#include "mpm/material/law.hpp"
#include "mpm/rules/feature_rules.hpp"
#include "mpm/rules/section_keys.hpp"
#include "mpm/step/damping_keys.hpp"

namespace mpm {
namespace {

using Fault = std::optional<MethodFault>;

constexpr int kMostOrder = 20;  ///< a pass over all particles each; the series has long converged

Fault shape_fault(const MethodDefinition& method, GeometryKind geometry) {
  if (has_shape(method.shape, geometry)) return {};
  if (axisymmetric(geometry)) {
    return MethodFault{"shape", fmt::format("{} is not made for an axis of symmetry; use ugimp, ugimp_stretch or cpdi",
                                            shape_name(method.shape))};
  }
  return MethodFault{"shape", "qcpdi has the nine points of a parallelogram and is planar; use cpdi"};
}

Fault order_fault(const std::string& name, int order) {
  if (order >= 1 && order <= kMostOrder) return {};
  return MethodFault{"transfer." + name,
                     fmt::format("order {} is not possible; write 1 (which is PIC) to {}", order, kMostOrder)};
}

Fault transfer_fault(const MethodDefinition& method) {
  const Transfer& transfer = method.transfer;
  switch (transfer.kind) {
    case TransferKind::flip:
      if (!(transfer.flip >= 0.0 && transfer.flip <= 1.0)) {
        return MethodFault{"transfer.flip",
                           fmt::format("'{:g}' is not a fraction; write one from 0 (PIC) to 1 (FLIP)", transfer.flip)};
      }
      if (transfer.every < 1) {
        return MethodFault{"transfer.every",
                           fmt::format("{} is not possible; write 1, for all steps, or more", transfer.every)};
      }
      return order_fault("xpic", transfer.mixed);
    case TransferKind::xpic:
    case TransferKind::fmpm:
      return order_fault(kTransferNames[static_cast<int>(transfer.kind)], transfer.order);
    case TransferKind::apic:
      break;
  }
  return {};
}

/// True if particles with one stress each may lock.
bool may_lock(GeometryKind geometry) {
  return geometry != GeometryKind::line && geometry != GeometryKind::plane_stress;
}

Fault start_fault(const char* key, const Function& rate) {
  if (!rate.uses_start()) return {};
  return MethodFault{std::string("damping.") + key, "damping is a function of t, x, y, z; X, Y, Z are not kept for it"};
}

/// The fault of a part of the section, with the path to it.
Fault within(const char* part, Fault fault) {
  if (fault) fault->key = std::string(part) + "." + fault->key;
  return fault;
}

Fault feedback_fault(const FeedbackDefinition& feedback) {
  if (Fault fault = within("damping.feedback", feedback_keys().fault(feedback))) return fault;
  if (feedback.target.uses_place()) {
    return MethodFault{"damping.feedback.target",
                       "the target is the energy of all bodies; write a function of t alone"};
  }
  return {};
}

// PIC and FLIP are two ends of one transfer; others have no such fraction.
Fault pic_fault(const MethodDefinition& method) {
  const Function& pic = method.damping.pic;
  if (pic.is_zero()) return {};
  if (method.transfer.kind != TransferKind::flip) {
    return MethodFault{"damping.pic", fmt::format("transfer {} has no part of PIC to change; use transfer flip",
                                                  kTransferNames[static_cast<int>(method.transfer.kind)])};
  }
  if (method.transfer.mixed != 1 || method.transfer.every != 1) {
    return MethodFault{"damping.pic",
                       "transfer says another part of PIC, by xpic or every; write transfer flip, or leave pic out"};
  }
  if (method.transfer.flip != 1.0) {
    return MethodFault{"damping.pic",
                       fmt::format("transfer says it too, with a FLIP fraction of {:g}; write transfer flip, or leave "
                                   "pic out",
                                   method.transfer.flip)};
  }
  return {};
}

Fault damping_fault(const MethodDefinition& method) {
  const DampingDefinition& damping = method.damping;
  if (Fault fault = within("damping", damping_keys().fault(damping))) return fault;
  if (const Fault fault = start_fault("grid", damping.grid)) return fault;
  if (const Fault fault = start_fault("particle", damping.particle)) return fault;
  if (const Fault fault = start_fault("pic", damping.pic)) return fault;
  if (damping.feedback) {
    if (const Fault fault = feedback_fault(*damping.feedback)) return fault;
  }
  if (const Fault fault = pic_fault(method)) return fault;
  if (damping.in_force && damping.grid.uses_place()) {
    return MethodFault{"damping.placement",
                       "a rate that is a function of place is read at the particles, not at the nodes; use placement: "
                       "update"};
  }
  return {};
}

/// Features of the method that do not go together, or not with the geometry.
Fault pair_fault(const MethodDefinition& method, GeometryKind geometry) {
  static const std::string kSection = "method.";
  SimulationDefinition alone;
  alone.method = method;
  alone.geometry = geometry;
  Fault fault = feature_fault(alone);
  if (!fault || fault->key.rfind(kSection, 0) != 0) return {};
  fault->key = fault->key.substr(kSection.size());
  return fault;
}

}  // namespace

double stable_cfl(const Transfer& transfer) {
  if (transfer.kind == TransferKind::apic) return 0.7;
  return transfer.kind == TransferKind::fmpm && transfer.order >= 5 ? 0.9 : 1.0;
}

bool averages_stress(const MethodDefinition& method, GeometryKind geometry) {
  const bool sensible = may_lock(geometry) && !method.average_dilatation;
  return method.average_stress.value_or(sensible && method.update != UpdateScheme::implicit);
}

bool closes_energy(const LawTraits& traits) {
  return traits.listed && traits.matter == Matter::soil && !traits.stiffness_of_pressure;
}

bool shares_stress(const SimulationDefinition& definition, const DeformableBody& body) {
  const MaterialDefinition& material = find_material(definition, body);
  const std::size_t number = &material - definition.materials.data();
  const auto& quantities = definition.transport.quantities;
  const bool expands = std::any_of(quantities.begin(), quantities.end(), [&](const QuantityDefinition& quantity) {
    return number < quantity.materials.size() && quantity.materials[number].expansion != 0.0;
  });
  const LawTraits traits = traits_of(material);
  return traits.averages_stress && !(finds_pressure(traits.stress_from) && expands);
}

std::optional<MethodFault> method_fault(const MethodDefinition& method, GeometryKind geometry) {
  if (const Fault fault = method_keys().fault(method)) return fault;
  if (const Fault fault = shape_fault(method, geometry)) return fault;
  if (const Fault fault = transfer_fault(method)) return fault;
  if (const Fault fault = damping_fault(method)) return fault;
  return pair_fault(method, geometry);
}

}  // namespace mpm
