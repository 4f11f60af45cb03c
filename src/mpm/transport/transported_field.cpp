#include "mpm/transport/transported_field.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include "mpm/math/dimension.hpp"
#include "mpm/particles/for_particles.hpp"
#include "mpm/ranks/of_all.hpp"
#include "mpm/transport/local_gain.hpp"
#include "visits.hpp"

namespace mpm {
namespace {

constexpr double kBeyond = 0.1;    ///< part of the range of given values by which FLIP's scatter may leave it
constexpr double kLargest = 1e30;  ///< largest value of any quantity

}  // namespace

std::string text_of(const Vec3& place) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", place.x(), place.y(), place.z());
}

void find_volume_ratios(const ParticleSet& set, GeometryKind geometry, int first, int last, double* j) {
  with_geometry(geometry, [&](auto kind) {
    for (int p = first; p < last; ++p) j[p - first] = determinant(kind.load_matrix(set.f, p));
  });
}

TransportedField::TransportedField(const QuantityDefinition& definition, const TransportParts& parts,
                                   std::unique_ptr<ScalarTransfer> transfer)
    : definition_(definition),
      parts_(parts),
      transfer_(std::move(transfer)),
      volume_(1, parts.fields.front()->layout.nodes_per_block()),
      stages_(parts.fields.front()->layout.nodes_per_block()),
      scratch_(parts.sets.size()),
      given_(parts.sets.size()),
      taken_(parts.sets.size()),
      around_(1, parts.fields.front()->layout.nodes_per_block()) {
  const int nodes = parts_.fields.front()->layout.nodes_per_block();
  for (std::size_t f = 0; f < parts_.fields.size(); ++f) {
    nodes_.push_back({NodalField(1, nodes), NodalField(1, nodes), NodalField(1, nodes)});
  }
  const std::string name = traits_of(definition_.quantity).name, unit = traits_of(definition_.quantity).unit;
  for (ParticleSet& set : parts_.sets) {
    place_.push_back(set.bring(name, unit));
    set.bring(name + "_carried", unit);
  }
  bool one = traits_of(definition_.quantity).by_mass;
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    const TransportMaterial& own = material(static_cast<int>(s));
    one = one && own.capacity.is_constant() && own.capacity(0.0) == material(0).capacity(0.0);
    conducts_ = conducts_ || own.conductivity.most() > 0.0;
    reads_nodes_ =
        reads_nodes_ || !own.capacity.is_constant() || !own.conductivity.is_constant() || own.expansion != 0.0;
    anisotropic_ = anisotropic_ || own.anisotropy.has_value();
    gravity_driven_ = gravity_driven_ || own.fluid_density * parts_.gravity.norm() > 0.0;
  }
  if (one) one_capacity_ = material(0).capacity(0.0);
  gravity_driven_ = gravity_driven_ && conducts_;
  flows_ = conducts_ || !definition_.values.empty() || !definition_.fluxes.empty() || !definition_.sources.empty() ||
           !definition_.tools.empty() || !definition_.pairs.empty();
  if (flows_) make_room();
  for (const ValueDefinition& value : definition_.values) {
    if (!value.value.is_constant()) continue;
    lowest_ = std::min(lowest_, value.value(0.0));
    highest_ = std::max(highest_, value.value(0.0));
  }
  prescribed_.name = "prescribed values";
  volume_sources_.name = "sources";
  start_values();
  find_limit();
}

void TransportedField::make_room() {
  const int nodes = parts_.fields.front()->layout.nodes_per_block();
  if (parts_.cracked) {
    const std::vector<NodalField> each(parts_.fields.size(), NodalField(1, nodes));
    joined_.emplace(Joined{{}, NodalField(1, nodes), NodalField(1, nodes), each, each});
  }
  vectors_ = (anisotropic_ || gravity_driven_) ? parts_.fields.front()->layout.dim() : 1;
  fit_scratch();
  if (definition_.method != RateMethod::particle_capacity) return;
  rooms_.assign(parts_.fields.size(), NodalField(1, nodes));
}

void TransportedField::fit_scratch() {
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    for (int k = 0; k < vectors_; ++k) scratch_[s][k].resize(parts_.sets[s].id.size());
  }
}

