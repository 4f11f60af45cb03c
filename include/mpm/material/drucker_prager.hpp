// Drucker-Prager soil: f = sqrt(J2) + eta p - xi c, potential with eta_bar from the dilation angle, tension positive, p
// = tr(sigma)/3. Elastic predictor in rate form (as linear_elastic.hpp), return to the cone, its apex, or the tension
// cut-off. Opened soil (apex, cut-off) closes before it carries pressure (opening.hpp). Weak: plastic work is computed
// with the stress at the end of a step; no hardening, no critical state, so dilation never ends; hypoelastic, meant for
// small elastic strain. Source: method reference 10.6 (flow rule and the three matches to Mohr-Coulomb verified there).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "mpm/material/linear_elastic.hpp"
#include "mpm/material/opening.hpp"

namespace mpm {

class DruckerPrager : public LawTraits {
 public:
  static constexpr int kHistory = 3;
  static constexpr int kPlasticStrain = 0;
  static constexpr int kPlasticWork = 2;
  static constexpr int kOpening = 1;  ///< logarithmic volume by which the soil has opened

  DruckerPrager(const DruckerPragerDefinition& d, double density);

  template <class T, class Matrix, class Symmetric>
  void update(const Increment<T, Matrix>& step, Symmetric& tau, T* history) const {
    const T to_tau = step.j * T(1.0 / density_);
    const Symmetric previous = scale_shift(tau, T(density_) / step.j_old, T(0));
    const Symmetric trial = LinearElastic::stress_rate_update(previous, step.du, bulk_, shear_);
    const T trial_mean = T(1.0 / 3.0) * trace(trial);
    Symmetric deviator = scale_shift(trial, T(1), -trial_mean);
    T mean = close_opening(trial_mean, bulk_, history[kOpening]);
    const T j2 = T(0.5) * squared_norm(deviator);
    const T yield_root_j2 = T(strength_) - T(eta_) * mean;
    const auto shears = (yield_root_j2 < T(0)) | (j2 > yield_root_j2 * yield_root_j2);
    if (any(shears | (mean > T(cutoff_)))) flow(shears, j2, yield_root_j2, to_tau, mean, deviator, history);
    tau = scale_shift(deviator, to_tau, mean * to_tau);
  }

  template <class Matrix, class Symmetric>
  double elastic_energy(const Matrix&, const Symmetric& tau, double j) const {
    return LinearElastic::stress_energy(scale_shift(tau, density_ / j, 0.0), bulk_, shear_) * j / density_;
  }

  template <class T, class Matrix, class Symmetric>
  T wave_speed(const Matrix&, const Symmetric& tau, T j) const {
    const T to_cauchy = T(density_) / j, third = T(1.0 / 3.0) * trace(tau);
    const T mean = third * to_cauchy;
    const T root_j2 = sqrt(T(0.5) * squared_norm(scale_shift(tau, T(1), -third))) * to_cauchy;
    const auto flows = root_j2 >= T(kNearYield) * (T(strength_) - T(eta_) * mean);
    // Opened soil carries no pressure and does not dilate.
    const T flow = select(mean > T(-kStressFree * bulk_), T(flow_stiffness(0.0)), T(flow_stiffness(eta_bar_)));
    return soil_wave_speed(tau, j, bulk_, shear_, density_, select(flows, flow, T(0)));
  }
  double density() const { return density_; }
  double eta() const { return eta_; }
  double eta_bar() const { return eta_bar_; }
  /// xi c: shear strength at zero mean stress [Pa]
  double strength() const { return strength_; }

 private:
  /// Largest contribution of plastic flow to rho c^2 [Pa] (opening.hpp): |p - q| = K (eta - eta_bar), h = G + K eta
  /// eta_bar.
  double flow_stiffness(double eta_bar) const {
    const double half = 0.5 * bulk_ * (eta_ - eta_bar);
    return half * half / (shear_ + bulk_ * eta_ * eta_bar);
  }

  /// Returns `mean` and `deviator` to the cone or its apex in the lanes where `shears` holds, and to the cut-off in
  /// all.
  template <class T, class Mask, class Symmetric>
  void flow(const Mask& shears, T j2, T yield_root_j2, T to_tau, T& mean, Symmetric& deviator, T* history) const {
    const T root_j2 = sqrt(j2);
    // Opened soil has room to dilate into, so dilation builds up no pressure.
    const T eta_bar = select(history[kOpening] > T(0), T(0), T(eta_bar_));
    // Increment of the equivalent plastic shear strain, sqrt(2 de:de).
    T multiplier = select(shears, (root_j2 - yield_root_j2) / (T(shear_) + T(bulk_ * eta_) * eta_bar), T(0));
    const T beyond = root_j2 - T(shear_) * multiplier;
    const T left = max(beyond, T(0));
    // Without friction there is no apex; values below zero are round-off.
    const auto apex = (beyond < T(0)) & (T(eta_) > T(0));
    multiplier = select(apex, T(1.0 / shear_) * root_j2, multiplier);
    const T dilation = select(apex, T(0), eta_bar * multiplier);
    T opened = select(apex, T(1.0 / bulk_) * (mean - T(apex_)), T(0));
    mean = select(apex, T(apex_), mean - T(bulk_) * dilation);
    opened += T(1.0 / bulk_) * max(mean - T(cutoff_), T(0));
    mean = min(mean, T(cutoff_));
    constexpr float kAlmostNothing = std::numeric_limits<float>::min();  // avoids 0 / 0 where the deviator is zero
    deviator = scale_shift(deviator, select(shears, left / max(root_j2, T(kAlmostNothing)), T(1)), T(0));
    history[kOpening] += opened;
    history[kPlasticStrain] += multiplier;
    history[kPlasticWork] += (left * multiplier + mean * (dilation + opened)) * to_tau;
  }

  double density_, bulk_, shear_;
  double eta_, eta_bar_, strength_;
  double apex_;    ///< mean stress at the cone's apex [Pa]
  double cutoff_;  ///< largest mean stress [Pa]
};

}  // namespace mpm
