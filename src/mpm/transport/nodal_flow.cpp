#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "mpm/grid/for_nodes.hpp"
#include "mpm/math/dimension.hpp"
#include "mpm/particles/for_particles.hpp"
#include "mpm/transport/local_gain.hpp"
#include "mpm/transport/transported_field.hpp"
#include "visits.hpp"

// From particles to nodes, and what flows between nodes: the first half of an update.
namespace mpm {
namespace {

constexpr double kOnFace = 1e-6;  ///< part of a cell: a node so far outside a region is on its face
constexpr double kLight = 1e-10;  ///< part of the lightest particle, see conduct()

}  // namespace

void TransportedField::find_capacities(int set, int first, int last, double* capacity) const {
  const ParticleSet& of = parts_.sets[set];
  const TransportMaterial& own = material(set);
  const PaddedArray<double>& value = values(set);
  const bool by_volume = !traits_of(definition_.quantity).by_mass;
  if (by_volume) find_volume_ratios(of, parts_.geometry, first, last, capacity);
  for (int p = first; p < last; ++p) {
    double& c = capacity[p - first];
    c = own.capacity(value[p]) * (by_volume ? c / parts_.densities[set] : 1.0);
  }
}

void TransportedField::find_conductances(int set, int first, int last, double* conductance) const {
  const TransportMaterial& own = material(set);
  const PaddedArray<double>& value = values(set);
  find_volume_ratios(parts_.sets[set], parts_.geometry, first, last, conductance);
  for (int p = first; p < last; ++p) conductance[p - first] *= own.conductivity(value[p]) / parts_.densities[set];
}

void TransportedField::fill(Number number) {
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    const ParticleSet& set = parts_.sets[s];
    const int index = static_cast<int>(s);
    const PaddedArray<double>& held = carried(index);
    double* to = scratch_[s][0].data();
    for_particle_groups("transport: spreading", set, kGainGroup, parts_.threads, [&](int first, int last, int) {
      if (number == Number::capacity || number == Number::content) {
        find_capacities(index, first, last, to + first);
        for (int p = first; p < last && number == Number::content; ++p) to[p] *= held[p];
        return;
      }
      if (number == Number::conductance) {
        find_conductances(index, first, last, to + first);
        return;
      }
      find_volume_ratios(set, parts_.geometry, first, last, to + first);
      for (int p = first; p < last; ++p) to[p] /= parts_.densities[s];
    });
  }
}

void TransportedField::spread_scratch(int field, NodalField& to) {
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) given_[s] = {scratch_[s][0].data()};
  transfer_->spread(field, given_, ScalarTransfer::Weight::mass, to);
}

double TransportedField::find_nodal_values(bool moved) {
  const int fields = static_cast<int>(nodes_.size());
  const bool by_mass = one_capacity_ && !moved;
  if (!by_mass) {
    fill(Number::capacity);
    for (int f = 0; f < fields; ++f) spread_scratch(f, nodes_[f].capacity);
  }
  fill(Number::content);
  double flowed = 0.0;
  for (int f = 0; f < fields; ++f) {
    const Grid& grid = *parts_.fields[f];
    NodalQuantity& nodes = nodes_[f];
    spread_scratch(f, nodes.value);
    nodes.source.resize(grid.blocks.size());
    nodes.capacity.resize(grid.blocks.size());
    for_nodes("transport: values of nodes", grid, parts_.threads, [&](int b, int n) {
      double& capacity = nodes.capacity.at(b, 0, n);
      if (by_mass) capacity = *one_capacity_ * grid.mass.at(b, 0, n);
      if (!grid.carries(b, n)) capacity = 0.0;
      nodes.value.at(b, 0, n) = capacity > 0.0 ? nodes.value.at(b, 0, n) / capacity : 0.0;
      nodes.source.at(b, 0, n) = 0.0;
    });
    if (rest_) flowed += join_at_rest(f);
  }
  return flowed;
}

double TransportedField::prescribed(const Held& held, double time) const {
  const ValueDefinition& condition = definition_.values[held.condition];
  try {
    return condition.value(time, held.place);
  } catch (const FunctionError& error) {
    throw TransportError(fmt::format("{}{}: prescribed value '{}' at {} at t = {:.6g} s: {}", condition.where,
                                     condition.where.empty() ? "" : ": ", condition.name, text_of(held.place), time,
                                     error.what()));
  }
}

