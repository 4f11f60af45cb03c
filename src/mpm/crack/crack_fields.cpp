#include "mpm/crack/crack_fields.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mpm/crack/crossing.hpp"
#include "mpm/crack/near_blocks.hpp"
#include "mpm/particles/for_particles.hpp"
#include "mpm/shape/domain_shear.hpp"
#include "mpm/shape/particle_domain.hpp"

namespace mpm {
namespace {

constexpr double kRoom = 0.25;  ///< for a chain or a tool to move between two sorts [cells]

constexpr double kSlack = 1e-6;  ///< slack of the extent of a particle [cells]

/// Distance beyond its centre at which a particle's function begins to be that of a point along an axis [cells]: nodes
/// farther than a cell beyond that get nothing.
double extent(const ParticleSet& set, const GridLayout& layout, ShapeKind shape, std::size_t p, std::size_t axis) {
  const ShapeTraits& traits = traits_of(shape);
  if (traits.degree > 0) return 0.5 * (traits.degree - 1);
  if (traits.shears()) {
    double d[2][2];
    for (int k = 0; k < 2; ++k) {
      for (int c = 0; c < 2; ++c) {
        d[k][c] = static_cast<double>(set.f[2 * c + k][p]) * set.half[k] * layout.cell(k) * layout.inverse_cell(c);
      }
    }
    if (leans_too_far(d)) set_up(d);
    return std::abs(d[0][axis]) + std::abs(d[1][axis]);
  }
  return traits.follows_deformation() ? 0.5 : set.half[axis];  // the most that a box is stretched to
}

Vec2 place_of(const ParticleSet& set, std::size_t p) { return {set.x[0][p], set.x[1][p]}; }

}  // namespace

CrackFields::CrackFields(std::vector<Crack>& cracks, std::vector<ParticleSet>& sets, NodeChoice& choice,
                         const FieldJumps& jumps, const FieldMap& map, Grouping grouping, ShapeKind shape,
                         ToolCuts cuts, int threads, Communicator* ranks)
    : cracks_(cracks),
      sets_(sets),
      choice_(choice),
      jumps_(jumps),
      sorter_(grouping),
      shape_(shape),
      cuts_(std::move(cuts)),
      threads_(threads),
      ranks_(ranks),
      near_(cracks.size()),
      around_(cracks.size()),
      patch_of_(sets.size()) {
  tile_.parts.resize(cracks.size());
  for (std::size_t s = 0; s < sets.size(); ++s) {
    heeded_.emplace_back();
    for (const Crack& crack : cracks) heeded_.back().push_back(crack.divides[s] != 0 && crack.felt ? 1 : 0);
  }
  across_.assign(choice.number(), 0);
  for (std::size_t s = 0; s < sets.size(); ++s) {
    int& across = across_[sets[s].field];
    across = std::max(across, map.across(static_cast<int>(s)));
  }
}

// visit(key) for every block with a chain, or a tool that divides material, within `margin` of its tile.
template <class Visit>
void CrackFields::each_near_block(double margin, Visit&& visit) const {
  const GridLayout& layout = choice_.grid().layout;
  const auto visit_key = [&](const std::array<int, 3>& block) { visit(layout.key(block)); };
  for (const Crack& crack : cracks_) {
    const std::vector<Vec2>& line = crack.chain.line();
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      each_block_near(layout, line[k].cwiseMin(line[k + 1]), line[k].cwiseMax(line[k + 1]), margin, visit_key);
    }
  }
  cuts_.each_near_block(layout, margin, visit_key);
}

void CrackFields::find_listed() {
  listed_.clear();
  each_near_block(kRoom, [&](std::uint64_t key) {
    if (listed_.empty() || listed_.back() != key) listed_.push_back(key);
  });
  std::sort(listed_.begin(), listed_.end());
  listed_.erase(std::unique(listed_.begin(), listed_.end()), listed_.end());
}

