// Wide<T>: a register of numbers that reads like one number, a lane a particle. The width is that of the instruction
// set which the file is compiled for: 16 bytes (plain), 32 (AVX2) or 64 (AVX-512).
//
// Compiler vectors (GCC, Clang) with a few intrinsics for what they do not have: masks, square roots, part loads.
// doc/decisions.md says why this is no library. Laws and shape functions are written once for numbers and registers
// (math/lanes.hpp). Whoever includes this file is compiled once an instruction set under another name of the namespace
// (kernels.hpp): no inline function of one is linked into another. With MPM_ONE_LANE a register is a plain number
// (lane.hpp).
#pragma once

#include <type_traits>
#include <utility>

#include "mpm/math/lanes.hpp"
#if defined(MPM_ONE_LANE)
#include "mpm/kernel/lane.hpp"
#elif defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512BW__) && defined(__AVX512VL__)
#include "mpm/kernel/backend_avx512.hpp"
#elif defined(__AVX2__) && defined(__FMA__)
#include "mpm/kernel/backend_avx2.hpp"
#else
#include "mpm/kernel/backend_plain.hpp"
#endif

namespace mpm {

#if !defined(MPM_ONE_LANE)

/// A truth value a lane.
template <class T>
struct WideMask {
  using B = Backend<T>;
  typename B::Mask m;

  friend WideMask operator&(WideMask a, WideMask b) { return {B::both(a.m, b.m)}; }
  friend WideMask operator|(WideMask a, WideMask b) { return {B::either(a.m, b.m)}; }
  friend WideMask operator!(WideMask a) { return {B::invert(a.m)}; }
  friend bool any(WideMask a) { return B::bits(a.m) != 0; }
  friend bool all(WideMask a) { return B::bits(a.m) == (1U << B::kLanes) - 1U; }
  /// Lane l as bit l.
  unsigned bits() const { return B::bits(m); }
  static WideMask first(int count) { return {B::first(count)}; }
};

template <class T>
struct Wide {
  using B = Backend<T>;
  using Vector = typename B::Vector;
  using Integers = typename B::Integers;
  using Mask = WideMask<T>;
  static constexpr int kLanes = B::kLanes;

  Vector v;

  Wide() = default;
  explicit Wide(Vector vector) : v(vector) {}
  explicit Wide(double value) : v(B::set(static_cast<T>(value))) {}

  static Wide load(const T* from) { return Wide(B::load(from)); }
  void store(T* to) const { B::store(to, v); }
  /// Loads the first `count` lanes; the others are zero, or not written.
  static Wide load_first(const T* from, int count) { return Wide(B::load_first(from, count)); }
  void store_first(T* to, int count) const { B::store_first(to, v, count); }

  Integers integers() const { return reinterpret_cast<Integers>(v); }
  static Wide from_integers(Integers bits) { return Wide(reinterpret_cast<Vector>(bits)); }

  friend Wide operator+(Wide a, Wide b) { return Wide(a.v + b.v); }
  friend Wide operator-(Wide a, Wide b) { return Wide(a.v - b.v); }
  friend Wide operator*(Wide a, Wide b) { return Wide(a.v * b.v); }
  friend Wide operator/(Wide a, Wide b) { return Wide(a.v / b.v); }
  friend Wide operator-(Wide a) { return Wide(-a.v); }
  Wide& operator+=(Wide b) { return *this = *this + b; }
  Wide& operator-=(Wide b) { return *this = *this - b; }
  Wide& operator*=(Wide b) { return *this = *this * b; }
  Wide& operator/=(Wide b) { return *this = *this / b; }

  friend Mask operator<(Wide a, Wide b) { return {B::less(a.v, b.v)}; }
  friend Mask operator>(Wide a, Wide b) { return {B::less(b.v, a.v)}; }
  friend Mask operator<=(Wide a, Wide b) { return {B::less_equal(a.v, b.v)}; }
  friend Mask operator>=(Wide a, Wide b) { return {B::less_equal(b.v, a.v)}; }
  friend Mask equal(Wide a, Wide b) { return {B::equal(a.v, b.v)}; }

  friend Wide select(Mask which, Wide a, Wide b) { return Wide(B::select(which.m, a.v, b.v)); }
  friend Wide sqrt(Wide a) { return Wide(B::sqrt(a.v)); }
  friend Wide max(Wide a, Wide b) { return Wide(B::max(a.v, b.v)); }
  friend Wide min(Wide a, Wide b) { return Wide(B::min(a.v, b.v)); }
  friend Wide abs(Wide a) {
    constexpr auto kSign = typename B::Bits(1) << (8 * sizeof(T) - 1);
    return from_integers(a.integers() & ~(Integers{} + kSign));
  }
  friend T lane(Wide a, int i) { return a.v[i]; }
  friend void set_lane(Wide& a, int i, T value) { a.v[i] = value; }
};

#endif

/// Lane l of the result is lane `at(l)` of a, of both when `at` reaches beyond a: at compile time.
template <class At, class T, int... L>
Wide<T> shuffle(Wide<T> a, Wide<T> b, std::integer_sequence<int, L...>) {
  return Wide<T>(__builtin_shufflevector(a.v, b.v, At::at(L)...));
}
template <class At, class T>
Wide<T> shuffle(Wide<T> a, Wide<T> b) {
  return shuffle<At>(a, b, std::make_integer_sequence<int, Wide<T>::kLanes>());
}

/// Lane l of the result is lane index[l] of a; of an index only the bits that number the lanes count.
template <class T>
Wide<T> permute(Wide<T> a, typename Wide<T>::Integers index) {
  return Wide<T>(Backend<T>::permute(a.v, index));
}

}  // namespace mpm