void TransportedField::find_held() {
  const std::uint64_t generation = parts_.fields.front()->blocks.generation();
  if (generation == generation_) return;
  generation_ = generation;
  held_.clear();
  for (std::size_t f = 0; f < parts_.fields.size() && !definition_.values.empty(); ++f) {
    const Grid& grid = *parts_.fields[f];
    const double band = kOnFace * grid.layout.smallest_cell();
    for (int b = 0; b < grid.blocks.size(); ++b) {
      const auto& block = grid.blocks.block(b);
      for (int n = 0; n < grid.layout.nodes_per_block(); ++n) {
        const Vec3 place = grid.layout.node_position(block, n);
        int condition = -1;
        for (std::size_t c = 0; c < definition_.values.size(); ++c) {
          const RigidBodyDefinition& region = definition_.values[c].region;
          SurfacePoint point;
          if (!region.surface->within(region.pose.to_body(place), band, point)) continue;
          const Held held{static_cast<int>(f), {b, n}, place, static_cast<int>(c), 0.0};
          if (condition >= 0 &&
              prescribed(held, 0.0) != prescribed({held.field, held.ref, place, condition, 0.0}, 0.0)) {
            throw TransportError(
                fmt::format("{}: at the node {} the prescribed values '{}' and '{}' disagree; keep their regions apart",
                            definition_.values[c].where, text_of(place), definition_.values[condition].name,
                            definition_.values[c].name));
          }
          condition = static_cast<int>(c);
        }
        if (condition >= 0) held_.push_back({static_cast<int>(f), {b, n}, place, condition, 0.0});
      }
    }
  }
}

void TransportedField::hold(int field, NodalField& value, double time, int first) const {
  for (const Held& held : held_) {
    if (held.field == field) value.at(first + held.ref.block, 0, held.ref.node) = prescribed(held, time);
  }
}

void TransportedField::take_gradients() {
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    taken_[s] = {};
    for (int k = 0; k < parts_.fields.front()->layout.dim(); ++k) taken_[s][k] = scratch_[s][k].data();
  }
}

void TransportedField::turn_gradients() {
  const GridLayout& layout = parts_.fields.front()->layout;
  const int dim = layout.dim();
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    const ParticleSet& set = parts_.sets[s];
    const TransportMaterial& own = material(static_cast<int>(s));
    const Symmetric3<double> k = own.anisotropy.value_or(Symmetric3<double>::isotropic(1.0));
    for_particle_groups("transport: gradients", set, kGainGroup, parts_.threads, [&](int first, int last, int) {
      double conducts[kGainGroup];
      find_conductances(static_cast<int>(s), first, last, conducts);
      for (int p = first; p < last; ++p) {
        Vec3 g = Vec3::Zero();
        for (int a = 0; a < dim; ++a) g[layout.axis(a)] = taken_[s][a][p];
        const Vec3 q = times(k, g);
        for (int a = 0; a < dim; ++a) taken_[s][a][p] = -conducts[p - first] * q[layout.axis(a)];
      }
    });
    given_[s] = {};
    for (int a = 0; a < dim; ++a) given_[s][a] = taken_[s][a];
  }
}

void TransportedField::flow(int field, const NodalField& value, NodalField& to) {
  const std::size_t sets = parts_.sets.size();
  const Grid& grid = *parts_.fields[field];
  if (!conducts_) {
    to.resize(grid.blocks.size());
    for_nodes("transport: flow", grid, parts_.threads, [&](int b, int n) { to.at(b, 0, n) = 0.0; });
  } else if (!anisotropic_) {
    for (std::size_t s = 0; s < sets; ++s) given_[s] = {scratch_[s][0].data()};
    transfer_->diffuse(field, given_, value, to);
  } else {
    take_gradients();
    transfer_->gradient(field, value, taken_);
    turn_gradients();
    transfer_->spread_gradient(field, given_, ScalarTransfer::Weight::mass, to);
  }
  const NodalField& source = nodes_[field].source;
  for_nodes("transport: flow", grid, parts_.threads, [&](int b, int n) { to.at(b, 0, n) += source.at(b, 0, n); });
}

