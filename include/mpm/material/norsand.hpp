// NorSand: sand whose strength, dilation and stiffness rise with density and fall with pressure. With the pressure p,
// the Mises stress q, the void ratio e (which follows from J) and the image pressure p_i, at which flow keeps the
// volume:
//
//   critical     e_c(p) = Gamma - lambda ln(p / 1 kPa), or Gamma - lambda (p / 100 kPa)^xi; q = M p
//   state        psi = e - e_c(p_i); the largest dilation is chi_i psi, with chi_i = chi / (1 - chi lambda / M)
//   image        M_i = M - N chi_i |psi|
//   surface      q / p = M_i (1 + ln(p_i / p)), and at most M_i - chi_i psi where that lies above M_i (internal cap)
//   flow         D = M_i - q / p, plastic loss of volume over plastic shear
//   hardening    d ln p_i = H (p / p_i)^2 (exp(-chi_i psi / M_i) - p_i / p) d eps_q,  H = H_0 - H_psi psi
//   elastic      G = G_100 (p / 100 kPa)^n, K by Poisson's ratio
//
// M, M_i, D and H are times M(theta) / M = (2 a^4 / (1 + a^4 - (1 - a^4) S))^(1/4), a = 3 / (3 + M), S = 1 in triaxial
// compression and -1 in extension: Mohr-Coulomb's value in both, and between them within 3 % of the source's form,
// which is the average of Mohr-Coulomb and Matsuoka-Nakai. In all of this p is p + p_r, except in q / p, so that sand
// without pressure has a stiffness and no cohesion: `p_r`, the least pressure, must be small beside the pressures that
// matter.
//
// Chosen over hypoplasticity and over bounding surfaces with fabric: it has a closed surface, so that sand is compacted
// by pressure too and tension is cut where it is by other soil; every constant is read from drained triaxial tests and
// is published for many sands; and a step is one equation with a bracket. Opened sand closes before it carries pressure
// (opening.hpp); its void ratio is that before it opened, and it remembers its image pressure.
//
// Return: radial, so that the Lode angle of the trial stays. With the stress ratio y at the end as the unknown, D = M_i
// - y, shear strain d = (q_t - y p_t) / (3 G - y K D), p = p_t - K D d, and p_i is implicit in d: one equation, whose
// root lies from 0 to the smaller of the trial's ratio and the cap. Where even y = 0 is beyond the surface, the stress
// returns to the surface's tip, q = 0; d then stands for D = M_i, so that ln p_i rises by H e (e X - 1) / M_i of the
// plastic volume, X = exp(-chi_i psi / M_i) (this project's choice: the source has no flow there). G and K are means of
// a step; psi and the p / p_i of H are those before flow.
//
// Particles of a cell share their stress (kAveragesStress): the flow rule locks as that of other soil, and stress is
// kept, not found from J. Their image pressures are their own, so shared stress is returned in the next step.
//
// Weak: D is at most M_i where it would be without bound at q = 0, so that sand compressed without strain sideways
// ends with more pressure on its sides than sand has; unloading is elastic, so cycles do not compact, and no fabric is
// kept; dense sand softens with the strain of a cell, not with a slip (softening.hpp); G(p) in rate form stores and
// loses energy around closed paths, as in Cam clay with Poisson's ratio; chi_i psi is bounded (kMostRatio, kLoosest).
// Source: M. G. Jefferies (1993), Geotechnique 43, 91-103; M. Jefferies, K. Been (2016), Soil liquefaction: a critical
// state approach, 2nd ed., 3.6 and table 3.1; implicit: R. I. Borja, J. E. Andrade (2006), Comput. Methods Appl. Mech.
// Eng. 195, 5115-5140; curved critical line: X. S. Li, Y. Wang (1998), J. Geotech. Geoenviron. Eng. 124, 1215-1217;
// M(theta): D. Sheng, S. W. Sloan, H. S. Yu (2000), Comput. Mech. 26, 185-196.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "mpm/material/linear_elastic.hpp"
#include "mpm/material/returned_work.hpp"

