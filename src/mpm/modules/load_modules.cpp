// The loads of a definition as modules: body forces, forces on particles, tractions. Names of bodies become sets, and
// particles are chosen while they lie in the order of the definition. Sets that functions with X, Y or Z act on begin
// to remember where their particles start.
#include <fmt/core.h>

#include <algorithm>

#include "mpm/definition/definition.hpp"
#include "mpm/mechanics/face_tractions.hpp"
#include "mpm/mechanics/particle_loads.hpp"
#include "mpm/modules/shipped_modules.hpp"
#include "mpm/ranks/of_all.hpp"

namespace mpm {
namespace {

int find_set(const std::vector<ParticleSet>& sets, const std::string& body, const char* load) {
  const auto set = std::find_if(sets.begin(), sets.end(), [&](const auto& s) { return s.name == body; });
  if (set != sets.end()) return static_cast<int>(set - sets.begin());
  throw DefinitionError(fmt::format("{}: no deformable body is called '{}'; name one of 'bodies'", load, body));
}

/// Those that loads may act on.
struct Bodies {
  const SimulationDefinition& definition;
  const std::vector<ParticleSet>& sets;
  Communicator* ranks;
};
Bodies bodies_of(const RunParts& parts) { return {parts.definition, parts.sets, parts.ranks}; }

/// Particles of a set on all ranks.
std::uint64_t whole_of(int set, const Bodies& bodies) {
  const std::optional<BodyPart>& part = bodies.definition.bodies[set].part;
  return part ? part->whole : bodies.sets[set].id.size();
}

void check_particles(const std::vector<std::uint32_t>& particles, int set, const Bodies& bodies, const char* load) {
  const std::uint64_t whole = whole_of(set, bodies);
  for (const std::uint32_t p : particles) {
    if (p < whole) continue;
    throw DefinitionError(
        fmt::format("{} on '{}': it has no particle {}, but {}", load, bodies.sets[set].name, p, whole));
  }
}

ParticleLoadTerm make_term(const ParticleForceDefinition& load, const Bodies& bodies) {
  const std::vector<ParticleSet>& sets = bodies.sets;
  ParticleLoadTerm term;
  term.kind = ParticleLoadTerm::Kind::particle_force;
  term.set = find_set(sets, load.body, "particle force");
  term.value = load.force;
  term.spread = load.spread;
  const ParticleSet& set = sets[*term.set];
  check_particles(load.particles, *term.set, bodies, "particle force");
  if (!load.particles.empty()) {
    term.chosen.assign(whole_of(*term.set, bodies), 0);
    for (const std::uint32_t p : load.particles) term.chosen[p] = 1;
  }
  if (!load.shared) {
    term.each = true;
    return term;
  }
  double mass = 0.0, count = 0.0;
  for (int p = 0; p < set.size(); ++p) {
    if (!term.chosen.empty() && term.chosen[set.id[p] - set.first_id] == 0) continue;
    count += 1.0;
    mass += set.mass_of(p);
  }
  count = sum_of_all(bodies.ranks, count);
  mass = sum_of_all(bodies.ranks, mass);
  if (set.masses.empty()) mass = set.mass * count;
  term.factor = 1.0 / mass;
  return term;
}

void remember_start(const std::array<Function, 3>& value, ParticleSet& set) {
  const auto uses_start = [](const Function& component) { return component.uses_start(); };
  if (std::any_of(value.begin(), value.end(), uses_start)) set.start_x = set.x;
}

TractionTerm make_term(const TractionDefinition& load, RunParts& parts) {
  TractionTerm term;
  ChosenFaces faces = choose_faces(load.body, load.face, load.particles, "traction", parts);
  term.set = faces.set;
  term.face = faces.face;
  term.particles = std::move(faces.particles);
  term.follows = load.follows;
  term.value = load.value;
  remember_start(term.value, parts.sets[term.set]);
  return term;
}

}  // namespace

namespace {

/// True if all of these particles of a set reach to r = 0.
bool all_on_axis(const std::vector<std::uint32_t>& particles, const ParticleSet& set, const RunParts& parts) {
  const double touching = set.half[0] * parts.layout().cell(0) * (1.0 + 1e-9);
  std::vector<int> places;
  find_places(set, places);
  const bool beside = std::any_of(particles.begin(), particles.end(), [&](std::uint32_t p) {
    return p < places.size() && places[p] >= 0 && set.x[0][places[p]] > touching;
  });
  return !any_of_all(parts.ranks, beside);
}

}  // namespace

ChosenFaces choose_faces(const std::string& body, int face, const std::vector<std::uint32_t>& particles,
                         const char* what, const RunParts& parts) {
  const SimulationDefinition& definition = parts.definition;
  ChosenFaces chosen;
  chosen.set = find_set(parts.sets, body, what);
  const ParticleSet& set = parts.sets[chosen.set];
  const std::vector<int> axes = axes_of(definition.geometry);
  const auto axis = std::find(axes.begin(), axes.end(), face / 2);
  if (axis == axes.end()) {
    throw DefinitionError(fmt::format("{} on '{}': its particles have no face {} in this geometry, {}", what, body,
                                      kWallNames.at(face), geometry_name(definition.geometry)));
  }
  chosen.face = {static_cast<int>(axis - axes.begin()), face % 2 == 1};
  chosen.particles = particles.empty() ? outermost_particles(set, parts.layout(), chosen.face, parts.ranks) : particles;
  check_particles(chosen.particles, chosen.set, bodies_of(parts), what);
  if (axisymmetric(definition.geometry) && chosen.face.axis == 0 && !chosen.face.upper &&
      all_on_axis(chosen.particles, set, parts)) {
    throw DefinitionError(
        fmt::format("{} on '{}': its x_min lies on the axis r = 0 and has no area; use another face", what, body));
  }
  return chosen;
}

std::vector<ParticleLoadTerm> particle_load_terms(const SimulationDefinition& definition,
                                                  const std::vector<ParticleSet>& sets, Communicator* ranks) {
  std::vector<ParticleLoadTerm> terms;
  for (const BodyForceDefinition& load : definition.body_forces) {
    ParticleLoadTerm term;
    term.value = load.acceleration;
    term.spread = load.spread;
    if (!load.body.empty()) term.set = find_set(sets, load.body, "body force");
    terms.push_back(std::move(term));
  }
  for (const ParticleForceDefinition& load : definition.particle_forces) {
    terms.push_back(make_term(load, {definition, sets, ranks}));
  }
  return terms;
}

void add_particle_loads(RunParts& parts) {
  const SimulationDefinition& definition = parts.definition;
  std::vector<ParticleSet>& sets = parts.sets;
  const std::vector<ParticleLoadTerm> terms = particle_load_terms(definition, sets, parts.ranks);
  for (const ParticleLoadTerm& term : terms) {
    for (std::size_t s = 0; s < sets.size(); ++s) {
      if (!term.set || *term.set == static_cast<int>(s)) remember_start(term.value, sets[s]);
    }
  }
  if (terms.empty()) return;
  LoadTransfers transfers{parts.make_transfer(definition.method.shape), parts.make_transfer(ShapeKind::dirac)};
  const double gravity = definition.gravity.norm();
  parts.rest_partners.push_back(
      &parts.modules.add(make_particle_loads(std::move(transfers), parts.fields, sets, terms, parts.threads, gravity)));
}

void add_tractions(RunParts& parts) {
  const SimulationDefinition& definition = parts.definition;
  std::vector<TractionTerm> terms;
  for (const TractionDefinition& load : definition.tractions) {
    terms.push_back(make_term(load, parts));
  }
  if (terms.empty()) return;
  const FaceSettings settings{definition.geometry, definition.method.shape, definition.across(), parts.choice,
                              parts.halo};
  parts.rest_partners.push_back(&parts.modules.add(std::make_unique<FaceTractions>(
      settings, parts.fields, parts.sets, std::move(terms), definition.gravity.norm())));
}

}  // namespace mpm
