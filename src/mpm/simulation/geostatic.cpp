// Soil at rest: settling under the stress of its weight (geostatic_stress.cpp), before the run begins. Over several
// ranks they settle it together; particles that have gone to another rank come back with what they have settled to.
//
// The settling is done by the solver itself, in a run of its own with the geostatic bodies alone, every tool held where
// it stands and every load as at t = 0, and with kinetic damping: all velocities are set to zero whenever the kinetic
// energy has passed a peak. That needs no constant, calms elastic waves within a few swings, and lets a slope that is
// too steep slide down as fast as it would. The soil has settled when, from rest, the sum over nodes of |m a| is less
// than a stated part of the weight. What rests on friction may never show that: in the first step from rest friction
// has not caught hold, and afterwards the soil creeps, at a speed so low and so even that its energy has no peak. So it
// has settled, too, when it has gained next to no momentum in many steps: then no force was out of balance. Where it is
// needed the particles move; they keep the places, deformation and history in which they have come to rest. Source:
// Cundall (1976), Explicit finite-difference methods in geomechanics, 2nd Int. Conf. Num. Meth. Geomech.; Barnes
// (1999), Int. J. Space Structures 14, 89-104 (kinetic damping).
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "mpm/modules/run_parts.hpp"
#include "mpm/ranks/lists.hpp"
#include "mpm/ranks/of_all.hpp"
#include "mpm/start/initial.hpp"
#include "mpm/start/particle_start.hpp"
#include "state.hpp"