// The same in all fields at once, whose nodes follow each other in `value`: a particle near a crack feels the gradient
// of the nodes that it has in each of them.
void TransportedField::flow_in_all(const NodalField& value, NodalField& to) {
  Joined& joined = *joined_;
  const int fields = static_cast<int>(parts_.fields.size()), nodes = parts_.fields.front()->layout.nodes_per_block();
  to.resize(joined.first.back());
  for (int f = 0; f < fields; ++f) {
    const int blocks = parts_.fields[f]->blocks.size();
    joined.values[f].resize(blocks);
    std::copy_n(value.block(joined.first[f]), blocks * nodes, joined.values[f].data());
  }
  if (conducts_ && anisotropic_) {
    take_gradients();
    for (int f = 0; f < fields; ++f) transfer_->gradient(f, joined.values[f], taken_);
    turn_gradients();
    for (int f = 0; f < fields; ++f) {
      transfer_->spread_gradient(f, given_, ScalarTransfer::Weight::mass, joined.flows[f]);
    }
  } else if (conducts_) {
    for (std::size_t s = 0; s < parts_.sets.size(); ++s) given_[s] = {scratch_[s][0].data()};
    for (int f = 0; f < fields; ++f) transfer_->diffuse(f, given_, joined.values[f], joined.flows[f]);
    transfer_->diffuse_chosen(given_, joined.values, joined.flows);
  }
  for (int f = 0; f < fields; ++f) {
    const NodalField& source = nodes_[f].source;
    for_nodes("transport: flow", *parts_.fields[f], parts_.threads, [&](int b, int n) {
      const double flow = conducts_ ? joined.flows[f].at(b, 0, n) : 0.0;
      to.at(joined.first[f] + b, 0, n) = flow + source.at(b, 0, n);
    });
  }
}

// The part of Darcy's flux that does not depend on the pressure, K rho_w g; its divergence goes to the sources.
void TransportedField::drive_by_gravity() {
  const GridLayout& layout = parts_.fields.front()->layout;
  const int dim = layout.dim();
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    const ParticleSet& set = parts_.sets[s];
    const TransportMaterial& own = material(static_cast<int>(s));
    const Symmetric3<double> k = own.anisotropy.value_or(Symmetric3<double>::isotropic(1.0));
    const Vec3 g = own.fluid_density * parts_.gravity;
    const Vec3 along = times(k, g);
    for_particle_groups("transport: gravity", set, kGainGroup, parts_.threads, [&](int first, int last, int) {
      double conducts[kGainGroup];
      find_conductances(static_cast<int>(s), first, last, conducts);
      for (int p = first; p < last; ++p) {
        for (int a = 0; a < dim; ++a) scratch_[s][a][p] = conducts[p - first] * along[layout.axis(a)];
      }
    });
    given_[s] = {};
    for (int a = 0; a < dim; ++a) given_[s][a] = scratch_[s][a].data();
  }
  for (int f = 0; f < static_cast<int>(nodes_.size()); ++f) {
    transfer_->spread_gradient(f, given_, ScalarTransfer::Weight::mass, volume_);
    add_to_sources(f);
  }
}

void TransportedField::add_to_sources(int field) {
  for_nodes("transport: sources", *parts_.fields[field], parts_.threads,
            [&](int b, int n) { nodes_[field].source.at(b, 0, n) += volume_.at(b, 0, n); });
}

void TransportedField::add_volume_sources(double start, double dt) {
  const bool any = std::any_of(definition_.sources.begin(), definition_.sources.end(),
                               [](const SourceDefinition& source) { return !source.ramp; });
  if (!any) return;
  double given_content = 0.0;
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    const ParticleSet& set = parts_.sets[s];
    double* to = scratch_[s][0].data();
    find_volume_ratios(set, parts_.geometry, 0, set.awake(), to);
    for (int p = 0; p < set.awake(); ++p) {
      const Vec3 place = place_of(set, parts_.fields.front()->layout, p);
      double rate = 0.0;
      for (const SourceDefinition& source : definition_.sources) {
        if (!source.ramp && (source.body.empty() || source.body == set.name)) {
          rate += value_of(source, set.name, start + 0.5 * dt, place);
        }
      }
      to[p] *= rate / parts_.densities[s];
      given_content += to[p] * set.mass_of(p);
    }
  }
  volume_sources_.add(given_content * dt);
  for (std::size_t f = 0; f < parts_.fields.size(); ++f) {
    spread_scratch(static_cast<int>(f), volume_);
    add_to_sources(static_cast<int>(f));
  }
}

