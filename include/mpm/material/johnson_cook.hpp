// Metal under impact: pressure by Mie-Grueneisen (mie_grueneisen.hpp), and an elastic-plastic deviator with the
// Johnson-Cook flow stress, which limits the Mises value of Cauchy stress:
//
//   sigma_y = (A + B a^n) (1 + C ln(a'/a0')) (1 - T*^m),   T* = (T - T_r) / (T_m - T_r) from 0 to 1
//
// with plastic strain a, its rate a' (the logarithm is at least 0) and temperature T. At T_m there is no strength.
//
// The deviator is that of j2_plasticity.hpp: dev tau = G dev b with the isochoric elastic left Cauchy-Green tensor b,
// which follows from the stress. No stress rate has to be chosen, rotation is exact, and increments of 0.1 and more, as
// in a penetrating rod, are handled correctly. Flow is implicit in strain and rate; temperature is that at the start of
// the flow.
//
// Adiabatic. The internal energy e of the pressure contains the work of pressure and the heat, heat_fraction of the
// plastic work; not the elastic energy of the deviator, and not the rest of the plastic work, which stays in the
// lattice. It is relative to the start, where stress is zero whatever the temperature. Temperature follows the
// isentrope, dT = -gamma0 T dJ, and rises by heat / c_v.
//
// Weak: without artificial viscosity a shock gets only the entropy of the method's own dissipation, so its temperature
// is too low. No spall or damage: material parts only where the grid lets it. G does not soften with heat. Softening
// localises in bands as wide as the particles. Source: Johnson & Cook (1983), 7th Int. Symp. Ballistics; method
// reference 10.3, 10.4.
#pragma once

#include <cmath>
#include <limits>

#include "mpm/material/definition.hpp"
#include "mpm/material/increment.hpp"
#include "mpm/material/isochoric.hpp"
#include "mpm/material/mie_grueneisen.hpp"

namespace mpm {

class JohnsonCook : public LawDefaults {
 public:
  static constexpr Matter kMatter = Matter::solid;
  static constexpr bool kRateDependent = true;
  static constexpr bool kStiffnessOfPressure = false;
  static constexpr bool kForgetsShape = false;
  static constexpr bool kAveragesStress = false;
  static constexpr StressSource kStressFrom = StressSource::volume_and_stress;
  static constexpr ImplicitSteps kImplicit = ImplicitSteps::refused;
  static constexpr int kHistory = 4;
  static constexpr int kPlasticStrain = 0;
  static constexpr int kPlasticWork = 1;
  static constexpr int kTemperature = 2;
  static constexpr int kEnergy = 3;  ///< e [J/kg]

  JohnsonCook(const JohnsonCookDefinition& d, double density)
      : density_(density),
        shear_(d.shear_modulus),
        equation_of_state_(d.pressure, density),
        yield_(d.yield_stress),
        hardening_(d.hardening),
        exponent_(d.hardening_exponent),
        rate_(d.rate_sensitivity),
        reference_rate_(d.reference_rate),
        softening_(d.softening_exponent),
        reference_(d.reference_temperature),
        range_(d.melting_temperature > 0.0 ? 1.0 / (d.melting_temperature - d.reference_temperature) : 0.0),
        capacity_(d.heat_capacity),
        heat_fraction_(d.heat_fraction) {}

  template <class T, class Matrix, class Symmetric>
  void update(const Increment<T, Matrix>& step, Symmetric& tau, T* history) const {
    const Symmetric before = elastic_deviator<T>(tau);
    T pressure = pressure_of(tau, step.j_old);
    Symmetric deviator = stretch_isochoric(step.df, step.j / step.j_old, before, isochoric_excess(before));
    T temperature = (T(reference_) + history[kTemperature]) * equation_of_state_.isentropic_heating(step.j_old, step.j);
    const T j2 = T(0.5) * squared_norm(deviator);
    const T homologous = homologous_temperature(temperature);
    // Powers are evaluated only where the stress exceeds a bound of the strength without them: T*^m <= T* where m >= 1.
    const T least = T(yield_) * step.j * (T(1) - (softening_ < 1.0 ? T(1) : homologous));
    T heat = T(0);
    if (any(T(3.0 * shear_ * shear_) * j2 > least * least)) {
      const T start = T(shear_) * sqrt(T(1.5) * squared_norm(before));
      heat = T(heat_fraction_) * flow(step, start, j2, softening(homologous), deviator, history);
      temperature += T(1.0 / capacity_) * heat;
    }
    history[kTemperature] = temperature - T(reference_);
    equation_of_state_.advance(step.j_old, step.j, heat, pressure, history[kEnergy]);
    tau = scale_shift(deviator, T(shear_ / density_), T(-1.0 / density_) * step.j * pressure);
  }

