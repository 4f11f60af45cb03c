// Soil at rest: the stress of the weight above it, less what water in its pores carries, and settling to rest before
// the run begins.
//
// The settling is done by the solver itself, in a run of its own with the geostatic bodies alone, every tool held where
// it stands and every load as at t = 0, and with kinetic damping: all velocities are set to zero whenever the kinetic
// energy has passed a peak. That needs no constant, calms elastic waves within a few swings, and lets a slope that is
// too steep slide down as fast as it would. The soil has settled when, from rest, the sum over nodes of |m a| is less
// than a stated part of the weight. Where it is needed the particles move; they keep the places, deformation and
// history in which they have come to rest. Source: Cundall (1976), Explicit finite-difference methods in geomechanics,
// 2nd Int. Conf. Num. Meth. Geomech.; Barnes (1999), Int. J. Space Structures 14, 89-104 (kinetic damping).
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "initial.hpp"
#include "mpm/simulation/geometry_rules.hpp"
#include "state.hpp"

namespace mpm {
namespace {

constexpr double kGap = 1.5;                          ///< particle spacings from centre to centre that part a column
constexpr std::uint64_t kMostSettlingSteps = 10'000;  ///< of settling
constexpr double kNoChange = 1e30;                    ///< storage at which a pressure stays as it is [1/Pa]
constexpr std::uint64_t kSurveyEvery = 10;            ///< steps between looks at the wave speed

struct Part {
  std::int64_t column;  ///< which column of the lattice
  double depth;         ///< along gravity [m]
  double weight;        ///< [N]
  std::size_t body, particle;
};

int axis_of(const Vec3& gravity) {
  int axis = 0;
  if (!(gravity.norm() > 0.0)) {
    throw DefinitionError("a geostatic start needs gravity; write it, such as gravity: [0, 0, -9.81]");
  }
  gravity.cwiseAbs().maxCoeff(&axis);
  if (std::abs(gravity[axis]) < (1.0 - 1e-12) * gravity.norm()) {
    throw DefinitionError(fmt::format(
        "a geostatic start needs gravity along an axis of the grid, not ({:g}, {:g}, {:g}) m/s^2; turn the scene, "
        "or let the soil settle in the run",
        gravity.x(), gravity.y(), gravity.z()));
  }
  return axis;
}

/// Ratio of horizontal to vertical stress: as asked, or the material's own, raised to what it can carry.
double ratio_at_rest(const DeformableBody& body, const MaterialDefinition& material, const InitialStates& states,
                     double deepest, const std::function<Symmetric3<double>(double, double)>& stress) {
  if (body.geostatic->k0) return *body.geostatic->k0;
  const std::optional<double> own = pressure_at_rest(material.law);
  if (!own) {
    throw DefinitionError(
        fmt::format("body '{}': material '{}' ({}) cannot start geostatic; give it initial stress or "
                    "temperature",
                    body.name, material.name, law_name(material.law)));
  }
  double low = *own, high = 1.0;
  if (states.carries(stress(deepest, low)) || !(low < high)) return low;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (states.carries(stress(deepest, middle)) ? high : low) = middle;
  }
  return high;
}

/// What is out of balance after a step from rest.
struct Unbalanced {
  double mean = std::numeric_limits<double>::infinity();  ///< sum over nodes of |m a| over the weight
  double most = std::numeric_limits<double>::infinity();  ///< largest |a| / g of nodes that carry half a particle
};

void add_unbalanced(const Grid& grid, double weight, double g, double half_particle, Unbalanced& found) {
  for (int b = 0; b < grid.blocks.size(); ++b) {
    for (int n = 0; n < grid.layout.nodes_per_block(); ++n) {
      if (!grid.carries(b, n)) continue;
      const double mass = grid.mass.at(b, 0, n), a = nodal_vector(grid.force, grid.layout, {b, n}).norm();
      found.mean += mass * a / weight;
      if (mass >= half_particle) found.most = std::max(found.most, a / g);
    }
  }
}

void stop(std::vector<ParticleSet>& sets) {
  for (ParticleSet& set : sets) {
    for (auto* motion : {&set.v, &set.affine}) {
      for (ParticleScalar& component : *motion) component.assign(component.size(), 0.0);
    }
  }
}

/// The part of a scene that settles.
SimulationDefinition resting_part(const SimulationDefinition& definition) {
  SimulationDefinition part = definition;
  // What is settled comes to rest sooner if each particle has its own strength.
  part.method.average_stress = false;
  part.bodies.clear();
  part.metrics.clear();
  part.sleep.reset();
  part.cracks = {};                      // what settles is whole
  part.method.damping.feedback.reset();  // it would remember the fall
  for (const DeformableBody& body : definition.bodies) {
    if (!body.geostatic) continue;
    part.bodies.push_back(body);
    part.bodies.back().geostatic.reset();
  }
  const auto elsewhere = [&](const auto& load) {
    return !load.body.empty() && std::none_of(part.bodies.begin(), part.bodies.end(),
                                              [&](const DeformableBody& body) { return body.name == load.body; });
  };
  auto& body_forces = part.body_forces;
  body_forces.erase(std::remove_if(body_forces.begin(), body_forces.end(), elsewhere), body_forces.end());
  auto& forces = part.particle_forces;
  forces.erase(std::remove_if(forces.begin(), forces.end(), elsewhere), forces.end());
  auto& tractions = part.tractions;
  tractions.erase(std::remove_if(tractions.begin(), tractions.end(), elsewhere), tractions.end());
  auto& pairs = part.contact.pairs;
  const auto absent = [&](const PairDefinition& pair) {
    return std::any_of(definition.bodies.begin(), definition.bodies.end(), [&](const DeformableBody& body) {
      return !body.geostatic && (body.name == pair.first || body.name == pair.second);
    });
  };
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(), absent), pairs.end());
  for (RigidBodyDefinition& body : part.rigid_bodies) {
    body.velocity = body.rotation_rate = {};
    body.free.reset();
  }
  for (ConditionDefinition& condition : part.conditions) {
    condition.region.velocity = condition.region.rotation_rate = {};
    condition.velocity = Function();
  }
  // Water stands: its pressure is what it is at the start, whatever the soil does. Heat and moisture come later.
  std::vector<QuantityDefinition> water;
  if (const QuantityDefinition* pores = part.transport.find(Transported::pore_pressure)) {
    water.push_back(*pores);
    water.back().values.clear();
    water.back().fluxes.clear();
    water.back().sources.clear();
    for (TransportMaterial& material : water.back().materials) {
      material.capacity = kNoChange;
      material.conductivity = 0.0;
    }
  }
  part.transport.quantities = std::move(water);
  // Dashpots would let it sink.
  for (WallDefinition& wall : part.walls) {
    if (wall.kind == WallKind::absorbing) wall.kind = WallKind::slip;
  }
  return part;
}

}  // namespace

