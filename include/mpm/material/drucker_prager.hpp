// Drucker-Prager soil: f = sqrt(J2) + eta p - xi c, flow s / (2 sqrt(J2)) + eta_bar / 3, tension positive, p =
// tr(sigma)/3. Elastic predictor in rate form (as linear_elastic.hpp), return to the cone, its apex, or the tension
// cut-off. Opened soil (apex, cut-off) closes before it carries pressure (opening.hpp).
//
// A round cone has Mohr-Coulomb's strength at one Lode angle only (ConeMatch). The match in triaxial compression acts
// in plane strain as 44 degrees for 30, without dilation. With ConeMatch::mohr_coulomb, the default, eta and eta_bar
// follow the Lode angle so that strength is Mohr-Coulomb's in every state. Flow remains radial in the deviatoric plane,
// so the return keeps the Lode angle and is in closed form, without principal directions:
//
//   eta = sin(phi) / k(phi), xi = cos(phi) / k(phi), eta_bar = sin(psi) / k(psi),
//   k(a) = ((s1 - s3) + (s1 + s3) sin(a)) / (2 sqrt(J2)), s1 and s3 the largest and smallest principal deviators.
//
// In triaxial compression and extension these are the cones matched there; in plane strain (no plastic strain along y)
// s1 + s3 = 2/3 eta_bar sqrt(J2), and the dilation of the plane is psi.
//
// Dilation ends when the soil, or a shear band in it, has gained a given volume, and its strength remains; or both fall
// together to those of the critical state (softening.hpp; of a round cone, eta and xi c fall in a straight line).
// Plastic work has the mean stress of a step (returned_work.hpp). Weak: no hardening; hypoelastic, meant for small
// elastic strain; with a slope that follows the Lode angle, flow is not normal to the surface even if phi = psi, except
// in the states named above. Source: method reference 10.6; exact-solutions 31 for plane strain with any dilation; the
// surface is Mohr-Coulomb's in invariants, G. C. Nayak, O. C. Zienkiewicz (1972), J. Struct. Div. ASCE 98, 949-954.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "mpm/material/linear_elastic.hpp"
#include "mpm/material/opening.hpp"
#include "mpm/material/returned_work.hpp"
#include "mpm/material/softening.hpp"
#include "mpm/math/principal.hpp"

namespace mpm {

class DruckerPrager : public LawDefaults {
 public:
  static constexpr Matter kMatter = Matter::soil;
  static constexpr bool kRateDependent = false;
  static constexpr bool kStiffnessOfPressure = false;
  static constexpr bool kForgetsShape = false;
  static constexpr bool kAveragesStress = true;
  static constexpr StressSource kStressFrom = StressSource::stress;
  static constexpr ImplicitSteps kImplicit = ImplicitSteps::measured;
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
    const Symmetric deviator = scale_shift(trial, T(1), -trial_mean);
    T mean = close_opening(trial_mean, bulk_, history[kOpening]);
    const T j2 = T(0.5) * squared_norm(deviator);
    const Surface<T> now = surface(history[kPlasticStrain]);
    const T yield_root_j2 = now.strength - now.eta * mean;
    const auto shears = (yield_root_j2 < T(0)) | (j2 > yield_root_j2 * yield_root_j2);
    const auto flows = shears | (mean > now.cutoff), closes = mean > trial_mean;
    T kept(1);  // part of the trial deviator
    if (any(flows)) kept = flow(now, shears, sqrt(j2), yield_root_j2, step.j, deviator, mean, history);
    if (any(flows | closes)) {
      const T work = radially_returned_work(previous, deviator, j2, kept, trial_mean, mean, bulk_, shear_);
      history[kPlasticWork] += select(flows | closes, work * to_tau, T(0));
    }
    tau = scale_shift(deviator, kept * to_tau, mean * to_tau);
  }

  template <class Matrix, class Symmetric>
  double elastic_energy(const Matrix&, const Symmetric& tau, double j) const {
    return LinearElastic::stress_energy(scale_shift(tau, density_ / j, 0.0), bulk_, shear_) * j / density_;
  }

  template <class T, class Matrix, class Symmetric>
  T wave_speed(const Matrix&, const Symmetric& tau, T j) const {
    return soil_wave_speed(tau, j, bulk_, shear_, density_, flow_);
  }
  Symmetric3<double> elastic_strain(const StressedPoint& at) const {
    return LinearElastic::stress_strain(at.cauchy, bulk_, shear_);
  }
  double density() const { return density_; }
  /// The slope; with ConeMatch::mohr_coulomb the smallest one, that of the cone inside the surface.
  double eta() const { return eta_; }
  /// The dilation; with ConeMatch::mohr_coulomb the smallest one.
  double eta_bar() const { return eta_bar_; }
  /// xi c: shear strength at zero mean stress, of the cone of eta() [Pa]
  double strength() const { return strength_; }