  /// The sum of e and the elastic energy of the deviator. It includes the heat of plastic work; see heat_fraction().
  template <class Matrix, class Symmetric>
  double elastic_energy(const Matrix&, const Symmetric& tau, double j) const {
    const double excess = isochoric_excess(elastic_deviator<double>(tau));
    return equation_of_state_.energy(j, pressure_of(tau, j)) + 1.5 * shear_ / density_ * excess;
  }

  /// Wave speed of the adiabatic elastic response; plastic flow is slower.
  template <class T, class Matrix, class Symmetric>
  T wave_speed(const Matrix&, const Symmetric& tau, T j) const {
    const Symmetric deviator = elastic_deviator<T>(tau);
    const T modulus = T(shear_) / j;
    const Symmetric gb = scale_shift(deviator, modulus, modulus * (T(1) + isochoric_excess(deviator)));
    const T bulk = equation_of_state_.bulk(j, pressure_of(tau, j));
    return sqrt(stiffest_wave(gb, bulk) * j * T(1.0 / density_));
  }
  Symmetric3<double> elastic_strain(const StressedPoint& at) const {
    return isochoric_strain(at.tau, at.j, density_ / shear_);
  }
  /// Heat c_v dT joins the internal energy, and the pressure with it.
  double warm(double by, double j, double* history) const {
    history[kEnergy] += capacity_ * by;
    return -j / density_ * equation_of_state_.thermal_pressure(capacity_ * by);
  }
  double heat_capacity() const { return capacity_; }
  double density() const { return density_; }
  double heat_fraction() const { return heat_fraction_; }
  double reference_temperature() const { return reference_; }

 private:
  /// Part of the strength at the reference rate above which the material counts as flowing at the start of a step. Its
  /// stress is then the strength of the last step, which heat and rate change by a few per cent.
  static constexpr double kFlowed = 0.9;
  /// Least plastic strain in B a^n, whose slope at 0 is infinite.
  static constexpr double kSmallest = 1e-30;

  template <class T, class Symmetric>
  Symmetric elastic_deviator(const Symmetric& tau) const {
    const T scale = T(density_ / shear_);
    return scale_shift(tau, scale, T(-1.0 / 3.0) * scale * trace(tau));
  }
  /// [Pa]
  template <class T, class Symmetric>
  T pressure_of(const Symmetric& tau, T j) const {
    return T(-1.0 / 3.0 * density_) * trace(tau) / j;
  }

  /// T*; 0 for a material that does not melt.
  template <class T>
  T homologous_temperature(T temperature) const {
    return max(min(T(range_) * (temperature - T(reference_)), T(1)), T(0));
  }
  /// 1 - T*^m
  template <class T>
  T softening(T homologous) const {
    if (softening_ == 1.0) return T(1) - homologous;
    return max(T(1) - select(homologous > T(0), pow(homologous, T(softening_)), T(0)), T(0));
  }
  /// B a^n [Pa]
  template <class T>
  T hardening(T strain) const {
    return hardening_ > 0.0 ? T(hardening_) * pow(max(strain, T(kSmallest)), T(exponent_)) : T(0);
  }
  /// 1 + C ln(a'/a0'), with the plastic strain of a step, `plastic`, for a', and that of a step at the reference rate,
  /// `slow`, for a0'.
  template <class T>
  T rate_factor(T plastic, T slow) const {
    return rate_ > 0.0 ? T(1) + T(rate_) * log(max(plastic / slow, T(1))) : T(1);
  }

