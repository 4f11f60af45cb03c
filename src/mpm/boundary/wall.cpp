#include "mpm/boundary/wall.hpp"

#include <utility>

#include "mpm/step/device.hpp"

namespace mpm {

Wall::Wall(int face, const WallDefinition& definition, const std::string& name, const Vec3& gravity, int threads,
           HeatSink* heat)
    : face_(face), definition_(definition), gravity_(gravity), threads_(threads), heat_(heat) {
  account_.name = "wall/" + name;
}

Vec3 Wall::normal(const GridLayout& layout) const {
  return Vec3::Unit(layout.axis(face_ / 2)) * (face_ % 2 == 0 ? 1.0 : -1.0);
}

ContactChange Wall::change(const Vec3& velocity, const Vec3& normal) const {
  switch (definition_.kind) {
    case WallKind::fixed:
      return {-velocity, Hold::stick};
    case WallKind::slip:
    case WallKind::symmetry:
      return {-velocity.dot(normal) * normal, Hold::slide};
    case WallKind::frictional:
      return contact_change(velocity, normal, definition_.friction);
    case WallKind::none:
    case WallKind::absorbing:
    case WallKind::periodic:
      break;
  }
  return {Vec3::Zero(), Hold::free};
}

void Wall::momentum_gathered(FieldContext& context) {
  acted_ = false;
  find_nodes(context.grid);
  carrying_.clear();
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (context.grid.carries(nodes_[i].ref.block, nodes_[i].ref.node)) {
      carrying_.push_back(static_cast<std::uint32_t>(i));
      nodes_[i].removed.setZero();
    } else {
      nodes_[i].hold = Hold::free;
    }
  }
}

void Wall::find_nodes(const Grid& grid) {
  const BlockTable& blocks = grid.blocks;
  if (generation_ == blocks.generation()) return;
  generation_ = blocks.generation();
  nodes_.clear();
  const GridLayout& layout = grid.layout;
  const int axis = face_ / 2;
  const bool upper = face_ % 2 == 1;
  for (int b = 0; b < blocks.size(); ++b) {
    const int first = blocks.block(b)[axis] * kBlockEdge;
    if (upper ? first + kBlockEdge <= layout.last_node(axis) : first > 0) continue;
    for (int n = 0; n < layout.nodes_per_block(); ++n) {
      // A centre is half a cell beyond the face at most, and reaches one node beyond it; of a deformed domain, two.
      const int node = layout.node(blocks.block(b), n)[axis];
      const int beyond = upper ? node - layout.last_node(axis) : -node;
      if (beyond >= 0 && beyond <= grid.wall_layers) {
        const std::uint64_t id = HeldNodes::id(blocks.key(b), n);
        nodes_.push_back({{b, n}, id, held_.find(id), grid.counts(b)});
      }
    }
  }
  if (!always_holds()) losses_.assign(nodes_.size(), {});
  if (heat_ != nullptr) rubbed_.assign(nodes_.size(), 0.0);
  held_.reserve(nodes_.size());
  deeds_.reserve(nodes_.size());
  carrying_.reserve(nodes_.size());
}

std::pair<int, int> Wall::held_axes(const GridLayout& layout) const {
  if (definition_.kind == WallKind::fixed) return {0, layout.dim()};
  return {face_ / 2, face_ / 2 + 1};
}

void Wall::hold_up(Node& node, const FieldContext& context, const Vec3& impulse, Hold before, SurfaceLoss& loss) const {
  const Grid& grid = context.grid;
  const auto [first, end] = held_axes(grid.layout);
  const double mass = grid.mass.at(node.ref.block, 0, node.ref.node);
  for (int k = first; k < end; ++k) {
    const int axis = grid.layout.axis(k);
    const AxisLoss taken =
        axis_loss(mass, grid.momentum.at(node.ref.block, k, node.ref.node), mass * context.dt * gravity_[axis],
                  impulse[axis], node.removed[k], before != Hold::free, context.strain_at_start);
    node.at_end[k] = taken.at_end;
    loss.held += taken.taken;
  }
}

