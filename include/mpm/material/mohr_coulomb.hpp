// Mohr-Coulomb soil. Principal stresses s1 >= s2 >= s3, tension positive:
//   f = (s1 - s3) + (s1 + s3) sin(phi) - 2 c cos(phi) <= 0,   s1 <= tension cut-off (Rankine),
// flow from the same f with the dilation angle, and normal to the cut-off. Elastic predictor in rate form (as
// linear_elastic.hpp); its principal axes are kept and its principal values are returned to the surface in closed form:
// to the main plane, the edges of triaxial compression and extension, the apex, and the planes, edges and corners of
// the cut-off. Opened soil (apex, cut-off) closes before it carries pressure (opening.hpp). Dilation ends when the
// soil, or a shear band in it, has gained a given volume, and its strength remains; or both fall together to those of
// the critical state (softening.hpp). In a wide register, lanes that are certainly elastic are computed together and
// the others one by one. Plastic work has the mean stress of a step (returned_work.hpp). Weak: no hardening;
// hypoelastic, meant for small elastic strain; an opening is stored as a volume without direction, and only where no
// pressure remains: a crack in soil under pressure along the crack heals as it closes. Source: method reference 10.7;
// de Souza Neto, Peric & Owen (2008) section 8.2; Clausen, Damkilde & Andersen (2006).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mpm/material/linear_elastic.hpp"
#include "mpm/material/opening.hpp"
#include "mpm/material/returned_work.hpp"
#include "mpm/material/softening.hpp"
#include "mpm/math/principal.hpp"

namespace mpm {

class MohrCoulomb : public LawDefaults {
 public:
  static constexpr Matter kMatter = Matter::soil;
  static constexpr bool kRateDependent = false;
  static constexpr bool kStiffnessOfPressure = false;
  static constexpr bool kForgetsShape = false;
  static constexpr bool kAveragesStress = true;
  static constexpr StressSource kStressFrom = StressSource::stress;
  static constexpr ImplicitSteps kImplicit = ImplicitSteps::measured;
  static constexpr int kHistory = 3;
  static constexpr int kPlasticStrain = 0;  ///< sum of sqrt(2 de:de) with the plastic deviator de, as in Drucker-Prager
  static constexpr int kOpening = 1;        ///< logarithmic volume by which the soil has opened
  static constexpr int kPlasticWork = 2;

  /// The part of the surface to which a stress was returned.
  enum class Region { elastic, plane, extension_edge, compression_edge, apex, tension, tension_and_shear };

  MohrCoulomb(const MohrCoulombDefinition& d, double density);

  template <class T, class Matrix, class Symmetric>
  void update(const Increment<T, Matrix>& step, Symmetric& tau, T* history) const {
    const T to_tau = step.j * T(1.0 / density_);
    const Symmetric previous = scale_shift(tau, T(density_) / step.j_old, T(0));
    const Symmetric trial = LinearElastic::stress_rate_update(previous, step.du, bulk_, shear_);
    const T trial_mean = T(1.0 / 3.0) * trace(trial);
    const T mean = close_opening(trial_mean, bulk_, history[kOpening]);
    Symmetric cauchy = scale_shift(trial, T(1), mean - trial_mean);
    const T j2 = T(0.5) * squared_norm(scale_shift(cauchy, T(1), -mean));
    const auto suspects = fall_.falls() ? may_flow(mean, j2, fall_.left(history[kPlasticStrain])) : may_flow(mean, j2);
    if (any(suspects)) flow_by_lanes(select(suspects, T(1), T(0)), step.j, cauchy, history);
    const auto returns = suspects | (mean > trial_mean);
    if (any(returns)) {
      const T work = returned_work(previous, trial, cauchy, bulk_, shear_);
      history[kPlasticWork] += select(returns, work * to_tau, T(0));
    }
    tau = scale_shift(cauchy, to_tau, T(0));
  }

