// One damage D for both directions (Nairn & Aimene 2021; crack reference 5.5): T = (1 - D) (k_n u_n, k_t u_t), and D
// grows so that (u_n / delta_n(D))^2 + (u_t / delta_t(D))^2 = 1, delta(D) the opening at which a direction alone would
// have that damage. The left side falls as D rises: its one root is found by halving [D, 1].
//
// While D grows from D_0 at u_0 to D_1 at u_1, dG = 1/2 k u_0 u_1 (D_1 - D_0) in each direction. It is the energy that
// the trapezoid rule misses in what is stored, so that the balance holds to round-off in steps of any size; and with
// triangular curves on a straight way from the origin it is the integral of 1/2 k u^2 dD itself.
#include <algorithm>
#include <cmath>

#include "mpm/crack/traction_law.hpp"
#include "opening_path.hpp"

namespace mpm {
namespace {

constexpr int kMostHalvings = 60;  ///< after which an interval in [0, 1] is round-off

double square_of_part(double opening, double limit) {
  return opening == 0.0 ? 0.0 : (opening / limit) * (opening / limit);
}

}  // namespace

double TractionLaw::damage_at(const FaceOpening& opening, double least) const {
  const auto beyond = [&](double damage) {
    return square_of_part(opening.normal, curve_[0].opening_at(damage)) +
               square_of_part(opening.shear, curve_[1].opening_at(damage)) >
           1.0;
  };
  if (beyond(1.0)) return 1.0;
  if (!beyond(least)) return least;
  double low = least, high = 1.0;
  for (int n = 0; n < kMostHalvings; ++n) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (beyond(middle) ? low : high) = middle;
  }
  return high;
}

void TractionLaw::advance_mixed(const FaceOpening& from, const FaceOpening& to, TractionState& state) const {
  const double before = state.damage;
  const std::array<double, 2> secant = secants(state);
  state.damage = damage_at(to, before);
  if (state.damage == before) {
    state.traction = traction_of(secant, to);
    state.work += traction_work(traction_of(secant, from), from, state.traction, to);
    return;
  }
  const OpeningPath path{from, to};
  state.failed = state.damage == 1.0;
  const FaceOpening onset = path.leaves(curve_[0].opening_at(before), curve_[1].opening_at(before));
  const FaceOpening end = state.failed ? path.leaves(curve_[0].opening(), curve_[1].opening()) : to;
  state.traction = traction_of(secants(state), end);
  state.work += traction_work(traction_of(secant, from), from, traction_of(secant, onset), onset) +
                traction_work(traction_of(secant, onset), onset, state.traction, end);
  const double growth = 0.5 * (state.damage - before);
  state.dissipated[0] += growth * curve_[0].stiffness() * onset.normal * end.normal;
  state.dissipated[1] += growth * curve_[1].stiffness() * onset.shear * end.shear;
}

}  // namespace mpm
