// Drucker-Prager soil: f = sqrt(J2) + eta p - xi c, potential with eta_bar from the dilation angle, tension positive,
// p = tr(sigma)/3. Elastic predictor in rate form (as linear_elastic.hpp), return to the cone, its apex, or the tension
// cut-off. Soil that has opened (apex, cut-off) closes before it carries pressure (opening.hpp).
// Weak: plastic work counts the stress at the end of a step; no hardening, no critical state, so dilation never ends;
// hypoelastic, meant for small elastic strain. Source: method reference 10.6 (flow rule and the three matches to
// Mohr-Coulomb verified there).
#pragma once

#include <algorithm>
#include <cmath>

#include "mpm/material/linear_elastic.hpp"
#include "mpm/material/opening.hpp"

namespace mpm {

class DruckerPrager : public LawTraits {
 public:
  static constexpr int kHistory = 3;
  static constexpr int kPlasticStrain = 0;
  static constexpr int kPlasticWork = 2;
  static constexpr int kOpening = 1;  ///< logarithmic volume that the soil has opened by

  DruckerPrager(const DruckerPragerDefinition& d, double density);

  template <class T, class Matrix, class Symmetric>
  void update(const Increment<T, Matrix>& step, Symmetric& tau, T* const* history, int p) const {
    const T j = step.j;
    const T bulk = T(bulk_), shear = T(shear_);
    const Symmetric previous = scale_shift(tau, T(density_) / step.j_old, T(0));
    const Symmetric trial = LinearElastic::stress_rate_update(previous, step.du, bulk, shear);

    T mean = trace(trial) / T(3);
    Symmetric deviator = scale_shift(trial, T(1), -mean);
    T& opening = history[kOpening][p];
    mean = close_opening(mean, bulk, opening);
    const T root_j2 = std::sqrt(T(0.5) * squared_norm(deviator));
    const T yield = root_j2 + T(eta_) * mean - T(strength_);
    T multiplier = T(0);  // increment of the equivalent plastic shear strain, sqrt(2 de:de)
    T dilation = T(0), opened = T(0);
    if (yield > T(0)) {
      // Opened soil has room to dilate into: no pressure comes of it.
      const T eta_bar = opening > T(0) ? T(0) : T(eta_bar_);
      multiplier = yield / (shear + bulk * T(eta_) * eta_bar);
      const T left = root_j2 - shear * multiplier;
      if (left >= T(0) || eta_ == 0.0) {  // without friction there is no apex, only round-off below zero
        deviator = scale_shift(deviator, std::max(left, T(0)) / root_j2, T(0));
        dilation = eta_bar * multiplier;
        mean -= bulk * dilation;
      } else {
        multiplier = root_j2 / shear;
        deviator = scale_shift(deviator, T(0), T(0));
        opened += (mean - T(apex_)) / bulk;
        mean = T(apex_);
      }
    }
    if (mean > T(cutoff_)) {
      opened += (mean - T(cutoff_)) / bulk;
      mean = T(cutoff_);
    }
    if (multiplier > T(0) || opened > T(0)) {
      opening += opened;
      history[kPlasticStrain][p] += multiplier;
      const T shear_stress = std::sqrt(T(0.5) * squared_norm(deviator));
      history[kPlasticWork][p] += (shear_stress * multiplier + mean * (dilation + opened)) * j / T(density_);
    }
    tau = scale_shift(scale_shift(deviator, T(1), mean), j / T(density_), T(0));
  }

  template <class Matrix, class Symmetric>
  double elastic_energy(const Matrix&, const Symmetric& tau, double j) const {
    return LinearElastic::stress_energy(scale_shift(tau, density_ / j, 0.0), bulk_, shear_) * j / density_;
  }

  double wave_speed(const Matrix3<double>&, const Symmetric3<double>& tau, double j) const {
    const double mean = trace(tau) / 3.0 * density_ / j;
    const double root_j2 = std::sqrt(0.5 * squared_norm(scale_shift(tau, 1.0, -trace(tau) / 3.0))) * density_ / j;
    const bool flows = root_j2 >= kNearYield * (strength_ - eta_ * mean);
    // |p - q| = K (eta - eta_bar), h = G + K eta eta_bar; opened soil, which never bears pressure, does not dilate.
    const double eta_bar = mean > -kStressFree * bulk_ ? 0.0 : eta_bar_;
    const double half = 0.5 * bulk_ * (eta_ - eta_bar);
    const double flow = half * half / (shear_ + bulk_ * eta_ * eta_bar);
    return soil_wave_speed(tau, j, bulk_, shear_, density_, flows ? flow : 0.0);
  }
  double density() const { return density_; }
  double eta() const { return eta_; }
  double eta_bar() const { return eta_bar_; }
  /// xi c: shear strength at zero mean stress [Pa]
  double strength() const { return strength_; }

 private:
  double density_, bulk_, shear_;
  double eta_, eta_bar_, strength_;
  double apex_;    ///< mean stress at the cone's apex [Pa]
  double cutoff_;  ///< largest mean stress [Pa]
};

}  // namespace mpm
