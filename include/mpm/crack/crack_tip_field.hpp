// The elastic field next to the tip of a crack whose faces are free (Williams's first terms and the T-stress), as an
// exact solution for tests and as the auxiliary field of the interaction integral. In the frame of the tip: component 0
// along its direction, 1 along its normal to the left; the crack is the half line of negative component 0.
// It has no terms of higher order: it is the field of a body only near the tip, and exactly that of one whose outer
// boundary moves with it. The tip is at rest.
// Source: crack reference 4.7; Williams (1957), On the stress distribution at the base of a stationary crack.
#pragma once

#include <Eigen/Core>

#include "mpm/crack/stress_intensity.hpp"
#include "mpm/math/geometry.hpp"

namespace mpm {

/// Values at a point. Strain is the symmetric part of the gradient.
struct TipFieldValue {
  Vec2 displacement = Vec2::Zero();                    ///< [m]; the tip is at rest
  Eigen::Matrix2d gradient = Eigen::Matrix2d::Zero();  ///< (i, j): of component i along j
  Eigen::Matrix2d stress = Eigen::Matrix2d::Zero();    ///< [Pa]
  double stress_out = 0.0;                             ///< normal to the plane [Pa]; 0 in plane stress
};

class CrackTipField {
 public:
  /// `t_stress` [Pa], along the crack.
  CrackTipField(const StressIntensity& k, double t_stress, const ElasticConstants& constants)
      : k_(k), t_stress_(t_stress), constants_(constants) {}

  /// `place` from the tip [m], not the tip itself, where stress is infinite. On the crack the face above is meant, but
  /// for a component 1 of -0.0, which is on the face below.
  TipFieldValue at(const Vec2& place) const;

 private:
  StressIntensity k_;
  double t_stress_;
  ElasticConstants constants_;
};

}  // namespace mpm
