#include "mpm/material/strain_path.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>

namespace mpm {
namespace {

constexpr int kZz = 2, kXz = 4;
/// A step in strain or stress takes this part of the time that it is held for.
constexpr double kSudden = 1e-6;

void require_positive(double value, const char* what, const char* unit) {
  if (!(value > 0.0) || !std::isfinite(value)) {
    throw PathError(fmt::format("{} is {:g} {}; it must be positive and finite", what, value, unit));
  }
}

void require_finite(double value, const char* what, const char* unit) {
  if (!std::isfinite(value)) throw PathError(fmt::format("{} is {:g} {}; it must be finite", what, value, unit));
}

Leg leg(const PathDefinition& d, double duration) {
  Leg leg;
  leg.duration = duration;
  leg.steps = d.steps;
  return leg;
}

Leg strain_leg(const PathDefinition& d, int component, Control control) {
  require_finite(d.strain, "the strain", "");
  if (d.strain == 0.0) throw PathError("the strain is 0: there is nothing to drive; give another");
  Leg straining = leg(d, std::abs(d.strain) / d.rate);
  straining.control[component] = control;
  straining.target[component] = d.strain;
  return straining;
}

void free_sides(Leg& leg, double pressure) {
  for (const int side : {0, 1}) {
    leg.control[side] = Control::stress;
    leg.target[side] = -pressure;
  }
}

StrainPath uniaxial_strain(const PathDefinition& d) { return {strain_leg(d, kZz, Control::strain)}; }

StrainPath uniaxial_stress(const PathDefinition& d) {
  Leg pull = strain_leg(d, kZz, Control::strain);
  free_sides(pull, 0.0);
  return {pull};
}

StrainPath triaxial(const PathDefinition& d) {
  require_positive(d.confining, "the confining pressure", "Pa");
  Leg axial = strain_leg(d, kZz, Control::strain);
  free_sides(axial, d.confining);
  Leg confine = leg(d, axial.duration);
  for (const int k : {0, 1, 2}) {
    confine.control[k] = Control::stress;
    confine.target[k] = -d.confining;
  }
  return {confine, axial};
}

StrainPath simple_shear(const PathDefinition& d) { return {strain_leg(d, kXz, Control::simple_shear)}; }

StrainPath volumetric(const PathDefinition& d) {
  Leg squeeze = strain_leg(d, kZz, Control::strain);
  for (const int k : {0, 1, 2}) squeeze.target[k] = d.strain / 3.0;
  return {squeeze};
}

/// The sudden step, and the hold after it with the same targets.
StrainPath step_and_hold(const PathDefinition& d, Leg step) {
  require_positive(d.hold, "the time to hold", "s");
  step.duration = kSudden * d.hold;
  Leg hold = step;
  hold.duration = d.hold;
  return {step, hold};
}

StrainPath relaxation(const PathDefinition& d) {
  Leg step = strain_leg(d, d.shear ? kXz : kZz, d.shear ? Control::simple_shear : Control::strain);
  if (!d.shear) free_sides(step, 0.0);
  return step_and_hold(d, step);
}

StrainPath creep(const PathDefinition& d) {
  require_finite(d.stress, "the stress", "Pa");
  if (d.stress == 0.0) throw PathError("the stress to hold is 0; give another");
  Leg step = leg(d, 0.0);
  const int component = d.shear ? kXz : kZz;
  step.control[component] = Control::stress;
  step.target[component] = d.stress;
  if (!d.shear) free_sides(step, 0.0);
  return step_and_hold(d, step);
}

struct NamedPath {
  const char* name;
  StrainPath (*make)(const PathDefinition&);
};
constexpr std::array<NamedPath, 7> kPaths = {{{"uniaxial_strain", uniaxial_strain},
                                              {"uniaxial_stress", uniaxial_stress},
                                              {"triaxial", triaxial},
                                              {"simple_shear", simple_shear},
                                              {"volumetric", volumetric},
                                              {"relaxation", relaxation},
                                              {"creep", creep}}};

}  // namespace

const std::array<const char*, kComponents> kComponentNames = {"xx", "yy", "zz", "yz", "xz", "xy"};

const std::vector<std::string>& strain_path_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const NamedPath& path : kPaths) list.emplace_back(path.name);
    return list;
  }();
  return names;
}

StrainPath make_strain_path(const std::string& name, const PathDefinition& definition) {
  if (definition.steps < 1) throw PathError(fmt::format("{} steps; take at least one", definition.steps));
  require_positive(definition.rate, "the rate of strain", "1/s");
  for (const NamedPath& path : kPaths) {
    if (name == path.name) return path.make(definition);
  }
  throw PathError(fmt::format("'{}' is not a path; write one of {}", name, fmt::join(strain_path_names(), ", ")));
}

}  // namespace mpm