namespace mpm {

class NorSand : public LawDefaults {
 public:
  static constexpr Matter kMatter = Matter::soil;
  static constexpr bool kRateDependent = false;
  static constexpr bool kStiffnessOfPressure = true;
  static constexpr bool kForgetsShape = false;
  static constexpr bool kAveragesStress = true;
  static constexpr StressSource kStressFrom = StressSource::stress;
  static constexpr ImplicitSteps kImplicit = ImplicitSteps::refused;
  static constexpr int kHistory = 4;
  static constexpr int kPlasticStrain = 0;  ///< sum of sqrt(2 de:de) with the plastic deviator de
  static constexpr int kOpening = 1;        ///< logarithmic volume by which the sand has opened beyond p = 0
  static constexpr int kPlasticWork = 2;
  static constexpr int kHardening = 3;  ///< ln(p_i / p_r)

  NorSand(const NorSandDefinition& d, double density);

  template <class T, class Matrix, class Symmetric>
  void update(const Increment<T, Matrix>& step, Symmetric& tau, T* history) const {
    const T to_tau = step.j * T(1.0 / density_);
    const Symmetric previous = scale_shift(tau, T(density_) / step.j_old, T(0));
    const T mean = T(1.0 / 3.0) * trace(previous);
    const Symmetric rate = symmetric_part(step.du);
    const T growth = trace(rate);
    // (p + p_r)^(1 - n) falls by spring_ times the growth of the volume.
    const T before = max(-mean, T(0)) + T(least_), root = power(before, 1.0 - exponent_);
    const T next = root - T(spring_) * (growth + history[kOpening]);
    const auto open = next < T(least_root_);
    history[kOpening] = select(open, T(1.0 / spring_) * (T(least_root_) - next), T(0));
    const T change = power(max(next, T(least_root_)) / root, 1.0 / (1.0 - exponent_));  // 1 without motion, exactly
    const T raised = max(before * change, T(least_));
    const T bulk = T(0.5 * stiffness_) * (before / root + raised / max(next, T(least_root_)));
    const T shear = T(shear_over_bulk_) * bulk;
    T pressure = select(open, T(0), raised - T(least_));
    const Symmetric half = scale_shift(rate, shear, T(-1.0 / 3.0) * shear * growth);
    Symmetric deviator = sum(rotate(sum(scale_shift(previous, T(1), -mean), half), step.du), half);
    const T j2 = T(0.5) * squared_norm(deviator), q_trial = sqrt(T(3) * j2);

    const T image = T(least_) * exp(history[kHardening]);
    const Surface<T> now = surface(T(1.0 + void_ratio_) * step.j * exp(-history[kOpening]) - T(1), image);
    const auto flows = (q_trial > T(least_lode_) * pressure * now.ratio(image, raised)) & !open;
    if (any(flows | open)) {
      const T lode = lode_factor(deviator, j2);
      const auto yields = flows & (q_trial > lode * pressure * now.ratio(image, raised));
      Return<T> end{q_trial, pressure, image};
      if (any(yields)) end = returned(yields, now, lode, bulk, shear, end);
      const T q = select(open, T(0), end.q);
      const T kept = q / max(q_trial, T(std::numeric_limits<float>::min()));
      history[kPlasticStrain] += T(1.0 / kRoot3) * (q_trial - q) / shear;
      // The mean of the stresses at the start and at the end (returned_work.hpp).
      const T sheared = (T(1) - kept) * (inner(previous, deviator) + T(2) * kept * j2);
      const T pressed = (before - T(least_) + end.pressure) * (pressure - end.pressure);
      history[kPlasticWork] += (T(0.25) * sheared / shear + T(0.5) * pressed / bulk) * to_tau;
      history[kHardening] = select(yields, log(end.image * T(1.0 / least_)), history[kHardening]);
      pressure = end.pressure;
      deviator = scale_shift(deviator, kept, T(0));
    }
    tau = scale_shift(deviator, to_tau, -pressure * to_tau);
  }

  /// Energy of volume, the integral of p dp / K, and of shape, q^2 / 6 G at the present pressure.
  template <class Matrix, class Symmetric>
  double elastic_energy(const Matrix&, const Symmetric& tau, double j) const {
    const double mean = trace(tau) / 3.0 * density_ / j, raised = std::max(-mean, 0.0) + least_;
    const double j2 = 0.5 * squared_norm(scale_shift(tau, density_ / j, -mean));
    return (volume_energy(raised) + 0.5 * j2 / (shear_over_bulk_ * bulk_at(raised))) * j / density_;
  }

