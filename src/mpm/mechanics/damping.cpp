#include "mpm/mechanics/damping.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "mpm/grid/for_nodes.hpp"
#include "mpm/particles/sum_particles.hpp"

namespace mpm {
namespace {

std::vector<DampingDefinition> copies_of(const DampingDefinition& definition, int threads) {
  std::vector<DampingDefinition> copies(threads, definition);
  for (DampingDefinition& copy : copies) {
    for (Function* function : {&copy.grid, &copy.particle, &copy.pic}) *function = function->own_copy();
  }
  return copies;
}

double rate_of(const char* key, const Function& function, double t, const Vec3* place) {
  if (place == nullptr && function.uses_place()) return 0.0;
  const double rate = function(t, place == nullptr ? Vec3(Vec3::Zero()) : *place);
  if (rate >= 0.0) return rate;
  throw DampingError(
      fmt::format("{} is {:.4g} 1/s: below 0 it drives the motion; write max(0, ...) around it", key, rate));
}

double part_of_pic(const Function& function, double t, const Vec3* place) {
  if (place == nullptr && function.uses_place()) return 0.0;
  const double part = function(t, place == nullptr ? Vec3(Vec3::Zero()) : *place);
  if (part >= 0.0 && part <= 1.0) return part;
  throw DampingError(
      fmt::format("pic is {:.4g}: it is a part of a step's update, from 0 (FLIP) to 1 (PIC); write "
                  "max(0, min(1, ...)) around it",
                  part));
}

}  // namespace

DampingControl::DampingControl(const DampingDefinition& definition, double flip, Fields& fields,
                               const std::vector<ParticleSet>& sets, int threads, Communicator* ranks)
    : of_thread_(copies_of(definition, threads)),
      fields_(fields),
      sets_(sets),
      threads_(threads),
      ranks_(ranks),
      of_place_(definition.grid.uses_place() || definition.particle.uses_place() || definition.pic.uses_place()),
      given_flip_(flip),
      flip_(flip),
      fault_(threads) {
  account_.name = "damping";
  total_mass_ = mass();
  if (!of_place_) return;
  for (const ParticleSet& set : sets) {
    grid_values_.emplace_back(set.size(), 0.0);
    particle_values_.emplace_back(set.size(), 0.0);
  }
}

double DampingControl::mass() const {
  double mass = 0.0;
  for (const ParticleSet& set : sets_) mass += set.total_mass();
  return mass;
}

DampingControl::Sample DampingControl::sample(int thread, double t, double alpha, const Vec3* place) const {
  const DampingDefinition& of = of_thread_[thread];
  Sample sample;
  sample.grid = rate_of("grid", of.grid, t, place);
  sample.particle = rate_of("particle", of.particle, t, place);
  sample.pic = part_of_pic(of.pic, t, place);
  if (of.feedback) (of.feedback->of == FeedbackDefinition::Of::grid ? sample.grid : sample.particle) += alpha;
  return sample;
}

template <class Visit>
void DampingControl::everywhere(double t, double alpha, Visit&& visit) const {
  try {
    visit(sample(0, t, alpha, nullptr));
  } catch (const Error& error) {
    throw DampingError(fmt::format("method.damping at t = {:.6g} s: {}", t, error.what()));
  }
}

template <class Visit>
void DampingControl::each_particle(double t, double alpha, const GridLayout& layout, Visit&& visit) const {
  fault_.clear();
  for (std::size_t s = 0; s < sets_.size(); ++s) {
    const ParticleSet& set = sets_[s];
    for_parts("particles: rates of damping", threads_, set.size(), [&](int first, int end, int thread) {
      for (int p = first; p < end; ++p) {
        Vec3 place = Vec3::Zero();
        for (int k = 0; k < layout.dim(); ++k) place[layout.axis(k)] = set.x[k][p];
        try {
          visit(thread, s, p, sample(thread, t, alpha, &place));
        } catch (const Error& error) {
          fault_.note(thread, set.id[p], [&] {
            return fmt::format("method.damping at particle {} of '{}' at ({:.6g}, {:.6g}, {:.6g}) m, t = {:.6g} s: {}",
                               set.id[p], set.name, place.x(), place.y(), place.z(), t, error.what());
          });
        }
      }
    });
  }
  fault_.check<DampingError>();
}

void DampingControl::check(const Sample& sample, double dt) {
  const double rate = sample.grid + sample.particle;
  if (rate * dt <= 1.0) return;
  throw DampingError(
      fmt::format("a rate of {:.4g} 1/s turns a velocity round in a step of {:.4g} s; lower it, give feedback a "
                  "limit, or lower time.step or time.sync",
                  rate, dt));
}

void DampingControl::begin_step(double start, double dt) {
  const bool on_nodes = definition().in_force;
  everywhere(start + 0.5 * dt, alpha_, [&](const Sample& sample) {
    check(sample, dt);
    force_rate_ = on_nodes ? sample.grid : 0.0;
    rates_ = {on_nodes ? 0.0 : sample.grid, sample.particle};
    // A part of PIC of its own replaces the transfer's, which is FLIP then.
    flip_ = given_flip_ - sample.pic;
  });
}

void DampingControl::begin_step(const StepContext& context) {
  const double dt = context.dt, t = context.start + 0.5 * dt;
  begin_step(context.start, dt);
  if (!of_place_) return;
  const bool on_nodes = definition().in_force, exchanges = definition().pic.uses_place();
  for (std::size_t s = 0; s < sets_.size(); ++s) {  // particles may have come from other ranks and gone there
    grid_values_[s].resize(sets_[s].id.size());
    particle_values_[s].resize(sets_[s].id.size());
  }
  each_particle(t, alpha_, context.layout(), [&](int, std::size_t s, int p, const Sample& sample) {
    check(sample, dt);
    const double pic = exchanges ? sample.pic / dt : 0.0;
    grid_values_[s][p] = (on_nodes ? 0.0 : sample.grid) - pic;
    particle_values_[s][p] = sample.particle + pic;
  });
}

DampingRates DampingControl::rates(int set) const {
  DampingRates rates = rates_;
  if (of_place_) {
    rates.grid_of_particle = grid_values_[set].data();
    rates.particle_of_particle = particle_values_[set].data();
  }
  return rates;
}

void DampingControl::forces_gathered(StepContext& context) {
  if (force_rate_ == 0.0) return;
  Vec3 given = Vec3::Zero();
  for (auto& grid : fields_) given += damp_nodes(*grid, context.dt);
  account_.add(given);
}

Vec3 DampingControl::damp_nodes(Grid& grid, double dt) {
  const int nodes = grid.layout.nodes_per_block(), dim = grid.layout.dim();
  block_sums_.resize(grid.blocks.size());
  for_blocks("grid: damping", grid, threads_, [&](int b) {
    block_sums_[b] = Vec3::Zero();
    for (int k = 0; k < dim; ++k) {
      const double* momentum = grid.momentum.block(b) + k * nodes;
      double* force = grid.force.block(b) + k * nodes;
      double total = 0.0;
      for (int n = 0; n < nodes; ++n) {
        const double f = -force_rate_ * momentum[n];
        force[n] += f;
        total += f;
      }
      block_sums_[b][grid.layout.axis(k)] = grid.counts(b) ? total : 0.0;
    }
  });
  Vec3 given = Vec3::Zero();
  for (const Vec3& sum : block_sums_) given += sum * dt;
  return given;
}

void DampingControl::end_step(double start, double dt, const Damped& damped) {
  if (in_update()) account_.add(-damped.momentum);
  if (!definition().feedback) return;
  const FeedbackDefinition& feedback = *definition().feedback;
  const double energy = feedback.of == FeedbackDefinition::Of::grid ? damped.grid_energy : damped.particle_energy;
  alpha_ = std::min(alpha_ + dt * growth(sum_of_all(ranks_, energy), start), feedback.limit);
}

double DampingControl::growth(double energy, double t) const {
  try {
    return 2.0 * definition().feedback->gain / total_mass_ * (energy - definition().feedback->target(t));
  } catch (const FunctionError& error) {
    throw DampingError(fmt::format("method.damping.feedback.target: {}", error.what()));
  }
}

void DampingControl::limit_step(const PeriodAhead& period, StepLimit& limit) const {
  const double energy = needs_energy() ? sum_of_all(ranks_, kinetic_energy(sets_, threads_)) : 0.0;
  const double rate = largest_rate(period.start, period.length, energy, fields_.front()->layout);
  StepLimit own;
  own.by = this;
  own.dt = period.cfl / rate;
  if (rate > 0.0) limit.tighten(own);
}

double DampingControl::largest_rate(double start, double period, double energy, const GridLayout& layout) const {
  double alpha = alpha_;
  if (definition().feedback) {
    alpha = std::clamp(alpha_ + period * growth(energy, start), alpha_, std::max(alpha_, definition().feedback->limit));
  }
  double largest = 0.0;
  std::vector<double> of_thread(threads_, 0.0);
  for (const double part : {0.0, 0.5, 1.0}) {
    const double t = start + part * period;
    everywhere(t, alpha, [&](const Sample& sample) { largest = std::max(largest, sample.grid + sample.particle); });
    if (!of_place_) continue;
    each_particle(t, alpha, layout, [&](int thread, std::size_t, int, const Sample& sample) {
      of_thread[thread] = std::max(of_thread[thread], sample.grid + sample.particle);
    });
  }
  for (const double rate : of_thread) largest = std::max(largest, rate);
  return largest;
}

}  // namespace mpm
