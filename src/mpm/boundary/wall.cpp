#include "mpm/boundary/wall.hpp"

#include "mpm/step/coulomb.hpp"

namespace mpm {

Wall::Wall(int face, const WallDefinition& definition, const std::string& name) : face_(face), definition_(definition) {
  account_.name = "wall/" + name;
}

Vec3 Wall::normal(const GridLayout& layout) const {
  return Vec3::Unit(layout.axis(face_ / 2)) * (face_ % 2 == 0 ? 1.0 : -1.0);
}

Vec3 Wall::change(const Vec3& velocity, const Vec3& normal) const {
  switch (definition_.kind) {
    case WallKind::fixed:
      return -velocity;
    case WallKind::slip:
      return -velocity.dot(normal) * normal;
    case WallKind::frictional:
      return contact_velocity_change(velocity, normal, definition_.friction);
    case WallKind::none:
      break;
  }
  return Vec3::Zero();
}

void Wall::momentum_gathered(StepContext& context) {
  const BlockTable& blocks = context.grid.blocks;
  if (generation_ == blocks.generation()) return;
  generation_ = blocks.generation();
  nodes_.clear();
  const GridLayout& layout = context.grid.layout;
  const int axis = face_ / 2;
  const bool upper = face_ % 2 == 1;
  for (int b = 0; b < blocks.size(); ++b) {
    const int first = blocks.block(b)[axis] * kBlockEdge;
    if (upper ? first + kBlockEdge <= layout.last_node(axis) : first > 0) continue;
    for (int n = 0; n < layout.nodes_per_block(); ++n) {
      const int node = layout.node(blocks.block(b), n)[axis];
      if (upper ? node >= layout.last_node(axis) : node <= 0) nodes_.push_back({b, n});
    }
  }
}

void Wall::before_strain(StepContext& context) {
  Grid& grid = context.grid;
  const Vec3 n = normal(grid.layout);
  for (const NodeRef& node : nodes_) {
    add_nodal_vector(grid.velocity, grid.layout, node, change(nodal_vector(grid.velocity, grid.layout, node), n));
  }
}

void Wall::momentum_updated(StepContext& context) {
  Grid& grid = context.grid;
  const Vec3 n = normal(grid.layout);
  Vec3 given = Vec3::Zero();
  for (const NodeRef& node : nodes_) {
    const double mass = grid.mass.at(node.block, 0, node.node);
    if (!(mass > 0.0)) continue;
    const Vec3 dv = change(nodal_vector(grid.velocity, grid.layout, node), n);
    add_nodal_vector(grid.velocity, grid.layout, node, dv);
    add_nodal_vector(grid.force, grid.layout, node, dv / context.dt);
    given += mass * dv;
  }
  account_.add(given);
}

}  // namespace mpm