void CrackFields::before_sort() {
  find_listed();
  const GridLayout& layout = choice_.grid().layout;
  for (ParticleSet& set : sets_) {
    if (!set.chooses || set.side.empty()) continue;
    for_particles("crack: particles near it", set, threads_, [&](int p) {
      std::array<int, 3> block{};
      bool finite = true;  // the sort tells of what is not, and of those outside, which may be put back
      for (int k = 0; k < 2; ++k) {
        const double cells = layout.in_cells(k, set.x[k][p]);
        finite = finite && std::isfinite(cells);
        if (finite) block[k] = GridLayout::nearest(std::clamp(cells, set.lowest[k], set.highest[k])) / kBlockEdge;
      }
      set.side[p] = finite && std::binary_search(listed_.begin(), listed_.end(), layout.key(block)) ? 1 : 0;
    });
  }
}

bool CrackFields::needs_sort() const {
  bool needs = false;
  each_near_block(
      0.0, [&](std::uint64_t key) { needs = needs || !std::binary_search(listed_.begin(), listed_.end(), key); });
  return needs;
}

DividedNode& CrackFields::divided_node(const Tile& tile, int tile_node, int first, const Vec2& place) {
  const NodeChoice::Node of = choice_.node_of(tile.block, tile_node, first);
  int& at = node_at_[first][static_cast<std::size_t>(of.block) * choice_.grid().layout.nodes_per_block() + of.node];
  if (at >= 0) return nodes_[at];
  at = static_cast<int>(nodes_.size());
  DividedNode node;
  node.first = first;
  node.place = place;
  for (int f = 0; f < DividedNode::kFields; ++f) {
    const NodeChoice::Node own =
        f <= across_[first] ? choice_.node_of(tile.block, tile_node, first + f) : NodeChoice::Node{-1, 0};
    node.ref[f] = {own.block, own.node};
  }
  nodes_.push_back(node);
  return nodes_.back();
}

int CrackFields::find_slot(const Tile& tile, int tile_node, std::size_t set, const Vec2& particle, const Vec2& node) {
  const Vec2 low = particle.cwiseMin(node), high = particle.cwiseMax(node);
  CracksBetween between;
  std::array<Vec2, 2> normals{Vec2::Zero(), Vec2::Zero()};
  for (std::size_t c = 0; c < cracks_.size(); ++c) {
    const LinePart& part = near_[c];
    if (cracks_[c].divides[set] == 0 || part.misses(low, high)) continue;
    const Crossing found = find_crossing(cracks_[c].chain.line().data() + part.first, part.points, particle, node);
    if (!found.crosses) continue;
    if (between.count == 2) {
      ++misfits_;
      return 0;
    }
    normals[between.count] = found.normal;
    between.across[between.count++] = {static_cast<int>(c), found.above};
  }
  if (tools_near_ && !cuts_.add_between(
                         particle, node, [&](int cut) { return cuts_.divides(cut, set); }, between)) {
    ++misfits_;
    return 0;
  }
  int slot = 0;
  if (between.count > 0) slot = take_slot(divided_node(tile, tile_node, sets_[set].field, node), between, normals);
  if (!jumps_.any()) return slot;
  const FieldJumps::Jump found = jumps_.find(sets_[set].field, particle, node, between, heeded_[set]);
  if (found.code == 0) return slot;
  wanted_.jumping |= NodeSet{1} << tile_node;
  wanted_.code[tile_node] = static_cast<std::uint8_t>(found.code);
  jump_[tile_node] = found.by;
  return slot;
}

// Takes the field of a node for what lies beyond these cracks; an empty one becomes it.
int CrackFields::take_slot(DividedNode& node, const CracksBetween& between, const std::array<Vec2, 2>& normals) {
  if (between.count == 2) {
    if (node.ref[3].block >= 0 && (node.both[0].crack < 0 || node.both == between.across)) {
      if (node.both[0].crack < 0) note_found(node, 3);
      node.both = between.across;
      return 3;
    }
    ++misfits_;
    return 0;
  }
  for (int f = 0; f < 2; ++f) {
    if (node.ref[1 + f].block < 0) break;
    if (node.single[f].crack >= 0 && !(node.single[f] == between.across[0])) continue;
    if (node.single[f].crack < 0) note_found(node, 1 + f);
    node.single[f] = between.across[0];
    node.normal[f] += normals[0];
    return 1 + f;
  }
  ++misfits_;
  return 0;
}

