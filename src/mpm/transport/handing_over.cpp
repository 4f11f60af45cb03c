#include <numeric>

#include "mpm/grid/for_nodes.hpp"
#include "mpm/math/dimension.hpp"
#include "mpm/particles/for_particles.hpp"
#include "mpm/transport/local_gain.hpp"
#include "mpm/transport/transported_field.hpp"
#include "visits.hpp"

// From nodes to particles: the second half of an update.
namespace mpm {

// Particles and nodes lose a part of a change, dT - P dT, on the way to and fro: it is added once, as FMPM(2) does with
// velocities. The changes are in the scratch arrays.
void TransportedField::sharpen() {
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    double* change = scratch_[s][0].data();
    const ParticleSet& set = parts_.sets[s];
    for_particle_groups("transport: changes", set, kGainGroup, parts_.threads, [&](int first, int last, int) {
      double capacity[kGainGroup];
      find_capacities(static_cast<int>(s), first, last, capacity);
      for (int p = first; p < last; ++p) change[p] *= capacity[p - first];
    });
  }
  for (std::size_t f = 0; f < parts_.fields.size(); ++f) {
    NodalQuantity& nodes = nodes_[f];
    spread_scratch(static_cast<int>(f), volume_);
    if (rest_) {
      for (const ContentAtRest::Shared& shared : rest_->shared(static_cast<int>(f))) {
        if (!shared.active) continue;
        const NodeRef node = shared.node;
        volume_.at(node.block, 0, node.node) +=
            shared.tile->capacity[shared.at] * nodes.source.at(node.block, 0, node.node);
      }
    }
    for_nodes("transport: changes", *parts_.fields[f], parts_.threads, [&](int b, int n) {
      const double capacity = nodes.capacity.at(b, 0, n);
      double& change = nodes.source.at(b, 0, n);
      if (capacity > 0.0) change += change - volume_.at(b, 0, n) / capacity;
    });
  }
}

// Hands to the particles what came to the nodes.
void TransportedField::finish(double start, double dt, bool sees) {
  const bool by_volume = definition_.method == RateMethod::particle_capacity;
  const std::size_t sets = parts_.sets.size(), fields = parts_.fields.size();
  if (by_volume) {
    fill(Number::volume);
    for (std::size_t f = 0; f < fields; ++f) {
      spread_scratch(static_cast<int>(f), rooms_[f]);
      for (std::size_t i = 0; rest_ && i < rest_->shared(static_cast<int>(f)).size(); ++i) {
        const ContentAtRest::Shared& shared = rest_->shared(static_cast<int>(f))[i];
        if (shared.active) rooms_[f].at(shared.node.block, 0, shared.node.node) += shared.tile->room[shared.at];
      }
    }
  }
  for (std::size_t s = 0; s < sets; ++s) taken_[s] = {scratch_[s][0].data()};
  for (std::size_t f = 0; f < fields; ++f) {
    NodalQuantity& nodes = nodes_[f];
    const NodalField& room = by_volume ? rooms_[f] : nodes.capacity;
    for_nodes("transport: values of nodes", *parts_.fields[f], parts_.threads, [&](int b, int n) {
      double& content = nodes.source.at(b, 0, n);
      const double capacity = room.at(b, 0, n);
      content = nodes.capacity.at(b, 0, n) > 0.0 && capacity > 0.0 ? content / capacity : 0.0;
    });
    transfer_->gather(static_cast<int>(f), nodes.source, taken_);
  }
  if (definition_.order == 2 && !by_volume) {
    sharpen();
    for (std::size_t f = 0; f < fields; ++f) transfer_->gather(static_cast<int>(f), nodes_[f].source, taken_);
  }
  for (std::size_t s = 0; s < sets; ++s) {
    const ParticleSet& set = parts_.sets[s];
    PaddedArray<double>& held = carried(static_cast<int>(s));
    double* change = scratch_[s][0].data();
    const auto take = [&](int first, int last, double& sum) {
      double capacity[kGainGroup], j[kGainGroup];
      find_capacities(static_cast<int>(s), first, last, capacity);
      if (by_volume) find_volume_ratios(set, parts_.geometry, first, last, j);
      for (int p = first; p < last; ++p) {
        const double c = capacity[p - first];
        const double gain = by_volume ? change[p] * j[p - first] / (parts_.densities[s] * c) : change[p];
        held[p] += gain;
        if (by_volume) change[p] = gain;
        sum += set.mass_of(p) * c * gain;
      }
    };
    gained_ = sum_groups("transport: changes", set, parts_.threads, sums_, gained_, take);
  }
  if (rest_) {
    for (std::size_t f = 0; f < fields; ++f) keep_for_rest(static_cast<int>(f));
    watch_rest(start + dt, dt);
  }
  for (std::size_t s = 0; s < sets; ++s) taken_[s] = {values(static_cast<int>(s)).data()};
  for (std::size_t f = 0; f < fields && sees; ++f) transfer_->gather(static_cast<int>(f), nodes_[f].value, taken_);
  follow_ramps(start, dt);
}

void TransportedField::follow_ramps(double start, double dt) {
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    const ParticleSet& set = parts_.sets[s];
    PaddedArray<double>&value = values(static_cast<int>(s)), &held = carried(static_cast<int>(s));
    for (const SourceDefinition& source : definition_.sources) {
      if (!source.ramp || !(source.body.empty() || source.body == set.name)) continue;
      double content = 0.0;
      for (int p = 0; p < set.awake(); ++p) {
        const Vec3 place = place_of(set, parts_.fields.front()->layout, p);
        const double gain = value_of(source, set.name, start + dt, place) - value_of(source, set.name, start, place);
        double capacity = 0.0;
        find_capacities(static_cast<int>(s), p, p + 1, &capacity);
        held[p] += gain;
        value[p] += gain;
        content += set.mass_of(p) * capacity * gain;
      }
      volume_sources_.add(content);
      gained_ += content;
    }
  }
}

}  // namespace mpm
