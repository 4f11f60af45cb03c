// Registers of 32 bytes: AVX2 with fused multiply-add.
#pragma once

#include <immintrin.h>

#include <cstdint>

namespace mpm {

template <class T>
struct Backend;

template <>
struct Backend<double> {
  static constexpr int kBytes = 32, kLanes = 4;
  typedef double Vector __attribute__((vector_size(kBytes)));
  using Bits = std::uint64_t;
  typedef Bits Integers __attribute__((vector_size(kBytes)));
  using Mask = Integers;

  static Vector set(double value) { return _mm256_set1_pd(value); }
  static Vector load(const double* from) { return _mm256_loadu_pd(from); }
  /// Four numbers, over and over.
  static Vector repeat(const double* four) { return load(four); }
  static void store(double* to, Vector v) { _mm256_storeu_pd(to, v); }
  static Mask first(int count) {
    return reinterpret_cast<Mask>(_mm256_cmpgt_epi64(_mm256_set1_epi64x(count), _mm256_setr_epi64x(0, 1, 2, 3)));
  }
  static Vector load_first(const double* from, int count) {
    return _mm256_maskload_pd(from, reinterpret_cast<__m256i>(first(count)));
  }
  static void store_first(double* to, Vector v, int count) {
    _mm256_maskstore_pd(to, reinterpret_cast<__m256i>(first(count)), v);
  }
  static Mask less(Vector a, Vector b) { return reinterpret_cast<Mask>(_mm256_cmp_pd(a, b, _CMP_LT_OQ)); }
  static Mask less_equal(Vector a, Vector b) { return reinterpret_cast<Mask>(_mm256_cmp_pd(a, b, _CMP_LE_OQ)); }
  static Mask equal(Vector a, Vector b) { return reinterpret_cast<Mask>(_mm256_cmp_pd(a, b, _CMP_EQ_OQ)); }
  static Mask both(Mask a, Mask b) { return a & b; }
  static Mask either(Mask a, Mask b) { return a | b; }
  static Mask invert(Mask a) { return ~a; }
  static Vector select(Mask which, Vector a, Vector b) {
    return _mm256_blendv_pd(b, a, reinterpret_cast<__m256d>(which));
  }
  static unsigned bits(Mask m) { return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(m))); }
  static Vector sqrt(Vector a) { return _mm256_sqrt_pd(a); }
  static Vector max(Vector a, Vector b) { return _mm256_max_pd(a, b); }
  static Vector min(Vector a, Vector b) { return _mm256_min_pd(a, b); }
  static Vector place(const double* x, int count, double origin, double scale, double shift) {
    return (load_first(x, count) - set(origin)) * set(scale) - set(shift);
  }
  static void displace(double* x_new, const double* x, Vector displacement, int count) {
    store_first(x_new, load_first(x, count) + displacement, count);
  }
};

template <>
struct Backend<float> {
  static constexpr int kBytes = 32, kLanes = 8;
  typedef float Vector __attribute__((vector_size(kBytes)));
  using Bits = std::uint32_t;
  typedef Bits Integers __attribute__((vector_size(kBytes)));
  using Mask = Integers;

  static Vector set(float value) { return _mm256_set1_ps(value); }
  static Vector load(const float* from) { return _mm256_loadu_ps(from); }
  static Vector repeat(const float* four) { return _mm256_broadcast_ps(reinterpret_cast<const __m128*>(four)); }
  static void store(float* to, Vector v) { _mm256_storeu_ps(to, v); }
  static Mask first(int count) {
    return reinterpret_cast<Mask>(
        _mm256_cmpgt_epi32(_mm256_set1_epi32(count), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7)));
  }
  static Vector load_first(const float* from, int count) {
    return _mm256_maskload_ps(from, reinterpret_cast<__m256i>(first(count)));
  }
  static void store_first(float* to, Vector v, int count) {
    _mm256_maskstore_ps(to, reinterpret_cast<__m256i>(first(count)), v);
  }
  static Mask less(Vector a, Vector b) { return reinterpret_cast<Mask>(_mm256_cmp_ps(a, b, _CMP_LT_OQ)); }
  static Mask less_equal(Vector a, Vector b) { return reinterpret_cast<Mask>(_mm256_cmp_ps(a, b, _CMP_LE_OQ)); }
  static Mask equal(Vector a, Vector b) { return reinterpret_cast<Mask>(_mm256_cmp_ps(a, b, _CMP_EQ_OQ)); }
  static Mask both(Mask a, Mask b) { return a & b; }
  static Mask either(Mask a, Mask b) { return a | b; }
  static Mask invert(Mask a) { return ~a; }
  static Vector select(Mask which, Vector a, Vector b) {
    return _mm256_blendv_ps(b, a, reinterpret_cast<__m256>(which));
  }
  static unsigned bits(Mask m) { return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(m))); }
  static Vector sqrt(Vector a) { return _mm256_sqrt_ps(a); }
  static Vector max(Vector a, Vector b) { return _mm256_max_ps(a, b); }
  static Vector min(Vector a, Vector b) { return _mm256_min_ps(a, b); }
  static Vector place(const double* x, int count, double origin, double scale, double shift) {
    using Half = Backend<double>;
    const __m128 low = _mm256_cvtpd_ps(Half::place(x, count, origin, scale, shift));
    const __m128 high = _mm256_cvtpd_ps(Half::place(x + 4, count - 4, origin, scale, shift));
    return _mm256_set_m128(high, low);
  }
  static void displace(double* x_new, const double* x, Vector displacement, int count) {
    using Half = Backend<double>;
    Half::displace(x_new, x, _mm256_cvtps_pd(_mm256_castps256_ps128(displacement)), count);
    Half::displace(x_new + 4, x + 4, _mm256_cvtps_pd(_mm256_extractf128_ps(displacement, 1)), count - 4);
  }
};

}  // namespace mpm
