#include "mpm/contact/pair_law.hpp"

#include <cmath>

namespace mpm {
namespace {

// Impulse on a along one direction, of stiffness D >= 0. `stick`: m w, w the velocity of opening.
double spring_impulse(double stiffness, double area, double mass, double opening, double stick, double dt) {
  const double k = area * stiffness * dt * dt / mass;
  const double beta = 0.5 + k / (2.0 * k + 8.0);
  return (area * stiffness * dt * opening + beta * k * stick) / (1.0 + beta * k);
}

}  // namespace

PairImpulse coulomb_impulse(const Vec3& stick, const Vec3& normal, const FrictionLaw& law, double bond) {
  const double along = stick.dot(normal);  // on a: negative where b presses
  const Vec3 tangential = stick - along * normal;
  const double shear = tangential.norm();
  if (along >= 0.0) {
    const double whole = std::hypot(along, shear);
    if (!(bond > 0.0) || whole > bond) return {};
    return {stick, PairHold::both};
  }
  if (law.stick || shear <= -law.at_rest() * along + bond) return {stick, PairHold::both};
  const double limit = -law.coefficient * along + bond;
  return {along * normal + tangential * (limit / shear), PairHold::normal};
}

double normal_stiffness(const InterfaceLaw& law, double normal_opening) {
  return normal_opening > 0.0 ? law.opened : law.closed;
}

PairImpulse interface_impulse(const InterfaceLaw& law, const InterfaceState& state, const Vec3& stick,
                              const Vec3& normal, double dt) {
  const double along = stick.dot(normal), opening = state.opening.dot(normal);
  const Vec3 tangential = stick - along * normal;
  PairImpulse impulse;
  // Surfaces that just touch are on the side that they move to.
  const bool opened = opening > 0.0 || (opening == 0.0 && along > 0.0);
  const double stiffness = opened ? law.opened : law.closed;
  bool normal_held = false, tangential_held = false;
  if (stiffness >= 0.0) {
    impulse.on_a = spring_impulse(stiffness, state.area, state.reduced_mass, opening, along, dt) * normal;
  } else if (law.opened < 0.0 || along < 0.0) {
    impulse.on_a = along * normal;
    normal_held = true;
  }
  if (law.tangential < 0.0) {
    impulse.on_a += tangential;
    tangential_held = true;
  } else {
    const Vec3 slip = state.opening - opening * normal;
    for (int k = 0; k < 3; ++k) {
      impulse.on_a[k] += spring_impulse(law.tangential, state.area, state.reduced_mass, slip[k], tangential[k], dt);
    }
  }
  impulse.hold = tangential_held ? (normal_held ? PairHold::both : PairHold::tangential)
                                 : (normal_held ? PairHold::normal : PairHold::none);
  return impulse;
}

double interface_energy(const InterfaceLaw& law, const InterfaceState& state, const Vec3& impulse, const Vec3& normal,
                        double dt) {
  const double along = impulse.dot(normal), tangential2 = (impulse - along * normal).squaredNorm();
  const double stiffness = normal_stiffness(law, along);  // a is pulled where it has opened
  double sum = 0.0;
  if (stiffness > 0.0) sum += along * along / stiffness;
  if (law.tangential > 0.0) sum += tangential2 / law.tangential;
  return sum / (2.0 * state.area * dt * dt);
}

}  // namespace mpm
