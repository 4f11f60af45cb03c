// The impulse between two materials at a node: Coulomb's law with adhesion, and the imperfect interface.
//
// Interface: the opening u of the two surfaces is measured at the step's start. Its traction acts with the opening that
// the step's end velocity leads to, impulse J = A D dt (u + beta dt w'), w' = w - J / m the velocity of opening after
// it, so J = A D dt (u + beta dt w) / (1 + beta K), K = A D dt^2 / m. Particles move by the mean of the velocities
// before and after; the step's matrix for (u, w) then has determinant (1 + K/2) / (1 + beta K) and trace (2 + (beta -
// 1/2) K) / (1 + beta K): beta = 1/2 keeps amplitudes, and beta in [1/2, 1] is stable at any stiffness. We take
// 1/2 + K / (2 K + 8): an oscillation that the step resolves loses (omega dt)^3 pi / 4 of its energy in a period; one
// that it does not resolve dies out. (Derived here; Nairn (2013) integrates the same oscillator in closed form.)
// Weak: friction remembers no slip, a pair that sticks is a pair with little speed.
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

/// The part of a relative velocity that a pair which is held keeps at zero.
inline Vec3 kept_part(const Vec3& vector, const Vec3& normal, PairHold hold) {
  const Vec3 along = vector.dot(normal) * normal;
  if (holds_normal(hold)) return holds_tangential(hold) ? vector : along;
  return holds_tangential(hold) ? Vec3(vector - along) : Vec3::Zero();
}

/// What contact does to the first of a pair; the second gets the opposite.
struct PairImpulse {
  Vec3 on_a = Vec3::Zero();  ///< [N s]
  PairHold hold = PairHold::none;
};

/// Coulomb's law. `stick`: the impulse on a that would take all relative velocity away, m (v_b - v_a); `normal`: from a
/// to b. `bond`: strength of adhesion times area times step [N s]; 0 where surfaces do not adhere. Pressed surfaces
/// slide when the tangential part exceeds friction and bond; pulled ones stay together while the whole is below it.
PairImpulse coulomb_impulse(const Vec3& stick, const Vec3& normal, const FrictionLaw& law, double bond);

/// An imperfect interface at a node.
struct InterfaceState {
  Vec3 opening = Vec3::Zero();  ///< u_b - u_a [m]
  double area = 0.0;            ///< [m^2]
  double reduced_mass = 0.0;    ///< [kg]
};
/// How stiff it is along the normal now: as opened or as closed.
double normal_stiffness(const InterfaceLaw& law, double normal_opening);
/// `stick` as above. A perfect direction (negative stiffness) takes the stick impulse; perfect while closed alone, only
/// while it presses. `hold`: what perfect directions hold.
PairImpulse interface_impulse(const InterfaceLaw& law, const InterfaceState& state, const Vec3& stick,
                              const Vec3& normal, double dt);
/// Stored where `impulse` is what a step's traction gave: (J_n^2 / D_n + J_t^2 / D_t) / (2 A dt^2), without perfect
/// directions [J]. By the traction: a measured opening is never as small as a stiff interface's, and D times its square
/// would be anything.
double interface_energy(const InterfaceLaw& law, const InterfaceState& state, const Vec3& impulse, const Vec3& normal,
                        double dt);

}  // namespace mpm
