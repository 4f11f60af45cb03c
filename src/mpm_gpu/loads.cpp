#include "mpm_gpu/loads.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "mpm_gpu/error.hpp"

namespace mpm_gpu {
namespace {

using mpm::Function;
using mpm::ParticleSet;
using mpm::Vec3;

bool differs(const std::array<Function, 3>& value) {
  return std::any_of(value.begin(), value.end(), [](const Function& f) { return f.uses_place(); });
}

std::string title_of(const mpm::ParticleLoadTerm& term, const std::vector<ParticleSet>& sets) {
  const char* kind = term.kind == mpm::ParticleLoadTerm::Kind::body_force ? "body force" : "particle force";
  return term.set ? fmt::format("{} on '{}'", kind, sets[static_cast<std::size_t>(*term.set)].name) : kind;
}

double value_of(const Function& function, int axis, double time, const Vec3& start, const std::string& title) {
  try {
    return function(time, start, start);
  } catch (const mpm::FunctionError& error) {
    throw mpm::LoadError(fmt::format("{}, along {}: {}", title, "xyz"[axis], error.what()));
  }
}

/// visit(set, particle) for all awake that a load acts on.
template <class Visit>
void each_loaded(const mpm::ParticleLoadTerm& term, const std::vector<ParticleSet>& sets, Visit&& visit) {
  for (std::size_t s = 0; s < sets.size(); ++s) {
    if (term.set && *term.set != static_cast<int>(s)) continue;
    for (int p = 0; p < sets[s].awake(); ++p) {
      const std::uint32_t number = sets[s].id[p] - sets[s].first_id;
      if (term.chosen.empty() || term.chosen[number] != 0) visit(sets[s], p);
    }
  }
}

}  // namespace

template <class T>
Loads<T>::Loads(const std::vector<mpm::ParticleLoadTerm>& terms, const std::vector<ParticleSet>& sets,
                const mpm::GridLayout& layout, const Passes<T>& passes, mpm::ParticleLoadStage* book,
                std::optional<Tractions<T>> tractions)
    : layout_(layout), passes_(passes), book_(book), tractions_(std::move(tractions)) {
  const int dim = layout.dim();
  for (const ParticleSet& set : sets) ids_ = std::max(ids_, static_cast<long>(set.first_id) + set.size());
  std::array<std::vector<std::uint32_t>, kSpreads> acts;
  std::array<std::vector<double>, kSpreads> fixed;
  for (const mpm::ParticleLoadTerm& term : terms) {
    const auto s = static_cast<std::size_t>(term.spread);
    OfSpread& spread = spreads_[s];
    spread.used = true;
    acts[s].resize(static_cast<std::size_t>(ids_));
    const std::string title = title_of(term, sets);
    if (differs(term.value)) {
      spread.fixes = true;
      fixed[s].resize(static_cast<std::size_t>(ids_ * dim));
      each_loaded(term, sets, [&](const ParticleSet& set, int p) {
        Vec3 start = Vec3::Zero();
        for (int k = 0; k < dim; ++k) start[layout.axis(k)] = (set.start_x.empty() ? set.x : set.start_x)[k][p];
        const double factor = term.each ? 1.0 / set.mass : term.factor;
        for (int k = 0; k < dim; ++k) {
          const int axis = layout.axis(k);
          const double value = factor * value_of(term.value[static_cast<std::size_t>(axis)], axis, 0.0, start, title);
          fixed[s][static_cast<std::size_t>(k * ids_ + set.id[p])] += value;
          fixed_[static_cast<std::size_t>(term.kind)][axis] += set.mass * value;
        }
      });
      continue;
    }
    if (spread.alike.size() == kMost)
      throw GpuError(fmt::format("gpu: more than {} loads on particles at once: run it with --device cpu", kMost));
    double mass = 0.0;
    const std::uint32_t bit = 1U << spread.alike.size();
    each_loaded(term, sets, [&](const ParticleSet& set, int p) {
      mass += set.mass;
      acts[s][set.id[p]] |= bit;
    });
    const double factor = term.each ? 1.0 / sets[static_cast<std::size_t>(*term.set)].mass : term.factor;
    spread.alike.push_back({term.kind, term.value, factor, mass, title});
  }
  for (std::size_t s = 0; s < kSpreads; ++s) {
    OfSpread& spread = spreads_[s];
    if (!spread.used) continue;
    spread.acts.fit(ids_);
    spread.acts.upload(acts[s]);
    if (spread.fixes) spread.fixed.fit(ids_ * dim);
    if (spread.fixes) spread.fixed.upload(fixed[s]);
    const std::size_t values = spread.alike.size() * static_cast<std::size_t>(dim);
    spread.value.fit(std::max(1L, static_cast<long>(values)));
    for (std::vector<double>* list : {&spread.now, &spread.next}) list->reserve(values);
  }
}

template <class T>
void Loads<T>::make_room(Executor&, long nodes) {
  load_.fit(nodes * layout_.dim());
  power_.fit(nodes);
  work_.make_room(nodes);
}

template <class T>
void Loads<T>::begin_step(Executor&, Step<T>& step, double start, long) {
  step.settings.driven = true;
  step.nodes.load = load_.data();
  const double dt = step.settings.dt, middle = start + 0.5 * dt;
  if (tractions_) tractions_->begin_step(start, dt);
  ByKind force = fixed_;
  for (OfSpread& spread : spreads_) {
    spread.next.clear();
    for (const Alike& load : spread.alike) {
      for (int k = 0; k < layout_.dim(); ++k) {
        const int axis = layout_.axis(k);
        const Function& function = load.value[static_cast<std::size_t>(axis)];
        spread.next.push_back(load.factor * value_of(function, axis, middle, Vec3::Zero(), load.title));
        force[static_cast<std::size_t>(load.kind)][axis] += load.mass * spread.next.back();
      }
    }
    if (spread.next == spread.now) continue;
    spread.now.swap(spread.next);
    spread.value.upload(spread.now);
  }
  for (std::size_t kind = 0; kind < kKinds; ++kind) given_[kind].add(force[kind] * dt);
}

template <class T>
LoadView Loads<T>::view_of(OfSpread& spread) const {
  return {static_cast<long>(spread.alike.size()), ids_, spread.acts.data(), spread.value.data(),
          spread.fixes ? spread.fixed.data() : nullptr};
}

template <class T>
void Loads<T>::act(mpm::Hook hook, Executor& run, const Step<T>& step) {
  if (hook == mpm::Hook::forces_gathered) {
    bool adds = false;
    for (std::size_t s = 0; s < kSpreads; ++s) {
      if (!spreads_[s].used) continue;
      passes_.load_of_particles(run, step, view_of(spreads_[s]));
      passes_.load[s](run, step, adds);
      adds = true;
    }
    if (tractions_) tractions_->act(run, step, adds);
  } else if (hook == mpm::Hook::momentum_updated) {
    passes_.load_power(run, step, power_.data());
    work_.add(run, "gpu: accounts", power_.data(), step.nodes.nodes, 1, step.settings.dt);
  }
}

template <class T>
void Loads<T>::tell_modules() {
  double work = work_.take().of[0];
  if (tractions_) tractions_->tell_modules(std::exchange(work, 0.0));  // one of the stages has all of it
  if (book_ != nullptr) book_->count_work(work);
  for (std::size_t kind = 0; kind < kKinds; ++kind) {
    if (book_ != nullptr) book_->count(static_cast<mpm::ParticleLoadTerm::Kind>(kind), given_[kind]);
    given_[kind] = {};
  }
}

template <class T>
std::size_t Loads<T>::bytes() const {
  std::size_t sum = load_.bytes() + power_.bytes() + work_.bytes() + (tractions_ ? tractions_->bytes() : 0);
  for (const OfSpread& one : spreads_) sum += one.acts.bytes() + one.value.bytes() + one.fixed.bytes();
  return sum;
}

template class Loads<double>;
template class Loads<float>;

}  // namespace mpm_gpu
