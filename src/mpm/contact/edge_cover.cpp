#include "mpm/contact/edge_cover.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "mpm/contact/thin_tool.hpp"
#include "mpm/step/point_weights.hpp"

namespace mpm {
namespace {

constexpr double kLook = 2.0;          ///< cells along the surface to where an edge is looked for
constexpr double kEdge = 0.9;          ///< cosine between the look and the normal met, from which on there is an edge
constexpr double kLeast = 0.1;         ///< S of a point that counts
constexpr double kLeastPart = 1e-3;    ///< cover of a node that counts
constexpr double kWhole = 1.0 - 1e-6;  ///< part of a hat inside the edge that is all: round-off must not make an edge
constexpr double kLeastFront = 5e-3;   ///< part of a hat in front of a face: splines reach nodes that have none
constexpr double kHalf = 0.5;          ///< cover from which on a node decides with its whole weight
constexpr double kFurther = 0.15;      ///< cells by which an edge acts further out than it lies
constexpr double kThinnest = 1e-2;     ///< mass beyond an edge, over that of the node, from which on there is material

/// Directions along the surface across the edges near a point, away from the face.
struct Edges {
  std::array<Vec3, 4> across;
  std::array<double, 4> cell{};  ///< length of a cell along each [m]
  int count = 0;
};

/// The surface nearest to a place, with the normal in the world.
SurfacePoint nearest(const RigidBody& body, const Vec3& place) {
  SurfacePoint surface = body.surface().at(body.pose().to_body(place));
  surface.normal = body.pose().orientation * surface.normal;
  return surface;
}

/// Length of a cell along a direction [m].
double cell_along(const GridLayout& layout, const Vec3& direction) {
  double inverse = 0.0;
  for (int k = 0; k < layout.dim(); ++k) {
    inverse = std::max(inverse, std::abs(direction[layout.axis(k)]) * layout.inverse_cell(k));
  }
  return 1.0 / inverse;
}

/// Distance of a place beyond a body's surface along a direction [m]; negative inside.
double beyond(const RigidBody& body, const Vec3& place, const Vec3& along) {
  const SurfacePoint surface = nearest(body, place);
  return surface.distance * surface.normal.dot(along);
}

/// Edges across `along` and against it.
void look(const RigidBody& body, const ContactPoint& point, const Vec3& along, const GridLayout& layout, Edges& edges) {
  const double cell = cell_along(layout, along);
  for (const double sign : {1.0, -1.0}) {
    const SurfacePoint met = nearest(body, point.place + sign * kLook * cell * along);
    if (!(met.distance > 0.0 && sign * along.dot(met.normal) > kEdge)) continue;
    const Vec3 across = (met.normal - met.normal.dot(point.normal) * point.normal).normalized();
    const auto known = [&](const Vec3& other) { return other.dot(across) > 0.99; };
    const auto end = edges.across.begin() + edges.count;
    if (std::any_of(edges.across.begin(), end, known)) continue;
    edges.across[edges.count] = across;
    edges.cell[edges.count++] = cell_along(layout, across);
  }
}

/// Part of a hat function that lies on the node's side of a plane; `cells` from the plane to the node, negative on the
/// other side.
double hat_part(double cells) {
  const double left = 1.0 - std::min(std::abs(cells), 1.0), other = 0.5 * left * left;
  return cells > 0.0 ? 1.0 - other : other;
}

/// Part of a node's mass that lies before the face, of the parts of its hat function that lie on the covered side of
/// the edge and in front of the plane of the face; `backed`: how full it is behind that plane beyond the edge.
double part_before(double covered, double front, double backed) {
  const double before = covered * front, beyond = (1.0 - covered) * (front + backed * (1.0 - front));
  return before / (before + beyond);
}

Edges edges_near(const RigidBody& body, const ContactPoint& point, const GridLayout& layout) {
  Edges edges;
  if (layout.dim() == 2) {
    look(body, point, Vec3::UnitY().cross(point.normal).normalized(), layout, edges);
  } else if (layout.dim() == 3) {
    // Along the body's own axes, along which edges often lie.
    const Vec3 normal = body.pose().orientation.conjugate() * point.normal;
    int least = 0;
    normal.cwiseAbs().minCoeff(&least);
    const Vec3 first = body.pose().orientation * normal.cross(Vec3::Unit(least)).normalized();
    look(body, point, first, layout, edges);
    look(body, point, point.normal.cross(first), layout, edges);
  }
  return edges;
}

/// Material beyond an edge, as a node near it sees it.
struct Beyond {
  int field = -1;
  int node = -1;        ///< none if negative
  double backed = 0.0;  ///< fullness behind the plane that continues the face, 0 to 1
};

/// Adds to a node of the list, or a node to the list.
void add(const PointNode& added, PointNode* nodes, int& count) {
  PointNode* end = nodes + count;
  PointNode* found = std::find_if(
      nodes, end, [&](const PointNode& one) { return one.node == added.node && one.field == added.field; });
  if (found == end) {
    *end = {added.field, added.node, 0.0, 0.0};
    ++count;
  }
  found->weight += added.weight;
  found->reading += added.reading;
  found->start += added.start;
}

}  // namespace

EdgeCover::EdgeCover(const std::vector<const RigidBody*>& bodies, GeometryKind geometry, double cell)
    : bodies_(bodies) {
  for (const RigidBody* body : bodies) {
    further_.push_back(has_sides(body->definition(), geometry, cell) ? 0.0 : kFurther);
  }
}

EdgeCover::Nodes EdgeCover::apply(const ContactPoint& point, const MaterialNodes& material, PointNode* nodes,
                                  int count) const {
  const RigidBody& body = *bodies_[point.body];
  const GridLayout& layout = material.grid().layout;
  const Edges edges = edges_near(body, point, layout);
  if (edges.count == 0) return {count, false};
  const int per_block = layout.nodes_per_block();
  const Vec3 into = -cell_along(layout, point.normal) * point.normal;
  std::array<PointNode, PointWeights::kMost> around;
  std::copy(nodes, nodes + count, around.begin());
  double sum = 0.0;
  Nodes result;
  for (int n = 0; n < count; ++n) {
    const FieldNode own{around[n].field, {around[n].node / per_block, around[n].node % per_block}};
    const Vec3 place = material.place(own);
    const double mass = material.mass(own);
    double cover = 1.0;
    Beyond other;
    for (int e = 0; e < edges.count; ++e) {
      const Vec3& across = edges.across[e];
      const double cell = edges.cell[e];
      const double within = 1.0 + further_[point.body] - beyond(body, place + cell * across, across) / cell;
      if (hat_part(within) >= kWhole) continue;
      const FieldNode further = material.nearest(place + cell * across);
      if (further.ref.block < 0 || further == own) continue;
      const double beyond_edge = material.mass(further);
      if (beyond_edge < kThinnest * mass) continue;
      const FieldNode behind = material.nearest(place + cell * across + into);
      const double least = behind.ref.block < 0 ? 0.0 : std::min(material.mass(behind), beyond_edge);
      const double backed = std::min(1.0, least / mass);
      const double ahead = ((place - point.place).dot(point.normal) + point.gap) / into.norm();
      const double front = std::max(hat_part(ahead), kLeastFront);
      const double of_node = part_before(hat_part(within), front, backed);
      const double of_further = part_before(hat_part(within - 1.0), front, backed);
      const double part = (of_node - of_further) / (1.0 - of_further);
      if (!(part < cover)) continue;
      cover = part;
      other.field = further.field;
      other.node = further.ref.block * per_block + further.ref.node;
      other.backed = backed;
    }
    if (cover < kLeastPart) continue;
    const double reading = around[n].reading * std::min(1.0, cover / kHalf), rest = reading * (1.0 - cover);
    const double carried = other.backed * rest;
    add({around[n].field, around[n].node, reading - rest + carried, reading}, nodes, result.count);
    if (rest > 0.0) {
      add({other.field, other.node, -carried, -carried, carried - rest}, nodes, result.count);
      result.at_edge = true;
    }
    sum += reading * cover;
  }
  if (!(sum > kLeast)) return {};
  for (int n = 0; n < result.count; ++n) {
    nodes[n].weight /= sum;
    nodes[n].reading /= sum;
    nodes[n].start /= sum;
  }
  return result;
}

}  // namespace mpm
