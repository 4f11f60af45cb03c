#include "mpm/mechanics/particle_loads.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <string>

#include "mpm/grid/for_nodes.hpp"
#include "mpm/mechanics/first_fault.hpp"

namespace mpm {
namespace {

constexpr int kSpreads = 2, kKinds = 2;
constexpr std::array<const char*, kKinds> kKindNames = {"body_force", "particle_force"};
constexpr std::array<const char*, kKinds> kKindTexts = {"body force", "particle force"};

class ParticleLoads final : public ParticleLoadStage {
  /// Particles whose sum is made in one go, so that it does not depend on the number of threads.
  static constexpr int kGroup = 1024;

 public:
  ParticleLoads(LoadTransfers transfers, Fields& fields, std::vector<ParticleSet>& sets,
                const std::vector<ParticleLoadTerm>& terms, int threads, double gravity)
      : transfers_{std::move(transfers.domain), std::move(transfers.center)},
        dim_(static_cast<int>(sets.front().x.size())),
        fields_(fields),
        sets_(sets),
        threads_(threads),
        weight_(gravity),
        given_(sets.size()),
        nodal_(fields.size(), NodalField(dim_, nodes_of_block(dim_))),
        fault_(threads) {
    for (const ParticleLoadTerm& term : terms) {
      terms_.emplace_back(term, threads);
      changes_ = changes_ || terms_.back().changes();
    }
    values_.resize(sets.size());
    for (std::size_t s = 0; s < sets.size(); ++s) {
      for (const Term& term : terms_) {
        if (!term.acts_on(s)) continue;
        values_[s][term.spread()].assign(dim_, PaddedArray<double>(sets[s].size(), 0.0));
        there_[term.kind()] = true;
      }
    }
    for (int kind = 0; kind < kKinds; ++kind) accounts_[kind].name = kKindNames[kind];
    int groups = 1;
    for (const ParticleSet& set : sets) groups = std::max(groups, (set.size() + kGroup - 1) / kGroup);
    sums_.resize(groups);
  }

  std::string name() const override { return "particle_loads"; }
  Ranks ranks(Hook) const override { return {Rank::load}; }

  void forces_gathered(StepContext& context) override {
    const ByKind impulse = evaluate(context);
    for (int kind = 0; kind < kKinds; ++kind) accounts_[kind].add(impulse[kind]);
    for (std::size_t f = 0; f < fields_.size(); ++f) add_to(static_cast<int>(f));
  }

  void momentum_updated(StepContext& context) override {
    double power = 0.0;
    // The displacement of a particle in the step: v^{n+1} dt - a dt^2 / 2, GIMP notes (2.16).
    const double back = context.works_at_end ? 0.0 : 0.5 * context.dt;
    for (std::size_t f = 0; f < fields_.size(); ++f) {
      const Grid& grid = *fields_[f];
      const int count = dim_ * grid.layout.nodes_per_block();
      for (int b = 0; b < grid.blocks.size(); ++b) {
        if (!grid.counts(b)) continue;
        const double *load = nodal_[f].block(b), *v = grid.velocity.block(b), *a = grid.force.block(b);
        for (int n = 0; n < count; ++n) power += load[n] * (v[n] - back * a[n]);
      }
    }
    work_ += power * context.dt;
  }

  // Asked of one block after another, by one thread.
  bool stirs(const RestingBlock& block, const RestTimes& times) override {
    if (!changes_) return false;
    double change = 0.0, scale = 0.0;
    block.each(sets_, [&](std::size_t s, int p) {
      const double mass = sets_[s].mass_of(p);
      const Vec3 before = changing_force(s, p, mass, times.before), now = changing_force(s, p, mass, times.now);
      change += (now - before).norm();
      scale += before.norm() + mass * weight_;
    });
    return change > times.part * scale;
  }

  bool has_forces() const override { return true; }
  void find_forces(const StepContext& context) override { evaluate(context); }
  // Those of the step that has ended, in which it was at rest.
  void add_forces(const RestingBlock& block, BlockForces& forces) override {
    for (int spread = 0; spread < kSpreads; ++spread) {
      if (!look_at(spread)) continue;
      transfers_[spread]->spread_of_block(block.field, block.owner, given_, ScalarTransfer::Weight::mass, around_);
      add_around(around_, forces);
    }
  }

