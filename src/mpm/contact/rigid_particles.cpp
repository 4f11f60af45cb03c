#include "mpm/contact/rigid_particles.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mpm {
namespace {

constexpr double kDepth = 3.0;  // below the surface that particles matter [cells]

int block_of(int node) { return node >= 0 ? node / kBlockEdge : (node + 1) / kBlockEdge - 1; }

}  // namespace

RigidParticles::RigidParticles(const RigidBody& body, const Grid& grid, GeometryKind geometry, int per_cell,
                               double across)
    : body_(body),
      grid_(grid),
      layout_(grid.layout),
      axisymmetric_(axisymmetric(geometry)),
      start_(body.pose()),
      half_(0.5 / per_cell),
      volume_each_(across),
      volume_(1, layout_.nodes_per_block()),
      gradient_(layout_.dim(), layout_.nodes_per_block()),
      place_(layout_.dim(), layout_.nodes_per_block()),
      moved_(layout_.dim(), layout_.nodes_per_block()) {
  const Box bounds = body.surface().bounds();
  std::array<int, 3> count{1, 1, 1};
  Vec3 spacing = Vec3::Zero(), first = Vec3::Zero();
  const double largest = layout_.largest_cell();
  for (int k = 0; k < layout_.dim(); ++k) {
    const int axis = layout_.axis(k);
    spacing[axis] = layout_.cell(k) / per_cell;
    volume_each_ *= spacing[axis];
    const double length = bounds.max[axis] - bounds.min[axis];
    if (!std::isfinite(length)) {
      throw RigidError(
          fmt::format("rigid body '{}' has no end along {}, so it cannot be filled with particles; give it "
                      "one, or normals: surface",
                      body.name(), "xyz"[axis]));
    }
    count[axis] = std::max(1, static_cast<int>(std::round(length / spacing[axis])));
    // In the middle of the bounds: what is left over is shared by both sides.
    first[axis] = 0.5 * (bounds.min[axis] + bounds.max[axis] - (count[axis] - 1) * spacing[axis]);
  }
  for (int i = 0; i < count[0]; ++i) {
    for (int j = 0; j < count[1]; ++j) {
      for (int k = 0; k < count[2]; ++k) {
        const Vec3 point = first + spacing.cwiseProduct(Vec3(i, j, k));
        const double distance = body.surface().at(point).distance;
        if (distance < 0.0 && distance > -kDepth * largest) local_.push_back(point);
      }
    }
  }
  if (local_.empty()) {
    throw RigidError(
        fmt::format("rigid body '{}' is thinner than the distance of particles, so none fills it; use a "
                    "finer grid.cell, or normals: surface",
                    body.name()));
  }
}

void RigidParticles::gather(const std::vector<std::uint64_t>& keys) {
  const int blocks = static_cast<int>(keys.size()), nodes = layout_.nodes_per_block();
  for (NodalField* field : {&volume_, &gradient_, &place_, &moved_}) {
    field->resize(blocks);
    std::fill_n(field->data(), static_cast<std::ptrdiff_t>(blocks) * field->components() * nodes, 0.0);
  }
  Box reach;
  for (const std::uint64_t key : keys) {
    reach.add(layout_.node_position(layout_.block(key), 0));
    reach.add(layout_.node_position(layout_.block(key), nodes - 1));
  }
  reach = reach.grown(2.0 * layout_.largest_cell());
  for (const Vec3& local : local_) {
    const Vec3 place = body_.pose().to_world(local);
    bool near = true;
    for (int k = 0; k < layout_.dim(); ++k) {
      const int axis = layout_.axis(k);
      near = near && place[axis] >= reach.min[axis] && place[axis] <= reach.max[axis];
    }
    if (near) add(place, place - start_.to_world(local), keys);
  }
}

std::optional<RigidParticles::Along> RigidParticles::along(int k, double cells) const {
  const int nearest = GridLayout::nearest(cells);
  const double offset = cells - nearest;
  double below = offset - half_, above = offset + half_;
  if (grid_.mirrors[2 * k]) below = std::max(below, 0.0 - nearest);
  if (grid_.mirrors[2 * k + 1]) above = std::min<double>(above, layout_.last_node(k) - nearest);
  if (above <= below) return std::nullopt;
  const bool radial = axisymmetric_ && k == 0;
  const double radius = radial ? nearest + layout_.origin(0) * layout_.inverse_cell(0) : 1.0;  // not read in a plane
  return Along{nearest - 1, (above - below) / (2.0 * half_), nearest + 0.5 * (below + above),
               RadialBox<double>(offset, radius, below, above, layout_.inverse_cell(k), !radial)};
}

void RigidParticles::add(const Vec3& particle, const Vec3& moved, const std::vector<std::uint64_t>& keys) {
  const int dim = layout_.dim();
  std::array<std::optional<Along>, 3> axes;
  Vec3 place = particle;
  double left = volume_each_;
  for (int k = 0; k < dim; ++k) {
    axes[k] = along(k, layout_.in_cells(k, particle[layout_.axis(k)]));
    if (!axes[k]) return;
    place[layout_.axis(k)] = layout_.origin(k) + axes[k]->middle * layout_.cell(k);
    left *= axes[k]->part;
  }
  std::array<int, 3> step{};
  const auto nodes = [dim](int k) { return k < dim ? 3 : 1; };
  for (step[0] = 0; step[0] < nodes(0); ++step[0]) {
    for (step[1] = 0; step[1] < nodes(1); ++step[1]) {
      for (step[2] = 0; step[2] < nodes(2); ++step[2]) {
        std::array<int, 3> block{};
        int local = 0;
        double s = left;
        bool inside = true;
        for (int k = 0; k < dim; ++k) {
          const int node = axes[k]->first + step[k];
          block[k] = block_of(node);
          inside = inside && node >= -kBlockEdge && node <= layout_.last_node(k) + kBlockEdge;
          local = local * kBlockEdge + node - block[k] * kBlockEdge;
          s *= axes[k]->of.s[step[k]];
        }
        if (!inside || !(s > 0.0)) continue;
        const std::uint64_t key = layout_.key(block);
        const auto it = std::lower_bound(keys.begin(), keys.end(), key);
        if (it == keys.end() || *it != key) continue;
        const int b = static_cast<int>(it - keys.begin());
        volume_.at(b, 0, local) += s;
        for (int k = 0; k < dim; ++k) {
          double g = left;
          for (int other = 0; other < dim; ++other) {
            g *= other == k ? axes[other]->of.g[step[other]] : axes[other]->of.s[step[other]];
          }
          gradient_.at(b, k, local) += g;
          place_.at(b, k, local) += s * place[layout_.axis(k)];
          moved_.at(b, k, local) += s * moved[layout_.axis(k)];
        }
      }
    }
  }
}

Vec3 RigidParticles::gradient(int block, int node) const {
  Vec3 v = Vec3::Zero();
  for (int k = 0; k < layout_.dim(); ++k) v[layout_.axis(k)] = gradient_.at(block, k, node);
  return v;
}

Vec3 RigidParticles::position(int block, int node) const {
  Vec3 v = Vec3::Zero();
  for (int k = 0; k < layout_.dim(); ++k) v[layout_.axis(k)] = place_.at(block, k, node) / volume(block, node);
  return v;
}

Vec3 RigidParticles::displacement(int block, int node) const {
  Vec3 v = Vec3::Zero();
  for (int k = 0; k < layout_.dim(); ++k) v[layout_.axis(k)] = moved_.at(block, k, node) / volume(block, node);
  return v;
}

}  // namespace mpm
