// The data that a stage is handed in a step: all velocity fields, or the grid of the field in which it works.
#pragma once

#include "mpm/grid/fields.hpp"

namespace mpm {

/// For a stage that acts across velocity fields.
struct StepContext {
  Fields& fields;
  double dt;           ///< [s]
  double start = 0.0;  ///< time at which the step begins [s]
  /// Part of the strain that sees the velocities of the step's start, not its end: 1 for USF, 1/2 for USAVG, 0 for USL.
  double strain_at_start = 0.5;
  /// True if forces work on the velocities of the step's end, as in implicit steps; else they do on what particles are
  /// moved by.
  bool works_at_end = false;

  /// The layout that all fields share.
  const GridLayout& layout() const { return fields.front()->layout; }
};

/// For a stage that acts in one velocity field.
struct FieldContext {
  Grid& grid;                    ///< grid of the field
  double dt;                     ///< [s]
  double start = 0.0;            ///< time at which the step begins [s]
  double strain_at_start = 0.5;  ///< as in StepContext
  bool works_at_end = false;     ///< as in StepContext
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
