// Registers without intrinsics: 16 bytes, what the compiler makes of loops over their lanes (SSE2 on x86-64). The
// backend of the plain path, and of processors other than x86.
#pragma once

#include <cmath>
#include <cstdint>
#include <type_traits>

namespace mpm {

template <class T>
struct Backend {
  static constexpr int kBytes = 16;
  static constexpr int kLanes = kBytes / static_cast<int>(sizeof(T));
  typedef T Vector __attribute__((vector_size(kBytes)));
  using Bits = std::conditional_t<sizeof(T) == 8, std::uint64_t, std::uint32_t>;
  typedef Bits Integers __attribute__((vector_size(kBytes)));
  using Mask = Integers;

  static Vector set(T value) {
    Vector v{};
    for (int l = 0; l < kLanes; ++l) v[l] = value;
    return v;
  }
  static Vector load(const T* from) {
    Vector v{};
    __builtin_memcpy(&v, from, kBytes);
    return v;
  }
  static void store(T* to, Vector v) { __builtin_memcpy(to, &v, kBytes); }
  static Mask first(int count) {
    Mask m{};
    for (int l = 0; l < kLanes; ++l) m[l] = l < count ? ~Bits(0) : Bits(0);
    return m;
  }
  static Vector load_first(const T* from, int count) {
    Vector v{};
    for (int l = 0; l < kLanes; ++l) v[l] = l < count ? from[l] : T(0);
    return v;
  }
  static void store_first(T* to, Vector v, int count) {
    for (int l = 0; l < kLanes; ++l) {
      if (l < count) to[l] = v[l];
    }
  }
  static Mask less(Vector a, Vector b) { return reinterpret_cast<Mask>(a < b); }
  static Mask less_equal(Vector a, Vector b) { return reinterpret_cast<Mask>(a <= b); }
  static Mask equal(Vector a, Vector b) { return reinterpret_cast<Mask>(a == b); }
  static Mask both(Mask a, Mask b) { return a & b; }
  static Mask either(Mask a, Mask b) { return a | b; }
  static Mask invert(Mask a) { return ~a; }
  static Vector select(Mask which, Vector a, Vector b) {
    return reinterpret_cast<Vector>((which & reinterpret_cast<Integers>(a)) | (~which & reinterpret_cast<Integers>(b)));
  }
  /// Lane l as bit l.
  static unsigned bits(Mask m) {
    unsigned result = 0;
    for (int l = 0; l < kLanes; ++l) result |= static_cast<unsigned>(m[l] & 1) << l;
    return result;
  }
  /// Lane l of the result is lane index[l] of a; only the bits of an index that number the lanes count. No kernel does
  /// this where a row of nodes does not fit into a register.
  static Vector permute(Vector a, Integers index) {
    Vector v{};
    for (int l = 0; l < kLanes; ++l) v[l] = a[index[l] % kLanes];
    return v;
  }
  static Vector sqrt(Vector a) {
    for (int l = 0; l < kLanes; ++l) a[l] = std::sqrt(a[l]);
    return a;
  }
  static Vector max(Vector a, Vector b) { return select(less(b, a), a, b); }
  static Vector min(Vector a, Vector b) { return select(less(a, b), a, b); }
  /// Positions of the particles, in double precision, less `origin`, times `scale`, less `shift`.
  static Vector place(const double* x, int count, double origin, double scale, double shift) {
    Vector v{};
    for (int l = 0; l < kLanes; ++l) v[l] = l < count ? static_cast<T>((x[l] - origin) * scale - shift) : T(0);
    return v;
  }
  /// x_new = x + displacement, of the first `count`.
  static void displace(double* x_new, const double* x, Vector displacement, int count) {
    for (int l = 0; l < kLanes; ++l) {
      if (l < count) x_new[l] = x[l] + displacement[l];
    }
  }
};

}  // namespace mpm
