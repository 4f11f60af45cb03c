#include "mpm/rules/transport_work.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mpm/definition/definition.hpp"
#include "mpm/definition/layout.hpp"
#include "mpm/material/material_point.hpp"
#include "mpm/math/geometry_kind.hpp"
#include "mpm/transport/stages.hpp"
#include "mpm/transport/transported_field.hpp"

namespace mpm {
namespace {

constexpr double kMostStages = 1e5;   ///< in a step
constexpr double kManyStages = 15.0;  ///< in a step: a pass over the particles each, they are most of its work
constexpr double kMostRatio = 1e12;   ///< ratio of a step to the stable one, of which the stages are an integer
constexpr double kGravity = 9.81;     ///< [m/s^2]
constexpr double kWater = 1000.0;     ///< [kg/m^3]

bool is_used(const MaterialDefinition& material, const std::vector<std::string>& used) {
  return std::find(used.begin(), used.end(), material.name) != used.end();
}

/// Longest step that mechanics takes at the start [s].
double longest_step(const SimulationDefinition& d, const std::vector<std::string>& used, double cell) {
  double dt = seconds_of(d.time.sync);
  if (d.time.step) dt = std::min(dt, *d.time.step);
  const QuantityDefinition* pores = d.transport.find(Transported::pore_pressure);
  for (std::size_t m = 0; m < d.materials.size(); ++m) {
    if (!is_used(d.materials[m], used)) continue;
    double square = std::pow(MaterialPoint(d.materials[m]).wave_speed(), 2);
    if (pores != nullptr && m < pores->materials.size()) {
      const TransportMaterial& own = pores->materials[m];
      const double biot = std::max({own.biot.xx, own.biot.yy, own.biot.zz});
      square += biot * biot / (own.capacity.least() * d.materials[m].density);
    }
    dt = std::min(dt, d.time.cfl * cell / std::sqrt(square));
  }
  return dt;
}

std::string material_cause(const MaterialDefinition& material, const TransportMaterial& own, Transported quantity,
                           double diffusivity) {
  const double most = own.conductivity.most();
  if (quantity == Transported::temperature) {
    return fmt::format(
        "materials.{}.conductivity: {:.4g} W/(m K) with a heat capacity of {:.4g} J/(kg K) spreads heat with {:.3g} "
        "m^2/s (copper: 1e-4)",
        material.name, most, own.capacity.least(), diffusivity);
  }
  if (quantity == Transported::concentration) {
    return fmt::format("materials.{}.diffusivity: {:.3g} m^2/s", material.name, diffusivity);
  }
  const double weight = kGravity * (own.fluid_density > 0.0 ? own.fluid_density : kWater);
  return fmt::format(
      "materials.{}.permeability: over the viscosity it is {:.3g} m^2/(Pa s), a hydraulic conductivity of {:.3g} m/s "
      "(gravel: 0.01); a conductivity in m/s is no permeability: multiply it by viscosity / (density g), about 1e-7 "
      "m s for water",
      material.name, most, most * weight);
}

TransportWork work_of(const SimulationDefinition& d, const QuantityDefinition& quantity,
                      const std::vector<std::string>& used, double cell, double dt) {
  TransportWork work;
  work.step = dt;
  work.quantity = traits_of(quantity.quantity).name;
  double capacity = std::numeric_limits<double>::infinity();
  std::string conductor;
  for (std::size_t m = 0; m < std::min(d.materials.size(), quantity.materials.size()); ++m) {
    if (!is_used(d.materials[m], used)) continue;
    const TransportMaterial& own = quantity.materials[m];
    capacity = std::min(capacity, least_capacity(own, quantity.quantity, d.materials[m].density));
    const double diffusivity = largest_diffusivity(own, quantity.quantity, d.materials[m].density);
    if (diffusivity <= work.diffusivity) continue;
    work.diffusivity = diffusivity;
    work.material = d.materials[m].name;
    conductor = material_cause(d.materials[m], own, quantity.quantity, diffusivity);
  }
  double conductance = 0.0;
  std::string surface;
  for (const FluxDefinition& flux : quantity.fluxes) {
    const double own = surface_conductance(flux, quantity.reference);
    if (own <= conductance) continue;
    conductance = own;
    surface = fmt::format("transport.{}.fluxes: '{}' takes {:.4g} W/(m^2 K) from its surface (boiling water: 1e4)",
                          work.quantity, flux.name, own);
  }
  double longest = longest_update(cell, capacity, conductance);
  const double stable = stable_step(cell, work.diffusivity);
  bool by_surface = longest < stable;
  if (traits_of(d.method.shape).point() && kOfPoints * stable < longest) {
    longest = kOfPoints * stable;
    by_surface = false;
  }
  const double updates = std::max(1.0, std::ceil(dt / longest));
  const double ratio = dt / updates / stable;
  work.stages = updates * (ratio < kMostRatio ? stages_for(ratio) : stages_needed(ratio));
  work.cause = by_surface ? surface : conductor;
  return work;
}

}  // namespace

std::vector<TransportWork> transport_work(const SimulationDefinition& d, const std::vector<std::string>& materials) {
  std::vector<TransportWork> all;
  if (d.transport.quantities.empty()) return all;
  const double cell = layout_of(d).smallest_cell(), dt = longest_step(d, materials, cell);
  for (const QuantityDefinition& quantity : d.transport.quantities) {
    all.push_back(work_of(d, quantity, materials, cell, dt));
  }
  return all;
}

std::string transport_warning(const SimulationDefinition& d, const std::vector<std::string>& materials) {
  TransportWork most;
  for (const TransportWork& own : transport_work(d, materials)) {
    if (own.stages > most.stages) most = own;
  }
  if (most.stages < kManyStages) return {};
  const double sync = seconds_of(d.time.sync);
  const std::string text =
      fmt::format("{}: a step of {:.3g} s takes {:.3g} stages of it", most.cause, most.step, most.stages);
  if (most.stages <= kMostStages && std::ceil(sync / most.step) * most.stages <= kMostSteps) {
    return text +
           ", each a pass over the particles, which sets the pace: check the number and its unit, or make grid.cell "
           "larger";
  }
  throw DefinitionError(
      fmt::format("{}; at most {:.0e} are taken in a step and {:.0e} in a sync period: check the "
                  "number and its unit, or make grid.cell larger",
                  text, kMostStages, kMostSteps));
}

}  // namespace mpm