  /// Returns the deviator to the flow stress in the lanes where it exceeds it. `start`: Mises value of tau at the start
  /// of the step [Pa]; `soft`: 1 - T*^m. Returns the plastic work of the step [J/kg].
  template <class T, class Matrix, class Symmetric>
  T flow(const Increment<T, Matrix>& step, T start, T j2, T soft, Symmetric& deviator, T* history) const {
    T& strain = history[kPlasticStrain];
    const T mises = T(shear_) * sqrt(T(3) * j2);
    const T before = T(yield_) + hardening(strain);
    // A molten material has no strength, so a deviator too small to divide by is excluded here.
    const auto flows = (mises > step.j * soft * before) & (j2 > T(kSmallest));
    if (!any(flows)) return T(0);
    const T j3 = determinant(deviator);
    const T excess = isochoric_excess(j2, j3);
    const T modulus = return_modulus(T(shear_), j2, j3, excess);
    const T slow = step.dt * T(reference_rate_);
    const T plastic = plastic_increment(flows, mises, step.j * soft, modulus, strain, slow);
    deviator = scale_shift(deviator, select(flows, T(1) - modulus * plastic / mises, T(1)), T(0));
    strain += plastic;
    // The energy released by the return, minus the surplus that the trial step took up to get there: the mean Mises
    // stress during flow times the plastic strain. Flow begins at the stress at the start if the material flowed
    // already, else at yield.
    const T yield = step.j_old * soft * before;
    const T first = select(start > T(kFlowed) * yield, start, yield * rate_factor(plastic, slow));
    const T released = T(1.5 * shear_) * (excess - isochoric_excess(deviator));
    const T work = select(flows, T(1.0 / density_) * (released - T(0.5) * (mises - first) * plastic), T(0));
    history[kPlasticWork] += work;
    return work;
  }

  /// Root x of mises - modulus x = scale (A + B (strain + x)^n) (1 + C ln(x/slow)) where `flows` holds, 0 elsewhere.
  /// The right side increases and, on either side of x = slow, its slope decreases, so Newton's method approaches the
  /// root from below; it starts from the value that the largest strength gives, or from `slow` where the root is above
  /// it. For n > 1/2 a step with a strain of about 1 can overshoot; the middle of the bracket is then taken.
  template <class T, class Mask>
  T plastic_increment(const Mask& flows, T mises, T scale, T modulus, T strain, T slow) const {
    constexpr int kSteps = 60;
    constexpr double kRoundOff = 64.0 * std::numeric_limits<ScalarOf<T>>::epsilon();
    const auto strength = [&](T x) { return scale * (T(yield_) + hardening(strain + x)) * rate_factor(x, slow); };
    T low = T(0), high = select(flows, mises / modulus, T(0));
    T x = max((mises - strength(high)) / modulus, T(0));
    const auto slower = flows & (x < slow);
    if (rate_ > 0.0 && any(slower)) {
      const auto above = slower & (slow < high) & (mises - modulus * slow > strength(slow));
      x = select(above, slow, x);
    }
    x = select(flows, x, T(0));
    auto open = flows;
    for (int i = 0; i < kSteps; ++i) {
      const T power = hardening(strain + x), factor = rate_factor(x, slow);
      const T hard = T(yield_) + power;
      const T miss = mises - modulus * x - scale * hard * factor;
      open = open & (abs(miss) > T(kRoundOff) * mises);
      if (!any(open)) break;
      low = select(miss > T(0), x, low);
      high = select(miss > T(0), high, x);
      const T hardens = T(exponent_) * power / max(strain + x, T(kSmallest)) * factor;
      const T quickens = select(x >= slow, T(rate_) * hard / x, T(0));
      const T next = x + miss / (modulus + scale * (hardens + quickens));
      const auto inside = (next > low) & (next < high);
      x = select(open, select(inside, next, T(0.5) * (low + high)), x);
    }
    return x;
  }

  double density_, shear_;
  MieGrueneisen equation_of_state_;
  double yield_, hardening_, exponent_, rate_, reference_rate_, softening_;
  double reference_;  ///< T_r [K]
  double range_;      ///< 1 / (T_m - T_r) [1/K]
  double capacity_;   ///< c_v [J/(kg K)]
  double heat_fraction_;
};

}  // namespace mpm
