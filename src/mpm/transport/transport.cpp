#include "mpm/transport/transport.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include "mpm/math/constants.hpp"
#include "mpm/math/dimension.hpp"
#include "mpm/math/nanoseconds.hpp"
#include "mpm/particles/for_particles.hpp"
#include "mpm/ranks/of_all.hpp"
#include "mpm/transport/local_gain.hpp"
#include "visits.hpp"

namespace mpm {
namespace {

constexpr double kWait = 1.0;        ///< part of the step of one stage that an update may wait for
constexpr double kRoundOff = 1e-13;  ///< part of a sum over all particles and updates, relative to what is summed

std::string content_name(const TransportedTraits& of) { return std::string(of.name) + " content"; }

}  // namespace

Transport::Transport(TransportParts parts, std::int64_t sync, std::vector<double> drained_speeds)
    : parts_(std::move(parts)), sync_(sync), sync_end_(sync), drained_speeds_(std::move(drained_speeds)) {
  hoop_.name = "hoop stress";
}

void Transport::add(std::unique_ptr<TransportedField> field) {
  fields_.push_back(std::move(field));
  waited_.push_back(0.0);
}

void Transport::prepare_expansion(const std::function<std::unique_ptr<ScalarTransfer>()>& make_transfer) {
  std::vector<const TransportedField*> expanding;
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    bool grows = false;
    for (const auto& field : fields_) {
      if (field->material(static_cast<int>(s)).expansion == 0.0) continue;
      grows = true;
      if (std::find(expanding.begin(), expanding.end(), field.get()) == expanding.end())
        expanding.push_back(field.get());
    }
    if (!grows) continue;
    parts_.sets[s].free_strain = static_cast<int>(parts_.sets[s].bring("free_strain", "1"));
    parts_.sets[s].bring("free_strain_before", "1");
    parts_.sets[s].bring("free_strain_grown", "1");
  }
  if (expanding.empty()) return;
  expands_for_ = seconds_of(sync_);  // time for a start that is not free of strain
  expands_ = true;
  if (traits_of(parts_.shape).spline()) return;
  enhanced_ = std::make_unique<EnhancedStrain>(parts_, std::move(expanding), make_transfer());
}

template <class Term>
double Transport::sum_over(const ParticleSet& set, Term&& term) {
  return sum_groups("transport: sums", set, parts_.threads, sums_, 0.0, [&](int first, int last, double& sum) {
    for (int p = first; p < last; ++p) sum += term(p);
  });
}

// The law takes the new strain at the next look at the stress, which is in this step or, with USF, in the next; the
// work is that of the mean of the stress before and after, so that it is what the elastic energy gains, to the second
// order.
void Transport::expand(double part) {
  finish_expansion();
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    ParticleSet& set = parts_.sets[s];
    if (set.free_strain < 0) continue;
    double* strain = set.brought[set.free_strain].values.data();
    double* grows = set.brought[set.free_strain + 2].values.data();
    with_geometry(parts_.geometry, [&](auto kind) {
      expansion_begun_ += sum_over(set, [&](int p) {
        double stretch = 1.0;
        for (const auto& field : fields_) {
          const double by_one = field->material(static_cast<int>(s)).expansion;
          stretch *= 1.0 + by_one * (field->values(static_cast<int>(s))[p] - field->definition().reference);
        }
        const double grown = part * (stretch - 1.0 - strain[p]);
        const double by = std::log1p(grown / (1.0 + strain[p]));
        strain[p] += grown;
        grows[p] += by;
        return -0.5 * set.mass_of(p) * trace(kind.load_symmetric(set.tau, p)) * by;
      });
    });
  }
  if (enhanced_) expansion_begun_ += enhanced_->give(part);
  begun_ = true;
}

void Transport::finish_expansion() {
  if (!begun_) return;
  std::atomic<bool> left{false};
  for (ParticleSet& set : parts_.sets) {
    if (set.free_strain < 0) continue;
    const double* strain = set.brought[set.free_strain].values.data();
    const double* taken = set.brought[set.free_strain + 1].values.data();
    double* grows = set.brought[set.free_strain + 2].values.data();
    with_geometry(parts_.geometry, [&](auto kind) {
      expansion_work_ += sum_over(set, [&](int p) {
        const double by = grows[p];
        if (by == 0.0) return 0.0;
        if (taken[p] != strain[p]) {
          left.store(true, std::memory_order_relaxed);
          return 0.0;
        }
        grows[p] = 0.0;
        return -0.5 * set.mass_of(p) * trace(kind.load_symmetric(set.tau, p)) * by;
      });
    });
  }
  begun_ = left;
  if (begun_) return;
  expansion_work_ += expansion_begun_;
  if (enhanced_) expansion_work_ += enhanced_->book();
  expansion_begun_ = 0.0;
}

void Transport::step_begun(StepContext&) { finish_expansion(); }

void Transport::forces_gathered(StepContext& context) {
  finish_expansion();
  if (!water_) return;
  for (const auto& field : fields_) {
    if (field->quantity() == Transported::pore_pressure) field->collect();
  }
  water_->add_force(context);
  hoop_.add(Vec3(water_->radial(), 0.0, 0.0));
}