void TransportedField::add(std::unique_ptr<NodalSource> source) {
  if (vectors_ == 0) make_room();
  // A surface that takes h (T_a - T), h as at the start, is read once an update: that must not overshoot.
  const double cell = parts_.fields.front()->layout.smallest_cell();
  longest_update_ =
      std::min(longest_update_, mpm::longest_update(cell, least_of_volume_, source->conductance(highest_)));
  sources_.push_back(std::move(source));
}

void TransportedField::start_values() {
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    const ParticleSet& set = parts_.sets[s];
    PaddedArray<double>& value = values(static_cast<int>(s));
    for (int p = 0; p < set.size(); ++p) {
      const Vec3 place = place_of(set, parts_.fields.front()->layout, p);
      value[p] = initial_value(definition_, set.name, place);
      lowest_ = std::min(lowest_, value[p]);
      highest_ = std::max(highest_, value[p]);
    }
    carried(static_cast<int>(s)) = value;
  }
}

void TransportedField::start_from(int set, const std::function<double(int)>& value) {
  for (int p = 0; p < parts_.sets[set].size(); ++p) values(set)[p] = carried(set)[p] = value(p);
}

void TransportedField::find_limit() {
  double fastest = 0.0;  // K over C [m^2/s]
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    const TransportMaterial& own = material(static_cast<int>(s));
    const double capacity = mpm::least_capacity(own, definition_.quantity, parts_.densities[s]);
    fastest = std::max(fastest, largest_diffusivity(own, definition_.quantity, parts_.densities[s]));
    least_of_volume_ = std::min(least_of_volume_, capacity);
    if (parts_.sets[s].size() == 0) continue;  // they are on other ranks
    least_capacity_ = std::min(least_capacity_, capacity * parts_.sets[s].least_mass() / parts_.densities[s]);
  }
  const double cell = parts_.fields.front()->layout.smallest_cell();
  stable_step_ = mpm::stable_step(cell, fastest);
  longest_update_ = std::numeric_limits<double>::infinity();
  if (traits_of(parts_.shape).point()) longest_update_ = kOfPoints * stable_step_;
}

void TransportedField::share_limits(Communicator& ranks) {
  double limits[] = {-lowest_, highest_, -least_capacity_};
  ranks.largest(limits, 3);
  lowest_ = -limits[0];
  highest_ = limits[1];
  least_capacity_ = -limits[2];
}

void TransportedField::collect() {
  for (std::size_t g = 0; g < gains_.size(); ++g) {
    for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
      const int index = static_cast<int>(s);
      if (!gains_[g]->acts_on(index)) continue;
      const ParticleSet& set = parts_.sets[s];
      PaddedArray<double>&value = values(index), &held = carried(index);
      const auto take = [&](int first, int last, double& sum) {
        double gain[kGainGroup] = {}, capacity[kGainGroup];
        find_capacities(index, first, last, capacity);
        gains_[g]->take(index, first, last, value.data(), gain);
        for (int p = first; p < last; ++p) {
          value[p] += gain[p - first];
          held[p] += gain[p - first];
          sum += set.mass_of(p) * capacity[p - first] * gain[p - first];
        }
      };
      const double content = sum_groups("transport: gains", set, parts_.threads, sums_, 0.0, take);
      gain_accounts_[g].add(content);
      gained_ += content;
    }
  }
}

// Over several ranks all of them stop, or none; they are asked less often, since it takes a message.
void TransportedField::ask_to_stop() {
  constexpr std::uint32_t kRanksEvery = 64;
  if (!parts_.interrupt) return;
  if (parts_.ranks != nullptr && ++asked_ % kRanksEvery != 0) return;
  const bool own = parts_.interrupt();
  if (!any_of_all(parts_.ranks, own)) return;
  throw StoppedError(
      fmt::format("stopped within a step, while the {} moved in stages", traits_of(definition_.quantity).name));
}

