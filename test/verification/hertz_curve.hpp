// Helpers for the Hertz tests: the exact force of a sphere or cylinder (layer_contact.hpp) as a curve over its depth,
// and the fit of an offset of the depth.
//
// A node is in contact when it lies in the tool, so the force of a curved tool is right only once the tool has passed
// some rows of nodes. The offset, between zero and the reach of a particle's box, is the depth at which contact appears
// to begin.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "layer_contact.hpp"
#include "page.hpp"

namespace verification {

/// The exact solution as a table over the contact radius; all other entries increase with it.
struct HertzCurve {
  Numbers radius, approach, force;  ///< [m], [m], [N] or [N/m] for a strip

  /// Tabulates contact radii from `least` to `most` [m].
  HertzCurve(const ElasticBlock& block, ToolShape shape, double tool_radius, double least, double most) {
    const int entries = 22;
    for (int i = 0; i <= entries; ++i) {
      const double a = least + (most - least) * i / entries;
      const PressedTool tool = LayerContact(block, shape, a).paraboloid(tool_radius);
      radius.push_back(a);
      approach.push_back(tool.approach);
      force.push_back(tool.force);
    }
  }
  /// Interpolates by a power law between two entries, within 1e-3 of the curve.
  static double at(const Numbers& xs, const Numbers& ys, double x) {
    const auto above = std::clamp<std::ptrdiff_t>(std::upper_bound(xs.begin(), xs.end(), x) - xs.begin(), 1,
                                                  static_cast<std::ptrdiff_t>(xs.size()) - 1);
    const double x0 = xs[above - 1], x1 = xs[above], y0 = ys[above - 1], y1 = ys[above];
    return y0 * std::pow(y1 / y0, std::log(x / x0) / std::log(x1 / x0));
  }
  double force_at_depth(double depth) const { return at(approach, force, depth); }
  double radius_at_depth(double depth) const { return at(approach, radius, depth); }
  double force_at_radius(double a) const { return at(radius, force, a); }
  double radius_at_force(double f) const { return at(force, radius, f); }
};

/// The offset in [0, 1.25 rows] that minimises the squares of the relative errors of the force over all steps but the
/// first [m].
inline double fit_offset(const HertzCurve& curve, const Numbers& depth, const Numbers& force, double row) {
  constexpr double kMost = 1.25;  // the reach of a particle's box [rows]
  double best = 0.0, least = 1e300;
  for (double offset = 0.0; offset <= kMost * row; offset += 0.001 * row) {
    double squares = 0.0;
    for (std::size_t i = 1; i < depth.size(); ++i) {
      squares += std::pow(force[i] / curve.force_at_depth(depth[i] - offset) - 1.0, 2);
    }
    if (squares < least) {
      least = squares;
      best = offset;
    }
  }
  return best;
}

}  // namespace verification
