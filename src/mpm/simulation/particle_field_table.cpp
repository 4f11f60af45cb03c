// Particle fields by name: the one list that topics, bags, CSV files, metrics and global quantities draw from. To add
// one: a line here, and its row in doc/watching.md.
#include "particle_field_table.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace mpm {
namespace {

using View = ParticleView;

double mises(const Symmetric3<double>& s) {
  const double mean = trace(s) / 3.0;
  return std::sqrt(1.5 * squared_norm(scale_shift(s, 1.0, -mean)));
}

double mass(const View& a) { return a.set.set.mass_of(a.p); }
double plastic_work(const View& a) { return a.set.history(a.set.plastic_work, a.p); }
double heating(const View& a) { return a.set.history(a.set.temperature, a.p); }
double moved(const View& a, int axis) {
  return a.set.along(a.set.set.x, axis, a.p) - a.set.along(a.set.set.start_x, axis, a.p);
}
double kinetic(const View& a) {
  double sum = 0.0;
  for (const auto& component : a.set.set.v) sum += component[a.p] * component[a.p];
  return 0.5 * mass(a) * sum;
}
double stored(const View& a) {
  ParticleTensors t{a.f, a.tau, a.j};
  if (a.set.set.free_strain >= 0) t = without_free_strain(a.set.set, a.p, t);
  const double whole = std::visit([&](const auto& law) { return law.elastic_energy(t.f, t.tau, t.j); }, a.set.law);
  return mass(a) * (whole - a.set.heat_fraction * plastic_work(a));
}
double thermal(const View& a) {
  if (a.set.temperatures != nullptr) {
    const double now = a.set.temperatures[a.p], start = a.set.reference_temperature;
    return start > 0.0 ? mass(a) * a.set.transported->capacity(now) * (now - start) * (now - start) / (2.0 * start)
                       : 0.0;
  }
  if (a.set.heat_capacity == 0.0 || a.set.temperature < 0) return 0.0;
  return mass(a) * a.set.heat_capacity * heating(a) * heating(a) / (2.0 * a.set.reference_temperature);
}

const ParticleField kFields[] = {
    {"x", "m", kNeedsNothing, [](const View& a) { return a.set.along(a.set.set.x, 0, a.p); }},
    {"y", "m", kNeedsNothing, [](const View& a) { return a.set.along(a.set.set.x, 1, a.p); }},
    {"z", "m", kNeedsNothing, [](const View& a) { return a.set.along(a.set.set.x, 2, a.p); }},
    {"vx", "m/s", kNeedsNothing, [](const View& a) { return a.set.along(a.set.set.v, 0, a.p); }},
    {"vy", "m/s", kNeedsNothing, [](const View& a) { return a.set.along(a.set.set.v, 1, a.p); }},
    {"vz", "m/s", kNeedsNothing, [](const View& a) { return a.set.along(a.set.set.v, 2, a.p); }},
    {"speed", "m/s", kNeedsNothing, [](const View& a) { return std::sqrt(2.0 * kinetic(a) / mass(a)); }},
    {"sxx", "Pa", kNeedsStress, [](const View& a) { return a.cauchy.xx; }},
    {"syy", "Pa", kNeedsStress, [](const View& a) { return a.cauchy.yy; }},
    {"szz", "Pa", kNeedsStress, [](const View& a) { return a.cauchy.zz; }},
    {"syz", "Pa", kNeedsStress, [](const View& a) { return a.cauchy.yz; }},
    {"sxz", "Pa", kNeedsStress, [](const View& a) { return a.cauchy.xz; }},
    {"sxy", "Pa", kNeedsStress, [](const View& a) { return a.cauchy.xy; }},
    {"p", "Pa", kNeedsStress, [](const View& a) { return -trace(a.cauchy) / 3.0; }},
    {"mises", "Pa", kNeedsStress, [](const View& a) { return mises(a.cauchy); }},
    {"exx", "1", kNeedsStrain, [](const View& a) { return a.total.xx; }},
    {"eyy", "1", kNeedsStrain, [](const View& a) { return a.total.yy; }},
    {"ezz", "1", kNeedsStrain, [](const View& a) { return a.total.zz; }},
    {"eyz", "1", kNeedsStrain, [](const View& a) { return a.total.yz; }},
    {"exz", "1", kNeedsStrain, [](const View& a) { return a.total.xz; }},
    {"exy", "1", kNeedsStrain, [](const View& a) { return a.total.xy; }},
    {"exxe", "1", kNeedsElastic, [](const View& a) { return a.elastic.xx; }},
    {"eyye", "1", kNeedsElastic, [](const View& a) { return a.elastic.yy; }},
    {"ezze", "1", kNeedsElastic, [](const View& a) { return a.elastic.zz; }},
    {"eyze", "1", kNeedsElastic, [](const View& a) { return a.elastic.yz; }},
    {"exze", "1", kNeedsElastic, [](const View& a) { return a.elastic.xz; }},
    {"exye", "1", kNeedsElastic, [](const View& a) { return a.elastic.xy; }},
    {"exxp", "1", kNeedsElastic, [](const View& a) { return a.total.xx - a.elastic.xx - a.free; }},
    {"eyyp", "1", kNeedsElastic, [](const View& a) { return a.total.yy - a.elastic.yy - a.free; }},
    {"ezzp", "1", kNeedsElastic, [](const View& a) { return a.total.zz - a.elastic.zz - a.free; }},
    {"eyzp", "1", kNeedsElastic, [](const View& a) { return a.total.yz - a.elastic.yz; }},
    {"exzp", "1", kNeedsElastic, [](const View& a) { return a.total.xz - a.elastic.xz; }},
    {"exyp", "1", kNeedsElastic, [](const View& a) { return a.total.xy - a.elastic.xy; }},
    {"ep", "1", kNeedsHistory, [](const View& a) { return a.set.history(a.set.plastic_strain, a.p); }},
    {"rx", "rad", kNeedsRotation, [](const View& a) { return a.rotation.x(); }},
    {"ry", "rad", kNeedsRotation, [](const View& a) { return a.rotation.y(); }},
    {"rz", "rad", kNeedsRotation, [](const View& a) { return a.rotation.z(); }},
    {"rotation", "rad", kNeedsRotation, [](const View& a) { return a.rotation.norm(); }},
    {"ux", "m", kNeedsNothing, [](const View& a) { return moved(a, 0); }, true},
    {"uy", "m", kNeedsNothing, [](const View& a) { return moved(a, 1); }, true},
    {"uz", "m", kNeedsNothing, [](const View& a) { return moved(a, 2); }, true},
    {"displacement", "m", kNeedsNothing,
     [](const View& a) { return Vec3(moved(a, 0), moved(a, 1), moved(a, 2)).norm(); }, true},
    {"x0", "m", kNeedsNothing, [](const View& a) { return a.set.along(a.set.set.start_x, 0, a.p); }, true},
    {"y0", "m", kNeedsNothing, [](const View& a) { return a.set.along(a.set.set.start_x, 1, a.p); }, true},
    {"z0", "m", kNeedsNothing, [](const View& a) { return a.set.along(a.set.set.start_x, 2, a.p); }, true},
    {"j", "1", kNeedsVolume, [](const View& a) { return a.j; }},
    {"density", "kg/m^3", kNeedsVolume, [](const View& a) { return a.set.density / a.j; }},
    {"volume", "m^3", kNeedsVolume, [](const View& a) { return mass(a) * a.j / a.set.density; }},
    {"mass", "kg", kNeedsNothing, mass},
    {"kinetic_energy", "J", kNeedsNothing, kinetic},
    {"strain_energy", "J", kNeedsVolume | kNeedsHistory, stored},
    {"plastic_energy", "J", kNeedsHistory, [](const View& a) { return mass(a) * plastic_work(a); }},
    {"heat_energy", "J", kNeedsHistory, [](const View& a) { return mass(a) * a.set.part_as_heat * plastic_work(a); }},
    {"thermal_energy", "J", kNeedsHistory, thermal},
    // Zero where the law has none.
    {"temperature", "K", kNeedsHistory,
     [](const View& a) { return a.set.temperature < 0 ? 0.0 : a.set.reference_temperature + heating(a); }},
    // Brought by transport, where the scene has it.
    {"concentration", "1", kNeedsNothing, [](const View&) { return 0.0; }},
    {"pore_pressure", "Pa", kNeedsNothing, [](const View&) { return 0.0; }},
    {"h0", "1", kNeedsHistory, [](const View& a) { return a.set.history(0, a.p); }},
    {"h1", "1", kNeedsHistory, [](const View& a) { return a.set.history(1, a.p); }},
    {"h2", "1", kNeedsHistory, [](const View& a) { return a.set.history(2, a.p); }},
    {"h3", "1", kNeedsHistory, [](const View& a) { return a.set.history(3, a.p); }},
    {"body", "1", kNeedsNothing, [](const View& a) { return static_cast<double>(a.set.index); }},
};

/// Rest that float32 leaves of a place: together they have it in double precision. For programs; their names cannot be
/// written in a scene.
double float_rest(double place) { return place - static_cast<double>(static_cast<float>(place)); }

const ParticleField kRests[] = {
    {"x rest", "m", kNeedsNothing, [](const View& a) { return float_rest(a.set.along(a.set.set.x, 0, a.p)); }},
    {"y rest", "m", kNeedsNothing, [](const View& a) { return float_rest(a.set.along(a.set.set.x, 1, a.p)); }},
    {"z rest", "m", kNeedsNothing, [](const View& a) { return float_rest(a.set.along(a.set.set.x, 2, a.p)); }},
    {"x0 rest", "m", kNeedsNothing, [](const View& a) { return float_rest(a.set.along(a.set.set.start_x, 0, a.p)); },
     true},
    {"y0 rest", "m", kNeedsNothing, [](const View& a) { return float_rest(a.set.along(a.set.set.start_x, 1, a.p)); },
     true},
    {"z0 rest", "m", kNeedsNothing, [](const View& a) { return float_rest(a.set.along(a.set.set.start_x, 2, a.p)); },
     true},
};

}  // namespace

const ParticleField* find_particle_field(const std::string& name) {
  const auto is_it = [&](const ParticleField& f) { return name == f.name; };
  const auto* const found = std::find_if(std::begin(kFields), std::end(kFields), is_it);
  if (found != std::end(kFields)) return found;
  const auto* const rest = std::find_if(std::begin(kRests), std::end(kRests), is_it);
  return rest == std::end(kRests) ? nullptr : rest;
}

std::vector<std::pair<std::string, std::string>> names_of_particle_fields() {
  std::vector<std::pair<std::string, std::string>> names;
  for (const ParticleField& field : kFields) names.emplace_back(field.name, field.unit);
  return names;
}

}  // namespace mpm