void TransportedField::update(double start, double dt, bool reported) {
  ask_to_stop();
  if (flows_ || pending()) {
    fit_scratch();
    if (rest_) rest_->follow(parts_.fields);
    const double flowed = find_nodal_values();
    if (rest_) at_rest_.add(flowed * dt);
    find_held();
    add_volume_sources(start, dt);
    for (auto& source : sources_) source->give(nodes_, start, dt);
    if (gravity_driven_) drive_by_gravity();
    if (conducts_ && !anisotropic_) fill(Number::conductance);
    if (joined_) conduct_in_all(start, dt);
    for (std::size_t f = 0; f < parts_.fields.size() && !joined_; ++f) conduct(static_cast<int>(f), start, dt);
    finish(start, dt, reported || reads_nodes_ || !gains_.empty());
  }
  for (auto& gain : gains_) {
    for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
      if (!gain->acts_on(static_cast<int>(s))) continue;
      const ParticleSet& set = parts_.sets[s];
      const auto write = [&](int first, int last, double& sum) {
        sum = gain->written(static_cast<int>(s), first, last, values(static_cast<int>(s)).data());
      };
      given_to_laws_ = sum_groups("transport: gains", set, parts_.threads, sums_, given_to_laws_, write);
    }
  }
  check_range();
}

void TransportedField::check_range() const {
  const bool absolute = traits_of(definition_.quantity).absolute;
  const double least = -kBeyond * (highest_ - lowest_);  // FLIP's scatter
  const auto good = [&](double value) { return std::abs(value) < kLargest && (!absolute || value >= least); };
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    const ParticleSet& set = parts_.sets[s];
    const PaddedArray<double>& value = values(static_cast<int>(s));
    std::atomic<bool> all{true};
    for_particle_groups("transport: range", set, kGainGroup, parts_.threads, [&](int first, int last, int) {
      if (!std::all_of(value.data() + first, value.data() + last, good)) all.store(false, std::memory_order_relaxed);
    });
    for (int p = 0; p < set.awake() && !all; ++p) {
      if (good(value[p])) continue;
      throw TransportError(fmt::format(
          "the {} of particle {} of body '{}' at {} is {:.4g} {}, {}; lower time.step, or look at sources and "
          "conditions there",
          traits_of(definition_.quantity).name, set.id[p], set.name,
          text_of(place_of(set, parts_.fields.front()->layout, p)), value[p], traits_of(definition_.quantity).unit,
          absolute && value[p] < 0.0 ? "below the absolute zero" : "out of all range"));
    }
  }
}

double TransportedField::content() const {
  double sum = 0.0;
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    const ParticleSet& set = parts_.sets[s];
    for (int first = 0; first < set.size(); first += kGainGroup) {
      const int last = std::min(set.size(), first + kGainGroup);
      double capacity[kGainGroup];
      find_capacities(static_cast<int>(s), first, last, capacity);
      for (int p = first; p < last; ++p)
        sum += set.mass_of(p) * capacity[p - first] * std::abs(carried(static_cast<int>(s))[p]);
    }
  }
  return sum;
}

bool TransportedField::pending() const {
  const bool own = std::any_of(sources_.begin(), sources_.end(), [](const auto& source) { return source->pending(); });
  return sources_.empty() ? own : any_of_all(parts_.ranks, own);
}

std::vector<ContentAccount> TransportedField::accounts() const {
  std::vector<ContentAccount> list = gain_accounts_;
  if (!definition_.values.empty()) list.push_back(prescribed_);
  if (!definition_.sources.empty()) list.push_back(volume_sources_);
  for (const auto& source : sources_) source->accounts(list);
  if (rest_) list.push_back(at_rest_);
  return list;
}

void TransportedField::serialise(StateArchive& archive) {
  archive.sum("gained", gained_);
  if (gives_to_laws_) archive.sum("given_to_laws", given_to_laws_);
  const auto account = [&](const std::string& name, ContentAccount& one) {
    archive.sum(name + "/given", one.given);
    archive.sum(name + "/exchanged", one.exchanged);
  };
  account("prescribed", prescribed_);
  account("sources", volume_sources_);
  for (std::size_t g = 0; g < gains_.size(); ++g) account("gain_" + std::to_string(g), gain_accounts_[g]);
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    const StateArchive::Group group(archive, "source_" + std::to_string(s));
    sources_[s]->serialise(archive);
  }
  if (!rest_) return;
  const StateArchive::Group group(archive, "at_rest");
  account("asleep", at_rest_);
  archive.value("updated", updated_);
  rest_->serialise(archive);
  if (archive.reading()) rests_since_ = 0;
}

}  // namespace mpm