void add_geostatic_stress(SimulationDefinition& definition) {
  if (const std::string reason = refused_geostatic(definition.geometry); !reason.empty()) {
    throw DefinitionError("a geostatic start is not possible: " + reason);
  }
  const int up = axis_of(definition.gravity);
  const double g = definition.gravity.norm(), down = definition.gravity[up] > 0.0 ? 1.0 : -1.0;
  const bool plane = planar(definition.geometry), flat = dimensions(definition.geometry) == 2;
  Vec3 spacing = definition.grid.cell / definition.method.particles_per_direction;
  // Rings: weight and area are those of their section, a column is as heavy at any radius.
  if (flat) spacing.y() = plane ? definition.thickness : 1.0;
  const double area = spacing.prod() / spacing[up];

  std::vector<Part> parts;
  for (std::size_t b = 0; b < definition.bodies.size(); ++b) {
    const DeformableBody& body = definition.bodies[b];
    if (!body.geostatic) continue;
    const double weight = find_material(definition, body).density * body.particle_volume * g;
    for (std::size_t p = 0; p < body.positions.size(); ++p) {
      const Vec3 cells = (body.positions[p] - definition.grid.min).cwiseQuotient(spacing);
      std::int64_t column = 0;
      for (int axis = 0; axis < 3; ++axis) {
        if (axis != up && !(flat && axis == 1))
          column = column * (std::int64_t{1} << 31) + std::llround(std::floor(cells[axis]));
      }
      parts.push_back({column, down * body.positions[p][up], weight, b, p});
    }
  }
  std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
    return a.column != b.column ? a.column < b.column : a.depth < b.depth;
  });
  std::vector<std::vector<double>> vertical(definition.bodies.size());
  for (const Part& part : parts) vertical[part.body].resize(definition.bodies[part.body].positions.size());
  double above = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Part& part = parts[i];
    const bool on_other =
        i > 0 && parts[i - 1].column == part.column && part.depth - parts[i - 1].depth < kGap * spacing[up];
    if (!on_other) above = 0.0;
    vertical[part.body][part.particle] = -(above + 0.5 * part.weight) / area;
    above += part.weight;
  }
  // Laws see effective stress: the weight less what the water carries.
  const QuantityDefinition* water = definition.transport.find(Transported::pore_pressure);
  for (std::size_t b = 0; b < definition.bodies.size() && water != nullptr; ++b) {
    const DeformableBody& body = definition.bodies[b];
    const auto material = &find_material(definition, body) - definition.materials.data();
    const Symmetric3<double>& biot = water->materials[material].biot;
    const double part = up == 0 ? biot.xx : up == 1 ? biot.yy : biot.zz;
    for (std::size_t p = 0; p < vertical[b].size(); ++p) {
      const Vec3& place = body.positions[p];
      vertical[b][p] += part * initial_value(*water, body.name, place);
      if (!(vertical[b][p] > 0.0)) continue;
      throw DefinitionError(
          fmt::format("body '{}': at ({:.6g}, {:.6g}, {:.6g}) m the water in the pores carries more than the weight "
                      "above, by {:.4g} "
                      "Pa, so that the soil would be pulled apart; lower the water table to its surface, or load it",
                      body.name, place.x(), place.y(), place.z(), vertical[b][p]));
    }
  }
  const auto stress = [up](double along, double ratio) {
    const double across = ratio * along;
    return Symmetric3<double>{up == 0 ? along : across, up == 1 ? along : across, up == 2 ? along : across, 0, 0, 0};
  };
  for (std::size_t b = 0; b < definition.bodies.size(); ++b) {
    DeformableBody& body = definition.bodies[b];
    if (!body.geostatic || vertical[b].empty()) continue;
    const MaterialDefinition& material = find_material(definition, body);
    const InitialStates states(material, definition.geometry);
    const double deepest = *std::min_element(vertical[b].begin(), vertical[b].end());
    const double ratio = ratio_at_rest(body, material, states, deepest, stress);
    body.yy_follows = plane && states.yy_is_bound();
    body.stresses.clear();
    for (const double along : vertical[b]) body.stresses.push_back(stress(along, ratio));
  }
}