  void accounts(std::vector<ImpulseAccount>& list) const override {
    for (int kind = 0; kind < kKinds; ++kind) {
      if (there_[kind]) list.push_back(accounts_[kind]);
    }
  }
  void count(ParticleLoadTerm::Kind kind, const ImpulseAccount& given) override {
    ImpulseAccount& account = accounts_[static_cast<std::size_t>(kind)];
    account.impulse += given.impulse;
    account.exchanged += given.exchanged;
  }
  void count_work(double work) override { work_ += work; }
  void energies(EnergyReport& report) const override { report.add("load_work", NamedEnergy::Kind::work, work_); }
  void serialise(StateArchive& archive) override {
    archive.sum("work", work_);
    for (int kind = 0; kind < kKinds; ++kind) {
      const StateArchive::Group group(archive, kKindNames[kind]);
      accounts_[kind].serialise(archive);
    }
  }

 private:
  struct Term {
    Term(const ParticleLoadTerm& given, int threads) : of(given) {
      for (int thread = 0; thread < threads; ++thread) {
        copies.push_back({of.value[0].own_copy(), of.value[1].own_copy(), of.value[2].own_copy()});
      }
    }
    bool acts_on(std::size_t set) const { return !of.set || *of.set == static_cast<int>(set); }
    bool acts_on(std::size_t set, std::uint32_t particle) const {
      return acts_on(set) && (of.chosen.empty() || of.chosen[particle] != 0);
    }
    bool changes() const {
      const auto by_time = [](const Function& f) { return f.uses_time(); };
      return std::any_of(of.value.begin(), of.value.end(), by_time);
    }
    int spread() const { return static_cast<int>(of.spread); }
    int kind() const { return static_cast<int>(of.kind); }

    ParticleLoadTerm of;
    std::vector<std::array<Function, 3>> copies;  ///< copies by thread: an expression holds one evaluation at a time
  };
  using ByKind = std::array<Vec3, kKinds>;

  static ByKind nothing() { return {Vec3::Zero(), Vec3::Zero()}; }

  // The force on a particle at rest by loads that change with time [N].
  Vec3 changing_force(std::size_t s, int p, double mass, double time) {
    const GridLayout& layout = fields_.front()->layout;
    const ParticleSet& set = sets_[s];
    Vec3 place = Vec3::Zero(), start = Vec3::Zero(), force = Vec3::Zero();
    for (int k = 0; k < dim_; ++k) {
      place[layout.axis(k)] = set.x[k][p];
      if (!set.start_x.empty()) start[layout.axis(k)] = set.start_x[k][p];
    }
    for (Term& term : terms_) {
      if (!term.acts_on(s, set.id[p] - set.first_id)) continue;
      for (int k = 0; k < dim_; ++k) {
        const int axis = layout.axis(k);
        if (!term.of.value[axis].uses_time()) continue;
        try {
          force[axis] += term.copies[0][axis](time, place, start) * (term.of.each ? 1.0 : term.of.factor * mass);
        } catch (const FunctionError& error) {
          throw LoadError(
              fmt::format("{} on '{}', along {}: {}", kKindTexts[term.kind()], set.name, "xyz"[axis], error.what()));
        }
      }
    }
    return force;
  }

  // Acceleration of every particle awake. Returns the impulse that it is.
  ByKind evaluate(const StepContext& context) {
    ByKind impulse = nothing();
    fault_.clear();
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      if (values_[s][0].empty() && values_[s][1].empty()) continue;
      const ParticleSet& set = sets_[s];
      const int groups = (set.awake() + kGroup - 1) / kGroup;
      make_room(s, groups);
      for_parts("particles: loads", threads_, groups, [&](int first, int last, int thread) {
        for (int g = first; g < last; ++g) {
          sums_[g] = nothing();
          const int end = std::min(set.awake(), (g + 1) * kGroup);
          for (int p = g * kGroup; p < end; ++p) at_particle(context, s, p, thread, sums_[g]);
        }
      });
      for (int g = 0; g < groups; ++g) {
        for (int kind = 0; kind < kKinds; ++kind) impulse[kind] += sums_[g][kind] * context.dt;
      }
    }
    fault_.check<LoadError>();
    return impulse;
  }

  // A set's particles may have come from other ranks and gone there.
  void make_room(std::size_t s, int groups) {
    const std::size_t size = sets_[s].id.size();
    for (auto& of_spread : values_[s]) {
      for (PaddedArray<double>& values : of_spread) {
        if (values.size() != size) values.assign(size, 0.0);
      }
    }
    if (static_cast<std::size_t>(groups) > sums_.size()) sums_.resize(groups);
  }

