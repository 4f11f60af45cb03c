#include "mpm/boundary/axis.hpp"

#include <cmath>

namespace mpm {

void Axis::momentum_gathered(FieldContext& context) {
  const BlockTable& blocks = context.grid.blocks;
  if (generation_ == blocks.generation()) return;
  generation_ = blocks.generation();
  nodes_.clear();
  const GridLayout& layout = context.grid.layout;
  for (int b = 0; b < blocks.size(); ++b) {
    if (blocks.block(b)[0] > 0) continue;
    for (int n = 0; n < layout.nodes_per_block(); ++n) {
      const int beyond = -layout.node(blocks.block(b), n)[0];
      if (beyond < 0 || beyond > kBlockEdge) continue;
      if (beyond > 0 && ghosts_ == AxisGhosts::free) continue;
      Node node{{b, n}, {-1, 0}};
      if (beyond > 0 && ghosts_ == AxisGhosts::mirror) {
        // Within a block the first axis is the slowest.
        node.twin = {blocks.find(layout.key({beyond / kBlockEdge, blocks.block(b)[1], 0})),
                     beyond % kBlockEdge * kBlockEdge + n % kBlockEdge};
      }
      nodes_.push_back(node);
    }
  }
}

double Axis::wanted(const NodalField& velocity, const Node& node) {
  return node.twin.block < 0 ? 0.0 : -velocity.at(node.twin.block, 0, node.twin.node);
}

void Axis::before_strain(FieldContext& context) { hold(context.grid.velocity); }

void Axis::momentum_updated(FieldContext& context) {
  Grid& grid = context.grid;
  for (const Node& node : nodes_) {
    if (!grid.carries(node.ref.block, node.ref.node)) continue;
    double& velocity = grid.velocity.at(node.ref.block, 0, node.ref.node);
    const double change = wanted(grid.velocity, node) - velocity;
    velocity += change;
    grid.force.at(node.ref.block, 0, node.ref.node) += change / context.dt;
    if (grid.counts(node.ref.block)) given_ += grid.mass.at(node.ref.block, 0, node.ref.node) * change;
  }
}

void Axis::velocity_found(FieldContext& context) { hold(context.grid.increment); }

void Axis::hold(NodalField& velocity) const {
  for (const Node& node : nodes_) velocity.at(node.ref.block, 0, node.ref.node) = wanted(velocity, node);
}

void Axis::increment_found(FieldContext& context) {
  Grid& grid = context.grid;
  NodalField& increment = grid.increment;
  for (const Node& node : nodes_) {
    if (!grid.carries(node.ref.block, node.ref.node)) continue;
    double& value = increment.at(node.ref.block, 0, node.ref.node);
    const double change = wanted(increment, node) - value;
    value += change;
    if (grid.counts(node.ref.block)) given_ += grid.mass.at(node.ref.block, 0, node.ref.node) * change;
  }
}

void Axis::grid_advanced(FieldContext&) {
  account_.add(given_ * Vec3::UnitX());
  given_ = 0.0;
}

std::optional<OutsideReason> outside_at_axis(const GridLayout& layout, const ParticleSet& set, int particle) {
  const double r = set.x[0][particle];
  if (!(std::abs(r) < layout.cell(0))) return std::nullopt;
  return OutsideReason{
      "a particle has come to the axis",
      "use method.axis.motion: point, shape cpdi or transfer apic, or lower time.cfl if the run blew up"};
}

void HoopForce::forces_gathered(FieldContext& context) {
  const Grid& grid = context.grid;
  double sum = 0.0;
  for (int b = 0; b < grid.blocks.size(); ++b) {
    if (!grid.counts(b)) continue;
    const double* force = grid.force.block(b);
    for (int n = 0; n < grid.layout.nodes_per_block(); ++n) sum += force[n];
  }
  account_.add(sum * context.dt * Vec3::UnitX());
}

void MasslessNodes::forces_gathered(FieldContext& context) {
  const Grid& grid = context.grid;
  Vec3 lost = Vec3::Zero();
  for (int b = 0; b < grid.blocks.size(); ++b) {
    for (int n = 0; n < grid.layout.nodes_per_block(); ++n) {
      if (grid.carries(b, n) || !grid.counts(b)) continue;
      lost += nodal_vector(grid.force, grid.layout, {b, n}) + grid.mass.at(b, 0, n) * gravity_;
    }
  }
  account_.add(-context.dt * lost);
}

}  // namespace mpm
