// Strength of soil that falls from a peak to a residual value: friction, cohesion and dilation go in a straight line
// with the plastic shear strain, friction as sin(phi), cohesion as c cos(phi), dilation as sin(psi) to nothing. At the
// end the soil shears at constant volume and constant strength: its critical state.
//
// Softening gathers in a shear band, and a grid resolves a band in one cell, however thin the band in the soil is. Were
// the fall tied to strain, the slip and the work that it takes would shrink with the cell. It is tied to displacements
// of the band instead, by one rule: strain of a cell = displacement / width of the band on the grid, the edge of a
// cell. Strength falls over a slip along the band. Dilation of soil whose strength stays ends at a rise across it: a
// band of width w in the soil gains the volume limit w an area, and so does a band of width h on the grid in which
// dilation ends at the volume limit w / h. (Crack band: Z. P. Bazant, B. H. Oh (1983), Materiaux et Constructions 16,
// 155-177; for slip in soil A. C. Palmer, J. R. Rice (1973), Proc. R. Soc. A 332, 527-548; bands of 10 to 20 grains:
// H.-B. Muehlhaus, I. Vardoulakis (1987), Geotechnique 37, 271-283.)
//
// Strength within a step is that of the plastic strain at its start, an error of the first order in the step. Weak:
// where a band is wider than a cell, as one oblique to the grid (about two cells), strength falls over a slip longer by
// its width in cells, and it rises by as much more; soil that softens or dilates without a band, all of it alike, too
// has the strain of a band of one cell; on cells finer than the band in the soil nothing holds the band's width.
#pragma once

#include <cmath>

#include "mpm/material/definition.hpp"
#include "mpm/math/lanes.hpp"

namespace mpm {

class StrengthFall {
 public:
  explicit StrengthFall(const SoilSoftening& softening)
      : per_strain_(softening.falls() ? 1.0 / softening.strain() : 0.0) {}

  bool falls() const { return per_strain_ > 0.0; }
  /// Part left of the way from residual to peak strength after the plastic shear strain `strain`: 1 to 0.
  template <class T>
  T left(T strain) const {
    return max(T(1) - T(per_strain_) * strain, T(0));
  }
  double per_strain() const { return per_strain_; }

 private:
  double per_strain_;
};

/// A peak value and the value at the end.
struct Fall {
  double peak = 0.0, residual = 0.0;
  template <class T>
  T at(T left) const {
    return T(residual) + T(peak - residual) * left;
  }
};

/// Parts of a fall at which the stiffness of flow is sought: it has no extremes between them that matter, since the
/// largest contribution is that of the largest difference between friction and dilation.
constexpr double kPartsOfAFall[] = {0.0, 0.25, 0.5, 0.75};

/// The soil as it is where `left` of the way from residual to peak strength is left, as one that does not soften.
template <class SoilDefinition>
SoilDefinition weakened(const SoilDefinition& peak, double left) {
  SoilDefinition soil = peak;
  const double sine = std::sin(peak.friction_angle), residual = std::sin(peak.softening.friction_angle);
  const double strength = peak.cohesion * std::cos(peak.friction_angle);
  const double residual_strength = peak.softening.cohesion * std::cos(peak.softening.friction_angle);
  soil.friction_angle = left == 0.0 ? peak.softening.friction_angle : std::asin(Fall{sine, residual}.at(left));
  soil.dilation_angle = std::asin(left * std::sin(peak.dilation_angle));
  soil.cohesion = Fall{strength, residual_strength}.at(left) / std::cos(soil.friction_angle);
  if (left == 0.0) soil.cohesion = peak.softening.cohesion;
  soil.softening = {};
  return soil;
}

}  // namespace mpm
