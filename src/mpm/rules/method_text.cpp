#include "mpm/rules/method_text.hpp"

#include <fmt/core.h>

#include <cmath>

namespace mpm {
namespace {

/// An expression stands in quotes: its numbers are in the scene's units.
std::string value_text(const Function& function, const char* unit) {
  return function.is_constant() ? fmt::format("{:g}{}", function(0.0), unit) : fmt::format("\"{}\"", function.text());
}

std::string mixture_text(const Transfer& transfer) {
  const bool plain = transfer.mixed == 1 && transfer.every == 1;
  if (plain && transfer.flip == 0.0) return "pic";
  std::string text = fmt::format("flip {:g}", transfer.flip);
  if (transfer.mixed > 1) text += fmt::format(" and xpic {}", transfer.mixed);
  if (transfer.every > 1) text += fmt::format(" in one of {} steps", transfer.every);
  return text;
}

void join(std::string& text, const std::string& part) { text += (text.empty() ? "" : ", ") + part; }

}  // namespace

std::string update_name(UpdateScheme update) { return kUpdateNames[static_cast<int>(update)]; }

std::string transfer_text(const Transfer& transfer) {
  const char* name = kTransferNames[static_cast<int>(transfer.kind)];
  switch (transfer.kind) {
    case TransferKind::flip:
      if (transfer.flip == 1.0) return name;
      return mixture_text(transfer);
    case TransferKind::xpic:
    case TransferKind::fmpm:
      return fmt::format("{} {}", name, transfer.order);
    case TransferKind::apic:
      break;
  }
  return name;
}

std::string damping_text(const DampingDefinition& damping) {
  std::string text;
  const char* placement = damping.in_force ? "in the force" : "in the update";
  if (!damping.grid.is_zero()) join(text, fmt::format("grid {} {}", value_text(damping.grid, " 1/s"), placement));
  if (!damping.particle.is_zero()) join(text, fmt::format("particle {}", value_text(damping.particle, " 1/s")));
  if (!damping.pic.is_zero()) join(text, fmt::format("pic {} a step", value_text(damping.pic, "")));
  if (damping.feedback) {
    const FeedbackDefinition& feedback = *damping.feedback;
    const bool of_grid = feedback.of == FeedbackDefinition::Of::grid;
    std::string part = fmt::format("feedback of the {}, gain {:g} 1/m^2, target {}", of_grid ? "grid" : "particles",
                                   feedback.gain, value_text(feedback.target, " J"));
    if (std::isfinite(feedback.limit)) part += fmt::format(", at most {:g} 1/s", feedback.limit);
    join(text, part + (of_grid ? fmt::format(", {}", placement) : ""));
  }
  return text;
}

std::string method_text(const MethodDefinition& method) {
  std::string text =
      fmt::format("{}, {}, {}, {} precision, {} term{} of the deformation's exponential", shape_name(method.shape),
                  update_name(method.update), transfer_text(method.transfer), precision_name(method.precision),
                  method.gradient_terms, method.gradient_terms == 1 ? "" : "s");
  const AxisRules &axis = method.axis, usual;
  const bool whole = axis.domains != usual.domains, planar = axis.functions != usual.functions;
  if (whole) join(text, "domains across the axis");
  if (planar) join(text, "planar functions");
  if (whole || planar) {
    join(text, fmt::format("nodes beyond the axis {}", kAxisGhostNames[static_cast<int>(axis.ghosts)]));
  }
  if (axis.motion != usual.motion) join(text, "moved by the mean velocity in a domain");
  if (method.average_dilatation) join(text, "averaged dilatation");
  if (method.average_stress)
    join(text, *method.average_stress ? "averaged stress of what flows" : "stress of what flows as it is");
  if (method.damping.any()) join(text, "damping: " + damping_text(method.damping));
  return text;
}

}  // namespace mpm
