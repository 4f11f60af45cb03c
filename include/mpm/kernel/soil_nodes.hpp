// A component of a node's velocity before and after the sweeps of an implicit step: with which velocity it begins, and
// what it takes of the velocity that was found. Plain numbers, for the processor and for devices.
#pragma once

namespace mpm_kernel {

/// Velocity with which the solve begins, of a node of this mass that has the velocity `before` at the start of the step
/// and `velocity` with gravity and loads. A force on a node that hardly has any mass of its own would make momentum
/// with what is added to it, `lightest` [kg]; `loads`: such forces act.
constexpr double start_of_solve(double mass, double before, double velocity, double lightest, bool loads) {
  return loads ? before + mass / (mass + lightest) * (velocity - before) : velocity;
}

/// A node's component after the sweeps.
struct SolvedComponent {
  double velocity, acceleration;  ///< [m/s], [m/s^2]
  double held;                    ///< impulse of the wall that holds it [N s]
  double light;                   ///< impulse that it was not given, since the solve had more mass [N s]
  double taken;  ///< part of the work of all forces, on the velocity of the end, that does not become motion [J]
};

/// `found`: velocity that sweeps have found, 0 where a wall holds it; `start`, `velocity`: as start_of_solve() has
/// them.
constexpr SolvedComponent end_of_solve(double mass, double start, double velocity, double found, bool held,
                                       double lightest, bool loads, double dt) {
  const double by_sweeps = found - velocity, change = found - start;
  return {found, change / dt, held ? mass * by_sweeps : 0.0, held ? 0.0 : -(lightest * (loads ? change : by_sweeps)),
          0.5 * mass * change * change};
}

}  // namespace mpm_kernel
