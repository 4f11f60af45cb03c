// The loops that loops_*.cpp compile for their instruction set. Everything is local to the including file.
//
// The compiler cannot remove the work: in every iteration each accumulator passes through an empty asm statement that
// might change it, so that no iteration can be left out or done ahead. The asm holds no instruction, and the numbers
// stay in registers. Each sweep of the triad ends in an asm statement that might read all memory.
#pragma once

#include "loops.hpp"

namespace roofline {
namespace {

/// Enough to hide the latency of two units that take 4 cycles each, few enough for 16 registers.
constexpr int kChains = 12;

template <class Real, int bytes>
double multiply_add(long turns) {
  typedef Real Register __attribute__((vector_size(bytes)));
  constexpr int kLanes = bytes / static_cast<int>(sizeof(Real));
  // x converges to the fixed point of x = f x + g: no overflow, and no denormal numbers, which would take longer.
  Register f = Register{} + Real(0.5), g = Register{} + Real(0.5), x[kChains];
#pragma GCC unroll 12
  for (int k = 0; k < kChains; ++k) x[k] = Register{} + Real(k + 1);
  for (long turn = 0; turn < turns; ++turn) {
#pragma GCC unroll 12
    for (int k = 0; k < kChains; ++k) {
      x[k] = x[k] * f + g;
      asm volatile("" : "+v"(x[k]));
    }
  }
  return static_cast<double>(turns) * kChains * kLanes;
}

template <int bytes>
void triad(double* a, const double* b, const double* c, std::size_t n, long turns) {
  typedef double Register __attribute__((vector_size(bytes), aligned(8), may_alias));
  constexpr std::size_t kLanes = bytes / sizeof(double);
  for (long turn = 0; turn < turns; ++turn) {
    for (std::size_t i = 0; i + kLanes <= n; i += kLanes) {
      *reinterpret_cast<Register*>(a + i) =
          *reinterpret_cast<const Register*>(b + i) + 3.0 * *reinterpret_cast<const Register*>(c + i);
    }
    asm volatile("" : : "r"(a) : "memory");
  }
}

}  // namespace
}  // namespace roofline
