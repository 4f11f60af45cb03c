// Ground that follows bodies (bed/following_bed.hpp), at the start of a run and at its sync points. What changes the
// number of particles is here alone: in between steps see sets that stay as they are.
#include <utility>

#include "mpm/start/initial.hpp"
#include "mpm/start/particle_start.hpp"
#include "state.hpp"

namespace mpm {
namespace {

double energy_of(const MaterialTotals& totals) {
  return totals.kinetic + totals.elastic + totals.plastic + totals.potential;
}

}  // namespace

ParticleSet Simulation::State::make_ground(GroundParticles ground) {
  SimulationDefinition part = definition;
  DeformableBody& body = part.bodies.front();
  body.positions = std::move(ground.positions);
  body.parts = std::move(ground.parts);
  body.surfaces = std::move(ground.surfaces);
  std::vector<std::string> unused;  // warnings, which the start has given
  add_geostatic_stress(part, nullptr, unused);
  StopCheck never(nullptr, "ground was made");
  return make_set(part, body, find_material(part, body), laws.front(), layout(), 0, nullptr, unused, never);
}

void Simulation::State::begin_bed() {
  FollowingBed& bed = *services.bed;
  if (const auto fault = bed.fault()) throw DefinitionError("terrain: " + *fault);
  bed.lay_asleep();
  sort(0.0);
}

void Simulation::State::follow_bed() {
  if (const auto fault = services.bed->fault()) throw ModuleError(*fault);
  bring_ground();
}

void Simulation::State::bring_ground() {
  FollowingBed& bed = *services.bed;
  if (!bed.look()) return;
  const double now = seconds_of(time);
  sort(now);  // lets those fall asleep and wake that wait for it
  if (!bed.look()) return;
  if (bed.stop_far()) {
    sort(now);
    bed.look();
  }
  const double before = energy_of(find_totals().material);
  bed.put_away();
  GroundParticles ground;
  bed.fill(ground);
  if (!ground.positions.empty()) {
    ParticleSet made = make_ground(std::move(ground));
    bed.add(made);
  }
  sort(now);
  bed.lay_asleep();
  sort(now);
  sizes.front() = sets.front().id.size();
  total_mass = sets.front().total_mass();
  bed.count_energy(energy_of(find_totals().material) - before);
}

}  // namespace mpm
