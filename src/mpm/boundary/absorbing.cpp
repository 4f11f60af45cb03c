#include "mpm/boundary/absorbing.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/material/moduli.hpp"
#include "mpm/ranks/lists.hpp"
#include "mpm/ranks/of_all.hpp"
#include "mpm/shape/spline_weights.hpp"

namespace mpm {

ElasticWaves elastic_waves(const MaterialDefinition& material, GeometryKind geometry) {
  const auto [bulk, shear] = moduli_of(material);
  double modulus = bulk + 4.0 / 3.0 * shear;
  if (geometry == GeometryKind::plane_stress) modulus = 4.0 * shear * (3.0 * bulk + shear) / (3.0 * bulk + 4.0 * shear);
  return {std::sqrt(modulus / material.density), std::sqrt(shear / material.density)};
}

double face_mass(ShapeKind shape, int particles_per_direction) {
  const ShapeTraits& traits = traits_of(shape);
  if (!traits.spline()) return 0.5;  // hat functions, averaged over boxes that end on the face or not
  double sum = 0.0;
  for (int p = 0; p < weights_of_spline(traits.degree) * particles_per_direction; ++p) {
    const AxisWeights along = spline_weights(traits.degree, (p + 0.5) / particles_per_direction, 0.0);
    if (along.first <= 0) sum += along.weight[-along.first];
  }
  return sum / particles_per_direction;
}

Absorbing::Absorbing(int face, const std::string& name, const std::vector<ParticleSet>& sets,
                     std::vector<ElasticWaves> waves, double phi, bool hold, Communicator* ranks,
                     ParticlesNearCracks near_cracks)
    : face_(face),
      sets_(sets),
      waves_(std::move(waves)),
      phi_(phi),
      hold_(hold),
      ranks_(ranks),
      near_cracks_(std::move(near_cracks)) {
  account_.name = "absorbing/" + name;
}

std::uint64_t Absorbing::id_on_face(const GridLayout& layout, std::array<int, 3> node) const {
  node[face_ / 2] = face_ % 2 == 0 ? 0 : layout.last_node(face_ / 2);
  std::uint64_t id = 0;
  for (int k = 0; k < layout.dim(); ++k) id = (id << 21) + static_cast<std::uint64_t>(node[k] + kBlockEdge);
  return id;
}

void Absorbing::find_nodes(const Grid& grid) {
  const GridLayout& layout = grid.layout;
  const int axis = face_ / 2;
  const bool upper = face_ % 2 == 1;
  nodes_.clear();
  for (int b = 0; b < grid.blocks.size(); ++b) {
    const int first = grid.blocks.block(b)[axis] * kBlockEdge;
    if (upper ? first + kBlockEdge <= layout.last_node(axis) : first > 0) continue;
    for (int n = 0; n < layout.nodes_per_block(); ++n) {
      const int node = layout.node(grid.blocks.block(b), n)[axis];
      if (upper ? node < layout.last_node(axis) : node > 0) continue;
      const bool beyond = node != (upper ? layout.last_node(axis) : 0);
      nodes_.push_back({{b, n}, id_on_face(layout, layout.node(grid.blocks.block(b), n)), beyond});
    }
  }
  std::stable_sort(nodes_.begin(), nodes_.end(), [](const Node& a, const Node& b) { return a.column < b.column; });
  columns_.clear();
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (i == 0 || nodes_[i].column != nodes_[i - 1].column) columns_.push_back({static_cast<int>(i), 0, {}});
    ++columns_.back().count;
  }
}

