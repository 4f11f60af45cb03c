#include "mpm/contact/rigid_contact.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mpm/loop/loop.hpp"

namespace mpm {
namespace {

// Part of a cell within which a node counts as lying on the surface: keeps aligned surfaces from flickering by
// round-off. The same part of a cell from the axis is on it.
constexpr double kOnSurface = 1e-6;
constexpr double kThrough = 3.0;  ///< cells behind a thin tool that material before it may reach

}  // namespace

RigidContact::RigidContact(const RigidBody& body, Fields& fields, int threads, GeometryKind geometry,
                           const ToolSides* sides, const Vec3& gravity, HeatSink* heat)
    : body_(body),
      fields_(fields),
      threads_(threads),
      axisymmetric_(axisymmetric(geometry)),
      gravity_(gravity),
      sides_(sides),
      thin_(sides == nullptr ? nullptr : sides->find(body)),
      held_(fields.size()),
      centred_(fields.size(), 0),
      divided_(fields.size(), 0),
      ledger_(body, axisymmetric(geometry)),
      heat_(heat) {}

Vec3 RigidContact::mass_centre(int field, NodeRef node) const {
  const Grid& grid = *fields_[field];
  return nodal_vector(grid.place, grid.layout, node) / grid.mass.at(node.block, 0, node.node);
}

bool RigidContact::touches(int field, NodeRef node, const Vec3& place, double reach, SurfacePoint& point) const {
  const Surface& surface = body_.surface();
  const bool one_sided = thin_ != nullptr && sides_->map().one_sided(field);
  if (!one_sided && divided_[field] == 0) {
    if (!surface.within(body_.pose().to_body(place), reach, point)) return false;
    if (centred_[field] != 0) point.normal = surface.at(body_.pose().to_body(mass_centre(field, node))).normal;
    return true;
  }
  const Vec3 centre = mass_centre(field, node);
  const double farthest = std::max(reach, (centre - place).norm());  // that the tool can be between them
  if (!surface.within(body_.pose().to_body(place), farthest, point)) return false;
  if (point.distance > reach && !thin_->between(centre, place)) return false;
  point = surface.at(body_.pose().to_body(centre));
  // Pressed past the middle of the tool, it is still to be pushed out where it came from.
  if (one_sided && point.distance < 0.0 && thin_->side(centre) != sides_->map().side(field))
    point.normal = -point.normal;
  return true;
}

void RigidContact::momentum_gathered(StepContext& context) {
  const GridLayout& layout = context.layout();
  const double on_surface = kOnSurface * layout.smallest_cell();
  const double reach = on_surface + body_.reach() * layout.smallest_cell();
  // Nodes that a field reaches through a thin tool are no farther from their mass centres, along each axis.
  const double through = thin_ == nullptr ? 0.0 : kThrough * layout.smallest_cell();
  const Box bounds = body_.world_bounds().grown(std::max(reach, through));

  near_.clear();
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    const BlockTable& blocks = fields_[f]->blocks;
    for (int b = 0; b < blocks.size(); ++b) {
      const Box block{layout.node_position(blocks.block(b), 0),
                      layout.node_position(blocks.block(b), layout.nodes_per_block() - 1)};
      if (block.intersects(bounds)) near_.push_back({static_cast<int>(f), b});
    }
  }
  while (nodes_.size() < near_.size()) nodes_.emplace_back().reserve(layout.nodes_per_block());

  const int count = static_cast<int>(near_.size());
  for_unlike("contact: nodes near a rigid body", threads_, count, [&](int i) {
    const auto [field, block] = near_[i];
    const Grid& grid = *fields_[field];
    nodes_[i].clear();
    for (int n = 0; n < layout.nodes_per_block(); ++n) {
      if (!grid.carries(block, n)) continue;
      const Vec3 position = layout.node_position(grid.blocks.block(block), n);
      SurfacePoint point;
      if (!touches(field, {block, n}, position, reach, point)) continue;
      Vec3 normal = body_.pose().orientation * point.normal;
      if (axisymmetric_ && std::abs(position.x()) <= on_surface) {
        if (std::abs(normal.z()) <= kOnSurface) continue;  // all of it was radial
        normal = {0.0, 0.0, std::copysign(1.0, normal.z())};
      }
      nodes_[i].push_back({field,
                           {block, n},
                           normal,
                           body_.velocity_at(position),
                           position - body_.pose().position,
                           held_[field].find(HeldNodes::id(grid.blocks.key(block), n)),
                           {}});
    }
  });
}

