// Account that a Simulation gives of itself: momentum audit, energies, the hash of its state. Computed when asked for.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "mpm/math/byte_hash.hpp"
#include "mpm/math/dimension.hpp"
#include "mpm/ranks/of_all.hpp"
#include "mpm/rules/method_rules.hpp"
#include "state.hpp"

namespace mpm {
namespace {

template <class Field>
Vec3 particle_vector(const Field& field, const GridLayout& layout, int p) {
  Vec3 v = Vec3::Zero();
  for (int k = 0; k < layout.dim(); ++k) v[layout.axis(k)] = field[k][p];
  return v;
}

// In one pass, since most of the time goes into fetching the particles; grouped so that the result does not depend on
// the number of threads. `of_groups`: their sums, of which those asleep are kept from the last time. `begin`: the first
// particle that counts; 0, or the first one asleep.
template <class LawType>
MaterialTotals totals_of(const ParticleSet& set, const LawType& law, const GridLayout& layout, GeometryKind geometry,
                         const Vec3& gravity, int threads, int begin, RunTotals::OfGroups& of_groups) {
  constexpr int kGroup = ParticleSet::kRestGroup;
  const int groups = (set.size() + kGroup - 1) / kGroup, dim = layout.dim();
  of_groups.sums.resize(groups);
  of_groups.changes.resize(groups);
  of_groups.found_asleep.resize(groups);
  for_groups("particles: account", threads, set.size(), kGroup, [&](int first, int end, int g) {
    const bool asleep = first >= set.awake() && !set.rest_changes.empty();
    const std::uint32_t changes = asleep ? set.rest_changes[g] : 0;
    if (asleep && of_groups.found_asleep[g] != 0 && of_groups.changes[g] == changes) return;
    of_groups.found_asleep[g] = asleep;
    of_groups.changes[g] = changes;
    MaterialTotals& sum = of_groups.sums[g] = {};
    for (int p = std::max(first, begin); p < end; ++p) {
      const ParticleTensors t = particle_tensors(set, geometry, p);
      const double mass = set.masses.empty() ? 1.0 : set.mass_of(p);  // equal masses are multiplied in the end
      double speed2 = 0.0, height = 0.0;
      for (int k = 0; k < dim; ++k) {
        const double v = set.v[k][p];
        speed2 += v * v;
        height += gravity[layout.axis(k)] * set.x[k][p];
      }
      sum.kinetic += mass * (0.5 * speed2);
      sum.potential -= mass * height;
      const ParticleTensors stressed = set.free_strain < 0 ? t : without_free_strain(set, p, t);
      // The law counts energy by the volume that it sees, which what expands has more of.
      sum.elastic += mass * (t.j / stressed.j) * law.elastic_energy(stressed.f, stressed.tau, stressed.j);
      if constexpr (LawType::kPlasticWork >= 0) {
        const double work = mass * set.history[LawType::kPlasticWork][p];
        sum.elastic -= law.heat_fraction() * work;
        sum.plastic += work;
      }
      sum.carried += mass * std::sqrt(speed2);
      sum.min_j = std::min(sum.min_j, t.j);
    }
  });
  MaterialTotals total;
  for (const MaterialTotals& part : of_groups.sums) total += part;
  for (double* by_mass : {&total.kinetic, &total.potential, &total.elastic, &total.plastic, &total.carried}) {
    if (set.masses.empty()) *by_mass *= set.mass;
  }
  return total;
}

}  // namespace

ParticleTensors particle_tensors(const ParticleSet& set, GeometryKind geometry, int p) {
  return with_geometry(geometry, [&](auto kind) {
    ParticleTensors t{full(kind.load_matrix(set.f, p)), full(kind.load_symmetric(set.tau, p)), 0.0};
    t.j = determinant(t.f);
    return t;
  });
}

ParticleTensors without_free_strain(const ParticleSet& set, int p, ParticleTensors t) {
  const double shrink = 1.0 / (1.0 + set.brought[set.free_strain + 1].values[p]), volume = shrink * shrink * shrink;
  for (double* c : {&t.f.xx, &t.f.xy, &t.f.xz, &t.f.yx, &t.f.yy, &t.f.yz, &t.f.zx, &t.f.zy, &t.f.zz}) *c *= shrink;
  t.tau = scale_shift(t.tau, volume, 0.0);
  t.j *= volume;
  return t;
}

std::vector<int> places_by_id(const ParticleSet& set, bool whole) {
  std::vector<int> places(set.size());
  if (whole) {
    for (int p = 0; p < set.size(); ++p) places[set.id[p] - set.first_id] = p;
  } else {
    std::iota(places.begin(), places.end(), 0);
    std::sort(places.begin(), places.end(), [&](int a, int b) { return set.id[a] < set.id[b]; });
  }
  return places;
}

Vec3 Simulation::State::momentum() {
  if (device) {
    Vec3 total = Vec3::Zero();
    for (std::size_t s = 0; s < sets.size(); ++s) {
      total += ask_device([&] { return device->sums(static_cast<int>(s)); }).momentum;
    }
    return total;
  }
  Vec3 total = sum_particles(
      "particles: momentum", sets, threads, Vec3(Vec3::Zero()),
      [&](const ParticleSet& set, int p) { return Vec3(set.mass_of(p) * particle_vector(set.v, layout(), p)); });
  if (over) over->add_up(total);
  return total;
}

std::vector<NamedNumber> Simulation::State::numbers() const {
  std::vector<NamedNumber> list = modules.numbers();
  if (over) over->add_up(list);
  return list;
}

std::pair<std::size_t, std::size_t> Simulation::State::rows_of(std::uint64_t first, std::uint64_t last) const {
  if (renews_particles()) return {0, sets.front().id.size()};
  if (!over) return {first, last};
  std::size_t begin = 0, end = 0;
  for (const ParticleSet& set : sets) {
    const auto size = static_cast<std::size_t>(set.size());
    if (set.first_id < first) begin += size;
    if (set.first_id < last) end += size;
  }
  return {begin, end};
}

double Simulation::State::from_first(double value) const {
  return sum_of_all(ranks.get(), is_first(ranks.get()) ? value : 0.0);
}

Vec3 Simulation::State::impulse(const std::string& account) const {
  std::vector<ImpulseAccount> accounts;
  modules.accounts(accounts);
  if (over) over->add_up(accounts);
  const auto own = [&](const ImpulseAccount& one) { return one.name == account; };
  const auto found = std::find_if(accounts.begin(), accounts.end(), own);
  return found == accounts.end() ? Vec3(Vec3::Zero()) : found->impulse;
}

MaterialTotals& MaterialTotals::operator+=(const MaterialTotals& other) {
  kinetic += other.kinetic;
  potential += other.potential;
  elastic += other.elastic;
  plastic += other.plastic;
  carried += other.carried;
  min_j = std::min(min_j, other.min_j);
  return *this;
}

MaterialTotals Simulation::State::totals_of_device(int set) {
  const Device::Sums sums = ask_device([&] { return device->sums(set); });
  totals.momentum += sums.momentum;
  return {sums.kinetic, -definition.gravity.dot(sums.place), sums.elastic, sums.plastic, sums.carried, sums.min_j};
}

const RunTotals& Simulation::State::find_totals() {
  if (device) tell_modules();
  totals.energy.begin_again();
  totals.momentum.setZero();
  totals.of_set.resize(sets.size());
  MaterialTotals& of_all = totals.material = {};
  for (std::size_t i = 0; i < sets.size(); ++i) {
    if (!closes_energy(traits_of(laws[i]))) totals.energy.leave_open();
    if (device) of_all += totals_of_device(static_cast<int>(i));
    if (device && sets[i].asleep == 0) continue;
    of_all += std::visit(
        [&](const auto& law) {
          return totals_of(sets[i], law, layout(), definition.geometry, definition.gravity, threads,
                           device ? sets[i].awake() : 0, totals.of_set[i]);
        },
        laws[i]);
  }
  totals.energy.add("kinetic", NamedEnergy::Kind::stored, of_all.kinetic);
  totals.energy.add("elastic", NamedEnergy::Kind::stored, of_all.elastic);
  totals.energy.add("plastic", NamedEnergy::Kind::dissipated, of_all.plastic);
  totals.energy.add("potential", NamedEnergy::Kind::stored, of_all.potential);
  mechanics->energies(totals.energy);
  modules.energies(totals.energy);
  if (over) {
    over->add_up(totals.energy);
    over->ranks().sum(&of_all.carried, 1);
    double least = -of_all.min_j;
    over->ranks().largest(&least, 1);
    of_all.min_j = -least;
  }
  return totals;
}

SolverState Simulation::state() const {
  State& s = *state_;
  SolverState report;
  report.time = s.time;
  report.step = s.steps;
  report.step.limited_by = s.limit.text();
  report.particles = particles();
  report.wall_seconds = s.wall.count();

  const RunTotals& totals = s.find_totals();
  report.energy = totals.energy;
  report.min_j = totals.material.min_j;
  report.numbers = s.numbers();

  AuditReport& audit = report.audit;
  audit.momentum = s.device ? totals.momentum : s.momentum();
  audit.initial_momentum = s.initial_momentum;
  std::vector<ImpulseAccount> accounts;
  s.modules.accounts(accounts);
  if (s.over) s.over->add_up(accounts);
  accounts.insert(accounts.begin(), s.gravity);
  Vec3 given = Vec3::Zero();
  for (const ImpulseAccount& account : accounts) {
    audit.impulses.push_back({account.name, account.impulse});
    audit.exchanged += account.exchanged;
    given += account.impulse;
  }
  audit.carried = totals.material.carried;
  const double scale = std::max(audit.exchanged, audit.carried);
  const double error = (audit.momentum - audit.initial_momentum - given).norm();
  audit.residual = scale > 0.0 ? error / scale : error;
  return report;
}

SharingReport Simulation::sharing() const {
  SharingReport report;
  if (!state_->over) return report;
  const HandOver& hand_over = state_->over->hand_over();
  report.handed_over = static_cast<std::uint64_t>(state_->ranks->sum(static_cast<double>(hand_over.handed_over())));
  report.divisions = hand_over.divisions();
  report.imbalance = hand_over.imbalance();
  return report;
}

std::uint64_t Simulation::state_hash() const {
  State& s = *state_;
  s.fetch();
  ByteHash hash;
  hash.add(s.time);
  for (const ParticleSet& set : s.sets) {
    const std::vector<int> place = places_by_id(set, !s.over && !s.renews_particles());
    const auto add = [&](const auto& values) {
      for (const int p : place) hash.add(values[p]);
    };
    for (const PaddedArray<double>& scalar : set.x) add(scalar);
    for (const auto* fields : {&set.v, &set.f, &set.tau, &set.history, &set.affine}) {
      for (const ParticleScalar& scalar : *fields) scalar.visit(add);
    }
    for (const NamedScalar& scalar : set.brought) add(scalar.values);
  }
  std::vector<double> numbers;
  s.mechanics->hashed(numbers);
  for (const Module* module : s.modules.list()) module->hashed(numbers);
  for (const double number : numbers) hash.add(number);
  return s.over ? s.over->hash_of_all(hash.value()) : hash.value();
}

}  // namespace mpm
