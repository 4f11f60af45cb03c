// Nodes, and their fields, that material near cracks has: for the chains, tractions and tips.
#include <algorithm>
#include <cmath>

#include "mpm/crack/crack_fields.hpp"
#include "mpm/crack/crossing.hpp"

namespace mpm {

CrackFields::Place CrackFields::place_of_node(int first, const std::array<int, 2>& node) const {
  const GridLayout& layout = choice_.grid().layout;
  std::array<int, 3> block{};
  int local = 0;
  for (int k = 0; k < 2; ++k) {
    block[k] = (node[k] + kBlockEdge) / kBlockEdge - 1;
    local = local * kBlockEdge + node[k] - block[k] * kBlockEdge;
  }
  const int number = choice_.field(first).blocks.find(layout.key(block));
  return {number, local, static_cast<std::size_t>(std::max(number, 0)) * layout.nodes_per_block() + local};
}

void CrackFields::look_around(int first, const Vec2& place, const Vec2& from) const {
  const GridLayout& layout = choice_.grid().layout;
  Vec2 low = from, high = from;
  for (int k = 0; k < 2; ++k) {
    const double node = std::floor(layout.in_cells(k, place[k]));
    low[k] = std::min(low[k], layout.origin(k) + layout.cell(k) * node);
    high[k] = std::max(high[k], layout.origin(k) + layout.cell(k) * (node + 1.0));
  }
  for (std::size_t c = 0; c < cracks_.size(); ++c) {
    const Chain& chain = cracks_[c].chain;
    around_[c] = {};
    if (cracks_[c].felt && divides(static_cast<int>(c), first)) {
      around_[c] = part_between(chain, whole_line(chain), low, high);
    }
  }
}

CrackFields::NodeOfField CrackFields::find_node(int first, const Vec2& from, const std::array<int, 2>& node) const {
  const Place own = place_of_node(first, node);
  if (own.number < 0) return {};
  const Vec2 place = node_place(node);
  CracksBetween between;
  for (std::size_t c = 0; c < cracks_.size(); ++c) {
    if (around_[c].points < 2) continue;
    const LinePart part = part_between(cracks_[c].chain, around_[c], from.cwiseMin(place), from.cwiseMax(place));
    if (part.points < 2) continue;
    const Crossing found = find_crossing(cracks_[c].chain.line().data() + part.first, part.points, from, place);
    if (!found.crosses) continue;
    if (between.count == 2) return {};
    between.across[between.count++] = {static_cast<int>(c), found.above};
  }
  const auto of_group = [&](int cut) { return divides(static_cast<int>(cracks_.size()) + cut, first); };
  if (!cuts_.add_between(from, place, of_group, between)) return {};
  return field_at(first, own, between);
}

// As find_slot(), of a node that the particle need not reach.
FieldNode CrackFields::node_of(int set, const Vec3& from, const std::array<int, 3>& node) const {
  const int first = sets_[set].field;
  const Place own = place_of_node(first, {node[0], node[1]});
  if (own.number < 0) return {};
  const Vec2 particle(from.x(), from.z()), place = node_place({node[0], node[1]});
  CracksBetween between;
  for (std::size_t c = 0; c < cracks_.size(); ++c) {
    if (!cracks_[c].felt || cracks_[c].divides[set] == 0) continue;
    const Chain& chain = cracks_[c].chain;
    const LinePart part = part_between(chain, whole_line(chain), particle.cwiseMin(place), particle.cwiseMax(place));
    if (part.points < 2) continue;
    const Crossing found = find_crossing(chain.line().data() + part.first, part.points, particle, place);
    if (!found.crosses) continue;
    if (between.count == 2) return {};
    between.across[between.count++] = {static_cast<int>(c), found.above};
  }
  const auto of_set = [&](int cut) { return cuts_.divides(cut, set); };
  if (!cuts_.add_between(particle, place, of_set, between)) return {};
  return field_at(first, own, between);
}

Vec2 CrackFields::node_place(const std::array<int, 2>& node) const {
  const GridLayout& layout = choice_.grid().layout;
  return {layout.origin(0) + layout.cell(0) * node[0], layout.origin(1) + layout.cell(1) * node[1]};
}

CrackFields::NodeOfField CrackFields::field_at(int first, const Place& own, const CracksBetween& between) const {
  if (between.count == 0) return {first, {own.number, own.local}};
  const int at = node_at_[first][own.index];
  const int slot = at < 0 ? -1 : nodes_[at].field_of(between);
  return slot < 0 ? NodeOfField{} : NodeOfField{first + slot, nodes_[at].ref[slot]};
}

NodeRef CrackFields::find_place(int field, const std::array<int, 2>& node) const {
  const Place at = place_of_node(field, node);
  return {at.number, at.local};
}

CrackFields::NodeOfField CrackFields::find_across(int first, int crack, const std::array<int, 2>& node) const {
  const Place own = place_of_node(first, node);
  if (own.number < 0 || node_at_[first][own.index] < 0) return {};
  const DividedNode& divided = nodes_[node_at_[first][own.index]];
  for (int f = 0; f < 2; ++f) {
    if (divided.single[f].crack == crack) return {first + 1 + f, divided.ref[1 + f]};
  }
  return {};
}

bool CrackFields::divides(int crack, int first) const {
  const int cut = crack - static_cast<int>(cracks_.size());
  for (std::size_t s = 0; s < sets_.size(); ++s) {
    if (sets_[s].field == first && (cut < 0 ? cracks_[crack].divides[s] != 0 : cuts_.divides(cut, s))) return true;
  }
  return false;
}

std::vector<int> CrackFields::groups(int crack) const {
  std::vector<int> list;
  for (std::size_t s = 0; s < sets_.size(); ++s) {
    if (cracks_[crack].divides[s] != 0) list.push_back(sets_[s].field);
  }
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

}  // namespace mpm
