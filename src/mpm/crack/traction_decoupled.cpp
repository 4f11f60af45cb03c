// Laws whose directions know nothing of each other: crack reference 5.5, "Decoupled".
#include <algorithm>
#include <cmath>

#include "mpm/crack/traction_law.hpp"
#include "opening_path.hpp"

namespace mpm {
namespace {

/// Work of one direction from `from` to `to` [m], in which the largest opening was `largest`.
double decoupled_work(const TractionCurve& curve, double largest, double from, double to) {
  const double secant = curve.secant(largest), onset = std::max(largest, curve.elastic());
  if (std::abs(to) <= onset) return 0.5 * secant * (to + from) * (to - from);
  const double end = std::min(std::abs(to), curve.opening());
  return 0.5 * secant * (onset + from) * (onset - from) +
         0.5 * (secant * onset + curve.secant(end) * end) * (end - onset);
}

}  // namespace

bool TractionLaw::decoupled_failed(const TractionState& state) const {
  double sum = 0.0;
  for (int i = 0; i < 2; ++i) {
    if (state.largest[i] >= curve_[i].opening()) return true;
    if (definition_.mix > 0.0) sum += std::pow(state.dissipated[i] / curve_[i].toughness(), definition_.mix);
  }
  return sum >= 1.0;
}

void TractionLaw::advance_decoupled(const FaceOpening& from, const FaceOpening& to, TractionState& state) const {
  const double start[2] = {from.normal, from.shear}, end[2] = {to.normal, to.shear};
  for (int i = 0; i < 2; ++i) {
    state.work += decoupled_work(curve_[i], state.largest[i], start[i], end[i]);
    state.largest[i] = std::max(state.largest[i], std::abs(end[i]));
    state.dissipated[i] = curve_[i].dissipated(state.largest[i]);
  }
  if (decoupled_failed(state)) {
    state.freed = stored(state, to.normal, to.shear);
    state.failed = true;
  }
  state.traction = traction_of(secants(state), to);
}

}  // namespace mpm
