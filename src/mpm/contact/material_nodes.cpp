// Finds the nodes where bodies of different velocity fields meet, and what contact has to know of them.
#include <algorithm>

#include "mpm/contact/material_contact.hpp"
#include "mpm/loop/loop.hpp"
#include "mpm/ranks/of_all.hpp"
#include "mpm/step/coulomb.hpp"

namespace mpm {
namespace {

Vec3 mean(const NodalField& sums, const GridLayout& layout, NodeRef ref, double mass) {
  return nodal_vector(sums, layout, ref) / mass;
}

}  // namespace

void MaterialContact::momentum_gathered(StepContext& context) {
  for (std::size_t i = 0; i < friction_.size(); ++i) {
    const MaterialPair& pair = settings_.pairs[i];
    friction_[i] = pair.law.in_step(context.start, context.dt, [&] { return "'" + pair.name + "'"; });
  }
  if (shared_.update(fields_, [this](int a, int b) { return rule(a, b).pair >= 0; })) find_surveyed();
  for (int f = 0; f < static_cast<int>(fields_.size()); ++f) {
    if (surveyed_[f] != 0.0) survey_.survey(f, shared_.marks(f), wants_, volumes_[f]);
  }
  nodes_.blocks.resize(shared_.list().size());
  for_all("contact: nodes that bodies share", settings_.threads, nodes_.blocks.size(),
          [&](std::size_t i) { find_nodes(shared_.list()[i], context.dt, nodes_.blocks[i]); });
}

// Ranks survey a field together.
void MaterialContact::find_surveyed() {
  for (std::size_t f = 0; f < fields_.size(); ++f) surveyed_[f] = shared_.any(static_cast<int>(f)) ? 1.0 : 0.0;
  find_largest(settings_.ranks, surveyed_.data(), static_cast<int>(surveyed_.size()));
}

void MaterialContact::find_nodes(const SharedBlock& block, double dt, BlockNodes& found) const {
  found.clear();
  const Grid& first = *fields_[block.parts.front().field];
  const std::array<int, 3>& place = first.blocks.block(block.parts.front().block);
  for (int n = 0; n < first.layout.nodes_per_block(); ++n) {
    Node node{};
    node.first_member = static_cast<int>(found.members.size());
    for (const SharedBlock::Part& part : block.parts) {
      const Grid& grid = *fields_[part.field];
      if (!grid.carries(part.block, n)) continue;
      found.members.push_back({part.field, {part.block, n}, grid.mass.at(part.block, 0, n), 0});
    }
    node.members = static_cast<int>(found.members.size()) - node.first_member;
    node.groups = node.members;
    if (node.members > 1) {
      node.position = first.layout.node_position(place, n);
      node.id = HeldNodes::id(block.key, n);
      node.groups = group(found.members.data() + node.first_member, node.members);
      node.first_pair = static_cast<int>(found.pairs.size());
      add_pairs(node, first.mirrored(first.layout.node(place, n)), dt, found);
      node.pairs = static_cast<int>(found.pairs.size()) - node.first_pair;
    }
    if (node.members > 1 && (node.pairs > 0 || node.groups < node.members)) {
      found.nodes.push_back(node);
    } else {
      found.members.resize(node.first_member);
      found.materials.resize(node.first_member);
    }
  }
}

bool MaterialContact::parted(const Member& a, const Member& b) const {
  return settings_.sides != nullptr && settings_.sides->apart(*fields_[a.field], a.ref, *fields_[b.field], b.ref);
}

int MaterialContact::group(Member* members, int count) const {
  int groups = 0;
  for (int i = 0; i < count; ++i) {
    members[i].group = groups++;
    for (int k = 0; k < i; ++k) {
      const Rule between = rule(members[k].field, members[i].field);
      if (between.pair < 0 || parted(members[k], members[i]) ||
          settings_.pairs[between.pair].law.kind != ContactLaw::Kind::one_field)
        continue;
      const int kept = members[k].group, joined = members[i].group;
      if (kept == joined) continue;
      // The higher number goes, and those above it close up.
      const int low = std::min(kept, joined), high = std::max(kept, joined);
      for (int m = 0; m <= i; ++m) {
        if (members[m].group == high) members[m].group = low;
        if (members[m].group > high) --members[m].group;
      }
      --groups;
    }
  }
  return groups;
}

NodeMaterial MaterialContact::material_at(const Member& member, const Vec3& position) const {
  const NodalVolumes& volumes = volumes_[member.field];
  const GridLayout& layout = fields_[member.field]->layout;
  const NodeRef ref = member.ref;
  NodeMaterial material;
  material.mass = member.mass;
  material.volume = volumes.volume.at(ref.block, 0, ref.node);
  material.gradient = nodal_vector(volumes.gradient, layout, ref);
  if (wants_.start_volume) material.start_volume = volumes.start_volume.at(ref.block, 0, ref.node);
  if (settings_.detection.kind == Detection::positions) {
    material.place = mean(volumes.position, layout, ref, member.mass);
  } else if (settings_.detection.kind == Detection::displacements) {
    material.place = mean(volumes.displacement, layout, ref, member.mass);
  }
  if (wants_.slope) {
    // The mean is that of the material's mean place; its gradient carries it to the node.
    material.displacement = mean(volumes.displacement, layout, ref, member.mass);
    const Vec3 to_node = position - mean(volumes.position, layout, ref, member.mass);
    for (int c = 0; c < layout.dim(); ++c) {
      material.displacement[layout.axis(c)] += mean(volumes.slope[c], layout, ref, member.mass).dot(to_node);
    }
  }
  return material;
}

void MaterialContact::add_pairs(Node& node, const std::array<bool, 3>& mirrored, double dt, BlockNodes& found) const {
  const GridLayout& layout = fields_.front()->layout;
  const Member* members = found.members.data() + node.first_member;
  found.materials.resize(found.members.size());
  NodeMaterial* materials = found.materials.data() + node.first_member;
  std::vector<int> heaviest(node.groups, -1);
  for (int m = 0; m < node.members; ++m) {
    const int g = members[m].group;
    const NodeMaterial one = material_at(members[m], node.position);
    materials[g] = heaviest[g] < 0 ? one : lumped(materials[g], one);
    if (heaviest[g] < 0 || members[m].mass > members[heaviest[g]].mass) heaviest[g] = m;
  }
  double start_volume = 0.0;
  for (int g = 0; g < node.groups; ++g) {
    mirror(materials[g], layout, mirrored);
    start_volume += materials[g].start_volume;
  }
  const bool room = start_volume >= settings_.detection.minimum_volume * settings_.cell_volume;
  for (int a = 0; a < node.groups; ++a) {
    for (int b = a + 1; b < node.groups; ++b) {
      const int field_a = members[heaviest[a]].field, field_b = members[heaviest[b]].field;
      const Rule between = rule(field_a, field_b);
      if (between.pair < 0 || parted(members[heaviest[a]], members[heaviest[b]])) continue;
      const ContactLaw& law = settings_.pairs[between.pair].law;
      PairOfNode pair{};
      pair.rule = between.pair;
      pair.turned = between.turned;
      pair.fields = field_a * static_cast<int>(fields_.size()) + field_b;
      NodePair& state = pair.state;
      state.a = a;
      state.b = b;
      state.normals = pair_normals(settings_.normals, materials[a], materials[b]);
      if (state.normals.of_a.isZero(0.0)) continue;
      state.opposite = settings_.normals.method != NormalMethod::own;
      state.friction = friction_[between.pair];
      state.hold = nodes_.held(node.id, pair.fields);
      const double across = across_cell(layout, state.normals.of_a);
      state.area = contact_area(materials[a].volume, materials[b].volume, across) *
                   around_axis(settings_.geometry, layout, node.position);
      if (law.kind == ContactLaw::Kind::interface) {
        state.interface = &law.interface;
        state.opening = materials[b].displacement - materials[a].displacement;
      } else {
        state.touching =
            room && (settings_.detection.kind == Detection::approach ||
                     separation(settings_.detection, materials[a], materials[b], state.normals.of_a, across) < 0.0);
        // A bond that broke stays broken until the surfaces have pressed again; at the start what touches is bonded.
        if (state.hold != PairHold::none || !started_) state.bond = state.friction.adhesion * state.area * dt;
      }
      found.pairs.push_back(pair);
    }
  }
}

}  // namespace mpm