  /// Speed of the elastic response, with what flow that is not associated adds at most (soil_wave_speed in
  /// opening.hpp). Loose sand without pressure carries no wave until it has closed.
  template <class T, class Matrix, class Symmetric>
  T wave_speed(const Matrix&, const Symmetric& tau, T j) const {
    const T mean = T(1.0 / 3.0) * trace(tau) * T(density_) / j, pressure = max(-mean, T(0));
    const T closed = select((j > T(1)) & (pressure < T(1e-6 * least_)), T(1), j);
    const T bulk = T(stiffness_) * power(pressure + T(least_), exponent_), shear = T(shear_over_bulk_) * bulk;
    const T deviator = sqrt(squared_norm(scale_shift(tau, T(density_) / j, -mean)));
    const T along = bulk + T(4.0 / 3.0) * shear, across = shear + T(0.7071067811865476) * deviator;
    // select() instead of max(), so that NaN is passed on.
    return sqrt((select(across <= along, along, across) + T(flow_) * bulk) * closed * T(1.0 / density_));
  }
  double density() const { return density_; }
  /// Elastic strain of a Cauchy stress [Pa].
  Symmetric3<double> elastic_strain(const StressedPoint& at) const;
  /// kHardening at the start under a Cauchy stress [Pa]: of the surface through it, grown by the overconsolidation
  /// ratio.
  double initial_hardening(const Symmetric3<double>& cauchy) const;
  double least_pressure() const { return least_; }
  /// Void ratio at the volume j over the initial one, opened or not.
  double void_ratio(double j) const { return (1.0 + void_ratio_) * j - 1.0; }
  /// e_c at a pressure [Pa].
  double critical_void_ratio(double pressure) const { return critical(pressure + least_); }

 private:
  static constexpr double kRoot3 = 1.7320508075688772;
  static constexpr double kEuler = 2.718281828459045;

  /// x^a, x > 0
  template <class T>
  static T power(T x, double a) {
    return exp(T(a) * log(x));
  }
  /// e_c at p + p_r [Pa].
  template <class T>
  T critical(T raised) const {
    if (curve_ == 0.0) return T(gamma_) - T(lambda_) * log(T(1e-3) * raised);
    return T(gamma_) - T(lambda_) * power(T(1e-5) * raised, curve_);
  }

  /// The surface in triaxial compression as it is at a void ratio and an image pressure, and how it may harden.
  template <class T>
  struct Surface {
    T slope;      ///< M_i
    T most;       ///< largest q / p
    T limit;      ///< largest p_i / p
    T hardening;  ///< H
    /// q / p at yield, p + p_r being `raised`.
    T ratio(T image, T raised) const { return min(slope + slope * log(image / raised), most); }
  };
  template <class T>
  Surface<T> surface(T voids, T image) const {
    const T state = voids - critical(image);
    const T dilation = max(min(T(chi_) * state, T(loosest_)), T(-densest_));
    const T slope = T(slope_) - T(coupling_) * abs(dilation);
    return {slope, slope + max(-dilation, T(0)), exp(-dilation / slope),
            max(T(hardening_) - T(hardening_of_state_) * state, T(0.5 * hardening_))};
  }

  /// M(theta) / M of a deviator with this J2.
  template <class T, class Symmetric>
  T lode_factor(const Symmetric& deviator, T j2) const {
    const T scale = T(kRoot3) / sqrt(max(j2, T(std::numeric_limits<float>::min())));
    const T compression = T(-0.5) * determinant(scale_shift(deviator, scale, T(0)));
    return T(1) / sqrt(sqrt(T(lode_mean_) - T(lode_half_) * max(min(compression, T(1)), T(-1))));
  }

