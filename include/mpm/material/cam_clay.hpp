// Modified Cam clay: soft soil that hardens as it is compressed and flows at constant volume in the end (critical
// state). With the pressure p, the Mises stress q and the specific volume v (volume over that of the grains):
//
//   elastic      v falls by kappa d ln(p + p_r), so K = v (p + p_r) / kappa; G constant, or of K by Poisson's ratio
//   surface      f = q^2 / M^2 + p (p - p_c) <= 0, flow normal to it
//   hardening    d ln p_c = -dv_p / (lambda - kappa), v_p the plastic part of v
//
// so that isotropic compression goes along v = N - lambda ln p, and critical states are q = M p, p_c = 2 p. `p_r`, the
// least pressure, leaves clay without pressure a stiffness (the classic law has none); it must be small beside the
// pressures that matter. v follows from J, and with it ln(p + p_r) to the third order of a step; the deviator is in
// rate form (linear_elastic.hpp).
//
// Return: with u, the plastic part of the fall of v over kappa, p = (p_t + p_r) exp(-u) - p_r, p_c = p_c,n exp(kappa u
// / (lambda - kappa)) and q = q_t d / (d + c u), d = 2 p - p_c, c = 6 G kappa / (v M^2): one equation f(u) = 0, whose
// root lies between 0 and the u of the critical state, d = 0. Newton's method there, with bisection where it would
// leave the bracket; near the critical state q is then put on the surface. That holds at the tip (p = 0), on both sides
// of the critical state and on it. Clay without pressure carries nothing; opened clay closes before it carries pressure
// (opening.hpp).
//
// Weak: a round surface, so strength in triaxial extension is too high (M is that of compression); with Poisson's ratio
// the elastic part stores and loses energy around closed paths (M. Zytynski et al. (1978), Int. J. Numer. Anal. Meth.
// Geomech. 2, 87-93), which a constant G does not; strongly overconsolidated clay is too strong and softens with the
// cell, not with a slip; no pore water; plastic work is computed with the stress at the end of a step.
// Source: K. H. Roscoe, J. B. Burland (1968), in Engineering Plasticity, 535-609; D. Muir Wood (1990), Soil behaviour
// and critical state soil mechanics, ch. 5; implicit in ln p: R. I. Borja, S. R. Lee (1990), Comput. Methods Appl.
// Mech. Eng. 78, 49-72.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "mpm/material/linear_elastic.hpp"

namespace mpm {

class CamClay : public LawDefaults {
 public:
  static constexpr Matter kMatter = Matter::soil;
  static constexpr bool kRateDependent = false;
  static constexpr bool kStiffnessOfPressure = true;
  static constexpr bool kForgetsShape = false;
  static constexpr bool kAveragesStress = false;
  static constexpr StressSource kStressFrom = StressSource::stress;
  static constexpr ImplicitSteps kImplicit = ImplicitSteps::refused;
  static constexpr int kHistory = 4;
  static constexpr int kPlasticStrain = 0;  ///< sum of sqrt(2 de:de) with the plastic deviator de
  static constexpr int kOpening = 1;        ///< fall of v over kappa by which the clay has opened beyond p = 0
  static constexpr int kPlasticWork = 2;
  static constexpr int kHardening = 3;  ///< ln(p_c / p_c of the material)

  CamClay(const CamClayDefinition& d, double density);

  template <class T, class Matrix, class Symmetric>
  void update(const Increment<T, Matrix>& step, Symmetric& tau, T* history) const {
    const T to_tau = step.j * T(1.0 / density_);
    const Symmetric previous = scale_shift(tau, T(density_) / step.j_old, T(0));
    const T mean = T(1.0 / 3.0) * trace(previous);
    const Symmetric rate = symmetric_part(step.du);
    const T growth = trace(rate), volume = T(0.5 * volume_) * (step.j + step.j_old);
    // Rise of ln(p + p_r) in the step, after what is still open has closed.
    const T before = max(-mean, T(0)) + T(least_);
    const T rise = T(-1.0 / kappa_) * volume * growth - history[kOpening];
    const T raised = before * exp(rise);
    const auto open = raised < T(least_);
    history[kOpening] = T(0);
    if (any(open)) history[kOpening] = select(open, -rise - log(before * T(1.0 / least_)), T(0));
    T pressure = max(raised, T(least_)) - T(least_);
    const T bulk = T(0.5 / kappa_) * volume * (before + pressure + T(least_));
    const T shear = T(shear_) + T(shear_of_bulk_) * bulk;
    const Symmetric half = scale_shift(rate, shear, T(-1.0 / 3.0) * shear * growth);
    Symmetric deviator = sum(rotate(sum(scale_shift(previous, T(1), -mean), half), step.du), half);
    const T j2 = T(0.5) * squared_norm(deviator);
    const T consolidated = T(consolidation_) * exp(history[kHardening]);
    const T size = T(3.0 / (slope_ * slope_)) * j2;  // (q / M)^2
    const auto flows = (size + pressure * (pressure - consolidated) > T(0)) & !open;
    if (any(flows | open)) {
      const T steep = T(6.0 * kappa_ / (slope_ * slope_)) * shear / volume;
      const T plastic = select(flows, plastic_rise(flows, pressure + T(least_), consolidated, size, steep), T(0));
      const T after = max((pressure + T(least_)) * exp(-plastic) - T(least_), T(0));
      const T hardened = consolidated * exp(T(hardening_) * plastic);
      // The return gives q by the flow rule and on the surface: the first is round-off at the critical state, the
      // second at the tips of the surface.
      const T q_trial = sqrt(T(3) * j2), distance = T(2) * after - hardened;
      const T by_flow = q_trial * distance / (distance + steep * plastic);
      const T on_surface = min(T(slope_) * sqrt(max(after * (hardened - after), T(0))), q_trial);
      const T q_flow = select(abs(distance) > T(0.25) * hardened, by_flow, on_surface);
      const T q = select(open, T(0), select(flows, q_flow, q_trial));
      pressure = select(flows, after, pressure);
      deviator = scale_shift(deviator, q / max(q_trial, T(std::numeric_limits<float>::min())), T(0));
      const T lost = (q_trial - q) / (T(3) * shear);
      history[kPlasticStrain] += T(kRoot3) * lost;
      history[kPlasticWork] += (q * lost + pressure * (T(kappa_) * plastic / volume)) * to_tau;
      history[kHardening] += T(hardening_) * plastic;
    }
    tau = scale_shift(deviator, to_tau, -pressure * to_tau);
  }

