// Heat at a growing tip: a part f of the energy that growth by da releases becomes heat around the new tip, spread over
// as many steps as a wave takes to pass da. The sum over the steps is f G t da to round-off, also where the steps are
// not alike.
// Weak: when a tip grows again before its heat is given, what is left joins the new heat, at the new place.
// Source: crack reference 5.6; GIMP notes (6.34).
#pragma once

#include "mpm/math/state_archive.hpp"

namespace mpm {

/// n = max(1, floor(da / (c dt))) for growth [m], the material's wave speed [m/s] and the step [s], all above 0.
int heated_steps(double growth, double wave_speed, double step);

class TipHeat {
 public:
  /// `part` f between 0 and 1, `release_rate` G [J/m^2], `front` the length of the tip's front: the body's thickness t,
  /// about an axis 2 pi r of the tip for the whole ring [m]; `growth` da [m]; over `steps` steps, or those that are
  /// left of earlier heat if they are more.
  void add(double part, double release_rate, double front, double growth, int steps);
  /// Power of the step that is taken now, of length `step` [W]; 0 when all is given. Call it once a step.
  double take(double step);

  double left() const { return left_; }  ///< [J]
  int steps() const { return steps_; }   ///< in which it is given

  void serialise(StateArchive& archive);

 private:
  double left_ = 0.0;
  int steps_ = 0;
};

}  // namespace mpm
