// Nodes of the points of contact, and the order in which the points are solved. Sweeps end at a tolerance, so the
// order is seen in their result: it is that in which particles lie in memory, the same on any number of ranks.
#include <algorithm>

#include "mpm/contact/point_solver.hpp"
#include "mpm/loop/loop.hpp"
#include "mpm/shape/spline_weights.hpp"
#include "mpm/step/point_weights.hpp"

namespace mpm {
namespace {

constexpr int kPointsPerThread = 32;  ///< fewer do not pay for the start of a thread

}  // namespace

void PointSolver::find_weights(const std::vector<ContactPoint>& found) {
  const GridLayout& layout = fields_.front()->layout;
  const int along = weights_of_spline(traits_of(shape_).surface_degree), count = static_cast<int>(found.size());
  stride_ = sharp_ ? 2 : 1;  // nodes beyond edges, too
  for (int k = 0; k < layout.dim(); ++k) stride_ *= along;
  found_nodes_.resize(found.size() * stride_);
  found_count_.resize(found.size());
  found_block_.resize(found.size());
  found_at_edge_.resize(found.size());
  for_all("contact: weights of points", std::clamp(count / kPointsPerThread, 1, threads_), count, [&](int i) {
    const MaterialNodes material = nodes_of(found[i]);
    const PointWeights weights(material, shape_, found[i].place);
    PointNode* nodes = &found_nodes_[static_cast<std::size_t>(i) * stride_];
    for (int n = 0; n < weights.count; ++n) {
      const FieldNode& node = weights.node[n];
      nodes[n] = {node.field, node.ref.block * layout.nodes_per_block() + node.ref.node, weights.weight[n],
                  weights.weight[n]};
    }
    const auto [nodes_count, at_edge] =
        sharp_ ? edges_.apply(found[i], material, nodes, weights.count) : EdgeCover::Nodes{weights.count, false};
    found_at_edge_[i] = at_edge;
    // That of the nearest node, as of a particle: blocks of one colour then share no node (but see
    // sweep_prescribed() for cubic splines).
    std::array<int, 3> block{};
    for (int k = 0; k < layout.dim() && nodes_count > 0; ++k) {
      const int node = GridLayout::nearest(layout.in_cells(k, found[i].place[layout.axis(k)]));
      block[k] = (node + kBlockEdge) / kBlockEdge - 1;
    }
    found_block_[i] = nodes_count > 0 ? material.grid().blocks.find(layout.key(block)) : -1;
    found_count_[i] = found_block_[i] < 0 ? 0 : nodes_count;
  });
}

MaterialNodes PointSolver::nodes_of(const ContactPoint& point) const {
  if (sides_ == nullptr || point.chooser < 0) return {fields_, point.field};
  return {fields_, point.field, *sides_, point.chooser, point.centre};
}

void PointSolver::cluster(const std::vector<ContactPoint>& found) {
  cluster_of_.resize(fields_.size());
  for (std::size_t f = 0; f < fields_.size(); ++f) cluster_of_[f].resize(fields_[f]->blocks.size(), -1);
  unsorted_.clear();
  of_point_.assign(found.size(), -1);
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found_count_[i] == 0) continue;
    int& place = cluster_of_[found[i].field][found_block_[i]];
    if (place < 0) {
      place = static_cast<int>(unsorted_.size());
      const std::array<int, 3>& block = fields_[found[i].field]->blocks.block(found_block_[i]);
      const int colour = (block[0] & 1) | (block[1] & 1) << 1 | (block[2] & 1) << 2;
      unsorted_.push_back({found[i].field, found_block_[i], colour, 0, 0});
    }
    of_point_[i] = place;
    ++unsorted_[place].end;  // counts, so far
  }
  clusters_.clear();
  int points = 0;
  for (int colour = 0; colour < 8; ++colour) {
    colour_begin_[colour] = static_cast<int>(clusters_.size());
    for (Cluster& one : unsorted_) {
      if (one.colour != colour) continue;
      cluster_of_[one.field][one.block] = -1;
      one.first = points;
      points += one.end;
      one.end = one.first;
      clusters_.push_back({one.field, one.block, colour, one.first, points});
    }
  }
  colour_begin_[8] = static_cast<int>(clusters_.size());
  order_.resize(points);
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (of_point_[i] >= 0) order_[unsorted_[of_point_[i]].end++] = static_cast<int>(i);
  }
}

void PointSolver::add(const ContactPoint& contact, int found) {
  Point point;
  point.normal = contact.normal;
  point.velocity = contact.velocity;
  point.place = contact.place;
  point.found = found;
  point.body = contact.body;
  point.at_edge = found_at_edge_[found] != 0;
  any_at_edge_ = any_at_edge_ || point.at_edge;
  point.first = static_cast<int>(parts_.size());
  const int per_block = fields_.front()->layout.nodes_per_block();
  const auto ref_of = [per_block](int node) { return NodeRef{node / per_block, node % per_block}; };
  const PointNode* nodes = &found_nodes_[static_cast<std::size_t>(found) * stride_];
  for (int n = 0; n < found_count_[found]; ++n) {
    const PointNode& node = nodes[n];
    int& slot = slot_[node.field][node.node];
    if (slot < 0) {
      slot = static_cast<int>(nodes_.size());
      const NodeRef ref = ref_of(node.node);
      nodes_.push_back({{}, 1.0 / fields_[node.field]->mass.at(ref.block, 0, ref.node)});
      origins_.push_back({node.field, ref, {}});
    }
    parts_.push_back({slot, node.weight, node.reading});
    if (node.start != 0.0) starts_.push_back({static_cast<int>(points_.size()), slot, node.start});
    point.compliance += node.reading * (node.weight * nodes_[slot].inverse_mass);
  }
  point.end = static_cast<int>(parts_.size());
  points_.push_back(point);
}

void PointSolver::connect(const std::vector<ContactPoint>& found) {
  find_weights(found);
  cluster(found);
  const int per_block = fields_.front()->layout.nodes_per_block();
  slot_.resize(fields_.size());
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    slot_[f].resize(static_cast<std::size_t>(fields_[f]->blocks.size()) * per_block, -1);
  }
  any_at_edge_ = false;
  points_.clear();
  parts_.clear();
  starts_.clear();
  nodes_.clear();
  origins_.clear();
  for (const int i : order_) add(found[i], i);
  for (const NodeOrigin& origin : origins_) slot_[origin.field][origin.ref.block * per_block + origin.ref.node] = -1;
}

}  // namespace mpm
