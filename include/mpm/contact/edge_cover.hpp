// Part of a node that belongs to the material before a tool's face, where the face ends.
//
// A node near the edge of a face stands for material before the face, which the tool pushes, and for material beyond
// the edge, which it does not: below a blade, beside a plate. The node has one velocity for both. If a point of contact
// takes it as it is, the tool has to move the material beyond as well: it acts as if it were larger by an amount
// proportional to the cell.
//
// So the node's mass is divided: a part m in [0, 1] lies before the face, and the rest beyond the edge. With v and U
// the velocities of the two, the node's is u = m v + (1 - m) U, and that of the node one cell further out, of whose
// mass the part n lies before the face, n v + (1 - n) U. So u = s v + (1 - s) u_f with the cover s = (m - n) / (1 - n),
// and a point of contact sees v:
//
//   V = sum_i r_i (u_i - (1 - s_i) U_i),   r_i = w_i g_i / S,   S = sum_i w_i g_i s_i,   g = min(1, 2 s),
//
// U_i from here on the velocity of the node further out.
//
// By virtual work, an impulse J at the point then acts with r_i J on node i and with -r_i (1 - s_i) J on the node
// beyond. These parts sum to 1, so momentum is exact; a velocity that is the same everywhere is seen as it is; the
// answer is symmetric, and no energy is lost. The factor g takes weight from a node that lies mostly beyond the edge,
// whose v is known the least. A point with S < kLeast lies beyond the edge itself and is no contact.
//
// What acts on the node beyond pulls at the plane that continues the face. Soil that is pressed from the other side of
// that plane, as beside the edge of a blade in the ground, is pressed less; at a free surface, as beside a footing,
// nothing can be pulled. So only the part f of it acts, the lesser of the masses of the node beyond and of the one
// behind that, over the mass of node i, at most 1, so that no light node is pulled faster than r_i J would push node i;
// and node i gets r_i (s_i + f_i (1 - s_i)) J: the sum is 1 for every f. Of U_i the part 1 - f_i is that before the
// impulses, so that points answer each other symmetrically: within a hundredth along the grid's axes, within a few per
// cent where an edge is oblique, since the node nearest to one cell further out is less far then. What the nodes take
// over is less than the tool's work by J . sum r_i (1 - f_i)(1 - s_i)(u_i - U_i), with U_i before the impulses: the
// work of cutting the material inside the cells at the edge.
//
// The part m is that of the node's hat function. Let B be the part of it that lies inside the edge: of a node c cells
// inside, 1 - (1 - c)^2 / 2, of one -c cells outside, (1 + c)^2 / 2; and A the part that lies in front of the
// plane of the face. Before the face lies A B; beyond the edge 1 - B, on both sides of that plane where material lies
// behind it, so m = A B / (A B + (1 - B) (A + f (1 - A))); n is the same with c - 1. So tools on rows of nodes and
// between them meet nearly the same: with a cover that is whole from half a cell inside on, a blade between two rows
// drags the soil below it along, and acts half a cell deeper than one on a row. With t out of the face across its edge,
// h the length of a cell along t, and d n the signed distance and normal of the tool at x_i + h t, c = 1 - (d n).t / h
// + e. The shift e is measured: with 0.15 the mean over places of the grid of smooth, rough and rolled-back blades is
// nearest to exact. With e = 0 they act a sixth of a cell too short, since particles lie on one side of the edge or the
// other by their centres, and the lowest that a face pushes lies inside the edge. A tool whose two sides have a
// velocity field each has e = 0: no field goes on behind its face, and it acts where it lies.
//
// The directions t are found from the surface itself, by looking two cells along it from the point: beyond an edge the
// nearest surface lies straight back, while a surface that is round, or goes on behind a bend, lies aside. Faces
// without an edge that near cost these looks alone. Where no material lies beyond an edge, the whole node lies before
// the face.
//
// Weak: a surface whose radius is below a cell counts as an edge. Of a tool narrower than two cells no node is wholly
// covered. Where two edges are near, the lesser cover counts, not the product. Splines are taken for hats. Material
// that ends at the edge between two rows of nodes counts as going on where more than a hundredth of a node's mass lies
// beyond. What is cut shears without strength within a cell of the edge.
// Source: derived for this project; doc/methods.md has the forces on blades and strips with and without it,
// doc/contact.md those at other places of the grid.
#pragma once

#include <vector>

#include "mpm/contact/contact_point.hpp"
#include "mpm/grid/fields.hpp"
#include "mpm/math/geometry_kind.hpp"
#include "mpm/rigid/rigid_body.hpp"
#include "mpm/step/material_nodes.hpp"

namespace mpm {

/// A node of a point of contact. Nodes are numbered block * nodes_per_block + node in their field's grid.
struct PointNode {
  int field;
  int node;
  double weight;       ///< part of the point's impulse that it gets, negative beyond an edge; all sum to 1
  double reading;      ///< factor of its velocity in that at the point; as `weight` away from edges
  double start = 0.0;  ///< factor of its velocity before the impulses; with `reading` all sum to 1
};

class EdgeCover {
 public:
  /// `bodies` must outlive this. `cell`: the smallest edge of a cell [m].
  EdgeCover(const std::vector<const RigidBody*>& bodies, GeometryKind geometry, double cell);

  struct Nodes {
    int count = 0;         ///< 0 if the point lies beyond an edge
    bool at_edge = false;  ///< true if a node lies in part beyond an edge
  };
  /// Changes the `count` nodes around a point for edges near it. There is room for twice as many in `nodes`.
  /// `material`: the nodes that the point's material has.
  Nodes apply(const ContactPoint& point, const MaterialNodes& material, PointNode* nodes, int count) const;

 private:
  const std::vector<const RigidBody*>& bodies_;
  std::vector<double> further_;  ///< cells by which an edge of each body acts further out than it lies
};

}  // namespace mpm