  // The accelerations of one particle; its forces are added to `sum`.
  void at_particle(const StepContext& context, std::size_t s, int p, int thread, ByKind& sum) {
    const GridLayout& layout = context.layout();
    const ParticleSet& set = sets_[s];
    const double half = 0.5 * context.dt;
    Vec3 place = Vec3::Zero(), start = Vec3::Zero();
    for (int k = 0; k < dim_; ++k) {
      place[layout.axis(k)] = set.x[k][p] + half * set.v[k][p];
      if (!set.start_x.empty()) start[layout.axis(k)] = set.start_x[k][p];
    }
    const double mass = set.mass_of(p);
    std::array<Vec3, kSpreads> b = {Vec3::Zero(), Vec3::Zero()};
    for (Term& term : terms_) {
      if (!term.acts_on(s, set.id[p] - set.first_id)) continue;
      for (int k = 0; k < dim_; ++k) {  // no momentum along axes that the grid does not have
        const int axis = layout.axis(k);
        try {
          const double given = term.copies[thread][axis](context.start + half, place, start);
          const double value = given * (term.of.each ? 1.0 / mass : term.of.factor);
          b[term.spread()][axis] += value;
          sum[term.kind()][axis] += value * mass;
        } catch (const FunctionError& error) {
          fault_.note(thread, set.id[p], [&] {
            return fmt::format("{} on '{}', along {}: {}", kKindTexts[term.kind()], set.name, "xyz"[axis],
                               error.what());
          });
        }
      }
    }
    for (int spread = 0; spread < kSpreads; ++spread) {
      auto& values = values_[s][spread];
      for (std::size_t k = 0; k < values.size(); ++k) values[k][p] = b[spread][layout.axis(static_cast<int>(k))];
    }
  }

  // The load on the nodes of a field, and it to their force.
  void add_to(int field) {
    NodalField& nodal = nodal_[field];
    bool first = true;
    for (int spread = 0; spread < kSpreads; ++spread) {
      if (!look_at(spread)) continue;
      transfers_[spread]->spread(field, given_, ScalarTransfer::Weight::mass, first ? nodal : beside_);
      if (!first) add(beside_, nodal, *fields_[field]);
      first = false;
    }
    add(nodal, fields_[field]->force, *fields_[field]);
  }

  // True if any particle has a load of this spread; then `given_` points to these loads.
  bool look_at(int spread) {
    bool any = false;
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      const auto& values = values_[s][spread];
      given_[s] = {};
      for (std::size_t k = 0; k < values.size(); ++k) given_[s][k] = values[k].data();
      any = any || !values.empty();
    }
    return any;
  }

  void add(const NodalField& from, NodalField& to, const Grid& grid) const {
    const int count = dim_ * grid.layout.nodes_per_block();
    for_blocks("grid: loads", grid, threads_, [&](int b) {
      for (int n = 0; n < count; ++n) to.block(b)[n] += from.block(b)[n];
    });
  }

  std::array<std::unique_ptr<ScalarTransfer>, kSpreads> transfers_;  ///< by spread
  int dim_;
  Fields& fields_;
  std::vector<ParticleSet>& sets_;
  int threads_;
  double weight_;         ///< weight of a unit of mass [N/kg]
  bool changes_ = false;  ///< some load depends on time
  std::vector<Term> terms_;
  /// Acceleration of each set's particles by spread and axis [m/s^2].
  std::vector<std::array<std::vector<PaddedArray<double>>, kSpreads>> values_;
  ScalarTransfer::Given given_;
  std::vector<NodalField> nodal_;                               ///< load of each node in this step, for each field [N]
  NodalField beside_ = NodalField(dim_, nodes_of_block(dim_));  ///< loads of the second spread, if there are two [N]
  NodalField around_ = NodalField(dim_, nodes_of_block(dim_));  ///< loads of the particles of one block [N]
  std::vector<ByKind> sums_;
  FirstFault fault_;
  std::array<bool, kKinds> there_{};
  std::array<ImpulseAccount, kKinds> accounts_;
  double work_ = 0.0;
};

}  // namespace

std::unique_ptr<ParticleLoadStage> make_particle_loads(LoadTransfers transfers, Fields& fields,
                                                       std::vector<ParticleSet>& sets,
                                                       const std::vector<ParticleLoadTerm>& terms, int threads,
                                                       double gravity) {
  return std::make_unique<ParticleLoads>(std::move(transfers), fields, sets, terms, threads, gravity);
}

}  // namespace mpm
