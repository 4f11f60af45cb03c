// The largest stable time step: a fraction cfl of the time in which a wave on a moving particle, or a point of a tool,
// crosses a cell; viscosity and damping have their own rates. Every particle is looked at in its present state at
// every sync point and some times in between (kernel/survey.hpp, advance.cpp), and what got stiffer since the look
// before is expected to go on doing so until the next. A law's wave speed is that of a solid: in plane stress, where
// thickness gives way, it is an upper bound. With CPDI the fraction falls where domains are sheared far
// (shape/domain_shear.hpp), for which the largest shear of a body is taken to be where its waves are fastest. Source:
// method reference 11.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "mpm/implicit/implicit_step.hpp"
#include "mpm/loop/loop.hpp"
#include "mpm/modules/shipped_modules.hpp"
#include "mpm/ranks/of_all.hpp"
#include "mpm/shape/domain_shear.hpp"
#include "state.hpp"

namespace mpm {
namespace {

constexpr double kMostForeseen = 0.5;  ///< the limit is not expected to fall below this part of itself in one period

constexpr double kWorthTelling = 0.99;  ///< a trend below this is reported with the limit

class SceneStep final : public Module {
 public:
  explicit SceneStep(double dt) : dt_(dt) {}
  std::string name() const override { return "time.step"; }
  void limit_step(const PeriodAhead&, StepLimit& limit) const override {
    StepLimit own;
    own.dt = dt_;
    own.by = this;
    limit.tighten(own);
  }

 private:
  double dt_;
};

/// Time in which what moves and falls goes that way [m]: speed dt + gravity dt^2 = way. Not a number where the speed is
/// none.
double time_to_move(double way, double speed, double gravity) {
  const double sum = speed + std::sqrt(speed * speed + 4.0 * gravity * way);
  return sum == 0.0 ? std::numeric_limits<double>::infinity() : 2.0 * way / sum;
}

/// Largest magnitude; not a number where one is not finite.
template <class T>
double fastest_of(const T* v, int count, int threads) {
  double most = 0.0;
  bool finite = true;
  for_parts("particles: largest speed", threads, count, [&](int first, int end, int) {
    double own = 0.0;
    bool own_finite = true;
    for (int p = first; p < end; ++p) {
      const double speed = std::abs(static_cast<double>(v[p]));
      own = std::max(own, speed);
      own_finite = own_finite && std::isfinite(speed);
    }
    in_turn([&] {
      most = std::max(most, own);
      finite = finite && own_finite;
    });
  });
  return finite ? most : std::numeric_limits<double>::quiet_NaN();
}

/// Speed that at most this part of the particles exceeds, to a 64th of the largest.
template <class T>
double exceeded_by(double part, const T* v, int count, double largest, int threads) {
  constexpr int kBins = 64;
  if (!(largest > 0.0)) return largest;
  std::array<int, kBins> bins{};
  for_parts("particles: spread of speeds", threads, count, [&](int first, int end, int) {
    std::array<int, kBins> own{};
    for (int p = first; p < end; ++p) {
      ++own[std::min(kBins - 1, static_cast<int>(kBins * (std::abs(static_cast<double>(v[p])) / largest)))];
    }
    in_turn([&] { std::transform(own.begin(), own.end(), bins.begin(), bins.begin(), std::plus<>()); });
  });
  int bin = kBins, above = 0;
  while (bin > 0 && above + bins[bin - 1] <= part * count) above += bins[--bin];
  return largest * bin / kBins;
}

/// Largest shear of the domains that particles awake have now, at most the limit.
template <int Dim>
double largest_shear(const ParticleSet& set, const GridLayout& layout, int threads) {
  double half[Dim][Dim];  // half edges for F's components, from the undeformed box to cells
  for (int k = 0; k < Dim; ++k) {
    for (int c = 0; c < Dim; ++c) half[k][c] = set.half[k] * layout.cell(k) * layout.inverse_cell(c);
  }
  return set.f[0].visit([&](const auto& first) {
    using Array = std::decay_t<decltype(first)>;
    const Array* f[Dim * Dim];
    for (int c = 0; c < Dim * Dim; ++c) {
      set.f[c].visit([&](const auto& one) {
        if constexpr (std::is_same_v<std::decay_t<decltype(one)>, Array>) f[c] = &one;
      });
    }
    double most = 1.0;  // 1 + shear^2
    for_parts("particles: shear of domains", threads, set.awake(), [&](int first, int end, int) {
      double own = 1.0;
      for (int p = first; p < end; ++p) {
        double d[Dim][Dim];
        for (int k = 0; k < Dim; ++k) {
          for (int c = 0; c < Dim; ++c) d[k][c] = static_cast<double>((*f[c * Dim + k])[p]) * half[k][c];
        }
        const auto [edges, volume] = squared_edges_and_volume(d);
        if (edges > own * volume) own = edges / volume;
      }
      in_turn([&] { most = std::max(most, own); });
    });
    return std::min(std::sqrt(most - 1.0), kDomainShear);
  });
}

/// Largest shear of a set's domains where it shortens steps, else 0.
double shear_of(const SimulationDefinition& definition, const ParticleSet& set, const GridLayout& layout, int threads) {
  if (!traits_of(definition.method.shape).shear_limits_step || layout.dim() == 1 || set.awake() == 0) return 0.0;
  return layout.dim() == 2 ? largest_shear<2>(set, layout, threads) : largest_shear<3>(set, layout, threads);
}

}  // namespace

void add_step_limit(RunParts& parts) {
  std::optional<double> step = parts.definition.time.step;
  if (parts.definition.method.update == UpdateScheme::implicit) step = step.value_or(kImplicitStep);
  if (step) parts.modules.add(std::make_unique<SceneStep>(*step));
}

// No wave limits an implicit step; what moves, or falls from now on, may cross a part of a cell in it along each axis.
// Beside the corners of a tool a few particles are faster than all others (doc/implicit.md): they may cross more.
StepLimit Simulation::State::survey_motion() const {
  StepLimit limit;
  limit.by = modules.find(kImplicitName);
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const ParticleSet& set = sets[s];
    for (int k = 0; k < layout().dim(); ++k) {
      const double cell = layout().cell(k), gravity = std::abs(definition.gravity[layout().axis(k)]);
      StepLimit motion = limit;
      motion.part = static_cast<int>(s);
      set.v[k].visit([&](const auto& v) {
        motion.speed = fastest_of(v.data(), set.awake(), threads);
        motion.dt = time_to_move(kFastTravel * cell, motion.speed, gravity);
        if (!(time_to_move(kImplicitTravel * cell, motion.speed, gravity) < limit.dt)) return;
        const double bulk = exceeded_by(kFastPart, v.data(), set.awake(), motion.speed, threads);
        motion.dt = std::min(motion.dt, time_to_move(kImplicitTravel * cell, bulk, gravity));
      });
      if (!std::isfinite(motion.speed)) return motion;
      limit.tighten(motion);
    }
  }
  return limit;
}