/// @throws TransportError
double TransportedField::value_of(const SourceDefinition& source, const std::string& body, double time,
                                  const Vec3& place) {
  try {
    return source.value(time, place);
  } catch (const FunctionError& error) {
    throw TransportError(fmt::format("source on '{}': {}", body, error.what()));
  }
}

// A domain that reaches a node by round-off alone gives it next to no capacity, and a share of a flux through its face
// that is round-off too. In stages such a node would follow the ratio of the two and drag the face's particles along
// (half of a cell's conduction went missing); it keeps its value instead.
void TransportedField::conduct(int field, double start, double dt) {
  NodalQuantity& nodes = nodes_[field];
  begin_conduction(field, start);
  NodalField& came = volume_;
  stages_.advance(
      parts_.fields[field]->blocks.size(), parts_.threads, dt, stages_for(dt / stable_step_), nodes.value,
      nodes.capacity, kLight * least_capacity_,
      [&](const NodalField& value, NodalField& to) { flow(field, value, to); },
      [&](NodalField& value, double part) { hold(field, value, start + part * dt); }, came, [this] { ask_to_stop(); });
  end_conduction(field, start, dt, came);
}

void TransportedField::conduct_in_all(double start, double dt) {
  Joined& joined = *joined_;
  const int fields = static_cast<int>(parts_.fields.size()), nodes = parts_.fields.front()->layout.nodes_per_block();
  joined.first.assign(1, 0);
  for (const auto& grid : parts_.fields) joined.first.push_back(joined.first.back() + grid->blocks.size());
  joined.value.resize(joined.first.back());
  joined.capacity.resize(joined.first.back());
  for (int f = 0; f < fields; ++f) {
    begin_conduction(f, start);
    const int numbers = parts_.fields[f]->blocks.size() * nodes;
    std::copy_n(nodes_[f].value.block(0), numbers, joined.value.block(joined.first[f]));
    std::copy_n(nodes_[f].capacity.block(0), numbers, joined.capacity.block(joined.first[f]));
  }
  NodalField& came = volume_;
  stages_.advance(
      joined.first.back(), parts_.threads, dt, stages_for(dt / stable_step_), joined.value, joined.capacity,
      kLight * least_capacity_, [&](const NodalField& value, NodalField& to) { flow_in_all(value, to); },
      [&](NodalField& value, double part) {
        for (int f = 0; f < fields; ++f) hold(f, value, start + part * dt, joined.first[f]);
      },
      came, [this] { ask_to_stop(); });
  for (int f = 0; f < fields; ++f) end_conduction(f, start, dt, came, joined.first[f]);
}

void TransportedField::begin_conduction(int field, double start) {
  NodalQuantity& nodes = nodes_[field];
  for (Held& held : held_) {
    if (held.field == field) held.raw = nodes.value.at(held.ref.block, 0, held.ref.node);
  }
  hold(field, nodes.value, start);
}

void TransportedField::end_conduction(int field, double start, double dt, const NodalField& came, int first) {
  NodalQuantity& nodes = nodes_[field];
  NodalField& content = nodes.source;  // the stages have read it to the end
  for_nodes("transport: values of nodes", *parts_.fields[field], parts_.threads, [&](int b, int n) {
    content.at(b, 0, n) = came.at(first + b, 0, n);
    const double capacity = nodes.capacity.at(b, 0, n);
    if (capacity > 0.0) nodes.value.at(b, 0, n) += came.at(first + b, 0, n) / capacity;
  });
  hold(field, nodes.value, start + dt);
  for (const Held& held : held_) {
    if (held.field != field) continue;
    const double capacity = nodes.capacity.at(held.ref.block, 0, held.ref.node);
    if (!(capacity > 0.0)) continue;
    double& own = content.at(held.ref.block, 0, held.ref.node);
    const double wanted = capacity * (prescribed(held, start + dt) - held.raw);
    if (parts_.fields[field]->counts(held.ref.block)) prescribed_.add(wanted - own);
    own = wanted;
  }
}

}  // namespace mpm
