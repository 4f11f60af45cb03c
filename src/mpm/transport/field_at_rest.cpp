// A transported quantity where blocks sleep (transport/content_at_rest.hpp).
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "mpm/math/dimension.hpp"
#include "mpm/transport/transported_field.hpp"
#include "visits.hpp"

namespace mpm {
namespace {

constexpr double kOfRange =
    1e-3;  ///< default of the change that wakes: of the range of the values that the scene gives

/// visit(set, first, end) for the particles of a block that is sorted.
template <class Visit>
void each_range(const RestingBlock& block, const std::vector<ParticleSet>& sets, Visit&& visit) {
  const int at = block.first_owner + block.owner;
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const auto first = static_cast<int>(sets[s].begin[at]), end = static_cast<int>(sets[s].begin[at + 1]);
    if (first < end) visit(static_cast<int>(s), first, end);
  }
}

}  // namespace

void TransportedField::let_sleep(std::optional<double> asked, double after) {
  const GridLayout& layout = parts_.fields.front()->layout;
  const double change = asked.value_or(kOfRange * (highest_ - lowest_));
  if (!(change > 0.0)) {
    const char* name = traits_of(definition_.quantity).name;
    throw TransportError(fmt::format(
        "sleep: the {} begins with one value everywhere, so that there is no scale for a change that wakes what is "
        "asleep; write sleep.{}",
        name, name));
  }
  // Diffusion across a block takes (4 h)^2 C / K, and a stable step is h^2 C / (4 K).
  const double across = 4.0 * kBlockEdge * kBlockEdge * stable_step_;
  rest_.emplace(layout, change, conducts_ ? change / across : 0.0, after);
  at_rest_.name = "material asleep";
  for (const ValueDefinition& value : definition_.values) {
    if (value.value.uses_time()) changing_.push_back(RigidBody(value.region).world_bounds());
  }
  if (vectors_ == 0) make_room();
  vectors_ = layout.dim();
  fit_scratch();
}

bool TransportedField::is_fed(const RestingBlock& block) const {
  const GridLayout& layout = parts_.fields.front()->layout;
  const Box nodes{layout.node_position(block.block, 0),
                  layout.node_position(block.block, layout.nodes_per_block() - 1)};
  const Box tile = nodes.grown(BlockForces::kMargin * layout.largest_cell());
  if (std::any_of(changing_.begin(), changing_.end(), [&](const Box& box) { return box.intersects(tile); }))
    return true;
  for (const auto& source : sources_) {
    if (source->feeds(block)) return true;
  }
  bool fed = false;
  each_range(block, parts_.sets, [&](int s, int, int) {
    for (const SourceDefinition& source : definition_.sources) {
      const bool acts = source.body.empty() || source.body == parts_.sets[s].name;
      fed = fed || (acts && !source.value.is_zero());
    }
  });
  return fed;
}

bool TransportedField::stirs(const RestingBlock& block, double now) const {
  if (block.owner < 0) return rest_->changed(block);
  if (!flows_) return is_fed(block);
  return !rest_->quiet(block, now) || is_fed(block);
}

double TransportedField::join_at_rest(int field) {
  NodalQuantity& nodes = nodes_[field];
  double flowed = 0.0;
  for (ContentAtRest::Shared& shared : rest_->shared(field)) {
    double& capacity = nodes.capacity.at(shared.node.block, 0, shared.node.node);
    shared.active = capacity > 0.0;
    if (!shared.active) continue;
    const ContentAtRest::Tile& tile = *shared.tile;
    const double own = tile.capacity[shared.at];
    double& value = nodes.value.at(shared.node.block, 0, shared.node.node);
    value = (capacity * value + own * tile.at(shared.at)) / (capacity + own);
    capacity += own;
    nodes.source.at(shared.node.block, 0, shared.node.node) += tile.flow[shared.at];
    flowed += tile.flow[shared.at];
  }
  return flowed;
}

void TransportedField::keep_for_rest(int field) {
  const bool by_volume = definition_.method == RateMethod::particle_capacity;
  for (const ContentAtRest::Shared& shared : rest_->shared(field)) {
    if (!shared.active) continue;
    const double change = nodes_[field].source.at(shared.node.block, 0, shared.node.node);
    const double came = change * shared.tile->share(shared.at, by_volume);
    shared.tile->came[shared.at] += came;
    gained_ += came;
  }
}

void TransportedField::watch_rest(double now, double dt) {
  for (std::size_t f = 0; f < parts_.fields.size(); ++f) {
    const Grid& grid = *parts_.fields[f];
    changes_.assign(grid.blocks.owners(), 0.0);
    for_all("transport: blocks at rest", parts_.threads, grid.blocks.owners(), [&](int owner) {
      for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
        const std::vector<std::uint32_t>& begin = parts_.sets[s].begin;
        const int at = grid.first_owner + owner;
        for (std::uint32_t p = begin[at]; p < begin[at + 1]; ++p) {
          changes_[owner] = std::max(changes_[owner], std::abs(scratch_[s][0][p]) / dt);
        }
      }
    });
    rest_->watch(parts_.fields, static_cast<int>(f), changes_, now);
  }
  rest_->find_changed();
  updated_ = now;
}

// As they are now, for all blocks that fall asleep before one sort.
void TransportedField::find_values_at_rest() {
  const std::uint64_t generation = parts_.fields.front()->blocks.generation();
  if (generation == rests_since_) return;
  rests_since_ = generation;
  fit_scratch();
  rest_->follow(parts_.fields);
  find_nodal_values(true);
  find_held();
  for (int f = 0; f < static_cast<int>(nodes_.size()); ++f) hold(f, nodes_[f].value, updated_);
}

