// What a stage sees of the step it works in.
#pragma once

#include "mpm/grid/nodal_fields.hpp"

namespace mpm {

struct StepContext {
  Grid& grid;          ///< the velocity field that the stage works in; the first, for one that works in all
  double dt;           ///< [s]
  double start = 0.0;  ///< when the step begins [s]
};

/// A node by its block and its place in it.
struct NodeRef {
  int block;
  int node;
};

inline Vec3 nodal_vector(const NodalField& field, const GridLayout& layout, NodeRef n) {
  Vec3 v = Vec3::Zero();
  for (int k = 0; k < layout.dim(); ++k) v[layout.axis(k)] = field.at(n.block, k, n.node);
  return v;
}

inline void add_nodal_vector(NodalField& field, const GridLayout& layout, NodeRef n, const Vec3& v) {
  for (int k = 0; k < layout.dim(); ++k) field.at(n.block, k, n.node) += v[layout.axis(k)];
}

}  // namespace mpm
