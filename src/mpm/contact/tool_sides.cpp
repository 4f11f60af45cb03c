#include "mpm/contact/tool_sides.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mpm/particles/for_particles.hpp"

namespace mpm {
namespace {

/// A particle this near to a tool's surface goes by it: shape functions of both sides meet no farther out [cells].
constexpr double kBand = 3.5;
constexpr double kTravel = 0.25;  ///< part of a cell between two looks at the sides
/// Part of half a particle's box: a centre nearer to the surface than this, or in the tool, keeps its side.
constexpr double kPressed = 0.5;
/// Particles that give to the same node as one in the band, and how far they may have left their block [cells].
constexpr double kReach = 6.0;

double half_diagonal(const GridLayout& layout) {
  double squared = 0.0;
  for (int k = 0; k < layout.dim(); ++k) squared += std::pow(0.5 * (kBlockEdge - 1) * layout.cell(k), 2);
  return std::sqrt(squared);
}

Vec3 middle_of(const GridLayout& layout, const std::array<int, 3>& block) {
  return 0.5 * (layout.node_position(block, 0) + layout.node_position(block, layout.nodes_per_block() - 1));
}

}  // namespace

void ToolSides::before_sort() {
  if (std::exchange(kept_, false) && labelled_) return;
  travelled_ = 0.0;
  for (ThinTool& tool : tools_) tool.aim();
  const double largest = layout_.largest_cell();
  for (ParticleSet& set : sets_) {
    if (set.side.empty() || set.chooses) continue;
    double half = std::numeric_limits<double>::infinity();
    for (int k = 0; k < layout_.dim(); ++k) half = std::min(half, set.half[k] * layout_.cell(k));
    for_particles("contact: sides of thin tools", set, threads_, [&](int p) {  // near a tool nothing sleeps
      Vec3 place = Vec3::Zero();
      for (int k = 0; k < layout_.dim(); ++k) place[layout_.axis(k)] = set.x[k][p];
      double band = kBand * largest;
      const ThinTool* nearest = nullptr;
      for (const ThinTool& tool : tools_) {
        SurfacePoint found;
        if (!tool.within(place, band, found)) continue;
        band = found.distance;
        nearest = &tool;
      }
      if (nearest != nullptr && labelled_ && band < kPressed * half) return;
      set.side[p] = static_cast<std::uint8_t>(nearest == nullptr ? 0 : nearest->side(place));
    });
  }
  labelled_ = true;
}

void ToolSides::body_put(const RigidBody& body) {
  if (find(body) == nullptr) return;
  labelled_ = false;
  travelled_ = std::numeric_limits<double>::infinity();
}

bool ToolSides::needs_sort() const { return travelled_ > kTravel * layout_.smallest_cell(); }

bool ToolSides::apart(const Grid& first, NodeRef of_first, const Grid& second, NodeRef of_second) const {
  const Vec3 node = layout_.node_position(first.blocks.block(of_first.block), of_first.node);
  SurfacePoint found;
  for (const ThinTool& tool : tools_) {
    if (!tool.within(node, kBand * layout_.largest_cell(), found)) continue;  // farther than what shares a node
    const Vec3 from = nodal_vector(first.place, layout_, of_first) / first.mass.at(of_first.block, 0, of_first.node);
    const Vec3 to = nodal_vector(second.place, layout_, of_second) / second.mass.at(of_second.block, 0, of_second.node);
    // The line between the centres does not leave this ball.
    const double radius = std::max((from - node).norm(), (to - node).norm());
    if (found.distance <= radius && tool.between(from, to)) return true;
  }
  return false;
}

bool ToolSides::near(const Vec3& point, double radius) const {
  const double largest = layout_.largest_cell();
  SurfacePoint found;
  return std::any_of(tools_.begin(), tools_.end(), [&](const ThinTool& tool) {
    return tool.within(point, radius + (kBand + kReach) * largest, found);
  });
}

const ThinTool* ToolSides::find(const RigidBody& body) const {
  const auto own = [&](const ThinTool& tool) { return &tool.body() == &body; };
  const auto found = std::find_if(tools_.begin(), tools_.end(), own);
  return found == tools_.end() ? nullptr : &*found;
}

// Ranks after those who act on one side alone, to share that; nothing has been done to the momentum before.
Ranks SideGlue::ranks(Hook hook) const {
  if (hook == Hook::momentum_gathered) return {Rank::side};
  if (hook == Hook::forces_gathered || hook == Hook::momentum_updated) return {Rank::side_again};
  return {Rank::side, Rank::side_again};
}

void SideGlue::momentum_gathered(StepContext& context) {
  for (const auto& grid : fields_) watch(*grid, context.dt);
  nodes_.clear();
  for (const std::array<int, 2>& sides : sides_.map().divisions()) find_nodes(sides);
  part(&Grid::momentum);
  part(&Grid::place);
  share(&Grid::velocity);
}

void SideGlue::momentum_updated(StepContext&) {
  share(&Grid::velocity);
  share(&Grid::force);  // the acceleration
}

// Finds how far the material near a tool moves against it in this step.
void SideGlue::watch(const Grid& grid, double dt) {
  const GridLayout& layout = grid.layout;
  const double around = half_diagonal(layout);
  double fastest = 0.0;
  for (int b = 0; b < grid.blocks.size(); ++b) {
    const Vec3 middle = middle_of(layout, grid.blocks.block(b));
    for (const ThinTool& tool : sides_.tools()) {
      SurfacePoint found;
      if (!tool.within(middle, around + kBand * layout.largest_cell(), found)) continue;
      for (int n = 0; n < layout.nodes_per_block(); ++n) {
        if (!grid.carries(b, n)) continue;
        const Vec3 velocity = nodal_vector(grid.velocity, layout, {b, n});
        const Vec3 place = layout.node_position(grid.blocks.block(b), n);
        fastest = std::max(fastest, (velocity - tool.body().velocity_at(place)).squaredNorm());
      }
    }
  }
  sides_.add_travel(std::sqrt(fastest) * dt);
}

void SideGlue::find_nodes(const std::array<int, 2>& sides) {
  const Grid &first = *fields_[sides[0]], &second = *fields_[sides[1]];
  const GridLayout& layout = first.layout;
  for (int b = 0; b < second.blocks.size(); ++b) {
    const int other = first.blocks.find(second.blocks.key(b));
    if (other < 0) continue;
    for (int n = 0; n < layout.nodes_per_block(); ++n) {
      if (!second.carries(b, n) || !first.carries(other, n)) continue;
      const double mass[2] = {first.mass.at(other, 0, n), second.mass.at(b, 0, n)};
      if (sides_.apart(first, {other, n}, second, {b, n})) continue;
      const double total = mass[0] + mass[1];
      nodes_.push_back({sides, {{other, n}, {b, n}}, {mass[0] / total, mass[1] / total}});
    }
  }
}

void SideGlue::share(NodalField Grid::*field) {
  for (const Node& node : nodes_) {
    NodalField &first = *fields_[node.field[0]].*field, &second = *fields_[node.field[1]].*field;
    for (int k = 0; k < first.components(); ++k) {
      double &a = first.at(node.ref[0].block, k, node.ref[0].node),
             &b = second.at(node.ref[1].block, k, node.ref[1].node);
      a = b = node.part[0] * a + node.part[1] * b;
    }
  }
}

void SideGlue::part(NodalField Grid::*field) {
  for (const Node& node : nodes_) {
    NodalField &first = *fields_[node.field[0]].*field, &second = *fields_[node.field[1]].*field;
    for (int k = 0; k < first.components(); ++k) {
      double &a = first.at(node.ref[0].block, k, node.ref[0].node),
             &b = second.at(node.ref[1].block, k, node.ref[1].node);
      const double sum = a + b;
      a = node.part[0] * sum;
      b = node.part[1] * sum;
    }
  }
}

void ToolSides::serialise(StateArchive& archive) {
  archive.value("labelled", labelled_);
  archive.value("travelled", travelled_);
  kept_ = archive.merging();  // then particles are sorted though nothing has moved
  for (std::size_t t = 0; t < tools_.size(); ++t) {
    const StateArchive::Group group(archive, "tool_" + std::to_string(t));
    tools_[t].serialise(archive);
  }
}

}  // namespace mpm
