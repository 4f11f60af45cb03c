#include "mpm/advice/auto_method.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "mpm/advice/expected_motion.hpp"
#include "mpm/choice/method_choice.hpp"
#include "mpm/math/constants.hpp"
#include "mpm/rules/method_rules.hpp"
#include "mpm/rules/method_text.hpp"

namespace mpm {
namespace {

using choice::Judged;
using choice::Preference;
using choice::Standing;

constexpr double kLargeStrain = 0.02;  // as in auto_method.hpp
constexpr double kTurned = 10.0 * kDegree;
const char* const kDefault = "ugimp/usavg/flip";

/// True if some method reached the required error. Where all grids are too coarse, the method with the least error may
/// not be the one that reaches the required error on finer grids.
bool solved(const choice::MethodCosts& costs, const std::string& suite, const choice::Budget& budget) {
  const auto methods = costs.find(suite);
  if (methods == costs.end()) return false;
  return budget.cost || std::any_of(methods->second.begin(), methods->second.end(),
                                    [&](const auto& method) { return method.second.back().error <= *budget.error; });
}

std::vector<std::string> suites_like(const ExpectedMotion& expected, GeometryKind geometry,
                                     const choice::MethodCosts& costs, const choice::Budget& budget) {
  std::vector<std::string> suites;
  const bool large = expected.strain > kLargeStrain;
  const bool cube = geometry == GeometryKind::solid && solved(costs, large ? "cube_large" : "cube_small", budget);
  if (!large) suites.emplace_back("bar_small");
  if (geometry == GeometryKind::line) {
    if (large) suites.emplace_back("bar_crossing");
  } else {
    suites.emplace_back(fmt::format("{}_{}", cube ? "cube" : "square", large ? "large" : "small"));
  }
  if (expected.turn >= kTurned) suites.insert(suites.end(), {"rotation", "vortex"});
  if (expected.contact) suites.insert(suites.end(), {"plate_compression", "sliding_block"});
  if (expected.free) suites.emplace_back("colliding_disks");
  return suites;
}

/// `method` with shape, update and transfer of `measured` where the scene does not name them.
MethodDefinition filled(MethodDefinition method, const MethodDefinition& measured, const AutoMethod& asked) {
  if (!asked.keep_shape) method.shape = measured.shape;
  if (!asked.keep_update) method.update = measured.update;
  if (!asked.keep_transfer) method.transfer = measured.transfer;
  return method;
}

/// True if a measured method is allowed for this scene, which keeps `transfer`.
bool eligible(const MethodDefinition& measured, const AutoMethod& asked, const std::string& transfer, bool flows,
              const SimulationDefinition& definition) {
  const MethodDefinition& said = definition.method;
  if (measured.precision != Precision::float64) return false;
  if (asked.keep_shape ? measured.shape != said.shape
                       : traits_of(measured.shape).point() || (flows && measured.shape != MethodDefinition().shape)) {
    return false;
  }
  // The study's problems are elastic, so a flowing material keeps the transfer that is proven for it.
  const bool plain = measured.transfer.kind == TransferKind::flip && measured.transfer.flip == 1.0;
  if (flows && !asked.keep_transfer && !plain) return false;
  // XPIC and FMPM preserve the velocity of a ring's centre of mass, which is not at the ring's position:
  // doc/axisymmetric.md.
  const bool filters = measured.transfer.kind == TransferKind::xpic || measured.transfer.kind == TransferKind::fmpm;
  if (filters && axisymmetric(definition.geometry) && !asked.keep_transfer) return false;
  if (asked.keep_update && measured.update != said.update) return false;
  if (asked.keep_transfer && choice::transfer_label(measured.transfer) != transfer) return false;
  return !method_fault(filled(said, measured, asked), definition.geometry);
}

std::vector<std::string> candidates_for(const AutoMethod& asked, bool flows, const choice::MethodCosts& costs,
                                        const SimulationDefinition& definition) {
  std::set<std::string> labels;
  for (const auto& [suite, methods] : costs) {
    for (const auto& [label, points] : methods) labels.insert(label);
  }
  std::vector<std::string> found;
  // A transfer that the study has not run, such as a fraction of FLIP, is judged as FLIP.
  for (const std::string& transfer : {choice::transfer_label(definition.method.transfer), std::string("flip")}) {
    for (const std::string& label : labels) {
      if (eligible(choice::find_method(label).method, asked, transfer, flows, definition)) found.push_back(label);
    }
    if (!found.empty()) break;
  }
  return found;
}

std::string name_of(const std::string& label) {
  const MethodDefinition method = choice::find_method(label).method;
  return fmt::format("{}, {}, {}", shape_name(method.shape), update_name(method.update),
                     transfer_text(method.transfer));
}

std::string percent(double part) { return fmt::format("{:.3g} %", 100.0 * part); }

/// "1.05 times the least cost in square_large, 1.20 in rotation", over the suites judged `by` this measure; empty if
/// none.
std::string numbers(const Preference& preference, Judged by, const std::string& unit) {
  std::string text;
  for (std::size_t s = 0; s < preference.suites.size(); ++s) {
    const choice::JudgedSuite& suite = preference.suites[s];
    if (suite.by != by) continue;
    text += fmt::format("{}{:.2f}{} in {}", text.empty() ? "" : ", ", preference.chosen.by_suite[s],
                        text.empty() ? " times " + unit : "", suite.name);
  }
  return text;
}

std::string reasons(const Preference& preference, const choice::Budget& budget) {
  std::vector<std::string> parts;
  const auto add = [&](Judged by, const std::string& start, const std::string& unit) {
    if (const std::string list = numbers(preference, by, unit); !list.empty()) parts.push_back(start + list);
  };
  if (budget.error) {
    const std::string error = percent(*budget.error);
    add(Judged::cost, fmt::format("reaches {} at ", error), "the least cost");
    add(Judged::smallest_error, fmt::format("where not all methods reach {}, errs by ", error),
        "the smallest error or " + error);
  } else {
    add(Judged::error_at_cost,
        fmt::format("at {:g} times the cost of ugimp, usf, flip for 1 %, errs by ", *budget.cost), "the least error");
  }
  if (!preference.others.empty()) {
    const Standing& next = preference.others.front();
    parts.push_back(fmt::format("{} {} {:.2f} at worst", name_of(next.method),
                                next.worst < preference.chosen.worst ? "is less simple, with" : "comes next, with",
                                next.worst));
    const auto usual = std::find_if(preference.others.begin() + 1, preference.others.end(),
                                    [](const Standing& standing) { return standing.method == kDefault; });
    if (usual != preference.others.end()) {
      parts.push_back(fmt::format("{} has {:.2f} at worst", name_of(kDefault), usual->worst));
    }
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace

void choose_method(const AutoMethod& asked, const MethodCostsFile& file, Scene& scene) {
  SimulationDefinition& definition = scene.definition;
  MethodDefinition& method = definition.method;
  const auto say = [&](const std::string& why) {
    scene.choices.emplace_back("method", fmt::format("{}, {}, {}: {}", shape_name(method.shape),
                                                     update_name(method.update), transfer_text(method.transfer), why));
  };
  if (asked.keep_shape && asked.keep_update && asked.keep_transfer) return say("all named by the scene");
  if (!file.fault.empty()) return say(fmt::format("the default; {}", file.fault));

  ExpectedMotion expected = expected_motion(scene);
  if (asked.strain) {
    expected.strain = *asked.strain;
  } else {
    scene.choices.emplace_back("method.auto.strain",
                               fmt::format("{}: {}", percent(expected.strain), expected.strain_why));
  }
  if (asked.turn) {
    expected.turn = *asked.turn;
  } else {
    scene.choices.emplace_back("method.auto.turn",
                               fmt::format("{:.3g} deg: {}", expected.turn / kDegree, expected.turn_why));
  }
  const auto preference =
      choice::prefer(file.costs, suites_like(expected, definition.geometry, file.costs, asked.budget),
                     candidates_for(asked, expected.flows, file.costs, definition), asked.budget);
  if (!preference) {
    return say(fmt::format("the default; no measured method {}",
                           asked.budget.error
                               ? "has what the scene keeps; name shape, update and transfer, or keep less"
                               : "has what the scene keeps and is as cheap; raise method.auto.cost"));
  }
  method = filled(method, choice::find_method(preference->chosen.method).method, asked);
  say(reasons(*preference, asked.budget));
}

}  // namespace mpm
