// What a Simulation says of itself: momentum audit, energies, metrics, the hash of its state. Computed when asked for.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "mpm/math/dimension.hpp"
#include "state.hpp"

namespace mpm {
namespace {

template <class Field>
Vec3 particle_vector(const Field& field, const GridLayout& layout, int p) {
  Vec3 v = Vec3::Zero();
  for (int k = 0; k < layout.dim(); ++k) v[layout.axis(k)] = field[k][p];
  return v;
}

double elastic_energy(const ParticleSet& set, const Law& law, int dim, int p) {
  const ParticleTensors t = particle_tensors(set, dim, p);
  return set.mass * std::visit([&](const auto& l) { return l.elastic_energy(t.f, t.tau, t.j); }, law);
}

double plastic_work(const ParticleSet& set, const Law& law, int p) {
  const int index = std::visit([](const auto& l) { return l.kPlasticWork; }, law);
  return index < 0 ? 0.0 : set.mass * set.history[index][p];
}

// FNV-1a, 64 bits.
class Hash {
 public:
  template <class T>
  void add(const T& value) {
    unsigned char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    for (const unsigned char byte : bytes) {
      value_ ^= byte;
      value_ *= 1099511628211ull;
    }
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 14695981039346656037ull;
};

}  // namespace

ParticleTensors particle_tensors(const ParticleSet& set, int dim, int p) {
  ParticleTensors t{};
  if (dim == 3) {
    t.f = Solid::load_matrix(set.f, p);
    t.tau = Solid::load_symmetric(set.tau, p);
  } else {
    const auto f = PlaneStrain::load_matrix(set.f, p);
    const auto tau = PlaneStrain::load_symmetric(set.tau, p);
    t.f = {f.xx, 0.0, f.xz, 0.0, f.yy, 0.0, f.zx, 0.0, f.zz};
    t.tau = {tau.xx, tau.yy, tau.zz, 0.0, tau.xz, 0.0};
  }
  t.j = determinant(t.f);
  return t;
}

Vec3 Simulation::State::momentum() const {
  return sum_particles(sets, threads, Vec3(Vec3::Zero()), [&](const ParticleSet& set, int p) {
    return Vec3(set.mass * particle_vector(set.v, grid->layout, p));
  });
}

SolverState Simulation::state() const {
  const State& s = *state_;
  const GridLayout& layout = s.grid->layout;
  SolverState report;
  report.time = s.time;
  report.step = s.steps;
  report.step.limited_by = s.limit.text();
  report.particles = particles();
  report.wall_seconds = s.wall.count();

  const int dim = layout.dim();
  auto sum = [&](auto&& term) { return sum_particles(s.sets, s.threads, 0.0, term); };
  auto law = [&](const ParticleSet& set) -> const Law& { return s.laws[&set - s.sets.data()]; };
  report.energy.kinetic = sum(
      [&](const ParticleSet& set, int p) { return 0.5 * set.mass * particle_vector(set.v, layout, p).squaredNorm(); });
  report.energy.potential = sum([&](const ParticleSet& set, int p) {
    return -set.mass * s.definition.gravity.dot(particle_vector(set.x, layout, p));
  });
  report.energy.elastic = sum([&](const ParticleSet& set, int p) { return elastic_energy(set, law(set), dim, p); });
  report.energy.plastic = sum([&](const ParticleSet& set, int p) { return plastic_work(set, law(set), p); });
  for (const RigidContact* contact : s.contacts) report.energy.contact_work += contact->work();
  if (s.body_force != nullptr) report.energy.load_work = s.body_force->work();

  AuditReport& audit = report.audit;
  audit.momentum = s.momentum();
  audit.initial_momentum = s.initial_momentum;
  std::vector<ImpulseAccount> accounts{s.gravity};
  for (const auto& stage : s.stages) stage->accounts(accounts);
  Vec3 given = Vec3::Zero();
  for (const ImpulseAccount& account : accounts) {
    audit.impulses.push_back({account.name, account.impulse});
    audit.exchanged += account.exchanged;
    given += account.impulse;
  }
  const double carried =
      sum([&](const ParticleSet& set, int p) { return set.mass * particle_vector(set.v, layout, p).norm(); });
  const double scale = std::max(audit.exchanged, carried);
  const double error = (audit.momentum - audit.initial_momentum - given).norm();
  audit.residual = scale > 0.0 ? error / scale : error;

  report.min_j = std::numeric_limits<double>::infinity();
  for (const ParticleSet& set : s.sets) {
    double least = report.min_j;
#pragma omp parallel for schedule(static) num_threads(s.threads) reduction(min : least)
    for (int p = 0; p < set.size(); ++p) least = std::min(least, particle_tensors(set, dim, p).j);
    report.min_j = least;
  }
  return report;
}

std::vector<std::pair<std::string, double>> Simulation::metrics() const {
  std::vector<std::pair<std::string, double>> list;
  std::vector<double> values;
  for (const MetricDefinition& metric : state_->definition.metrics) {
    particle_field(metric.field, values);
    const auto [first, last] =
        metric.body.empty() ? std::pair<std::uint64_t, std::uint64_t>{0, values.size()} : body_ids(metric.body);
    const auto begin = values.begin() + first, end = values.begin() + last;
    double mean = 0.0;
    for (auto it = begin; it != end; ++it) mean += *it;
    mean /= static_cast<double>(last - first);
    double result = mean;
    if (metric.statistic == Statistic::min) result = *std::min_element(begin, end);
    if (metric.statistic == Statistic::max) result = *std::max_element(begin, end);
    if (metric.statistic == Statistic::std_dev) {
      double squares = 0.0;
      for (auto it = begin; it != end; ++it) squares += (*it - mean) * (*it - mean);
      result = std::sqrt(squares / static_cast<double>(last - first));
    }
    list.emplace_back(metric.name, result);
  }
  return list;
}

std::uint64_t Simulation::state_hash() const {
  const State& s = *state_;
  Hash hash;
  hash.add(s.time);
  for (const ParticleSet& set : s.sets) {
    std::vector<int> place(set.size());
    for (int p = 0; p < set.size(); ++p) place[set.id[p] - set.first_id] = p;
    const auto add = [&](const auto& values) {
      for (const int p : place) hash.add(values[p]);
    };
    for (const PaddedArray<double>& scalar : set.x) add(scalar);
    for (const auto* fields : {&set.v, &set.f, &set.tau, &set.history}) {
      for (const ParticleScalar& scalar : *fields) scalar.visit(add);
    }
  }
  for (const RigidBody& body : s.bodies) {
    for (int k = 0; k < 3; ++k) hash.add(body.pose().position[k]);
    for (int k = 0; k < 4; ++k) hash.add(body.pose().orientation.coeffs()[k]);
  }
  return hash.value();
}

}  // namespace mpm