namespace mpm {
namespace {

constexpr std::uint64_t kMostSettlingSteps = 10'000;  ///< steps of settling
constexpr int kCreepingSteps = 100;                   ///< without a peak of the kinetic energy
constexpr double kOfCreep = 0.1;            ///< part of the residual that is asked for, as mean acceleration over g
constexpr double kNoChange = 1e30;          ///< storage at which a pressure stays as it is [1/Pa]
constexpr std::uint64_t kSurveyEvery = 10;  ///< steps between looks at the wave speed
constexpr int kRows = 4096;                 ///< particles taken over at once

/// Imbalance after a step from rest.
struct Unbalanced {
  double mean = std::numeric_limits<double>::infinity();  ///< sum over nodes of |m a| over the weight
  double most = std::numeric_limits<double>::infinity();  ///< largest |a| / g of nodes that carry half a particle
};

void add_unbalanced(const Grid& grid, double weight, double g, double half_particle, Unbalanced& found) {
  for (int b = 0; b < grid.blocks.size(); ++b) {
    if (!grid.counts(b)) continue;
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
  // Material that settles comes to rest sooner if each particle has its own strength.
  part.method.average_stress = false;
  // Waves settle it, which implicit steps do not have.
  if (part.method.update == UpdateScheme::implicit) {
    part.method.update = UpdateScheme::usavg;
    part.method.sweeps.reset();
    part.time.step.reset();
    part.time.budget.reset();
  }
  part.bodies.clear();
  part.metrics.clear();
  part.sleep.reset();
  part.cracks = {};                      // removes cracks: what settles is whole
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
  part.robots.clear();  // their links stand where the robots put them
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

/// Notes on every particle which rank has it, before any is handed over.
constexpr const char* kHome = "home";

void note_home(RunParts& parts) {
  for (ParticleSet& set : parts.sets) {
    NamedScalar& home = set.brought[set.bring(kHome, "1")];
    home.values.assign(home.values.size(), parts.ranks->rank());
  }
}

/// Calls visit(array) for each array of numbers that settling changes.
template <class Set, class Visit>
void each_settled(Set& set, Visit&& visit) {
  for (auto& values : set.x) visit(values);
  for (auto* fields : {&set.f, &set.tau, &set.history}) {
    for (auto& scalar : *fields) scalar.visit(visit);
  }
}

/// Particles [begin, end) of `settled` as rows of numbers, id and what has changed, for the ranks that they belong to.
std::vector<std::vector<double>> settled_rows(const ParticleSet& settled, int begin, int end, int ranks) {
  std::vector<std::vector<double>> rows(static_cast<std::size_t>(ranks));
  const auto home = std::find_if(settled.brought.begin(), settled.brought.end(),
                                 [](const NamedScalar& scalar) { return scalar.name == kHome; });
  for (int p = begin; p < end; ++p) {
    const bool here = home == settled.brought.end();
    std::vector<double>& row = rows[here ? 0 : static_cast<std::size_t>(home->values[p])];
    row.push_back(settled.id[p] - settled.first_id);
    each_settled(settled, [&](const auto& values) { row.push_back(static_cast<double>(values[p])); });
  }
  return rows;
}

/// Takes what particles of `set`, in the order of their ids, have settled to. Returns how far one moved at most [m].
double take(const std::vector<double>& rows, ParticleSet& set) {
  double farthest = 0.0;
  for (auto next = rows.begin(); next != rows.end();) {
    const auto id = static_cast<std::uint32_t>(*next++) + set.first_id;
    const auto i = static_cast<std::size_t>(std::lower_bound(set.id.begin(), set.id.end(), id) - set.id.begin());
    double moved = 0.0;
    for (std::size_t k = 0; k < set.x.size(); ++k) moved += std::pow(*(next + k) - set.x[k][i], 2);
    farthest = std::max(farthest, std::sqrt(moved));
    each_settled(set, [&](auto& values) { values[i] = static_cast<std::decay_t<decltype(values[i])>>(*next++); });
  }
  return farthest;
}

}  // namespace

void Simulation::State::settle() {
  SimulationDefinition part = resting_part(definition);
  double wanted = std::numeric_limits<double>::infinity();
  std::string names;
  for (const DeformableBody& body : definition.bodies) {
    if (!body.geostatic) continue;
    wanted = std::min(wanted, body.geostatic->residual);
    names += (names.empty() ? "'" : ", '") + body.name + "'";
  }
  SimulationOptions options;
  options.threads = threads;
  options.isa = isa;
  options.ranks = ranks;
  options.interrupt = interrupt;
  if (ranks) options.modules = {note_home};
  Simulation run(std::move(part), std::move(options));
  State& r = *run.state_;
  const double g = definition.gravity.norm(), lightest = mpm::least_mass(r.sets, ranks.get(), true);
  const double period = seconds_of(definition.time.sync);
  Unbalanced residual;
  double before = 0.0, moves_for = 0.0;
  std::optional<double> creeps;  // its mean acceleration over g
  int steps_of_motion = 0;
  std::uint64_t count = 0;
  try {
    for (bool at_rest = true; residual.mean > wanted && !creeps && count < kMostSettlingSteps; ++count) {
      if (count % kSurveyEvery == 0) r.previous_limit = r.material_limit = r.survey_material();
      const double dt = std::min(r.step_limit(r.previous_limit, r.material_limit).dt, period);
      r.step(0.0, dt, false);
      moves_for += dt;
      if (at_rest) {
        residual = {0.0, 0.0};
        for (const auto& grid : r.fields) add_unbalanced(*grid, r.total_mass * g, g, 0.5 * lightest, residual);
        residual = {sum_of_all(ranks.get(), residual.mean), largest_of_all(ranks.get(), residual.most)};
      }
      const double now = sum_of_all(ranks.get(), kinetic_energy(r.sets, r.threads));
      at_rest = now < before;
      if (at_rest) stop(r.sets);
      before = at_rest ? 0.0 : now;
      steps_of_motion = at_rest ? 0 : steps_of_motion + 1;
      if (at_rest) moves_for = 0.0;
      // The sum over particles of m |v| is at most this times the mass.
      const double gained = std::sqrt(2.0 * now / r.total_mass) / g;
      if (steps_of_motion >= kCreepingSteps && gained < kOfCreep * wanted * moves_for) creeps = gained / moves_for;
      if (settling) settling({count + 1, residual.mean, wanted});
      if (asked_to_stop && any_of_all(ranks.get(), asked_to_stop())) {
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
    if (ranks) {
      for (const auto& rows : exchange(*ranks, settled_rows(*other, 0, other->size(), ranks->size()))) {
        farthest = std::max(farthest, take(rows, set));
      }
    }
    for (int p = 0; p < other->size() && !ranks; p += kRows) {
      const int end = std::min(other->size(), p + kRows);
      farthest = std::max(farthest, take(settled_rows(*other, p, end, 1).front(), set));
    }
    const int work = std::visit([](const auto& law) { return law.kPlasticWork; }, laws[&set - sets.data()]);
    if (work >= 0) set.history[work].assign(set.history[work].size(), 0.0);  // dissipated since the start
  }
  farthest = largest_of_all(ranks.get(), farthest);
  const std::string text = fmt::format(
      "geostatic start of {}: unbalanced force {:.2g} of the weight (asked: {:.2g}), at a node {:.2g} g at most, "
      "after {} steps of settling, moved by at most {:.3g} m",
      names, residual.mean, wanted, residual.most, count, farthest);
  if (creeps) {
    notes.push_back(
        fmt::format("{}; that is of the first step from rest, before friction has caught hold: over the {} "
                    "steps that followed it was {:.2g} of the weight",
                    text, steps_of_motion, *creeps));
  } else if (residual.mean <= wanted) {
    notes.push_back(text);
  } else {
    warnings.push_back(text +
                       "; it goes on moving in the run: look for a slope or a wall that cannot stand, for "
                       "what lets it slide, or raise residual");
  }
}

}  // namespace mpm