void Wall::before_strain(FieldContext& context) {
  Grid& grid = context.grid;
  if (always_holds()) {
    const auto [begin, end] = held_axes(grid.layout);
    const int first = begin, last = end;
    each_node([&, first, last](std::size_t i, Deeds& deeds) {
      Node& node = nodes_[i];
      for (int k = first; k < last; ++k) {
        double& velocity = grid.velocity.at(node.ref.block, k, node.ref.node);
        if (acted_) {
          deeds.loss.held -= node.at_end[k] * velocity;
        } else {
          node.removed[k] += velocity;
        }
        velocity = 0.0;
      }
    });
    return;
  }
  const Vec3 n = normal(grid.layout);
  each_node([&](std::size_t i, Deeds& deeds) {
    const Node& node = nodes_[i];
    const Vec3 velocity = nodal_vector(grid.velocity, grid.layout, node.ref);
    const Vec3 change = strain_change(velocity, n, definition_.friction, node.hold);
    const SurfaceLoss loss = losses_[i].strain(velocity, change);
    deeds.loss += loss;
    if (heat_ != nullptr) rubbed_[i] += loss.friction;
    add_nodal_vector(grid.velocity, grid.layout, node.ref, change);
  });
  tell_of_heat(context);
}

void Wall::act(std::size_t i, FieldContext& context, const Vec3& n, Deeds& deeds) {
  Grid& grid = context.grid;
  Node& node = nodes_[i];
  const Hold held = std::exchange(node.hold, Hold::free);
  if (!acted_) node.at_end.setZero();
  const Vec3 velocity = nodal_vector(grid.velocity, grid.layout, node.ref);
  const auto [dv, hold] = change(velocity, n);
  node.hold = hold;
  const double mass = grid.mass.at(node.ref.block, 0, node.ref.node);
  if (always_holds()) {
    if (!acted_) hold_up(node, context, mass * dv, held, deeds.loss);
  } else {
    const Vec3 start = nodal_vector(grid.momentum, grid.layout, node.ref) / mass;
    if (context.strain_at_start == 0.0) losses_[i].strain(start, strain_change(start, n, definition_.friction, held));
    const SurfaceLoss loss = losses_[i].act({mass, n, mass * context.dt * gravity_, mass * dv, start, velocity + dv,
                                             held != Hold::free, context.strain_at_start});
    deeds.loss += loss;
    if (heat_ != nullptr) rubbed_[i] += loss.friction;
  }
  if (hold == Hold::free) return;
  add_nodal_vector(grid.velocity, grid.layout, node.ref, dv);
  add_nodal_vector(grid.force, grid.layout, node.ref, dv / context.dt);
  deeds.given += mass * dv;
}

void Wall::momentum_updated(FieldContext& context) {
  const Vec3 n = normal(context.grid.layout);
  each_node([&](std::size_t i, Deeds& deeds) { act(i, context, n, deeds); });
  tell_of_heat(context);
  held_.clear();
  // Keeps how the wall held: for one that always holds this decides with USF alone, in hold_up().
  if (!always_holds() || context.strain_at_start == 1.0) {
    for (const std::uint32_t i : carrying_) {
      if (nodes_[i].hold != Hold::free) held_.add(nodes_[i].id, nodes_[i].hold);
    }
  }
  acted_ = true;
}

void Wall::tell_of_heat(const FieldContext& context) {
  if (heat_ == nullptr || always_holds()) return;
  for (const std::uint32_t i : carrying_) {
    heat_->rub(nullptr, context.grid, nodes_[i].id, std::exchange(rubbed_[i], 0.0), context.dt);
  }
}

void Wall::velocity_found(FieldContext& context) {
  NodalField& velocity = context.grid.increment;
  const GridLayout& layout = context.grid.layout;
  const Vec3 n = normal(layout);
  for (const std::uint32_t i : carrying_) {
    const Node& node = nodes_[i];
    add_nodal_vector(velocity, layout, node.ref, held_part(nodal_vector(velocity, layout, node.ref), n, node.hold));
  }
}

void Wall::increment_found(FieldContext& context) {
  Grid& grid = context.grid;
  const Vec3 n = normal(grid.layout);
  for (const std::uint32_t i : carrying_) {
    const Node& node = nodes_[i];
    const Vec3 change = held_part(nodal_vector(grid.increment, grid.layout, node.ref), n, node.hold);
    add_nodal_vector(grid.increment, grid.layout, node.ref, change);
    if (node.counts) given_ += grid.mass.at(node.ref.block, 0, node.ref.node) * change;
  }
}

void Wall::count(Device& device) {
  const Device::OfWall now = device.take_wall(face_);
  account_.impulse += now.given.impulse;
  account_.exchanged += now.given.exchanged;
  loss_ += now.loss;
}

void Wall::learn(const Device& device) { held_ = device.held(face_); }

void Wall::teach(Device& device) const { device.hold(face_, held_); }

void Wall::grid_advanced(FieldContext&) {
  account_.add(given_);
  given_ = Vec3::Zero();
}

}  // namespace mpm
