#include "mpm/contact/rigid_particles.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mpm {
namespace {

constexpr double kDepth = 3.0;  // below the surface that particles matter [cells]

// Integral of the hat function from -1, and the hat function, of s in [-1, 1].
double hat_integral(double s) { return s < 0.0 ? 0.5 * (1.0 + s) * (1.0 + s) : 0.5 + s - 0.5 * s * s; }
double hat(double s) { return 1.0 - std::abs(s); }

/// uGIMP along one axis: values and gradients [1/cell] at the nodes that a box reaches.
struct Along {
  int first = 0, count = 0;
  std::array<double, 4> s{}, g{};
};
Along along(double cells, double half) {
  Along a;
  a.first = static_cast<int>(std::ceil(cells - half - 1.0));
  for (int node = a.first; node < cells + half + 1.0 && a.count < 4; ++node) {
    const double low = std::clamp(cells - half - node, -1.0, 1.0), high = std::clamp(cells + half - node, -1.0, 1.0);
    a.s[a.count] = (hat_integral(high) - hat_integral(low)) / (2.0 * half);
    a.g[a.count] = (hat(high) - hat(low)) / (2.0 * half);
    ++a.count;
  }
  return a;
}

int block_of(int node) { return node >= 0 ? node / kBlockEdge : (node + 1) / kBlockEdge - 1; }

}  // namespace

RigidParticles::RigidParticles(const RigidBody& body, const GridLayout& layout, GeometryKind geometry, int per_cell,
                               double across)
    : body_(body),
      layout_(layout),
      axisymmetric_(axisymmetric(geometry)),
      start_(body.pose()),
      half_(0.5 / per_cell),
      volume_each_(across),
      volume_(1, layout.nodes_per_block()),
      gradient_(layout.dim(), layout.nodes_per_block()),
      place_(layout.dim(), layout.nodes_per_block()),
      moved_(layout.dim(), layout.nodes_per_block()) {
  const Box bounds = body.surface().bounds();
  std::array<int, 3> count{1, 1, 1};
  Vec3 spacing = Vec3::Zero(), first = Vec3::Zero();
  double largest = 0.0;
  for (int k = 0; k < layout.dim(); ++k) {
    const int axis = layout.axis(k);
    largest = std::max(largest, layout.cell(k));
    spacing[axis] = layout.cell(k) / per_cell;
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
        if (axisymmetric_ && start_.to_world(point).x() < 0.0) continue;
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
  double largest = 0.0;
  for (int k = 0; k < layout_.dim(); ++k) largest = std::max(largest, layout_.cell(k));
  reach = reach.grown(2.0 * largest);
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

void RigidParticles::add(const Vec3& place, const Vec3& moved, const std::vector<std::uint64_t>& keys) {
  const int dim = layout_.dim();
  std::array<Along, 3> axes;
  for (Along& one : axes) one.count = 1, one.s[0] = 1.0;
  for (int k = 0; k < dim; ++k) axes[k] = along(layout_.in_cells(k, place[layout_.axis(k)]), half_);
  std::array<int, 3> step{};
  for (step[0] = 0; step[0] < axes[0].count; ++step[0]) {
    for (step[1] = 0; step[1] < axes[1].count; ++step[1]) {
      for (step[2] = 0; step[2] < axes[2].count; ++step[2]) {
        std::array<int, 3> block{};
        int local = 0;
        double s = volume_each_;
        bool inside = true;
        for (int k = 0; k < dim; ++k) {
          const int node = axes[k].first + step[k];
          block[k] = block_of(node);
          inside = inside && node >= -kBlockEdge && node <= layout_.last_node(k) + kBlockEdge;
          local = local * kBlockEdge + node - block[k] * kBlockEdge;
          s *= axes[k].s[step[k]];
        }
        if (!inside) continue;
        const std::uint64_t key = layout_.key(block);
        const auto it = std::lower_bound(keys.begin(), keys.end(), key);
        if (it == keys.end() || *it != key) continue;
        const int b = static_cast<int>(it - keys.begin());
        volume_.at(b, 0, local) += s;
        for (int k = 0; k < dim; ++k) {
          double g = volume_each_ * layout_.inverse_cell(k);
          for (int other = 0; other < dim; ++other) {
            g *= other == k ? axes[other].g[step[other]] : axes[other].s[step[other]];
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
