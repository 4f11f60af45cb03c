// The impulse between two materials at a node: Coulomb's law with adhesion, and the imperfect interface.
//
// Interface: the opening u of the two surfaces is measured at the step's start. Its traction acts with the opening that
// the step's end velocity leads to, impulse J = A D dt (u + beta dt w'), w' = w - J / m the velocity of opening after
// it, so J = A D dt (u + beta dt w) / (1 + beta K), K = A D dt^2 / m. Particles move by the mean of the velocities
// before and after; the step's matrix for (u, w) then has determinant (1 + K/2) / (1 + beta K) and trace (2 + (beta -
// 1/2) K) / (1 + beta K): beta = 1/2 keeps amplitudes, and beta in [1/2, 1] is stable at any stiffness. We take
// 1/2 + K / (2 K + 8): an oscillation that the step resolves loses (omega dt)^3 pi / 4 of its energy in a period; one
// that it does not resolve dies out. (Derived here; Nairn (2013) integrates the same oscillator in closed form.)
// Weak: friction remembers no slip; a pair sticks when its tangential speed is small.
// Source: method reference 8.3 (GIMP notes (3.13) with its erratum 24), 8.4.
#pragma once

#include <cstdint>

#include "mpm/math/geometry.hpp"
#include "mpm/rigid/contact_law.hpp"

namespace mpm {

/// The directions in which a pair moves as one.
enum class PairHold : std::uint8_t { none, normal, tangential, both };
inline bool holds_normal(PairHold hold) { return hold == PairHold::normal || hold == PairHold::both; }
inline bool holds_tangential(PairHold hold) { return hold == PairHold::tangential || hold == PairHold::both; }

/// The part of a relative velocity that a held pair keeps at zero.
inline Vec3 kept_part(const Vec3& vector, const Vec3& normal, PairHold hold) {
  const Vec3 along = vector.dot(normal) * normal;
  if (holds_normal(hold)) return holds_tangential(hold) ? vector : along;
  return holds_tangential(hold) ? Vec3(vector - along) : Vec3::Zero();
}

/// The slip that is left of a relative velocity where a pair is held.
inline Vec3 held_slip(const Vec3& relative, const Vec3& normal, PairHold hold) {
  return relative - kept_part(relative, normal, hold);
}

/// The impulse of contact on the first material of a pair; the second gets the opposite.
struct PairImpulse {
  Vec3 on_a = Vec3::Zero();  ///< [N s]
  PairHold hold = PairHold::none;
};

/// Coulomb's law. `stick`: the impulse on a that would remove all relative velocity, m (v_b - v_a); `normal`: from a
/// to b. `bond`: strength of adhesion times area times step [N s]; 0 where surfaces do not adhere. Pressed surfaces
/// slide when the tangential part exceeds friction and bond; pulled ones stay together while the whole is below it.
PairImpulse coulomb_impulse(const Vec3& stick, const Vec3& normal, const FrictionLaw& law, double bond);

/// An imperfect interface at a node.
struct InterfaceState {
  Vec3 opening = Vec3::Zero();  ///< u_b - u_a [m]
  double area = 0.0;            ///< [m^2]
  double reduced_mass = 0.0;    ///< [kg]
};
/// The present stiffness along the normal, that of the opened or of the closed interface [Pa/m].
double normal_stiffness(const InterfaceLaw& law, double normal_opening);
/// `stick` as above. A perfect direction (negative stiffness) takes the stick impulse; one that is perfect only while
/// closed takes it only while it presses. The result's `hold` names the perfect directions.
PairImpulse interface_impulse(const InterfaceLaw& law, const InterfaceState& state, const Vec3& stick,
                              const Vec3& normal, double dt);
/// Energy stored in an interface whose traction gave `impulse` in a step: (J_n^2 / D_n + J_t^2 / D_t) / (2 A dt^2),
/// without perfect directions [J]. It is computed from the traction because a measured opening is never as small as
/// that of a stiff interface, and D times its square would be arbitrary.
double interface_energy(const InterfaceLaw& law, const InterfaceState& state, const Vec3& impulse, const Vec3& normal,
                        double dt);

}  // namespace mpm
