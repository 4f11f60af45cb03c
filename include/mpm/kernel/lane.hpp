// A register of one lane: Wide<T> as a plain number. This is what a thread of a graphics processor computes with
// (doc/gpu.md), so nothing here goes beyond arithmetic: no intrinsics, no vectors, no calls that a device lacks.
// wide.hpp takes this file in place of its own registers where MPM_ONE_LANE is defined.
//
// Laws, shape functions and the advance of a particle see no difference: a mask is a truth value, and all work that is
// skipped "where no lane needs it" is skipped by this particle's own branch.
//
// Planned for CUDA: clang compiles the headers that are shared with the processor as they are between
// `#pragma clang force_cuda_host_device begin` and `end`, so that no function needs a mark of its own.
#pragma once

#include <cstdint>
#include <type_traits>

namespace mpm {

template <class T>
struct Backend {
  static constexpr int kBytes = sizeof(T);
  static constexpr int kLanes = 1;
  using Vector = T;
  using Bits = std::conditional_t<sizeof(T) == 8, std::uint64_t, std::uint32_t>;
  using Integers = Bits;
  using Mask = bool;

  // Square roots by the compiler: those of the standard library are functions of the host.
  static double root(double x) { return __builtin_sqrt(x); }
  static float root(float x) { return __builtin_sqrtf(x); }
  /// Position of the particle, in double precision, less `origin`, times `scale`, less `shift`.
  static T place(const double* x, int, double origin, double scale, double shift) {
    return static_cast<T>((*x - origin) * scale - shift);
  }
  /// x_new = x + displacement.
  static void displace(double* x_new, const double* x, T displacement, int) { *x_new = *x + displacement; }
};

template <class T>
struct WideMask {
  using B = Backend<T>;
  bool m;

  friend WideMask operator&(WideMask a, WideMask b) { return {a.m && b.m}; }
  friend WideMask operator|(WideMask a, WideMask b) { return {a.m || b.m}; }
  friend WideMask operator!(WideMask a) { return {!a.m}; }
  friend bool any(WideMask a) { return a.m; }
  friend bool all(WideMask a) { return a.m; }
  unsigned bits() const { return m ? 1U : 0U; }
  static WideMask first(int count) { return {count > 0}; }
};

/// `count` of load_first() and store_first() is 1 or more: a thread without a particle does nothing.
template <class T>
struct Wide {
  using B = Backend<T>;
  using Vector = T;
  using Integers = typename B::Integers;
  using Mask = WideMask<T>;
  static constexpr int kLanes = 1;

  T v;

  Wide() = default;
  explicit Wide(double value) : v(static_cast<T>(value)) {}

  static Wide load(const T* from) { return of(*from); }
  void store(T* to) const { *to = v; }
  static Wide load_first(const T* from, int) { return of(*from); }
  void store_first(T* to, int) const { *to = v; }

  Integers integers() const {
    Integers bits;
    __builtin_memcpy(&bits, &v, sizeof(T));
    return bits;
  }
  static Wide from_integers(Integers bits) {
    Wide w;
    __builtin_memcpy(&w.v, &bits, sizeof(T));
    return w;
  }

  friend Wide operator+(Wide a, Wide b) { return of(a.v + b.v); }
  friend Wide operator-(Wide a, Wide b) { return of(a.v - b.v); }
  friend Wide operator*(Wide a, Wide b) { return of(a.v * b.v); }
  friend Wide operator/(Wide a, Wide b) { return of(a.v / b.v); }
  friend Wide operator-(Wide a) { return of(-a.v); }
  Wide& operator+=(Wide b) { return *this = *this + b; }
  Wide& operator-=(Wide b) { return *this = *this - b; }
  Wide& operator*=(Wide b) { return *this = *this * b; }
  Wide& operator/=(Wide b) { return *this = *this / b; }

  friend Mask operator<(Wide a, Wide b) { return {a.v < b.v}; }
  friend Mask operator>(Wide a, Wide b) { return {a.v > b.v}; }
  friend Mask operator<=(Wide a, Wide b) { return {a.v <= b.v}; }
  friend Mask operator>=(Wide a, Wide b) { return {a.v >= b.v}; }
  friend Mask equal(Wide a, Wide b) { return {a.v == b.v}; }

  friend Wide select(Mask which, Wide a, Wide b) { return which.m ? a : b; }
  friend Wide sqrt(Wide a) { return of(B::root(a.v)); }
  friend Wide max(Wide a, Wide b) { return b.v < a.v ? a : b; }
  friend Wide min(Wide a, Wide b) { return a.v < b.v ? a : b; }
  friend Wide abs(Wide a) { return from_integers(a.integers() & ~(Integers(1) << (8 * sizeof(T) - 1))); }
  friend T lane(Wide a, int) { return a.v; }
  friend void set_lane(Wide& a, int, T value) { a.v = value; }

 private:
  static Wide of(T value) {
    Wide w;
    w.v = value;
    return w;
  }
};

}  // namespace mpm
