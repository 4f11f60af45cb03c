// Functions of a register that constitutive laws need: inverse_cbrt, exp, log, pow. Branch-free; a few units in the
// last place for what laws give them. Weak: no special values. log, pow and inverse_cbrt ask for normal numbers above
// zero, exp is cut off before it would overflow; what a particle with J <= 0 gets means nothing, and the kernel reports
// that particle. Source: argument reduction by powers of two, then Taylor's series (exp), that of artanh (log), and a
// fourth-order iteration for x r^3 = 1; the starting value from the bits of x is the classic one of the inverse square
// root, for the third root.
#pragma once

#include "mpm/kernel/wide.hpp"

namespace mpm {

/// Layout of a number's bits.
template <class T>
struct Format;
template <>
struct Format<double> {
  static constexpr int kMantissa = 52, kBias = 1023, kExpTerms = 13, kLogTerms = 11;
  static constexpr double kLargestExponent = 708.0;
  static constexpr double kLn2High = 0x1.62e42feep-1, kLn2Low = 0x1.a39ef35793c76p-33;
};
template <>
struct Format<float> {
  static constexpr int kMantissa = 23, kBias = 127, kExpTerms = 7, kLogTerms = 5;
  static constexpr double kLargestExponent = 87.0;
  static constexpr double kLn2High = 0x1.62ep-1, kLn2Low = 0x1.0bfbe8p-15;
};

/// Added to a small number, this leaves the number, rounded to whole ones, in its lowest bits.
template <class T>
constexpr T kRounder = T(3) * (typename Backend<T>::Bits(1) << (Format<T>::kMantissa - 1));

template <class T>
Wide<T> round(Wide<T> x) {
  const Wide<T> rounder(kRounder<T>);
  return (x + rounder) - rounder;
}
/// The same as an integer of two's complement, in the lowest bits.
template <class T>
typename Wide<T>::Integers round_to_bits(Wide<T> x) {
  return (x + Wide<T>(kRounder<T>)).integers();
}

/// The integers, below 2^kMantissa, as numbers.
template <class T>
Wide<T> to_numbers(typename Wide<T>::Integers i) {
  const Wide<T> big(static_cast<T>(typename Backend<T>::Bits(1) << Format<T>::kMantissa));
  return Wide<T>::from_integers(i | big.integers()) - big;
}

template <class T>
Wide<T> inverse_cbrt(Wide<T> x) {
  using W = Wide<T>;
  using Bits = typename Backend<T>::Bits;
  // The bits of x read as a number are its logarithm, nearly: a third of it from the bits of one to the fourth third.
  constexpr int kDrop = sizeof(T) == 8 ? 32 : 9;  // bits below those that matter
  constexpr Bits kOne = Bits(Format<T>::kBias) << (Format<T>::kMantissa - kDrop);
  const W high = to_numbers<T>(x.integers() >> kDrop);
  const W guess = W(4.0 / 3.0 * kOne - 0.067 * (Bits(1) << (Format<T>::kMantissa - kDrop))) - W(1.0 / 3.0) * high;
  W r = W::from_integers((guess + W(static_cast<T>(Bits(1) << Format<T>::kMantissa))).integers() << kDrop);
  for (int k = 0; k < 2; ++k) {
    const W h = W(1.0) - x * r * (r * r);
    r += r * h * (W(1.0 / 3.0) + h * (W(2.0 / 9.0) + h * W(14.0 / 81.0)));
  }
  return r;
}

template <class T>
Wide<T> exp(Wide<T> x) {
  using W = Wide<T>;
  using F = Format<T>;
  x = max(min(x, W(F::kLargestExponent)), W(-F::kLargestExponent));
  const W scaled = x * W(1.4426950408889634);
  const W k = round(scaled);
  const W r = (x - k * W(F::kLn2High)) - k * W(F::kLn2Low);
  W sum(1.0);
  for (int n = F::kExpTerms; n > 0; --n) sum = W(1.0) + r * sum * W(1.0 / n);
  return W::from_integers(sum.integers() + (round_to_bits(scaled) << F::kMantissa));
}

template <class T>
Wide<T> log(Wide<T> x) {
  using W = Wide<T>;
  using F = Format<T>;
  using Bits = typename Backend<T>::Bits;
  // x = 2^k m with m from sqrt(1/2) to sqrt(2).
  constexpr Bits kOne = Bits(F::kBias) << F::kMantissa;
  constexpr Bits kRoot = sizeof(T) == 8 ? Bits(0x3FE6A09E667F3BCDull) : Bits(0x3F3504F3u);
  constexpr Bits kFraction = (Bits(1) << F::kMantissa) - 1;
  const typename W::Integers shifted = x.integers() + (kOne - kRoot);
  const W k = to_numbers<T>(shifted >> F::kMantissa) - W(F::kBias);
  const W m = W::from_integers((shifted & kFraction) + kRoot);
  const W f = (m - W(1.0)) / (m + W(1.0)), square = f * f;
  W sum(1.0 / (2 * F::kLogTerms + 1));
  for (int n = F::kLogTerms - 1; n >= 0; --n) sum = W(1.0 / (2 * n + 1)) + square * sum;
  return k * W(F::kLn2High) + (W(2.0) * f * sum + k * W(F::kLn2Low));
}

template <class T>
Wide<T> pow(Wide<T> x, Wide<T> y) {
  return exp(y * log(x));
}

}  // namespace mpm
