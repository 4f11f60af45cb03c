// Registers of 64 bytes: AVX-512 (F, BW, DQ, VL), with one bit a lane as masks.
#pragma once

#include <immintrin.h>

#include <cstdint>

namespace mpm {

template <class T>
struct Backend;

template <>
struct Backend<double> {
  static constexpr int kBytes = 64, kLanes = 8;
  typedef double Vector __attribute__((vector_size(kBytes)));
  using Bits = std::uint64_t;
  typedef Bits Integers __attribute__((vector_size(kBytes)));
  using Mask = __mmask8;
  static constexpr Mask kAll = 0xFF;  // GCC 12 takes the intrinsics without a mask for uninitialised

  static Vector set(double value) { return _mm512_set1_pd(value); }
  static Vector load(const double* from) { return _mm512_loadu_pd(from); }
  static void store(double* to, Vector v) { _mm512_storeu_pd(to, v); }
  /// Four numbers, over and over.
  static Vector repeat(const double* four) { return _mm512_maskz_broadcast_f64x4(kAll, _mm256_loadu_pd(four)); }
  static Mask first(int count) { return count >= 8 ? Mask(0xFF) : count <= 0 ? Mask(0) : Mask((1U << count) - 1U); }
  static Vector load_first(const double* from, int count) { return _mm512_maskz_loadu_pd(first(count), from); }
  /// A store with a mask takes longer.
  static void store_first(double* to, Vector v, int count) {
    if (count >= kLanes) return store(to, v);
    _mm512_mask_storeu_pd(to, first(count), v);
  }
  static Mask less(Vector a, Vector b) { return _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ); }
  static Mask less_equal(Vector a, Vector b) { return _mm512_cmp_pd_mask(a, b, _CMP_LE_OQ); }
  static Mask equal(Vector a, Vector b) { return _mm512_cmp_pd_mask(a, b, _CMP_EQ_OQ); }
  static Mask both(Mask a, Mask b) { return a & b; }
  static Mask either(Mask a, Mask b) { return a | b; }
  static Mask invert(Mask a) { return static_cast<Mask>(~a); }
  static Vector select(Mask which, Vector a, Vector b) { return _mm512_mask_blend_pd(which, b, a); }
  static unsigned bits(Mask m) { return m; }
  /// Lane l of the result is lane index[l] of a; only the bits of an index that number the lanes count.
  static Vector permute(Vector a, Integers index) {
    return _mm512_maskz_permutexvar_pd(kAll, reinterpret_cast<__m512i>(index), a);
  }
  static Vector sqrt(Vector a) { return _mm512_maskz_sqrt_pd(kAll, a); }
  static Vector max(Vector a, Vector b) { return _mm512_maskz_max_pd(kAll, a, b); }
  static Vector min(Vector a, Vector b) { return _mm512_maskz_min_pd(kAll, a, b); }
  static Vector place(const double* x, int count, double origin, double scale, double shift) {
    return (load_first(x, count) - set(origin)) * set(scale) - set(shift);
  }
  static void displace(double* x_new, const double* x, Vector displacement, int count) {
    store_first(x_new, load_first(x, count) + displacement, count);
  }
};

template <>
struct Backend<float> {
  static constexpr int kBytes = 64, kLanes = 16;
  typedef float Vector __attribute__((vector_size(kBytes)));
  using Bits = std::uint32_t;
  typedef Bits Integers __attribute__((vector_size(kBytes)));
  using Mask = __mmask16;
  static constexpr Mask kAll = 0xFFFF;

  static Vector set(float value) { return _mm512_set1_ps(value); }
  static Vector load(const float* from) { return _mm512_loadu_ps(from); }
  static void store(float* to, Vector v) { _mm512_storeu_ps(to, v); }
  static Vector repeat(const float* four) { return _mm512_maskz_broadcast_f32x4(kAll, _mm_loadu_ps(four)); }
  static Mask first(int count) { return count >= 16 ? Mask(0xFFFF) : count <= 0 ? Mask(0) : Mask((1U << count) - 1U); }
  static Vector load_first(const float* from, int count) { return _mm512_maskz_loadu_ps(first(count), from); }
  static void store_first(float* to, Vector v, int count) {
    if (count >= kLanes) return store(to, v);
    _mm512_mask_storeu_ps(to, first(count), v);
  }
  static Mask less(Vector a, Vector b) { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ); }
  static Mask less_equal(Vector a, Vector b) { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ); }
  static Mask equal(Vector a, Vector b) { return _mm512_cmp_ps_mask(a, b, _CMP_EQ_OQ); }
  static Mask both(Mask a, Mask b) { return a & b; }
  static Mask either(Mask a, Mask b) { return a | b; }
  static Mask invert(Mask a) { return static_cast<Mask>(~a); }
  static Vector select(Mask which, Vector a, Vector b) { return _mm512_mask_blend_ps(which, b, a); }
  static unsigned bits(Mask m) { return m; }
  static Vector permute(Vector a, Integers index) {
    return _mm512_maskz_permutexvar_ps(kAll, reinterpret_cast<__m512i>(index), a);
  }
  static Vector sqrt(Vector a) { return _mm512_maskz_sqrt_ps(kAll, a); }
  static Vector max(Vector a, Vector b) { return _mm512_maskz_max_ps(kAll, a, b); }
  static Vector min(Vector a, Vector b) { return _mm512_maskz_min_ps(kAll, a, b); }
  static Vector place(const double* x, int count, double origin, double scale, double shift) {
    using Half = Backend<double>;
    const __m256 low = _mm512_maskz_cvtpd_ps(0xFF, Half::place(x, count, origin, scale, shift));
    const __m256 high = _mm512_maskz_cvtpd_ps(0xFF, Half::place(x + 8, count - 8, origin, scale, shift));
    return _mm512_insertf32x8(_mm512_castps256_ps512(low), high, 1);
  }
  static void displace(double* x_new, const double* x, Vector displacement, int count) {
    using Half = Backend<double>;
    Half::displace(x_new, x, _mm512_maskz_cvtps_pd(0xFF, _mm512_maskz_extractf32x8_ps(0xFF, displacement, 0)), count);
    Half::displace(x_new + 8, x + 8, _mm512_maskz_cvtps_pd(0xFF, _mm512_maskz_extractf32x8_ps(0xFF, displacement, 1)),
                   count - 8);
  }
};

}  // namespace mpm