// Sums of all together first, then of each column.
std::vector<Absorbing::WaveSum> Absorbing::sum_waves(const Grid& grid) const {
  const GridLayout& layout = grid.layout;
  const int axis = face_ / 2, on_face = face_ % 2 == 0 ? 0 : layout.last_node(axis);
  std::unordered_map<std::uint64_t, WaveSum> sums;
  WaveSum all;
  const auto add = [&](std::size_t s, std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t p = first; p < last; ++p) {
      std::array<int, 3> node{};
      for (int k = 0; k < layout.dim(); ++k) node[k] = GridLayout::nearest(layout.in_cells(k, sets_[s].x[k][p]));
      if (std::abs(node[axis] - on_face) > 1) continue;
      const double mass = sets_[s].mass_of(static_cast<int>(p));
      const WaveSum own{id_on_face(layout, node), mass, mass * waves_[s].pressure, mass * waves_[s].shear};
      sums[own.column] += own;
      all += own;
    }
  };
  for (int owner = 0; owner < grid.blocks.owners(); ++owner) {
    const int first = grid.blocks.block(grid.blocks.owner_block(owner))[axis] * kBlockEdge;
    if (on_face < first - 1 || on_face > first + kBlockEdge) continue;
    const int number = grid.first_owner + owner;
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      add(s, sets_[s].begin[number], sets_[s].begin[number + 1]);
    }
  }
  for (std::size_t s = 0; s < sets_.size() && near_cracks_.choice != nullptr; ++s) {
    if (near_cracks_.gives_to[s] == 0) continue;
    add(s, sets_[s].begin[near_cracks_.choice->grid().first_owner], sets_[s].begin.back());
  }
  all.column = kAllColumns;
  std::vector<WaveSum> list{all};
  for (const auto& [column, sum] : sums) list.push_back({column, sum.mass, sum.pressure, sum.shear});
  return list;
}

// The mean of the particles whose nearest node along the face this is, within a cell and a half of the face; where
// there is none, of all of them.
void Absorbing::find_waves(const Grid& grid) {
  std::unordered_map<std::uint64_t, WaveSum> sums;
  for (const WaveSum& sum : list_of_all(ranks_, sum_waves(grid))) sums[sum.column] += sum;
  const WaveSum& all = sums[kAllColumns];
  if (!(all.mass > 0.0)) columns_.clear();
  for (Column& column : columns_) {
    const auto found = sums.find(nodes_[column.first].column);
    const WaveSum& of = found == sums.end() ? all : found->second;
    column.waves = {of.pressure / of.mass, of.shear / of.mass};
  }
}

// Those that may carry material lie up to two nodes beyond the face. Only a rank that has that node's block, too, has
// all of the column; where it is the one on which that block counts, the column does.
void Absorbing::find_counted(const Grid& grid) {
  constexpr int kBeyond = 2;
  const int axis = face_ / 2;
  for (Column& column : columns_) {
    column.whole = column.counts = false;
    for (int i = column.first; i < column.first + column.count; ++i) {
      const NodeRef ref = nodes_[i].ref;
      const int node = grid.layout.node(grid.blocks.block(ref.block), ref.node)[axis];
      if ((face_ % 2 == 0 ? -node : node - grid.layout.last_node(axis)) != kBeyond) continue;
      column.whole = true;
      column.counts = grid.counts(ref.block);
    }
  }
}

void Absorbing::momentum_gathered(FieldContext& context) {
  if (generation_ != context.grid.blocks.generation()) {
    generation_ = context.grid.blocks.generation();
    find_nodes(context.grid);
    find_waves(context.grid);
    counted_ = false;
  }
  if (!counted_ && ranks_ != nullptr) find_counted(context.grid);
  counted_ = true;
}

// They do not change after the first step.
void Absorbing::share_memory(Communicator& ranks) {
  if (!hold_ || !started_ || held_by_all_) return;
  struct Held {
    std::uint64_t column;
    double acceleration[3];
  };
  std::vector<Held> own;
  for (const auto& [column, of] : held_) own.push_back({column, {of.x(), of.y(), of.z()}});
  for (const Held& one : gather_list(ranks, own)) held_[one.column] = Vec3(one.acceleration);
  held_by_all_ = true;
}

Absorbing::Load Absorbing::load_of(const Grid& grid, const Column& column, const NodalField& velocity) const {
  Load load;
  for (int i = column.first; i < column.first + column.count; ++i) {
    const NodeRef ref = nodes_[i].ref;
    if (!grid.carries(ref.block, ref.node)) continue;
    const double mass = grid.mass.at(ref.block, 0, ref.node);
    load.mass += mass;
    if (nodes_[i].beyond) load.beyond += mass;
    load.velocity += mass * nodal_vector(velocity, grid.layout, ref);
    load.acceleration += mass * nodal_vector(grid.force, grid.layout, ref);
  }
  if (load.mass > 0.0) load.velocity /= load.mass, load.acceleration /= load.mass;
  return load;
}