  /// True if a stress with this mean [Pa] and invariant J2 [Pa^2] may lie beyond the surface. True outside the largest
  /// cones inside the surface and the cut-off, whatever the third invariant; so it is never false beyond the surface.
  /// False for NaN.
  template <class T>
  auto may_flow(T mean, T j2) const {
    return may_flow(mean, j2, T(sin_friction_), T(strength_), T(cutoff_));
  }
  /// The same where `left` of the way from residual to peak strength is left.
  template <class T>
  auto may_flow(T mean, T j2, T left) const {
    const T sine = sine_fall_.at(left), strength = strength_fall_.at(left);
    return may_flow(mean, j2, sine, strength, min(T(cutoff_), apex_of(sine, strength)));
  }

  /// Returns `s`, trial principal stresses in descending order [Pa], to the surface, with flow at `sin_dilation`.
  template <class T>
  Region return_to_surface(T* s, T sin_dilation) const {
    const T cutoff = T(cutoff_);
    const bool shears = yield(s[0], s[2]) > T(0);
    if (!shears && s[0] <= cutoff) return Region::elastic;
    T r[3] = {s[0], s[1], s[2]};
    Region region = Region::elastic;
    if (shears) region = shear_return(r, sin_dilation);
    if (!(r[0] >= r[1] && r[1] >= r[2] && r[0] <= cutoff)) {
      region = cutoff_is_apex_ ? Region::apex : tension_return(s, r, sin_dilation);
      if (cutoff_is_apex_) r[0] = r[1] = r[2] = cutoff;
    }
    for (int k = 0; k < 3; ++k) s[k] = r[k];
    return region;
  }

