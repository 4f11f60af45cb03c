// Particle fields by name: the one list that topics, bags, CSV files and metrics draw from.
#include <fmt/core.h>

#include <cmath>

#include "state.hpp"

namespace mpm {
namespace {

// What a field may look at.
struct Particle {
  const ParticleSet& set;
  const Law& law;
  int set_index;
  const GridLayout& layout;
  GeometryKind geometry;
  int p;

  template <class Values>
  double along(const Values& field, int world_axis) const {
    for (int k = 0; k < layout.dim(); ++k) {
      if (layout.axis(k) == world_axis) return field[k][p];
    }
    return 0.0;
  }
  ParticleTensors tensors() const { return particle_tensors(set, geometry, p); }
  double density() const {
    return std::visit([](const auto& l) { return l.density(); }, law);
  }
  /// [Pa]
  Symmetric3<double> cauchy() const {
    const ParticleTensors t = tensors();
    return scale_shift(t.tau, density() / t.j, 0.0);
  }
};

struct Field {
  const char* name;
  const char* unit;
  double (*value)(const Particle&);
};

double mises(const Symmetric3<double>& s) {
  const double mean = trace(s) / 3.0;
  return std::sqrt(1.5 * squared_norm(scale_shift(s, 1.0, -mean)));
}

double history(const Particle& p, int index) { return index < 0 ? 0.0 : p.set.history[index][p.p]; }

const Field kFields[] = {
    {"x", "m", [](const Particle& p) { return p.along(p.set.x, 0); }},
    {"y", "m", [](const Particle& p) { return p.along(p.set.x, 1); }},
    {"z", "m", [](const Particle& p) { return p.along(p.set.x, 2); }},
    {"vx", "m/s", [](const Particle& p) { return p.along(p.set.v, 0); }},
    {"vy", "m/s", [](const Particle& p) { return p.along(p.set.v, 1); }},
    {"vz", "m/s", [](const Particle& p) { return p.along(p.set.v, 2); }},
    {"speed", "m/s",
     [](const Particle& p) {
       double sum = 0.0;
       for (const auto& component : p.set.v) sum += component[p.p] * component[p.p];
       return std::sqrt(sum);
     }},
    {"sxx", "Pa", [](const Particle& p) { return p.cauchy().xx; }},
    {"syy", "Pa", [](const Particle& p) { return p.cauchy().yy; }},
    {"szz", "Pa", [](const Particle& p) { return p.cauchy().zz; }},
    {"syz", "Pa", [](const Particle& p) { return p.cauchy().yz; }},
    {"sxz", "Pa", [](const Particle& p) { return p.cauchy().xz; }},
    {"sxy", "Pa", [](const Particle& p) { return p.cauchy().xy; }},
    {"p", "Pa", [](const Particle& p) { return -trace(p.cauchy()) / 3.0; }},
    {"mises", "Pa", [](const Particle& p) { return mises(p.cauchy()); }},
    {"j", "1", [](const Particle& p) { return p.tensors().j; }},
    {"density", "kg/m^3", [](const Particle& p) { return p.density() / p.tensors().j; }},
    {"ep", "1",
     [](const Particle& p) {
       return history(p, std::visit([](const auto& law) { return law.kPlasticStrain; }, p.law));
     }},
    // Zero where the law has none.
    {"temperature", "K",
     [](const Particle& p) {
       return std::visit(
           [&](const auto& law) {
             return law.kTemperature < 0 ? 0.0 : law.reference_temperature() + history(p, law.kTemperature);
           },
           p.law);
     }},
    {"body", "1", [](const Particle& p) { return static_cast<double>(p.set_index); }},
};

const Field& find_field(const std::string& name) {
  std::string known;
  for (const Field& field : kFields) {
    if (name == field.name) return field;
    known += known.empty() ? field.name : std::string(", ") + field.name;
  }
  throw DefinitionError(fmt::format("no particle field is called '{}'; there are {}", name, known));
}

template <class T>
void fill(const std::vector<ParticleSet>& sets, const std::vector<Law>& laws, const GridLayout& layout,
          GeometryKind geometry, int threads, const Field& field, std::vector<T>& values) {
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const ParticleSet& set = sets[s];
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int p = 0; p < set.size(); ++p) {
      values[set.id[p]] = static_cast<T>(field.value({set, laws[s], static_cast<int>(s), layout, geometry, p}));
    }
  }
}

}  // namespace

std::vector<std::pair<std::string, std::string>> Simulation::particle_fields() {
  std::vector<std::pair<std::string, std::string>> list;
  for (const Field& field : kFields) list.emplace_back(field.name, field.unit);
  return list;
}

void Simulation::particle_field(const std::string& name, std::vector<float>& values) const {
  const Field& field = find_field(name);
  values.resize(particles());
  fill(state_->sets, state_->laws, state_->layout(), state_->definition.geometry, state_->threads, field, values);
}

void Simulation::particle_field(const std::string& name, std::vector<double>& values) const {
  const Field& field = find_field(name);
  values.resize(particles());
  fill(state_->sets, state_->laws, state_->layout(), state_->definition.geometry, state_->threads, field, values);
}

}  // namespace mpm