void CrackFields::find_wanted(const Tile& tile, std::size_t set, std::size_t particle) {
  const GridLayout& layout = choice_.grid().layout;
  const Vec2 place = place_of(sets_[set], particle);
  std::array<int, 2> first{}, last{};
  Vec2 low, high;
  for (int k = 0; k < 2; ++k) {
    const double cells = layout.in_cells(k, place[k]);
    const double reach =
        std::min(extent(sets_[set], layout, shape_, particle, static_cast<std::size_t>(k)), kDomainReach) + kSlack;
    first[k] = std::max(static_cast<int>(std::floor(cells - reach)), tile.corner[k]);
    last[k] = std::min(static_cast<int>(std::floor(cells + reach)) + 1, tile.corner[k] + NodeChoice::kEdge - 1);
    low[k] = std::min(place[k], layout.origin(k) + layout.cell(k) * first[k]);
    high[k] = std::max(place[k], layout.origin(k) + layout.cell(k) * last[k]);
  }
  tools_near_ = tile.tools && cuts_.meet(low, high);
  bool any = tools_near_;
  for (std::size_t c = 0; c < cracks_.size(); ++c) {
    near_[c] = {};
    if (!tile.parts[c].misses(low, high)) near_[c] = part_between(cracks_[c].chain, tile.parts[c], low, high);
    any = any || near_[c].points >= 2;
  }
  wanted_.nodes = wanted_.jumping = 0;
  wanted_.of_field.fill(0);
  const int columns = last[1] - first[1] + 1;
  if (columns <= 0) return;
  for (int i = first[0]; i <= last[0]; ++i) {
    const int begin = (i - tile.corner[0]) * NodeChoice::kEdge + first[1] - tile.corner[1];
    wanted_.nodes |= ((NodeSet{1} << columns) - 1) << begin;
    for (int j = 0; any && j < columns; ++j) {
      const Vec2 node(layout.origin(0) + layout.cell(0) * i, layout.origin(1) + layout.cell(1) * (first[1] + j));
      const int slot = find_slot(tile, begin + j, set, place, node);
      if (slot > 0) wanted_.of_field[slot] |= NodeSet{1} << (begin + j);
    }
  }
  wanted_.of_field[0] = wanted_.nodes & ~(wanted_.of_field[1] | wanted_.of_field[2] | wanted_.of_field[3]);
}

// The first patch of the block that has chosen nothing else.
int CrackFields::fit(const Tile& tile, int first) {
  const auto lowest = [](NodeSet of) { return __builtin_ctzll(of); };
  const auto fits = [&](const Patch& patch) {
    if (patch.first != first) return false;
    const NodeSet both = wanted_.nodes & patch.chosen.nodes;
    NodeSet differ = (wanted_.jumping ^ patch.chosen.jumping) & both;
    for (std::size_t f = 0; f < DividedNode::kFields; ++f) {
      differ |= (wanted_.of_field[f] ^ patch.chosen.of_field[f]) & both;
    }
    for (NodeSet rest = wanted_.jumping & both; differ == 0 && rest != 0; rest &= rest - 1) {
      if (wanted_.code[lowest(rest)] != patch.chosen.code[lowest(rest)]) return false;
    }
    return differ == 0;
  };
  auto patch = std::find_if(patches_.begin(), patches_.end(), fits);
  if (patch == patches_.end()) {
    patch = patches_.insert(patches_.end(), Patch{choice_.add_patch(tile.block), first, {}});
  }
  Chosen& chosen = patch->chosen;
  for (NodeSet rest = wanted_.nodes & ~chosen.nodes; rest != 0; rest &= rest - 1) {
    const int node = lowest(rest);
    const NodeSet bit = rest & (~rest + 1);
    int slot = 0;
    while ((wanted_.of_field[slot] & bit) == 0) ++slot;
    choice_.choose(patch->number, node, first + slot);
    chosen.of_field[slot] |= bit;
    if ((wanted_.jumping & bit) == 0) continue;
    chosen.jumping |= bit;
    chosen.code[node] = wanted_.code[node];
    choice_.jump(patch->number, node, jump_[node]);
  }
  chosen.nodes |= wanted_.nodes;
  return patch->number;
}

