// The impulse of one row of contact, a point of the material or of two rigid bodies, by which it does not approach,
// sticks or slides: what a sweep of projected Gauss-Seidel does with each row.
#pragma once

#include <algorithm>

#include "mpm/math/geometry.hpp"
#include "mpm/step/coulomb.hpp"

namespace mpm {

enum class ContactPass {
  step,      ///< impulses >= 0, friction: decides which points are held
  strain,    ///< held points follow the surface, others as in step
  held,      ///< held points follow the surface
  increment  ///< the same for a velocity increment
};

/// Least velocity of a row along its normal [m/s]: what closes a gap in the step, or pushes an overlap out, by a tenth
/// and at most 2e-4 cells in a step.
inline double allowed_velocity(double gap, double cell, double dt) {
  constexpr double kPushOutPart = 0.1, kPushOut = 2e-4;
  return gap > 0.0 ? -gap / dt : std::min(-kPushOutPart * gap, kPushOut * cell) / dt;
}

/// True if the row stays held as it is.
template <ContactPass Kind, class Row>
bool is_bound(const Row& row) {
  return Kind != ContactPass::step && row.hold != Hold::free;
}

/// `slip`: velocity against the surface with the row's present impulse [m/s]. The compliances are those of the normal
/// and along the surface [1/kg]. `Row` has an impulse, a normal, the velocity that is allowed along it, friction,
/// adhesion, `sticks` and `hold`. @return the impulse [N s]
template <ContactPass Kind, class Row>
Vec3 next_impulse(Row& row, const Vec3& slip, double compliance, double compliance_along) {
  constexpr bool kDecides = Kind == ContactPass::step;
  const bool bound = is_bound<Kind>(row);
  const double approach = slip.dot(row.normal), pressed = row.impulse.dot(row.normal);
  double normal = pressed + ((bound ? 0.0 : row.allowed) - approach) / compliance;
  Vec3 along = row.impulse - pressed * row.normal;
  const Vec3 sticking = along - (slip - approach * row.normal) / compliance_along;
  if (bound) {
    if (row.hold == Hold::stick) along = sticking;
  } else {
    normal = std::max(normal, -row.adhesion);
    along = sticking;
    const double length = along.norm(), most = row.friction * std::max(normal, 0.0) + row.adhesion;
    Hold hold = normal > -row.adhesion ? Hold::stick : Hold::free;
    if (hold == Hold::free) {
      along.setZero();
    } else if (!row.sticks && length > most) {
      along *= most / length;
      hold = Hold::slide;
    }
    if (kDecides) row.hold = hold;
  }
  return normal * row.normal + along;
}

/// Largest changes of a sweep.
struct SweepProgress {
  double largest = 0.0;  ///< change of a velocity [m/s]
  double scale = 0.0;    ///< the largest velocity that an impulse gives its point [m/s]
};

}  // namespace mpm
