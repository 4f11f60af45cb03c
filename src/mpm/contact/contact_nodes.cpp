#include "mpm/contact/contact_nodes.hpp"

#include <algorithm>
#include <tuple>

#include "mpm/loop/loop.hpp"
#include "mpm/ranks/lists.hpp"
#include "mpm/shape/ring.hpp"

namespace mpm {
namespace {

constexpr double kNoTraction = 1e-12;

constexpr double kOnAxis = 1e-6;  // part of a cell

}  // namespace

double around_axis(GeometryKind geometry, const GridLayout& layout, const Vec3& position) {
  if (!axisymmetric(geometry)) return 1.0;
  const double cell = layout.cell(0), r = position.x();
  // The hat function of a node on the axis: its integral of 2 pi r over that of 1.
  return r > kOnAxis * cell ? kTurn * r : kTurn * cell / 3.0;
}

template <class FieldOf>
void ContactNodes::load(Pass pass, const Block& block, const Node& node, double dt, FieldOf&& velocity,
                        Scratch& scratch) const {
  const auto first = block.materials.begin() + node.first_member;
  scratch.materials.assign(first, first + node.groups);
  for (NodeMaterial& material : scratch.materials) material.velocity.setZero();
  for (int m = node.first_member; m < node.first_member + node.members; ++m) {
    const Member& member = block.members[m];
    Grid& grid = *fields_[member.field];
    NodeMaterial& material = scratch.materials[member.group];
    const Vec3 own = nodal_vector(velocity(grid), grid.layout, member.ref);
    // A material of one member keeps its velocity to the last bit.
    material.velocity += member.mass == material.mass ? own : Vec3(own * (member.mass / material.mass));
  }
  scratch.pairs.clear();
  for (int p = node.first_pair; p < node.first_pair + node.pairs; ++p) {
    NodePair pair = block.pairs[p].state;
    pair.on_a.setZero();
    pair.on_b.setZero();
    if (pass == Pass::strain && pair.interface != nullptr) {
      // Surfaces too stiff to open within a step move as one here too; strain would else be taken from a motion that
      // the interface forbids, which gains energy as letting go of pressed nodes does (step/coulomb.hpp).
      // No traction of the opening there is, but the side that the surfaces are on counts.
      pair.opening *= kNoTraction;
      // Little where a step resolves the interface's oscillation (K < 1): K^2 in the place of K.
      const double mass = reduced_mass(scratch.materials[pair.a], scratch.materials[pair.b]);
      const InterfaceLaw& law = *pair.interface;
      pair.area *= pair.area * std::max({law.opened, law.closed, law.tangential, 0.0}) * dt * dt / mass;
    } else if (pass != Pass::update) {
      pair.keep = pair.hold;
      pair.interface = nullptr;
      pair.bond = 0.0;
      if (pass == Pass::filter) pair.touching = false;
    }
    scratch.pairs.push_back(pair);
  }
}

template <class FieldOf>
void ContactNodes::hold(Pass pass, Block& block, const Node& node, double dt, FieldOf&& velocity, Scratch& scratch) {
  load(pass, block, node, dt, velocity, scratch);
  solve_contact(scratch.materials, scratch.pairs, dt);
  for (int m = node.first_member; m < node.first_member + node.members; ++m) {
    const Member& member = block.members[m];
    Grid& grid = *fields_[member.field];
    const Vec3 own = nodal_vector(velocity(grid), grid.layout, member.ref);
    add_nodal_vector(velocity(grid), grid.layout, member.ref, scratch.materials[member.group].velocity - own);
  }
  for (int p = 0; p < node.pairs; ++p) {
    NodePair& pair = block.pairs[node.first_pair + p].state;
    pair.on_a = scratch.pairs[p].on_a;
    pair.on_b = scratch.pairs[p].on_b;
  }
}

template <class FieldOf>
void ContactNodes::hold_nodes(Pass pass, double dt, FieldOf&& velocity) {
  for_parts("contact: velocities at nodes", threads_, blocks.size(), [&](std::size_t first, std::size_t end, int) {
    Scratch scratch;
    for (std::size_t i = first; i < end; ++i) {
      for (const Node& node : blocks[i].nodes) hold(pass, blocks[i], node, dt, velocity, scratch);
    }
  });
}

void ContactNodes::update_node(Block& block, const Node& node, double dt, Scratch& scratch) {
  load(
      Pass::update, block, node, dt, [](Grid& grid) -> NodalField& { return grid.velocity; }, scratch);
  std::vector<Vec3>& start = scratch.velocities;
  std::vector<Vec3>& accelerations = scratch.accelerations;
  std::vector<Vec3>& gathered = scratch.gathered;
  start.clear();
  accelerations.assign(node.groups, Vec3::Zero());
  for (const NodeMaterial& material : scratch.materials) start.push_back(material.velocity);
  gathered.assign(node.groups, Vec3::Zero());
  for (int m = node.first_member; m < node.first_member + node.members; ++m) {
    const Member& member = block.members[m];
    const Grid& grid = *fields_[member.field];
    accelerations[member.group] +=
        nodal_vector(grid.force, grid.layout, member.ref) * (member.mass / scratch.materials[member.group].mass);
    gathered[member.group] +=
        nodal_vector(grid.momentum, grid.layout, member.ref) / scratch.materials[member.group].mass;
  }
  for (NodePair& pair : scratch.pairs) {
    pair.start_slip = held_slip(gathered[pair.b] - gathered[pair.a], pair.normals.of_a, pair.hold);
  }
  solve_contact(scratch.materials, scratch.pairs, dt);
  for (int p = 0; p < node.pairs; ++p) block.pairs[node.first_pair + p].state = scratch.pairs[p];
  for (int m = node.first_member; m < node.first_member + node.members; ++m) {
    const Member& member = block.members[m];
    Grid& grid = *fields_[member.field];
    const Vec3 change = scratch.materials[member.group].velocity - start[member.group];
    const Vec3 apart = start[member.group] - nodal_vector(grid.velocity, grid.layout, member.ref);
    const Vec3 forced = accelerations[member.group] - nodal_vector(grid.force, grid.layout, member.ref);
    add_nodal_vector(grid.velocity, grid.layout, member.ref, change + apart);
    add_nodal_vector(grid.force, grid.layout, member.ref, change / dt + forced);
  }
}

void ContactNodes::strain(double dt) {
  hold_nodes(Pass::strain, dt, [](Grid& grid) -> NodalField& { return grid.velocity; });
}

void ContactNodes::update(double dt) {
  for_parts("contact: impulses at nodes", threads_, blocks.size(), [&](std::size_t first, std::size_t end, int) {
    Scratch scratch;
    for (std::size_t i = first; i < end; ++i) {
      for (const Node& node : blocks[i].nodes) update_node(blocks[i], node, dt, scratch);
    }
  });
  keep_held();
}

void ContactNodes::filter(double dt) {
  hold_nodes(Pass::filter, dt, [](Grid& grid) -> NodalField& { return grid.increment; });
}

void ContactNodes::share_memory(Communicator& ranks) {
  held_ = gather_list(ranks, held_);
  put_in_order();
}

void ContactNodes::put_in_order() {
  const auto before = [](const Held& a, const Held& b) {
    return std::tie(a.node, a.fields) < std::tie(b.node, b.fields);
  };
  const auto same = [](const Held& a, const Held& b) { return a.node == b.node && a.fields == b.fields; };
  std::sort(held_.begin(), held_.end(), before);
  held_.erase(std::unique(held_.begin(), held_.end(), same), held_.end());
}

void ContactNodes::keep_held() {
  held_.clear();
  for (const Block& block : blocks) {
    for (const Node& node : block.nodes) {
      for (int p = node.first_pair; p < node.first_pair + node.pairs; ++p) {
        const PairOfNode& pair = block.pairs[p];
        if (pair.state.hold != PairHold::none) held_.push_back({node.id, pair.fields, pair.state.hold});
      }
    }
  }
  const auto before = [](const Held& a, const Held& b) {
    return std::tie(a.node, a.fields) < std::tie(b.node, b.fields);
  };
  if (!std::is_sorted(held_.begin(), held_.end(), before)) std::sort(held_.begin(), held_.end(), before);
}

PairHold ContactNodes::held(std::uint64_t node, int fields) const {
  const auto before = [](const Held& one, const std::pair<std::uint64_t, int>& wanted) {
    return std::tie(one.node, one.fields) < std::tie(wanted.first, wanted.second);
  };
  const auto it = std::lower_bound(held_.begin(), held_.end(), std::pair{node, fields}, before);
  return it != held_.end() && it->node == node && it->fields == fields ? it->hold : PairHold::none;
}

void ContactNodes::serialise(StateArchive& archive) {
  archive.rows("held", held_);
  archive.column("held/node", held_, &Held::node);
  archive.column("held/fields", held_, &Held::fields);
  archive.column("held/hold", held_, &Held::hold);
  if (archive.merging()) put_in_order();
}

}  // namespace mpm
