#include "mpm/material/strain_path.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace mpm {
namespace {

constexpr int kZz = 2, kXz = 4;
/// Duration of a sudden change, relative to the time of constant strain or stress that follows.
constexpr double kSudden = 1e-6;

void require_positive(double value, const char* what, const char* unit) {
  if (!(value > 0.0) || !std::isfinite(value)) {
    throw PathError(fmt::format("{} is {:g} {}; it must be positive and finite", what, value, unit));
  }
}

Leg leg(const PathDefinition& d, double duration) {
  Leg leg;
  leg.duration = duration;
  leg.steps = d.steps;
  return leg;
}

double strain_of(const PathDefinition& d, double otherwise) {
  const double strain = d.strain.value_or(otherwise);
  if (strain == 0.0 || !std::isfinite(strain)) {
    throw PathError(fmt::format("the strain is {:g}; it must be finite and not 0", strain));
  }
  return strain;
}

Leg strain_leg(const PathDefinition& d, int component, Control control) {
  const double rate = d.rate.value_or(1.0);
  require_positive(rate, "the rate of strain", "1/s");
  const double strain = strain_of(d, control == Control::simple_shear ? 0.01 : -0.01);
  Leg straining = leg(d, std::abs(strain) / rate);
  straining.control[component] = control;
  straining.target[component] = strain;
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
  const double confining = d.confining.value_or(1e5);
  require_positive(confining, "the confining pressure", "Pa");
  Leg axial = strain_leg(d, kZz, Control::strain);
  axial.from_start = true;  // as in laboratories; soft soil shortens by more than that under the pressure alone
  free_sides(axial, confining);
  Leg confine = leg(d, axial.duration);
  for (const int k : {0, 1, 2}) {
    confine.control[k] = Control::stress;
    confine.target[k] = -confining;
  }
  return {confine, axial};
}

StrainPath simple_shear(const PathDefinition& d) { return {strain_leg(d, kXz, Control::simple_shear)}; }

StrainPath volumetric(const PathDefinition& d) {
  Leg squeeze = strain_leg(d, kZz, Control::strain);
  const double third = squeeze.target[kZz] / 3.0;
  for (const int k : {0, 1, 2}) squeeze.target[k] = third;
  return {squeeze};
}

/// The sudden step, and the time after it with the same targets.
StrainPath step_and_hold(const PathDefinition& d, Leg step) {
  const double time = d.hold.value_or(1.0);
  require_positive(time, "the time to hold", "s");
  step.duration = kSudden * time;
  Leg hold = step;
  hold.duration = time;
  return {step, hold};
}

StrainPath relaxation(const PathDefinition& d) {
  Leg step = strain_leg(d, d.shear ? kXz : kZz, d.shear ? Control::simple_shear : Control::strain);
  if (!d.shear) free_sides(step, 0.0);
  return step_and_hold(d, step);
}

StrainPath creep(const PathDefinition& d) {
  if (!d.stress) throw PathError("creep needs the stress to hold; give it");
  if (*d.stress == 0.0 || !std::isfinite(*d.stress)) {
    throw PathError(fmt::format("the stress to hold is {:g} Pa; it must be finite and not 0", *d.stress));
  }
  Leg step = leg(d, 0.0);
  const int component = d.shear ? kXz : kZz;
  step.control[component] = Control::stress;
  step.target[component] = *d.stress;
  if (!d.shear) free_sides(step, 0.0);
  return step_and_hold(d, step);
}

struct NamedPath {
  const char* name;
  StrainPath (*make)(const PathDefinition&);
  bool strain, confining, stress, rate, hold, shear;  ///< parameters that it uses
};
constexpr std::array<NamedPath, 7> kPaths = {{
    {"uniaxial_strain", uniaxial_strain, true, false, false, true, false, false},
    {"uniaxial_stress", uniaxial_stress, true, false, false, true, false, false},
    {"triaxial", triaxial, true, true, false, true, false, false},
    {"simple_shear", simple_shear, true, false, false, true, false, false},
    {"volumetric", volumetric, true, false, false, true, false, false},
    {"relaxation", relaxation, true, false, false, false, true, true},
    {"creep", creep, false, false, true, false, true, true},
}};

void refuse_unused(const NamedPath& path, const PathDefinition& d) {
  const auto check = [&path](bool given, bool used, const char* what) {
    if (given && !used) throw PathError(fmt::format("{} has no {}; leave it out", path.name, what));
  };
  check(d.strain.has_value(), path.strain, "strain to reach");
  check(d.confining.has_value(), path.confining, "confining pressure");
  check(d.stress.has_value(), path.stress, "stress to hold");
  check(d.rate.has_value(), path.rate, "rate of strain");
  check(d.hold.has_value(), path.hold, "time to hold");
  check(d.shear, path.shear, "choice of shear");
}

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
  for (const NamedPath& path : kPaths) {
    if (name != path.name) continue;
    refuse_unused(path, definition);
    return path.make(definition);
  }
  throw PathError(fmt::format("'{}' is not a path; write one of {}", name, fmt::join(strain_path_names(), ", ")));
}

}  // namespace mpm