  /// Energy of volume: the integral of p dv over kappa d ln(p + p_r); of shape: q^2 / 6 G at the present pressure.
  template <class Matrix, class Symmetric>
  double elastic_energy(const Matrix&, const Symmetric& tau, double j) const {
    const double mean = trace(tau) / 3.0 * density_ / j, pressure = std::max(-mean, 0.0);
    const double j2 = 0.5 * squared_norm(scale_shift(tau, density_ / j, -mean));
    const double volume = kappa_ / volume_ * (pressure - least_ * std::log1p(pressure / least_));
    return (volume + 0.5 * j2 / shear_at(pressure, j) * j) / density_;
  }

  /// Wave speed of the elastic response, which flow normal to the surface does not stiffen. Loose clay without pressure
  /// carries no wave until it has closed.
  template <class T, class Matrix, class Symmetric>
  T wave_speed(const Matrix&, const Symmetric& tau, T j) const {
    const T mean = T(1.0 / 3.0) * trace(tau) * T(density_) / j, pressure = max(-mean, T(0));
    const T closed = select((j > T(1)) & (pressure < T(1e-6 * least_)), T(1), j);
    const T bulk = T(volume_ / kappa_) * closed * (pressure + T(least_));
    const T shear = T(shear_) + T(shear_of_bulk_) * bulk;
    const T deviator = sqrt(squared_norm(scale_shift(tau, T(density_) / j, -mean)));
    const T along = bulk + T(4.0 / 3.0) * shear, across = shear + T(0.7071067811865476) * deviator;
    return sqrt(select(across <= along, along, across) * closed * T(1.0 / density_));
  }
  double density() const { return density_; }
  /// Elastic strain of a Cauchy stress [Pa] at the volume j over the initial one.
  Symmetric3<double> elastic_strain(const StressedPoint& at) const;
  /// kHardening at the start under a Cauchy stress [Pa]: of clay with an overconsolidation ratio, which has been under
  /// that many times the surface through this stress.
  double initial_hardening(const Symmetric3<double>& cauchy) const;

 private:
  static constexpr double kRoot3 = 1.7320508075688772;

  double shear_at(double pressure, double j) const {
    return shear_ + shear_of_bulk_ * volume_ * j * (pressure + least_) / kappa_;
  }

  /// u where `flows`; `trial`: p + p_r, `size`: (q / M)^2 of the predictor, `steep`: c. Not inlined, since all
  /// geometries share it.
  template <class T, class Mask>
  [[gnu::noinline]] T plastic_rise(const Mask& flows, const T& trial, const T& consolidated, const T& size,
                                   const T& steep) const {
    constexpr int kSteps = 60;
    constexpr double kEpsilon = std::numeric_limits<ScalarOf<T>>::epsilon();
    const T tiny = T(std::numeric_limits<float>::min());
    // Clay on the wet side of the critical state is compressed (u > 0), on the dry side it dilates.
    const T sign = select(T(2) * (trial - T(least_)) > consolidated, T(1), T(-1));
    T low = T(0), high = abs(log(trial / (T(0.5) * consolidated + T(least_)))), u = T(0);
    auto open = flows;
    for (int i = 0; i < kSteps; ++i) {
      const T raised = trial * exp(-sign * u), p = raised - T(least_);
      const T hardened = consolidated * exp(T(hardening_) * sign * u);
      const T distance = sign * (T(2) * p - hardened), with = max(distance + steep * u, tiny);
      const T part = max(distance, T(0)) / with;
      const T scale = size * part * part;
      const T f = select(distance > T(0), scale + p * (p - hardened), -raised * raised);
      open = open & (abs(f) > T(8.0 * kEpsilon) * (scale + p * hardened)) & (high - low > T(2.0 * kEpsilon));
      if (!any(open)) break;
      const T bend = T(-2) * raised - T(hardening_) * hardened;
      const T slope = T(2) * scale * steep * (bend * u - distance) / max(with * distance, tiny) - raised * distance -
                      T(hardening_) * sign * p * hardened;
      low = select(f > T(0), u, low);
      high = select(f > T(0), high, u);
      const T newton = u - f / slope;
      u = select(open, select((newton > low) & (newton < high), newton, T(0.5) * (low + high)), u);
    }
    return sign * u;
  }

  double density_;
  double volume_;                 ///< v at the start, 1 + void ratio
  double kappa_, hardening_;      ///< kappa, kappa / (lambda - kappa)
  double slope_;                  ///< M
  double shear_, shear_of_bulk_;  ///< G is the first [Pa] plus the second times K
  double consolidation_;          ///< p_c of the material [Pa]
  double least_;                  ///< p_r [Pa]
  double ratio_;                  ///< overconsolidation ratio, or 0
};

}  // namespace mpm