  /// Mises stress, pressure and image pressure [Pa].
  template <class T>
  struct Return {
    T q, pressure, image;
  };
  /// The return of the trial `at` where `flows`. Not inlined, since all geometries share it.
  template <class T, class Mask>
  [[gnu::noinline]] Return<T> returned(const Mask& flows, const Surface<T>& now, const T& lode, const T& bulk,
                                       const T& shear, const Return<T>& at) const {
    constexpr int kSteps = 40;
    constexpr double kEpsilon = std::numeric_limits<ScalarOf<T>>::epsilon();
    const T slope = lode * now.slope, triple = T(3) * shear;
    const T scaled = min((at.pressure + T(least_)) / at.image, T(kEuler));
    const T hardening = lode * now.hardening * scaled;
    const auto at_ratio = [&](const T& y) {
      const T loss = slope - y;
      const T strain = (at.q - y * at.pressure) / max(triple - y * bulk * loss, T(0.1) * triple);
      Return<T> end;
      end.pressure = max(at.pressure - bulk * loss * strain, T(0));
      end.q = y * end.pressure;
      const T grown = hardening * strain;
      end.image = (at.image + grown * now.limit * (end.pressure + T(least_))) / (T(1) + grown);
      return end;
    };
    const auto miss = [&](const T& y) {
      const Return<T> end = at_ratio(y);
      return y - lode * now.ratio(end.image, end.pressure + T(least_));
    };
    T low = T(0), high = min(at.q / max(at.pressure, T(std::numeric_limits<float>::min())), lode * now.most);
    T below = miss(low), above = miss(high), y = high, side = T(0);
    const auto tip = below >= T(0);
    auto open = flows & !tip & (above > T(4.0 * kEpsilon));
    // False position; an end that stays twice counts half (the Illinois rule).
    for (int i = 0; i < kSteps && any(open); ++i) {
      const T next = high - above * (high - low) / max(above - below, T(std::numeric_limits<float>::min()));
      y = select(open, next, y);
      const T f = miss(y);
      open = open & (abs(f) > T(4.0 * kEpsilon)) & (high - low > T(2.0 * kEpsilon));
      const auto over = f > T(0);
      below = select(over, select(side > T(0), T(0.5) * below, below), f);
      above = select(over, f, select(side < T(0), T(0.5) * above, above));
      low = select(over, low, y);
      high = select(over, y, high);
      side = select(over, T(1), T(-1));
    }
    Return<T> end = at_ratio(y);
    if (any(flows & tip)) {
      // (p + p_r) = e p_i, with p = p_t - K M_i d.
      const T start = at.pressure + T(least_), fall = bulk * slope;
      const T gain = hardening * (T(kEuler) * now.limit - T(1)), linear = fall + start * gain;
      const T excess = max(start - T(kEuler) * at.image, T(0));
      const T root = sqrt(max(linear * linear - T(4) * fall * gain * excess, T(0)));
      const T strain = T(2) * excess / max(linear + root, T(std::numeric_limits<float>::min()));
      const T raised = max(start - fall * strain, T(least_)), grown = hardening * strain;
      end.q = select(tip, T(0), end.q);
      end.pressure = select(tip, raised - T(least_), end.pressure);
      end.image = select(tip, (at.image + grown * now.limit * raised) / (T(1) + grown), end.image);
    }
    return {select(flows, end.q, at.q), select(flows, end.pressure, at.pressure), select(flows, end.image, at.image)};
  }

  double bulk_at(double raised) const { return stiffness_ * std::pow(raised, exponent_); }
  double volume_energy(double raised) const;
  double largest_flow_stiffness() const;

  double density_;
  double void_ratio_;
  double gamma_, lambda_, curve_;  ///< the critical line; the last is xi, or 0 for the logarithm
  double slope_;                   ///< M
  double coupling_, chi_;          ///< N, chi_i
  double densest_, loosest_;       ///< bounds of -chi_i psi and of chi_i psi
  double hardening_, hardening_of_state_;
  double exponent_, stiffness_;  ///< K = stiffness (p + p_r)^exponent [Pa]
  double shear_over_bulk_;
  double least_, least_root_;     ///< p_r [Pa], and its power 1 - n
  double spring_;                 ///< (1 - n) stiffness
  double least_lode_;             ///< a, smallest M(theta) / M
  double lode_mean_, lode_half_;  ///< (1 + a^4) / 2 a^4 and (1 - a^4) / 2 a^4
  double ratio_;                  ///< overconsolidation ratio
  double flow_;                   ///< largest contribution of plastic flow to rho c^2, over K
};

}  // namespace mpm
