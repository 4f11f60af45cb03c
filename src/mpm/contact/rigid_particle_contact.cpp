#include "mpm/contact/rigid_particle_contact.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "mpm/ranks/of_all.hpp"
#include "mpm/shape/ring.hpp"
#include "mpm/step/coulomb.hpp"

namespace mpm {

RigidParticleContact::RigidParticleContact(const RigidBody& body, RigidParticleSettings settings, Fields& fields,
                                           VolumeSurvey& survey)
    : body_(body),
      settings_(std::move(settings)),
      fields_(fields),
      survey_(survey),
      particles_(body, *fields.front(), settings_.geometry, settings_.per_cell, settings_.across),
      ledger_(body, axisymmetric(settings_.geometry)),
      cell_volume_(settings_.across),
      volumes_(fields.size(), NodalVolumes(fields.front()->layout.dim(), fields.front()->layout.nodes_per_block())),
      friction_(fields.size()),
      near_(fields.size()),
      surveyed_(fields.size(), 0.0),
      two_(2),
      one_(1) {
  for (int k = 0; k < fields.front()->layout.dim(); ++k) cell_volume_ *= fields.front()->layout.cell(k);
}

void RigidParticleContact::momentum_gathered(StepContext& context) {
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    friction_[f] = settings_.laws[f].in_step(context.start, context.dt, [&] { return "'" + body_.name() + "'"; });
  }
  nodes_.clear();
  find_blocks();
  find_surveyed();
  if (!keys_.empty()) particles_.gather(keys_);
  for (int f = 0; f < static_cast<int>(fields_.size()); ++f) {
    if (surveyed_[f] != 0.0) add_nodes(f, context.dt);
  }
}

// Ranks survey a field together.
void RigidParticleContact::find_surveyed() {
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    surveyed_[f] = std::find(near_[f].begin(), near_[f].end(), 1) == near_[f].end() ? 0.0 : 1.0;
  }
  find_largest(settings_.ranks, surveyed_.data(), static_cast<int>(surveyed_.size()));
}

void RigidParticleContact::find_blocks() {
  const GridLayout& layout = fields_.front()->layout;
  double cell = 0.0;
  for (int k = 0; k < layout.dim(); ++k) cell = std::max(cell, layout.cell(k));
  const Box bounds = body_.world_bounds().grown(2.0 * cell);
  keys_.clear();
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    const BlockTable& blocks = fields_[f]->blocks;
    near_[f].assign(blocks.size(), 0);
    for (int b = 0; b < blocks.size(); ++b) {
      const Vec3 low = layout.node_position(blocks.block(b), 0);
      const Vec3 high = layout.node_position(blocks.block(b), layout.nodes_per_block() - 1);
      bool meets = true;
      for (int k = 0; k < layout.dim(); ++k) {
        const int axis = layout.axis(k);
        meets = meets && low[axis] <= bounds.max[axis] && high[axis] >= bounds.min[axis];
      }
      if (!meets) continue;
      near_[f][b] = 1;
      keys_.push_back(blocks.key(b));
    }
  }
  std::sort(keys_.begin(), keys_.end());
  keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
}

void RigidParticleContact::add_nodes(int field, double dt) {
  const Grid& grid = *fields_[field];
  const GridLayout& layout = grid.layout;
  const DetectionRule& rule = settings_.detection;
  SurveyWants wants;
  wants.position = rule.kind == Detection::positions;
  wants.displacement = rule.kind == Detection::displacements;
  wants.start_volume = rule.minimum_volume > 0.0;
  NodalVolumes& volumes = volumes_[field];
  survey_.survey(field, near_[field], wants, volumes);
  const bool about_axis = axisymmetric(settings_.geometry);
  for (int b = 0; b < grid.blocks.size(); ++b) {
    if (near_[field][b] == 0) continue;
    const int place =
        static_cast<int>(std::lower_bound(keys_.begin(), keys_.end(), grid.blocks.key(b)) - keys_.begin());
    for (int n = 0; n < layout.nodes_per_block(); ++n) {
      if (!grid.carries(b, n) || !(particles_.volume(place, n) > 0.0)) continue;
      const Vec3 position = layout.node_position(grid.blocks.block(b), n);
      Node node{};
      node.field = field;
      node.ref = {b, n};
      node.id = HeldNodes::id(grid.blocks.key(b), n);
      node.arm = position - body_.pose().position;
      NodeMaterial& a = node.material;
      a.mass = grid.mass.at(b, 0, n);
      a.volume = volumes.volume.at(b, 0, n);
      a.gradient = nodal_vector(volumes.gradient, layout, node.ref);
      NodeMaterial& rigid = node.rigid;
      rigid.rigid = true;
      rigid.mass = 1.0;
      rigid.velocity = body_.velocity_at(position);
      rigid.volume = rigid.start_volume = particles_.volume(place, n);
      rigid.gradient = particles_.gradient(place, n);
      if (wants.start_volume) a.start_volume = volumes.start_volume.at(b, 0, n);
      if (wants.position) {
        a.place = nodal_vector(volumes.position, layout, node.ref) / a.mass;
        rigid.place = particles_.position(place, n);
      } else if (wants.displacement) {
        a.place = nodal_vector(volumes.displacement, layout, node.ref) / a.mass;
        rigid.place = particles_.displacement(place, n);
      }
      const std::array<bool, 3> mirrored = grid.mirrored(layout.node(grid.blocks.block(b), n));
      mirror(a, layout, mirrored);
      mirror(rigid, layout, mirrored);
      NodePair& pair = node.pair;
      pair.a = 0;
      pair.b = 1;
      pair.normals = pair_normals(settings_.normals, a, rigid);
      pair.normals.of_b = pair.normals.of_a;  // the rigid side has no impulse of its own
      if (pair.normals.of_a.isZero(0.0)) continue;
      const double across = across_cell(layout, pair.normals.of_a);
      const double around = !about_axis ? 1.0 : kTurn * (position.x() > 0.0 ? position.x() : layout.cell(0) / 3.0);
      pair.friction = friction_[field];
      pair.area = contact_area(a.volume, rigid.volume, across) * around;
      pair.touching = a.start_volume + rigid.start_volume >= rule.minimum_volume * cell_volume_ &&
                      (rule.kind == Detection::approach || separation(rule, a, rigid, pair.normals.of_a, across) < 0.0);
      pair.hold = held(field, node.id);
      if (pair.hold != PairHold::none || !started_) pair.bond = pair.friction.adhesion * pair.area * dt;
      nodes_.push_back(node);
    }
  }
}

