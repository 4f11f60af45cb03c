// What loops_*.cpp define for their instruction set. Include in the anonymous namespace's place: everything is local.
//
// The compiler cannot remove the work: every accumulator passes through an empty asm statement that it must take for a
// change, at every turn, so no turn can be left out or done ahead; the asm holds no instruction, and the numbers stay
// in registers. Sweeps of the triad end in one that may have read all memory.
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
  // Toward the fixed point x = f x + g: neither overflow nor denormal numbers, which take longer.
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