void Transport::grid_advanced(StepContext& context) {
  const double end = context.start + context.dt;
  const bool last = end + 0.25 * context.dt > seconds_of(sync_end_);
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    TransportedField& field = *fields_[i];
    waited_[i] += context.dt;
    const double longest = std::min(kWait * field.stable_step(), field.longest_update());
    const bool due =
        last || field.quantity() == Transported::pore_pressure || waited_[i] + context.dt > longest || field.pending();
    if (!due) continue;
    if (field.quantity() != Transported::pore_pressure) field.collect();  // its force has taken that of water
    // In parts only where a surface or points allow no longer update than a part of the mechanics' step.
    const double count = std::max(1.0, std::ceil(waited_[i] / field.longest_update()));
    for (int n = 0; n < static_cast<int>(count); ++n) {
      field.update(end - waited_[i] * (1.0 - n / count), waited_[i] / count, last);
    }
    expands_for_ = std::max(expands_for_, waited_[i]);
    waited_[i] = 0.0;
    changed_ = true;
  }
  if (!expands_ || !(expands_for_ > 0.0)) return;
  if (enhanced_ && changed_) enhanced_->look();
  changed_ = false;
  const bool arrives = expands_for_ < 1.5 * context.dt;
  expand(arrives ? 1.0 : context.dt / expands_for_);
  expands_for_ = arrives ? 0.0 : expands_for_ - context.dt;
}

bool Transport::stirs(const RestingBlock& block, const RestTimes& times) {
  const auto field_stirs = [&](const auto& field) { return field->stirs(block, times.now); };
  return std::any_of(fields_.begin(), fields_.end(), field_stirs);
}

void Transport::accounts(std::vector<ImpulseAccount>& list) const {
  if (water_ && axisymmetric(parts_.geometry)) list.push_back(hoop_);
}

void Transport::energies(EnergyReport& report) const {
  for (const auto& field : fields_) {
    if (field->gives_to_laws()) report.add("heat", NamedEnergy::Kind::work, field->given_to_laws());
  }
  if (water_) report.add("pore_pressure", NamedEnergy::Kind::work, water_->work());
  if (expands_) report.add("expansion", NamedEnergy::Kind::work, expansion_work_);
}

double Transport::budget_error(const TransportedField& field) const {
  double sums[] = {field.gained(), 0.0, 0.0};
  auto& [gained, given, exchanged] = sums;
  for (const ContentAccount& account : field.accounts()) {
    given += account.given;
    exchanged += account.exchanged;
  }
  add_up(parts_.ranks, sums, 3);
  const double error = std::abs(gained - given);
  if (error <= kRoundOff * exchanged) return exchanged > 0.0 ? error / exchanged : 0.0;
  const double content = sum_of_all(parts_.ranks, field.content());
  if (error <= kRoundOff * content) return error / content;
  return error / std::max(exchanged, kRoundOff * content);
}

std::vector<std::pair<std::string, std::string>> transport_numbers() {
  std::vector<std::pair<std::string, std::string>> list;
  for (const TransportedTraits& of : kTransported) list.emplace_back(content_name(of), of.content_unit);
  return list;
}

void Transport::numbers(std::vector<NamedNumber>& list) const {
  const double once = is_first(parts_.ranks) ? 1.0 : 0.0;  // weight of what all ranks know
  for (const auto& field : fields_) {
    const TransportedTraits& of = traits_of(field->quantity());
    const std::string name = of.name, unit = of.content_unit;
    list.push_back({content_name(of), unit, field->gained()});
    for (const ContentAccount& account : field->accounts()) {
      list.push_back({name + " by " + account.name, unit, account.given});
    }
    list.push_back({name + " budget error", "1", once * budget_error(*field)});
  }
  if (surface_ == nullptr) return;
  list.push_back({"heat of friction in the next step", "J", surface_->waiting()});
  for (const ToolHeat& tool : surface_->tools()) {
    if (!(tool.definition.conductance > 0.0)) continue;
    list.push_back({"heat from " + tool.definition.body, "J", once * tool.to_material});
    if (tool.definition.capacity > 0.0)
      list.push_back({"temperature of " + tool.definition.body, "K", once * tool.temperature});
  }
}

void Transport::limit_step(const PeriodAhead& period, StepLimit& limit) const {
  if (!water_) return;
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    StepLimit own;
    own.by = this;
    own.part = static_cast<int>(s);
    own.speed = water_->undrained_speed(static_cast<int>(s), drained_speeds_[s]);
    own.dt = period.reach() / own.speed;
    limit.tighten(own);
  }
}

std::string Transport::limit_text(const StepLimit& limit) const {
  return fmt::format("wave speed of '{}' with the water in its pores ({:.4g} m/s)", parts_.sets[limit.part].name,
                     limit.speed);
}

void Transport::hashed(std::vector<double>& numbers) const {
  numbers.insert(numbers.end(), waited_.begin(), waited_.end());
  numbers.push_back(expands_for_);
  for (const auto& field : fields_) field->hashed(numbers);
  if (surface_ == nullptr) return;
  numbers.push_back(surface_->waiting());
  for (const ToolHeat& tool : surface_->tools()) numbers.push_back(tool.temperature);
}

void Transport::serialise(StateArchive& archive) {
  archive.value("sync_end", sync_end_);
  archive.sum("expansion_work", expansion_work_);
  archive.sum("expansion_begun", expansion_begun_);
  if (archive.reading()) begun_ = expands_;  // it looks, and finds what there is
  archive.value("expands_for", expands_for_);
  if (enhanced_) archive.value("changed", changed_);
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    const StateArchive::Group group(archive, traits_of(fields_[i]->quantity()).name);
    archive.value("waited", waited_[i]);
    fields_[i]->serialise(archive);
  }
  if (water_) {
    const StateArchive::Group group(archive, "water");
    water_->serialise(archive);
  }
  hoop_.serialise(archive);
}

}  // namespace mpm