StepLimit Simulation::State::survey_material() {
  if (definition.method.update == UpdateScheme::implicit) {
    if (device) fetch(Device::Numbers::velocity);
    return survey_motion();
  }
  const int dim = layout().dim();
  const double cell = layout().smallest_cell();
  StepLimit limit;
  for (std::size_t s = 0; s < sets.size(); ++s) {
    double shear = shear_of(definition, sets[s], layout(), threads);
    if (traits_of(definition.method.shape).shear_limits_step) shear = largest_of_all(ranks.get(), shear);
    if (sets[s].awake() == 0) continue;
    Device::Fastest found{};
    if (device) {
      found = device->fastest(static_cast<int>(s), cell);
    } else {
      const FastestParticle own = mechanics->fastest(static_cast<int>(s), cell);
      found.rate = own.rate;
      for (int k = 0; k < dim; ++k) found.place[layout().axis(k)] = sets[s].x[k][own.index];
    }
    StepLimit material;
    material.dt = courant_of_shear(definition.time.cfl, shear) / found.rate;
    material.by = mechanics.get();
    material.part = static_cast<int>(s);
    material.speed = found.rate * cell;
    material.place = found.place;
    limit.tighten(material);
  }
  if (over) over->share(limit, modules, mechanics.get());
  return limit;
}

StepLimit Simulation::State::step_limit(const StepLimit& before, const StepLimit& now) const {
  const PeriodAhead period{seconds_of(time), seconds_of(definition.time.sync), definition.time.cfl,
                           layout().smallest_cell()};
  StepLimit limit = now;
  // Some material is awake, and its waves set the limit.
  const bool known = now.by != nullptr && before.by != nullptr && definition.method.update != UpdateScheme::implicit;
  const double trend = known ? std::clamp(now.dt / before.dt, kMostForeseen, 1.0) : 1.0;
  limit.dt *= trend;
  limit.foreseen = trend < kWorthTelling;
  for (const Module* module : modules.list()) module->limit_step(period, limit);
  if (over) over->share(limit, modules, mechanics.get());
  if (limit.dt > period.length) limit.by = nullptr;
  return limit;
}

}  // namespace mpm