PairHold RigidParticleContact::held(int field, std::uint64_t node) const {
  const auto it = std::lower_bound(held_.begin(), held_.end(), std::pair{field, node},
                                   [](const Held& one, const std::pair<int, std::uint64_t>& wanted) {
                                     return std::tie(one.field, one.node) < std::tie(wanted.first, wanted.second);
                                   });
  return it != held_.end() && it->field == field && it->node == node ? it->hold : PairHold::none;
}

void RigidParticleContact::act(Node& node, Vec3& velocity, double dt) {
  two_[0] = node.material;
  two_[0].velocity = velocity;
  two_[1] = node.rigid;
  one_[0] = node.pair;
  one_[0].on_a.setZero();
  one_[0].on_b.setZero();
  solve_contact(two_, one_, dt);
  velocity = two_[0].velocity;
}

void RigidParticleContact::before_strain(StepContext& context) {
  for (Node& node : nodes_) {
    Grid& grid = *fields_[node.field];
    const Vec3 before = nodal_vector(grid.velocity, grid.layout, node.ref);
    Vec3 after = before;
    const double bond = node.pair.bond;
    node.pair.keep = node.pair.hold;
    node.pair.bond = 0.0;
    act(node, after, context.dt);
    node.pair.keep = PairHold::none;
    node.pair.bond = bond;
    add_nodal_vector(grid.velocity, grid.layout, node.ref, after - before);
  }
}

void RigidParticleContact::momentum_updated(StepContext& context) {
  held_.clear();
  for (Node& node : nodes_) {
    Grid& grid = *fields_[node.field];
    const Vec3 before = nodal_vector(grid.velocity, grid.layout, node.ref);
    Vec3 after = before;
    const Vec3 start = nodal_vector(grid.momentum, grid.layout, node.ref) / node.material.mass - node.rigid.velocity;
    const Vec3 slip = held_slip(start, node.pair.normals.of_a, node.pair.hold);
    act(node, after, context.dt);
    node.pair.hold = one_[0].hold;
    if (node.pair.hold == PairHold::none) continue;
    held_.push_back({node.field, node.id, node.pair.hold});
    add_nodal_vector(grid.velocity, grid.layout, node.ref, after - before);
    add_nodal_vector(grid.force, grid.layout, node.ref, (after - before) / context.dt);
    ledger_.give({node.material.mass * (after - before), -node.pair.normals.of_a, node.arm, node.rigid.velocity,
                  0.5 * (slip + after - node.rigid.velocity)});
  }
  started_ = true;
}

void RigidParticleContact::velocity_found(StepContext&) {
  for (const Node& node : nodes_) {
    Grid& grid = *fields_[node.field];
    const Vec3 relative = nodal_vector(grid.increment, grid.layout, node.ref) - node.rigid.velocity;
    add_nodal_vector(grid.increment, grid.layout, node.ref,
                     -kept_part(relative, node.pair.normals.of_a, node.pair.hold));
  }
}

void RigidParticleContact::increment_found(StepContext&) {
  for (const Node& node : nodes_) {
    Grid& grid = *fields_[node.field];
    const Vec3 change =
        -kept_part(nodal_vector(grid.increment, grid.layout, node.ref), node.pair.normals.of_a, node.pair.hold);
    add_nodal_vector(grid.increment, grid.layout, node.ref, change);
    ledger_.give({node.material.mass * change, -node.pair.normals.of_a, node.arm, node.rigid.velocity});
  }
}

void RigidParticleContact::grid_advanced(StepContext& context) {
  double area = 0.0;
  for (const Node& node : nodes_) {
    if (node.pair.hold != PairHold::none) area += node.pair.area;
  }
  ledger_.end_step(context.dt, static_cast<int>(held_.size()), area);
}

void RigidParticleContact::serialise(StateArchive& archive) {
  archive.value("started", started_);
  archive.rows("held", held_);
  archive.column("held/field", held_, &Held::field);
  archive.column("held/node", held_, &Held::node);
  archive.column("held/hold", held_, &Held::hold);
  ledger_.serialise(archive);
}

}  // namespace mpm
