// What a stage sees of the step it works in: all velocity fields, or the grid of the one that it works in.
#pragma once

#include "mpm/grid/fields.hpp"

namespace mpm {

/// For what acts across velocity fields.
struct StepContext {
  Fields& fields;
  double dt;           ///< [s]
  double start = 0.0;  ///< when the step begins [s]

  /// Of every field.
  const GridLayout& layout() const { return fields.front()->layout; }
};

/// For what acts in one velocity field and knows of no other.
struct FieldContext {
  Grid& grid;          ///< of the field
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