void Simulation::State::settle() {
  SimulationDefinition part = resting_part(definition);
  double wanted = std::numeric_limits<double>::infinity();
  std::string names;
  for (const DeformableBody& body : definition.bodies) {
    if (!body.geostatic) continue;
    wanted = std::min(wanted, body.geostatic->residual);
    names += (names.empty() ? "'" : ", '") + body.name + "'";
  }
  Simulation run(std::move(part), {threads, isa});
  State& r = *run.state_;
  const double g = definition.gravity.norm();
  double lightest = r.sets.front().least_mass();
  for (const ParticleSet& set : r.sets) lightest = std::min(lightest, set.least_mass());
  const double period = static_cast<double>(definition.time.sync) * 1e-9;
  Unbalanced residual;
  double before = 0.0;
  std::uint64_t count = 0;
  try {
    for (bool at_rest = true; residual.mean > wanted && count < kMostSettlingSteps; ++count) {
      if (count % kSurveyEvery == 0) r.previous_limit = r.material_limit = r.survey_material();
      r.step(0.0, std::min(r.step_limit(r.previous_limit, r.material_limit).dt, period));
      if (at_rest) {
        residual = {0.0, 0.0};
        for (const auto& grid : r.fields) add_unbalanced(*grid, r.total_mass * g, g, 0.5 * lightest, residual);
      }
      const double now = kinetic_energy(r.sets, r.threads);
      at_rest = now < before;
      if (at_rest) stop(r.sets);
      before = at_rest ? 0.0 : now;
      if (settling) settling({count + 1, residual.mean, wanted});
      const bool stops = asked_to_stop && asked_to_stop();
      // Each rank settles all by itself, to the same bits, but one alone may be asked.
      if (ranks ? ranks->any(stops) : stops) {
        throw StoppedError(fmt::format("stopped while {} settled, after {} steps", names, count + 1));
      }
    }
  } catch (const StoppedError&) {
    throw;
  } catch (const Error& error) {
    throw PhysicsError(fmt::format("geostatic start of {}, while it settled: {}", names, error.what()));
  }

  double farthest = 0.0;
  for (ParticleSet& set : sets) {
    const auto other = std::find_if(r.sets.begin(), r.sets.end(), [&](const auto& o) { return o.name == set.name; });
    if (other == r.sets.end()) continue;
    const int work = std::visit([](const auto& law) { return law.kPlasticWork; }, laws[&set - sets.data()]);
    for (int p = 0; p < set.size(); ++p) {
      const std::size_t i = other->id[p] - other->first_id;
      double moved = 0.0;
      for (std::size_t k = 0; k < set.x.size(); ++k) moved += std::pow(other->x[k][p] - set.x[k][i], 2);
      farthest = std::max(farthest, std::sqrt(moved));
      for (std::size_t k = 0; k < set.x.size(); ++k) set.x[k][i] = other->x[k][p];
      for (std::size_t k = 0; k < set.f.size(); ++k) set.f[k].set(i, other->f[k][p]);
      for (std::size_t k = 0; k < set.tau.size(); ++k) set.tau[k].set(i, other->tau[k][p]);
      for (std::size_t k = 0; k < set.history.size(); ++k) set.history[k].set(i, other->history[k][p]);
      if (work >= 0) set.history[work].set(i, 0.0);  // dissipated since the start
    }
  }
  const std::string text = fmt::format(
      "geostatic start of {}: unbalanced force {:.2g} of the weight (asked: {:.2g}), at a node {:.2g} g at most, "
      "after {} steps of settling, moved by at most {:.3g} m",
      names, residual.mean, wanted, residual.most, count, farthest);
  if (residual.mean <= wanted) {
    notes.push_back(text);
  } else {
    warnings.push_back(text + "; it goes on moving in the run: look for a slope that cannot stand, or raise residual");
  }
}

}  // namespace mpm
