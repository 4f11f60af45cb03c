// K_I and K_II at the tip of a crack apart from each other, by the interaction integral on the contour of J: the part
// of J that the field at hand shares with the near-tip field of one mode alone,
//
//   I = int [sigma_ij e'_ij n_1 - sigma_ij n_j u'_i,1 - sigma'_ij n_j u_i,1] ds,   K = E' I / 2.
//
// Weak: in the plane, at rest, linear elastic and isotropic, with faces free of traction: where closed faces press on
// each other K_II holds and K_I means nothing. The near-tip fields are those of a straight crack along `direction`:
// inside a contour around a kink they leave tractions on the faces behind it, which are not counted.
// Source: crack reference 4.7; Yau, Wang and Corten (1980). Nodal values and rule as for J.
#pragma once

#include <vector>

#include "mpm/crack/j_integral.hpp"
#include "mpm/crack/stress_intensity.hpp"

namespace mpm {

/// @param pieces as gather_contour() lists them.
/// @param direction unit vector in which the crack would grow straight on.
StressIntensity interaction_integral(const ElasticConstants& constants, const Vec2& tip, const Vec2& direction,
                                     const std::vector<ContourPiece>& pieces);

/// Term of a strain e* that brings no stress, int tr(sigma') de*/dx_1 dA times E' / 2 (tip_physics.hpp).
/// @param samples particles inside the contour, which fill `area` [m^2]
StressIntensity eigenstrain_term(const ElasticConstants& constants, const Vec2& tip, const Vec2& direction,
                                 const std::vector<AreaSample>& samples, double area);

}  // namespace mpm