 private:
  /// The cone as it is after some plastic strain; with ConeMatch::mohr_coulomb the one inside the surface.
  template <class T>
  struct Surface {
    T eta, strength;
    T apex, cutoff;     ///< mean stress [Pa]
    T sine, per_shear;  ///< with ConeMatch::mohr_coulomb: sin(phi), and 1 / k(phi), the smallest of all Lode angles
    T dilates;          ///< part of eta_bar that is left
  };
  template <class T>
  Surface<T> surface(const T& strain) const {
    Surface<T> now{T(eta_), T(strength_), T(apex_), T(cutoff_), T(sin_friction_), T(1.0 / most_shear_), T(1)};
    if (fall_.falls()) {
      now.dilates = fall_.left(strain);
      now.eta = eta_fall_.at(now.dilates);
      now.strength = strength_fall_.at(now.dilates);
      if (follows_lode_) {
        now.sine = now.eta;
        now.per_shear = T(1) / sqrt(T(1) + T(1.0 / 3.0) * now.sine * now.sine);
        now.eta = now.sine * now.per_shear;
        now.strength = now.strength * now.per_shear;
      }
      now.apex = now.strength / max(now.eta, T(kAlmostNothing));
      now.cutoff = min(now.apex, T(tension_));
    }
    return now;
  }

  /// sqrt(3) k(a), where sin(a) is `sine`, from half_extremes() of the deviator scaled to d : d = 6. At least 1, but
  /// without a deviator, whose extremes in a plane are zero.
  template <class T>
  static T shear_measure(const std::pair<T, T>& s, T sine) {
    return max((T(1) + sine) * s.first + (T(1) - sine) * s.second, T(0.5));
  }
  double largest_flow_stiffness(bool dilates) const;

  /// Returns `mean` to the cone or its apex in the lanes where `shears` holds, and to the cut-off in all; returns the
  /// part of the deviator that is left. With ConeMatch::mohr_coulomb, `yield_root_j2` is of the cone inside the
  /// surface, and so is `shears`.
  template <class T, class Mask, class Symmetric>
  T flow(const Surface<T>& now, Mask shears, T root_j2, T yield_root_j2, T j, const Symmetric& deviator, T& mean,
         T* history) const {
    const T per_root_j2 = T(1) / max(root_j2, T(kAlmostNothing));
    const bool dilates = eta_bar_ != 0.0;
    T eta = now.eta, eta_bar = T(eta_bar_);
    if (follows_lode_) {
      // Shear strength over that of the cone inside the surface, and the same of the dilation.
      const auto extremes = half_extremes(scale_shift(deviator, T(kRoot3) * per_root_j2, T(0)));
      const T stronger = T(kRoot3) / (now.per_shear * shear_measure(extremes, now.sine));
      eta *= stronger;
      yield_root_j2 *= stronger;
      shears = shears & (root_j2 > yield_root_j2);
      if (dilates) eta_bar *= T(kRoot3 * most_dilation_shear_) / shear_measure(extremes, T(sin_dilation_));
    }
    const T beyond_yield = root_j2 - yield_root_j2;
    // Increment of the equivalent plastic shear strain, sqrt(2 de:de).
    T multiplier = T(1.0 / shear_) * beyond_yield;
    if (dilates) {
      // Opened soil has room to dilate into, so dilation builds up no pressure; loose soil has done with it.
      eta_bar = select(history[kOpening] > T(0), T(0), eta_bar * now.dilates * dilation_end_.left(j));
      multiplier = beyond_yield / (T(shear_) + T(bulk_) * eta * eta_bar);
    }
    multiplier = select(shears, multiplier, T(0));
    const T beyond = root_j2 - T(shear_) * multiplier;
    const T left = max(beyond, T(0));
    // Without friction there is no apex; values below zero are round-off.
    const auto apex = (beyond < T(0)) & (now.eta > T(0));
    multiplier = select(apex, T(1.0 / shear_) * root_j2, multiplier);
    T opened = select(apex, T(1.0 / bulk_) * (mean - now.apex), T(0));
    const T returned = dilates ? mean - T(bulk_) * (eta_bar * multiplier) : mean;
    mean = select(apex, now.apex, returned);
    opened += T(1.0 / bulk_) * max(mean - now.cutoff, T(0));
    mean = min(mean, now.cutoff);
    history[kOpening] += opened;
    history[kPlasticStrain] += multiplier;
    return select(shears, left * per_root_j2, T(1));
  }

  static constexpr double kRoot3 = 1.7320508075688772;
  static constexpr float kAlmostNothing = std::numeric_limits<float>::min();  // avoids 0 / 0

  double density_, bulk_, shear_;
  bool follows_lode_;  ///< ConeMatch::mohr_coulomb
  double sin_friction_, sin_dilation_;
  double most_shear_, most_dilation_shear_;  ///< largest k(phi) and k(psi) of all Lode angles
  double eta_, eta_bar_, strength_;
  double apex_;     ///< mean stress at the cone's apex [Pa]
  double tension_;  ///< cut-off from the scene [Pa]; infinite: none
  double cutoff_;   ///< largest mean stress [Pa]
  DilationEnd dilation_end_;
  StrengthFall fall_;
  /// eta and xi c [Pa]; with ConeMatch::mohr_coulomb sin(phi) and c cos(phi).
  Fall eta_fall_, strength_fall_;
  double flow_;  ///< largest contribution of plastic flow to rho c^2 [Pa]
};

/// sin of the friction angle with which the soil flows in plane strain: that of `friction_angle`, or for a cone that
/// passes through another state a different one; 1 or more where no stress in the plane makes it flow. Derived as the
/// match in plane strain (drucker_prager.cpp).
double friction_in_plane_strain(const DruckerPragerDefinition& d);
/// The same of any law; none for what is not a Drucker-Prager soil.
std::optional<double> friction_in_plane_strain(const LawDefinition& law);

}  // namespace mpm