  /// The yield function f above, of the largest and the smallest principal stress [Pa].
  template <class T>
  T yield(T largest, T smallest) const {
    return (largest - smallest) + (largest + smallest) * T(sin_friction_) - T(strength_);
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
  double sin_dilation() const { return sin_dilation_; }
  /// Largest possible principal stress [Pa]; infinite for a soil without friction and cut-off.
  double cutoff() const { return cutoff_; }

 private:
  static constexpr double kCaution = 1.0 + 1e-6;  ///< factor against round-off

  template <class T>
  static auto may_flow(T mean, T j2, T sine, T strength, T cutoff) {
    // Squares, over J2, of the largest values at given J2: of s1 - s3 + (s1 + s3 - 2 mean) sin(phi), and of s1 - mean.
    const T shear_factor = T(kCaution) * (T(4) + T(4.0 / 3.0) * sine * sine);
    const T tension_factor = T(kCaution * 4.0 / 3.0);
    const T shear_limit = strength - T(2) * sine * mean;
    const T below = cutoff - mean;
    return (shear_limit < T(0)) | (shear_factor * j2 > shear_limit * shear_limit) | (below < T(0)) |
           (tension_factor * j2 > below * below);
  }

  /// Stress at the apex [Pa]; without friction there is none, and without strength it is 0.
  template <class T>
  static T apex_of(T sine, T strength) {
    return strength / max(T(2) * sine, T(std::numeric_limits<float>::min()));
  }

  /// The law where `left` of the way from residual to peak strength is left.
  MohrCoulomb weaker(double left) const {
    MohrCoulomb law = *this;
    law.sin_friction_ = sine_fall_.at(left);
    law.strength_ = strength_fall_.at(left);
    law.sin_dilation_ = left * sin_dilation_;
    const double apex = apex_of(law.sin_friction_, law.strength_);
    law.cutoff_is_apex_ = cutoff_is_apex_ || apex <= cutoff_;
    law.cutoff_ = law.cutoff_is_apex_ ? apex : cutoff_;
    return law;
  }

  /// Calls flow() for each lane where `suspects` is not zero, since principal directions are found tensor by tensor.
  template <class T, class Symmetric>
  void flow_by_lanes(const T& suspects, const T& j, Symmetric& cauchy, T* history) const {
    for (int i = 0; i < lane_count<T>; ++i) {
      if (lane(suspects, i) == 0) continue;
      auto stress = lane(cauchy, i);
      ScalarOf<T> scalars[kHistory];
      for (int k = 0; k < kHistory; ++k) scalars[k] = lane(history[k], i);
      if (fall_.falls()) {
        weaker(fall_.left(static_cast<double>(scalars[kPlasticStrain]))).flow(lane(j, i), stress, scalars);
      } else {
        flow(lane(j, i), stress, scalars);
      }
      set_lane(cauchy, i, stress);
      for (int k = 0; k < kHistory; ++k) set_lane(history[k], i, scalars[k]);
    }
  }

  /// Returns a stress [Pa] that lies beyond the surface to it, and leaves others.
  template <class T, class Symmetric>
  void flow(T j, Symmetric& cauchy, T* history) const {
    const auto [largest, smallest] = principal_extremes(cauchy);
    // Ten times the error of the closed form.
    const T doubt = T(10) * std::sqrt(std::numeric_limits<T>::epsilon()) * (std::abs(largest) + std::abs(smallest));
    if (largest + doubt < T(cutoff_) && yield(largest, smallest) + T(2) * doubt < T(0)) return;
    Principal<T> axes = principal(cauchy);
    int order[3] = {0, 1, 2};  // an index, so that principal values stay paired with their directions
    const auto sort = [&axes, &order](int a, int b) {
      if (!(axes.value[order[a]] < axes.value[order[b]])) return;
      const int larger = order[b];
      order[b] = order[a];
      order[a] = larger;
    };
    sort(0, 1);
    sort(1, 2);
    sort(0, 1);
    T s[3], plastic[3];
    for (int k = 0; k < 3; ++k) plastic[k] = s[k] = axes.value[order[k]];
    // Opened soil has room to dilate into, so dilation builds up no pressure; loose soil has done with it.
    T& opening = history[kOpening];
    const bool has_room = opening > T(0);
    const Region region = return_to_surface(s, has_room ? T(0) : T(sin_dilation_) * dilation_end_.left(j));
    if (region == Region::elastic) return;
    if (region >= Region::apex && has_room) use_room(s);
    // Plastic strain is the elastic strain lost: C^-1 applied to the stress removed by the return.
    for (int k = 0; k < 3; ++k) plastic[k] -= s[k];
    const T mean = (plastic[0] + plastic[1] + plastic[2]) / T(3);
    T shear_strain = T(0);
    for (int k = 0; k < 3; ++k) {
      const T deviator = (plastic[k] - mean) / T(2.0 * shear_);
      shear_strain += T(2) * deviator * deviator;
      axes.value[order[k]] = s[k];
    }
    // Soil that is still under pressure has not parted. If an opening were recorded beside pressure, one would cancel
    // the other without any strain.
    const bool parts = has_room || s[0] + s[1] + s[2] >= T(0);
    if (region >= Region::apex && parts) opening += std::max(mean / T(bulk_), T(0));
    history[kPlasticStrain] += std::sqrt(shear_strain);
    cauchy = compose(axes, cauchy);
  }

  double lame() const { return bulk_ - 2.0 / 3.0 * shear_; }

  double largest_flow_stiffness(double sin_dilation) const;

  /// Returns r to the main plane, f(s1, s3) = 0, or to the edge where two planes meet; beyond the apex the order of r
  /// may come out wrong. C m = 2 lame q (1, 1, 1) + 2 G m, with m = (1 + q, 0, -1 + q) and q the sine of the dilation
  /// angle.
  template <class T>
  Region shear_return(T* r, T q) const {
    const T a = T(lame()), g = T(shear_), sine = T(sin_friction_);
    const T volumetric = T(4) * a * sine * q;
    const T own = volumetric + T(4) * g * (T(1) + sine * q);  // n . C m of one plane
    const T trial[3] = {r[0], r[1], r[2]};
    const T f = yield(trial[0], trial[2]);
    const T multiplier = f / own;
    r[0] -= multiplier * (T(2) * a * q + T(2) * g * (T(1) + q));
    r[1] -= multiplier * T(2) * a * q;
    r[2] -= multiplier * (T(2) * a * q - T(2) * g * (T(1) - q));
    if (r[0] >= r[1] && r[1] >= r[2]) return Region::plane;
    // The edge to which the flow leads (de Souza Neto et al. (2008) Box 8.4).
    if ((T(1) - q) * trial[0] - T(2) * trial[1] + (T(1) + q) * trial[2] > T(0)) {
      // s2 = s3: the planes of (1, 3) and (1, 2); the sum of their multipliers moves s1.
      const T other = volumetric + T(2) * g * (T(1) + sine) * (T(1) + q);
      const T both = (f + yield(trial[0], trial[1])) / (own + other);
      const T pair = T(0.5) * (trial[1] + trial[2]) - both * (T(2) * a * q - g * (T(1) - q));
      r[0] = (T(strength_) + (T(1) - sine) * pair) / (T(1) + sine);
      r[1] = r[2] = pair;
      return Region::extension_edge;
    }
    // s1 = s2: the planes of (1, 3) and (2, 3).
    const T other = volumetric + T(2) * g * (T(1) - sine) * (T(1) - q);
    const T both = (f + yield(trial[1], trial[2])) / (own + other);
    const T pair = T(0.5) * (trial[0] + trial[1]) - both * (T(2) * a * q + g * (T(1) + q));
    r[0] = r[1] = pair;
    r[2] = beside(pair);
    return Region::compression_edge;
  }

  /// Returns to the cut-off, alone or together with shear. Where neither of the two alone suffices, the stress lies on
  /// the line s1 = cut-off, f = 0, between its two ends.
  template <class T>
  Region tension_return(const T* trial, T* r, T q) const {
    const T a = T(lame()), g = T(shear_), cutoff = T(cutoff_);
    const T excess = trial[0] - cutoff;
    const T ratio = a / (a + T(2) * g);
    r[0] = cutoff;
    r[1] = trial[1] - ratio * excess;
    r[2] = trial[2] - ratio * excess;
    if (r[1] > cutoff) {
      r[1] = cutoff;
      r[2] = std::min(trial[2] - a * (trial[0] + trial[1] - T(2) * cutoff) / (T(2) * (a + g)), cutoff);
    }
    if (yield(r[0], r[2]) <= T(0)) return Region::tension;
    const T smallest = beside(cutoff);
    const T lower = trial[2] - smallest;
    const T determinant = T(4) * g * (T(1) - q) * (a + g);
    const T along1 = T(2) * a * q + T(2) * g * (T(1) + q), along3 = T(2) * a * q - T(2) * g * (T(1) - q);
    const T shear = (excess * a - lower * (a + T(2) * g)) / determinant;
    const T opening = (along1 * lower - along3 * excess) / determinant;
    r[1] = std::min(std::max(trial[1] - shear * T(2) * a * q - opening * a, smallest), cutoff);
    r[2] = smallest;
    return Region::tension_and_shear;
  }

  /// Removes pressure from soil that has opened before: the pressure left by the return to the cut-off goes into the
  /// room there is, and the deviator shrinks to the cut-off. Admissible, since the cut-off is not beyond the apex.
  template <class T>
  void use_room(T* s) const {
    const T mean = (s[0] + s[1] + s[2]) / T(3);
    if (!(mean < T(0))) return;
    const T scale = T(cutoff_) / (s[0] - mean);
    for (int k = 0; k < 3; ++k) s[k] = scale * (s[k] - mean);
  }

  /// The smallest principal stress on the surface that belongs to the largest one `largest` [Pa].
  template <class T>
  T beside(T largest) const {
    return ((T(1) + T(sin_friction_)) * largest - T(strength_)) / (T(1) - T(sin_friction_));
  }

  double density_, bulk_, shear_;
  double sin_friction_, sin_dilation_;
  double strength_;  ///< 2 c cos(phi) [Pa]
  double cutoff_;    ///< largest principal stress [Pa]
  bool cutoff_is_apex_;
  DilationEnd dilation_end_;
  StrengthFall fall_;
  Fall sine_fall_, strength_fall_;  ///< sin(phi) and 2 c cos(phi) [Pa]
  double flow_;                     ///< largest contribution of plastic flow to rho c^2 [Pa]
};

}  // namespace mpm
