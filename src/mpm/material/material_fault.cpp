// Conditions that have to hold between the constants of a law; the range of each alone is in its keys.
#include <fmt/core.h>

#include <cmath>

#include "mpm/material/add_user_law.hpp"
#include "mpm/material/law_keys.hpp"

namespace mpm {
namespace {

using Fault = std::optional<KeyFault>;

/// Refuses a constant `key` above or below another, whose `bound` has a name.
Fault more_than(const char* key, double value, const char* name, double bound, const Dimension& dimension) {
  return KeyFault{key, fmt::format("{} is more than {}, {}", quantity_text(value, dimension), name,
                                   quantity_text(bound, dimension))};
}
Fault less_than(const char* key, double value, const char* name, double bound, const Dimension& dimension) {
  return KeyFault{key, fmt::format("{} is less than {}, {}", quantity_text(value, dimension), name,
                                   quantity_text(bound, dimension))};
}

/// Checks how strength and dilation of a soil fall. Strength that falls faster with strain than the soil unloads would
/// be lost at once whatever the slip: c cos(phi) / G is the elastic shear strain that the loss of cohesion sets free.
/// (What the loss of friction sets free depends on the pressure, which a material does not know.)
template <class Soil>
Fault softening_fault(const Soil& law) {
  const SoilSoftening& fall = law.softening;
  if (!fall.falls() && std::isinf(fall.rise)) return {};
  if (!(fall.band > 0.0)) {
    return KeyFault{"shear_band",
                    "strength that falls over a slip and dilation that ends at a rise need the width of a shear band "
                    "as the grid resolves it: write the edge of a cell"};
  }
  if (!fall.falls()) return {};
  if (!(fall.friction_angle <= law.friction_angle)) {
    return more_than("residual_friction_angle", fall.friction_angle, "friction_angle", law.friction_angle, kAngle);
  }
  if (!(fall.cohesion <= law.cohesion)) {
    return more_than("residual_cohesion", fall.cohesion, "cohesion", law.cohesion, kPressure);
  }
  if (fall.friction_angle == 0.0 && fall.cohesion == 0.0) {
    return KeyFault{"residual_cohesion",
                    "it is 0 and so is residual_friction_angle: soil that ends without any strength; give one of them"};
  }
  if (fall.friction_angle == law.friction_angle && fall.cohesion == law.cohesion && law.dilation_angle == 0.0) {
    return KeyFault{"softening_slip",
                    fmt::format("nothing falls over the {:g} m; add residual_friction_angle, residual_cohesion or a "
                                "dilation_angle, or leave it out",
                                fall.slip)};
  }
  const double lost = law.cohesion * std::cos(law.friction_angle) - fall.cohesion * std::cos(fall.friction_angle);
  const double released = lost / law.elasticity.shear();
  if (fall.strain() > released) return {};
  return KeyFault{"softening_slip",
                  fmt::format("over {:g} m and a band of {:g} m cohesion falls faster than the soil can unload: write "
                              "more than {:.3g} m, or use smaller cells",
                              fall.slip, fall.band, released * fall.band)};
}

template <class Soil>
Fault soil_fault(const Soil& law) {
  if (!(law.dilation_angle <= law.friction_angle)) {
    return more_than("dilation_angle", law.dilation_angle, "friction_angle", law.friction_angle, kAngle);
  }
  if (law.friction_angle == 0.0 && law.cohesion == 0.0) {
    return KeyFault{"cohesion",
                    "it is 0 and so is friction_angle: soil without any strength; give one of them, or use "
                    "newtonian_fluid for a liquid"};
  }
  // The apex c cot(phi) holds for every match of the cone too (method reference 10.6: xi / eta); without friction there
  // is none.
  const double apex = law.friction_angle > 0.0 ? law.cohesion / std::tan(law.friction_angle) : kInfinity;
  if (!(law.tension_cutoff <= apex * (1.0 + 1e-12))) {  // an apex given as the cut-off may be rounded
    return more_than("tension_cutoff", law.tension_cutoff, "the apex, cohesion / tan(friction_angle)", apex, kPressure);
  }
  return softening_fault(law);
}

/// Checks what has to hold between constants of a law, and with the density of its material.
struct Together {
  const MaterialDefinition& material;

  template <class Law>
  Fault operator()(const Law&) const {
    return {};
  }
  Fault operator()(const DruckerPragerDefinition& law) const { return soil_fault(law); }
  Fault operator()(const MohrCoulombDefinition& law) const { return soil_fault(law); }
  Fault operator()(const MuIDefinition& law) const {
    if (law.limiting_friction < law.static_friction) {
      return less_than("mu_2", law.limiting_friction, "mu_s", law.static_friction, kPlain);
    }
    if (law.grain_density >= material.density) return {};
    return less_than("grain_density", law.grain_density, "density, that of the heap", material.density, kDensity);
  }
  Fault operator()(const CamClayDefinition& law) const {
    if (law.consolidation == 0.0 && law.overconsolidation == 0.0) {
      return KeyFault{"overconsolidation_ratio", "write it or preconsolidation_pressure"};
    }
    if (law.lambda > law.kappa) return {};
    return KeyFault{"lambda", fmt::format("{:g} is not above kappa, {:g}", law.lambda, law.kappa)};
  }
  Fault operator()(const NorSandDefinition& law) const {
    if (law.dilatancy * law.critical_slope() < 0.5 * law.slope) return {};
    return KeyFault{"chi", fmt::format("{:g} times the slope of the critical line, {:g}, is not below half of M, {:g}",
                                       law.dilatancy, law.critical_slope(), law.slope)};
  }
  Fault operator()(const J2PlasticityDefinition& law) const {
    if (law.saturation_rate == 0.0 || law.saturation_stress >= law.yield_stress) return {};
    return less_than("saturation_stress", law.saturation_stress, "yield_stress", law.yield_stress, kPressure);
  }
  Fault operator()(const JohnsonCookDefinition& law) const {
    if (law.melting_temperature == 0.0 || law.melting_temperature > law.reference_temperature) return {};
    return KeyFault{"melting_temperature", fmt::format("{:g} K is not above reference_temperature, {:g} K",
                                                       law.melting_temperature, law.reference_temperature)};
  }
};

}  // namespace

std::optional<KeyFault> material_fault(const MaterialDefinition& material) {
  if (Fault fault = material_keys().fault(material)) return fault;
  const auto out_of_range = [](const auto& law) -> Fault {
    if constexpr (std::is_same_v<std::decay_t<decltype(law)>, UserLawDefinition>) {
      if (law.kind == nullptr) return KeyFault{"law", "it names no law; add one by add_user_law(), and name its kind"};
      if (law.constants.size() != law.kind->constants.size()) {
        return KeyFault{"law", fmt::format("it has {} constants and '{}' asks for {}; begin with fresh() of its kind",
                                           law.constants.size(), law.kind->name, law.kind->constants.size())};
      }
      return law.kind->keys.fault(law);
    } else {
      return law_keys<std::decay_t<decltype(law)>>().fault(law);
    }
  };
  if (Fault fault = std::visit(out_of_range, material.law)) return fault;
  return std::visit(Together{material}, material.law);
}

void check(const MaterialDefinition& material) {
  if (material.name.empty()) throw MaterialError("material without a name; give it one");
  const Fault fault = material_fault(material);
  if (fault) throw MaterialError(fmt::format("material '{}': {}: {}", material.name, fault->key, fault->text));
}

}  // namespace mpm