template <class Visit>
void RigidContact::each_node(Visit&& visit) {
  for (std::size_t i = 0; i < near_.size(); ++i) {
    for (Node& node : nodes_[i]) visit(node, *fields_[node.field]);
  }
}

void RigidContact::before_strain(StepContext& context) {
  each_node([&](Node& node, Grid& grid) {
    const Vec3 relative = nodal_vector(grid.velocity, grid.layout, node.ref) - node.velocity;
    const Vec3 change = strain_change(relative, node.normal, body_.friction(), node.hold);
    add_nodal_vector(grid.velocity, grid.layout, node.ref, change);
    lose(node, grid, node.loss.strain(relative, change), context.dt);
  });
}

void RigidContact::momentum_updated(StepContext& context) {
  int touching = 0;
  for (HeldNodes& held : held_) held.clear();
  each_node([&](Node& node, Grid& grid) {
    const Vec3 relative = nodal_vector(grid.velocity, grid.layout, node.ref) - node.velocity;
    const auto [change, hold] = contact_change(relative, node.normal, body_.friction());
    const Hold held = std::exchange(node.hold, hold);
    const double mass = grid.mass.at(node.ref.block, 0, node.ref.node);
    const Vec3 start = nodal_vector(grid.momentum, grid.layout, node.ref) / mass - node.velocity;
    if (context.strain_at_start == 0.0) {
      node.loss.strain(start, strain_change(start, node.normal, body_.friction(), held));
    }
    lose(node, grid,
         node.loss.act({mass, node.normal, mass * context.dt * gravity_, mass * change, start, relative + change,
                        held != Hold::free, context.strain_at_start}),
         context.dt);
    if (hold == Hold::free) return;
    held_[node.field].add(HeldNodes::id(grid.blocks.key(node.ref.block), node.ref.node), hold);
    add_nodal_vector(grid.velocity, grid.layout, node.ref, change);
    add_nodal_vector(grid.force, grid.layout, node.ref, change / context.dt);
    give(node, mass * change);
    ++touching;
  });
  touching_ = touching;
}

void RigidContact::velocity_found(StepContext&) {
  each_node([&](const Node& node, Grid& grid) {
    const Vec3 relative = nodal_vector(grid.increment, grid.layout, node.ref) - node.velocity;
    add_nodal_vector(grid.increment, grid.layout, node.ref, held_part(relative, node.normal, node.hold));
  });
}

void RigidContact::increment_found(StepContext&) {
  each_node([&](const Node& node, Grid& grid) {
    const Vec3 change = held_part(nodal_vector(grid.increment, grid.layout, node.ref), node.normal, node.hold);
    add_nodal_vector(grid.increment, grid.layout, node.ref, change);
    give(node, grid.mass.at(node.ref.block, 0, node.ref.node) * change);
  });
}

void RigidContact::lose(const Node& node, const Grid& grid, const SurfaceLoss& loss, double dt) {
  ledger_.add_loss(loss);
  if (heat_ == nullptr) return;
  heat_->rub(&body_, grid, HeldNodes::id(grid.blocks.key(node.ref.block), node.ref.node), loss.friction, dt);
}

void RigidContact::give(const Node& node, const Vec3& impulse) {
  ledger_.give({impulse, node.normal, node.arm, node.velocity});
}

void RigidContact::grid_advanced(StepContext& context) { ledger_.end_step(context.dt, touching_, 0.0); }

void RigidContact::serialise(StateArchive& archive) {
  for (std::size_t f = 0; f < held_.size(); ++f) {
    const StateArchive::Group group(archive, "field_" + std::to_string(f));
    held_[f].serialise(archive);
  }
  ledger_.serialise(archive);
}

}  // namespace mpm