void Absorbing::tie(const Grid& grid, NodalField& velocity) const {
  for (const Column& column : columns_) {
    const Load load = load_of(grid, column, velocity);
    for (int i = column.first; i < column.first + column.count; ++i) {
      const NodeRef ref = nodes_[i].ref;
      add_nodal_vector(velocity, grid.layout, ref, load.velocity - nodal_vector(velocity, grid.layout, ref));
    }
  }
}

void Absorbing::before_strain(FieldContext& context) { tie(context.grid, context.grid.velocity); }

void Absorbing::velocity_found(FieldContext& context) { tie(context.grid, context.grid.increment); }

void Absorbing::increment_found(FieldContext& context) { tie(context.grid, context.grid.increment); }

void Absorbing::momentum_updated(FieldContext& context) {
  Grid& grid = context.grid;
  const GridLayout& layout = grid.layout;
  const int axis = face_ / 2;
  const double dt = context.dt;
  for (const Column& column : columns_) {
    const Load load = load_of(grid, column, grid.velocity);
    if (!(load.mass > 0.0)) continue;
    const std::uint64_t id = nodes_[column.first].column;
    if (hold_ && !started_ && column.whole) held_[id] = -load.acceleration;
    const auto found = held_.find(id);
    const Vec3 held = found == held_.end() ? Vec3(Vec3::Zero()) : found->second;
    const Vec3 after = load.velocity + held * dt, before = load.velocity - load.acceleration * dt;
    const double part = load.beyond / load.mass, given_way = part + std::sqrt(part * part + part);
    const double per_speed = 0.5 * dt / ((phi_ + given_way) * layout.cell(axis));
    Vec3 wanted = after;
    for (int k = 0; k < layout.dim(); ++k) {
      const int a = layout.axis(k);
      const double half = per_speed * (k == axis ? column.waves.pressure : column.waves.shear);
      wanted[a] -= half * (before[a] + after[a]) / (1.0 + half);
    }
    if (column.counts) work_ += load.mass * (wanted - load.velocity).dot(0.5 * (before + wanted));
    for (int i = column.first; i < column.first + column.count; ++i) {
      const NodeRef ref = nodes_[i].ref;
      if (!grid.carries(ref.block, ref.node)) continue;
      const Vec3 change = wanted - nodal_vector(grid.velocity, layout, ref);
      add_nodal_vector(grid.velocity, layout, ref, change);
      add_nodal_vector(grid.force, layout, ref, change / dt);
      if (column.counts) given_ += grid.mass.at(ref.block, 0, ref.node) * change;
    }
  }
  started_ = true;
}

void Absorbing::grid_advanced(FieldContext&) {
  account_.add(given_);
  given_ = Vec3::Zero();
}

// Speeds are those of the particles that lay at the face when they were sorted: found anew, they would be others.
void Absorbing::serialise(StateArchive& archive) {
  archive.rows("nodes", nodes_);
  archive.column("nodes/block", nodes_, [](Node& node) -> int& { return node.ref.block; });
  archive.column("nodes/node", nodes_, [](Node& node) -> int& { return node.ref.node; });
  archive.column("nodes/column", nodes_, &Node::column);
  archive.column("nodes/beyond", nodes_, &Node::beyond);
  archive.rows("columns", columns_);
  archive.column("columns/first", columns_, &Column::first);
  archive.column("columns/count", columns_, &Column::count);
  archive.column("columns/pressure", columns_, [](Column& column) -> double& { return column.waves.pressure; });
  archive.column("columns/shear", columns_, [](Column& column) -> double& { return column.waves.shear; });
  std::vector<std::pair<std::uint64_t, Vec3>> held(held_.begin(), held_.end());
  std::sort(held.begin(), held.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  archive.rows("held", held);
  archive.column("held/column", held, [](auto& one) -> std::uint64_t& { return one.first; });
  archive.column("held/acceleration", held, [](auto& one) -> Vec3& { return one.second; });
  if (archive.reading()) {
    held_.clear();
    held_.insert(held.begin(), held.end());
    held_by_all_ = counted_ = false;
  }
  archive.value("started", started_);
  archive.generation("sorts_since", generation_);
  account_.serialise(archive);
  archive.sum("given", given_);
  archive.sum("work", work_);
}

}  // namespace mpm
