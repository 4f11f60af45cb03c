// The coupled sawtooth (Hoegberg 2006; crack reference 5.5): with lambda the length of (u_n / u_nc, u_t / u_tc),
// elastic up to lambda_p, and from there T = (1 - lambda_w) / ((1 - lambda_p) lambda_w) sigma u / u_c, lambda_w the
// largest lambda. It dissipates G_c (sin^2, cos^2) d lambda_w / (1 - lambda_p), so that G_I/G_Ic + G_II/G_IIc = 1 at
// failure on every way. That needs one lambda_p for both directions: with two, the work of a closed way without damage
// is not zero.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mpm/crack/crack_error.hpp"
#include "mpm/crack/traction_law.hpp"
#include "opening_path.hpp"

namespace mpm {
namespace {

constexpr double kSameRatio = 1e-6;  ///< two elastic parts differ by no more, relative: numbers typed by hand

}  // namespace

void TractionLaw::check_coupled() const {
  const double normal = curve_[0].elastic() / curve_[0].opening(), shear = curve_[1].elastic() / curve_[1].opening();
  if (std::abs(normal - shear) > kSameRatio * normal) {
    throw CrackError(
        fmt::format("a coupled law must be elastic up to the same part of its opening in both directions, "
                    "not {} and {}; take kind 'mixed' for different ones",
                    normal, shear));
  }
}

// Part of the undamaged stiffness; `damage`: lambda_w.
double TractionLaw::coupled_factor(double damage) const {
  const double elastic = curve_[0].elastic() / curve_[0].opening();
  if (damage <= elastic) return 1.0;
  return elastic * (1.0 - damage) / ((1.0 - elastic) * damage);
}

void TractionLaw::advance_coupled(const FaceOpening& from, const FaceOpening& to, TractionState& state) const {
  const double normal = curve_[0].opening(), shear = curve_[1].opening();
  const double lambda = std::hypot(to.normal / normal, to.shear / shear);
  const double elastic = curve_[0].elastic() / normal, before = std::max(state.damage, elastic);
  const std::array<double, 2> secant = secants(state);
  if (lambda <= before) {
    state.traction = traction_of(secant, to);
    state.work += traction_work(traction_of(secant, from), from, state.traction, to);
    return;
  }
  const OpeningPath path{from, to};
  const FaceOpening onset = path.leaves(before * normal, before * shear);
  const FaceOpening end = lambda < 1.0 ? to : path.leaves(normal, shear);
  state.damage = std::min(lambda, 1.0);
  state.failed = lambda >= 1.0;
  state.traction = traction_of(secants(state), end);
  state.work += traction_work(traction_of(secant, from), from, traction_of(secant, onset), onset) +
                traction_work(traction_of(secant, onset), onset, state.traction, end);

  // The mean of the directions at the way's two ends, which differ by less than a right angle.
  const double sine = onset.normal / (normal * before) + end.normal / (normal * state.damage);
  const double cosine = onset.shear / (shear * before) + end.shear / (shear * state.damage);
  const double mode_1 = sine * sine / (sine * sine + cosine * cosine);
  const double part = (state.damage - before) / (1.0 - elastic);
  state.dissipated[0] += curve_[0].toughness() * mode_1 * part;
  state.dissipated[1] += curve_[1].toughness() * (1.0 - mode_1) * part;
}

}  // namespace mpm