void TransportedField::falls_asleep(const RestingBlock& block) {
  find_values_at_rest();
  const int dim = parts_.fields.front()->layout.dim();
  ContentAtRest::Tile& tile = rest_->tile(block);
  const auto spread = [&](auto&& number) {
    for (std::size_t s = 0; s < parts_.sets.size(); ++s) given_[s] = {scratch_[s][0].data()};
    each_range(block, parts_.sets, number);
    transfer_->spread_of_block(block.field, block.owner, given_, ScalarTransfer::Weight::mass, around_);
  };
  std::vector<double> content(tile.value.size());
  spread([&](int s, int first, int end) { find_capacities(s, first, end, scratch_[s][0].data() + first); });
  each_tile_node(dim, [&](int t, int beside, int node) {
    content[t] = tile.capacity[t] * tile.value[t];
    tile.capacity[t] += around_.at(beside, 0, node);
  });
  spread([&](int s, int first, int end) {
    double* numbers = scratch_[s][0].data();
    find_capacities(s, first, end, numbers + first);
    for (int p = first; p < end; ++p) numbers[p] *= carried(s)[p];
  });
  each_tile_node(dim, [&](int t, int beside, int node) {
    content[t] += around_.at(beside, 0, node);
    tile.value[t] = tile.capacity[t] > 0.0 ? content[t] / tile.capacity[t] : 0.0;
  });
  if (definition_.method == RateMethod::particle_capacity) {
    spread([&](int s, int first, int end) {
      find_volume_ratios(parts_.sets[s], parts_.geometry, first, end, scratch_[s][0].data() + first);
      for (int p = first; p < end; ++p) scratch_[s][0][p] /= parts_.densities[s];
    });
    each_tile_node(dim, [&](int t, int beside, int node) { tile.room[t] += around_.at(beside, 0, node); });
  }
  if (conducts_) add_flow_at_rest(block, tile);
}

void TransportedField::add_flow_at_rest(const RestingBlock& block, ContentAtRest::Tile& tile) {
  const GridLayout& layout = parts_.fields.front()->layout;
  const int dim = layout.dim();
  take_gradients();
  transfer_->gradient_of_block(block.field, block.owner, nodes_[block.field].value, taken_);
  std::vector<double> conducts;
  each_range(block, parts_.sets, [&](int s, int first, int end) {
    const TransportMaterial& own = material(s);
    const Symmetric3<double> k = own.anisotropy.value_or(Symmetric3<double>::isotropic(1.0));
    const Vec3 driven = gravity_driven_ ? Vec3(own.fluid_density * parts_.gravity) : Vec3(Vec3::Zero());
    conducts.resize(end - first);
    find_conductances(s, first, end, conducts.data());
    for (int p = first; p < end; ++p) {
      Vec3 g = -driven;
      for (int a = 0; a < dim; ++a) g[layout.axis(a)] += taken_[s][a][p];
      const Vec3 q = times(k, g);
      for (int a = 0; a < dim; ++a) taken_[s][a][p] = -conducts[p - first] * q[layout.axis(a)];
    }
  });
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    given_[s] = {};
    for (int a = 0; a < dim; ++a) given_[s][a] = taken_[s][a];
  }
  transfer_->spread_gradient_of_block(block.field, block.owner, given_, ScalarTransfer::Weight::mass, around_);
  each_tile_node(dim, [&](int t, int beside, int node) { tile.flow[t] += around_.at(beside, 0, node); });
}

// By the hat functions of the nodes, and the same for all particles of the block for what these do not account for.
void TransportedField::wakes(const RestingBlock& block) {
  const ContentAtRest::Tile tile = rest_->take(block);
  if (tile.came.empty()) return;
  const GridLayout& layout = parts_.fields.front()->layout;
  const int dim = layout.dim();
  double came = 0.0, given = 0.0, capacity = 0.0;
  for (const double one : tile.came) came += one;
  if (came == 0.0 && std::all_of(tile.came.begin(), tile.came.end(), [](double c) { return c == 0.0; })) return;
  const auto add = [&](int s, int p, double gain) {
    double own = 0.0;
    find_capacities(s, p, p + 1, &own);
    own *= parts_.sets[s].mass_of(p);
    carried(s)[p] += gain;
    values(s)[p] += gain;
    return own;
  };
  block.each(parts_.sets, [&](std::size_t s, int p) {
    double gain = 0.0;
    for (int i = 0; i < 1 << dim; ++i) {
      double hat = 1.0;
      int t = 0;
      for (int k = 0; k < dim; ++k) {
        const double at =
            layout.in_cells(k, parts_.sets[s].x[k][p]) - block.block[k] * kBlockEdge + BlockForces::kMargin;
        const int low = std::clamp(static_cast<int>(at), 0, BlockForces::kEdge - 2), up = i >> k & 1;
        hat *= up == 1 ? at - low : 1.0 - (at - low);
        t = t * BlockForces::kEdge + low + up;
      }
      if (tile.capacity[t] > 0.0) gain += hat * tile.came[t] / tile.capacity[t];
    }
    const double own = add(static_cast<int>(s), p, gain);
    given += own * gain;
    capacity += own;
  });
  const double rest = (came - given) / capacity;
  block.each(parts_.sets, [&](std::size_t s, int p) { add(static_cast<int>(s), p, rest); });
}

}  // namespace mpm