void CrackFields::clear_nodes() {
  nodes_.clear();
  node_at_.resize(choice_.number());
  for (const ParticleSet& set : sets_) {
    if (!set.chooses) continue;
    const Grid& grid = choice_.field(set.field);
    node_at_[set.field].assign(static_cast<std::size_t>(grid.blocks.size()) * grid.layout.nodes_per_block(), -1);
  }
}

// Blocks of other ranks join after a checkpoint has been read, and where ranks meet between sorts. Where there are as
// many as before, nodes may have other places, but forget_nodes() clears those that they had.
bool CrackFields::has_room() const {
  for (const ParticleSet& set : sets_) {
    if (!set.chooses) continue;
    const Grid& grid = choice_.field(set.field);
    const auto room = static_cast<std::size_t>(grid.blocks.size()) * grid.layout.nodes_per_block();
    if (node_at_[set.field].size() != room) return false;
  }
  return true;
}

void CrackFields::forget_nodes() {
  for (const DividedNode& node : nodes_) node_at(node.first, node.ref[0]) = -1;
  nodes_.clear();
}

void CrackFields::choose() {
  if (sorter_.outdated(choice_)) {
    sorter_.look_at(sets_, choice_);
    clear_nodes();
  } else if (ranks_ != nullptr && !has_room()) {
    clear_nodes();
  }
  forget_nodes();
  const long misfits = misfits_;
  find_patches();
  if (ranks_ != nullptr && share_nodes()) {
    misfits_ = misfits;
    const std::vector<DividedNode> of_all = nodes_;
    find_patches();
    nodes_ = of_all;
  }
  choice_.finish(threads_);
  for (std::size_t s = 0; s < sets_.size(); ++s) sorter_.sort(s, sets_[s], choice_, patch_of_[s]);
}

void CrackFields::find_patches() {
  const GridLayout& layout = choice_.grid().layout;
  choice_.clear_patches();
  for (std::vector<int>& of_set : patch_of_) of_set.clear();
  for (std::size_t b = 0; b < choice_.blocks().size(); ++b) {
    const std::array<int, 3> block = layout.block(choice_.blocks()[b]);
    tile_.block = static_cast<int>(b);
    Vec2 low, high;
    for (int k = 0; k < 2; ++k) {
      tile_.corner[k] = block[k] * kBlockEdge - NodeChoice::kMargin;
      low[k] = layout.origin(k) + layout.cell(k) * tile_.corner[k];
      high[k] = low[k] + layout.cell(k) * (NodeChoice::kEdge - 1);
    }
    for (std::size_t c = 0; c < cracks_.size(); ++c) {
      tile_.parts[c] = {};
      if (!cracks_[c].felt) continue;
      tile_.parts[c] = part_between(cracks_[c].chain, whole_line(cracks_[c].chain), low, high);
    }
    tile_.tools = cuts_.meet(low, high);
    patches_.clear();
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      for (std::uint32_t p = sorter_.begin(s, b); p < sorter_.begin(s, b + 1); ++p) {
        find_wanted(tile_, s, p);
        patch_of_[s].push_back(fit(tile_, sets_[s].field));
      }
    }
  }
}

void CrackFields::serialise(StateArchive& archive) {
  sorter_.serialise(archive, choice_);
  {
    const StateArchive::Same same(archive);
    archive.list("listed", listed_);
  }
  archive.sum("misfits", misfits_);
  if (archive.reading()) clear_nodes();
}

}  // namespace mpm
